// How much of the sun's disc a point sees, in 16 bits for one point in 2 × 2 texels: a byte that says how far the ground hides
// the disc there, and one that says over what height above the ground the penumbra goes by, so that what stands above the ground is
// lit as its own height has it. Needs surface.wgsl.

// log2 of the lowest penumbra that is kept, in metres, and of the ratio to the highest.
const PENUMBRA_LOW: f32 = -10.0;
const PENUMBRA_SPAN: f32 = 24.0;
// log2 of the deepest shadow that is kept, in penumbras.
const DEEPEST: f32 = 14.0;

// The part of a disc of radius 1 that lies above a line at height x.
fn disc_above(x: f32) -> f32 {
    let c = clamp(x, -1.0, 1.0);
    return 0.5 - (c * sqrt(1.0 - c * c) + asin(c)) / 3.14159265;
}

// The height of the line above which that part lies, within 0.01.
fn line_under(part: f32) -> f32 {
    let y = 1.0 - 2.0 * part;
    return y * (0.785 + 0.215 * y * y);
}

// `x` is how high the ground stands before the disc, in its radii; `penumbra` how many metres further up that is one less.
fn packed_sun(x: f32, penumbra: f32) -> u32 {
    let seen = floor(127.0 * disc_above(x) + 0.5);
    let deep = 128.0 + floor(clamp(log2(max(x, 1.0)) / DEEPEST, 0.0, 1.0) * 127.0 + 0.5);
    let high = clamp((log2(max(penumbra, 1e-9)) - PENUMBRA_LOW) / PENUMBRA_SPAN, 0.0, 1.0);
    return u32(select(seen, deep, x >= 1.0)) | (u32(floor(high * 255.0 + 0.5)) << 8u);
}

// The part of the disc that is seen from so many metres above the ground.
fn unpacked_sun(word: u32, above: f32) -> f32 {
    let code = word & 255u;
    let seen = select(0.0, f32(code) / 127.0, code < 128u);
    if (above <= 0.0 || code == 127u) {
        return seen;
    }
    let x = select(exp2(f32(code - 128u) / 127.0 * DEEPEST), line_under(seen), code < 128u);
    return disc_above(x - above / unpacked_penumbra(word));
}

// Over what height that changes by a radius of the disc, in metres.
fn unpacked_penumbra(word: u32) -> f32 {
    return exp2(f32(word >> 8u) / 255.0 * PENUMBRA_SPAN + PENUMBRA_LOW);
}
