// How much of the sun's disc a point sees, in 16 bits for one point in 2 × 2 texels: how far the ground hides the disc there, and over
// what height above the ground the penumbra goes by, so that what stands above the ground is lit as its own height has it. While
// some of the disc is seen, that are 7 bits of its part and 8 of the penumbra; behind a set bit, 10 of how deep the point lies in
// the shadow and 5 of the penumbra: an edge on what stands there is off by half a percent of its height. Needs surface.wgsl.

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

const DEEP: u32 = 0x8000u;

// A penumbra of so many metres as a part of the span, and back.
fn penumbra_part(penumbra: f32) -> f32 {
    return clamp((log2(max(penumbra, 1e-9)) - PENUMBRA_LOW) / PENUMBRA_SPAN, 0.0, 1.0);
}

fn penumbra_of(part: f32) -> f32 {
    return exp2(part * PENUMBRA_SPAN + PENUMBRA_LOW);
}

// `x` is how high the ground stands before the disc, in its radii; `penumbra` how many metres further up that is one less.
fn packed_sun(x: f32, penumbra: f32) -> u32 {
    let part = penumbra_part(penumbra);
    if (x >= 1.0) {
        let width = floor(part * 31.0 + 0.5);
        // In penumbras as they will be read: the depth is no coarser for them.
        let deep = max(x * penumbra / penumbra_of(width / 31.0), 1.0);
        return DEEP | (u32(width) << 10u) | u32(floor(clamp(log2(deep) / DEEPEST, 0.0, 1.0) * 1023.0 + 0.5));
    }
    return (u32(floor(part * 255.0 + 0.5)) << 7u) | u32(floor(127.0 * disc_above(x) + 0.5));
}

// The part of the disc that the ground sees.
fn unpacked_seen(word: u32) -> f32 {
    return select(f32(word & 127u) / 127.0, 0.0, word >= DEEP);
}

// Over what height that changes by a radius of the disc, in metres.
fn unpacked_penumbra(word: u32) -> f32 {
    return penumbra_of(select(f32(word >> 7u) / 255.0, f32((word >> 10u) & 31u) / 31.0, word >= DEEP));
}

// How far over the ground the disc's centre comes into sight, in metres; negative, by at most a penumbra, where the ground sees it.
fn unpacked_depth(word: u32) -> f32 {
    let x = select(line_under(unpacked_seen(word)), exp2(f32(word & 1023u) / 1023.0 * DEEPEST), word >= DEEP);
    return x * unpacked_penumbra(word);
}
