// What a camera's tables of the air are like.

// Half floats are dense from 6e-5 to 6e4: radiance of Earth's sky from a night to the sun's aureole, times this.
const SKY_VIEW_SCALE: f32 = 4096.0;

// The two layers of a texel of the sky all round, in three words.
fn sky_view_packed(soft: vec3<f32>, mie: vec3<f32>) -> vec4<u32> {
    let a = min(soft * SKY_VIEW_SCALE, vec3<f32>(6e4));
    let b = min(mie * SKY_VIEW_SCALE, vec3<f32>(6e4));
    return vec4<u32>(pack2x16float(a.rg), pack2x16float(vec2<f32>(a.b, b.r)), pack2x16float(b.gb), 0u);
}

fn sky_view_unpacked(texel: vec4<u32>, layer: u32) -> vec3<f32> {
    let shared_word = unpack2x16float(texel.y);
    if (layer == 0u) {
        return vec3<f32>(unpack2x16float(texel.x), shared_word.x) / SKY_VIEW_SCALE;
    }
    return vec3<f32>(shared_word.y, unpack2x16float(texel.z)) / SKY_VIEW_SCALE;
}

// Aerial perspective as a table, for one altitude and one sun: directions as the sky view's, coarser, and slices over distance, which
// crowd quadratically at the camera.

const AERIAL_AZIMUTHS: u32 = 32u;
const AERIAL_ABOVE: u32 = 16u;
const AERIAL_BELOW: u32 = 20u;
const AERIAL_SLICES: u32 = 24u;

// The table's coordinates, in texels' own 0 to 1, of a ray and a distance along it.
fn aerial_coordinates(medium: Medium, view: SkyRay, distance: f32, far: f32) -> vec3<f32> {
    let ground = hits_ground(medium.radius, view.h, view.mu);
    let uv = sky_view_coordinates(medium, view, ground);
    let rows = select(f32(AERIAL_ABOVE), f32(AERIAL_BELOW), ground);
    let row = select(0.0, f32(AERIAL_ABOVE), ground) + 0.5 + clamp(uv.y, 0.0, 1.0) * (rows - 1.0);
    return vec3<f32>(
        (0.5 + clamp(uv.x, 0.0, 1.0) * f32(AERIAL_AZIMUTHS - 1u)) / f32(AERIAL_AZIMUTHS),
        row / f32(AERIAL_ABOVE + AERIAL_BELOW),
        (0.5 + sqrt(clamp(distance / far, 0.0, 1.0)) * f32(AERIAL_SLICES - 1u)) / f32(AERIAL_SLICES));
}

// How far a slice is.
fn aerial_distance(slice: u32, far: f32) -> f32 {
    let part = f32(slice) / f32(AERIAL_SLICES - 1u);
    return far * part * part;
}
