// A view of the world: its rays, and what lights it. Nothing in here is an absolute coordinate.

struct HorizonView {
    view_from_clip: mat4x4<f32>,
    clip_from_view: mat4x4<f32>,
    // The columns of the camera's rotation.
    right: vec3<f32>,
    up: vec3<f32>,
    back: vec3<f32>,
    // From the clipmap's centre; y above the datum.
    eye: vec3<f32>,
    // Origin and size, in pixels of the target.
    viewport: vec4<f32>,
    // Towards the sun, while any of its disc stands over the level.
    sun_direction: vec3<f32>,
    exposure: f32,
    // Illuminance of the sun, in lux; luminance of the ambient light, in cd/m².
    sun: vec3<f32>,
    far: f32,
    ambient: vec3<f32>,
    debug: u32,
    // Radians per pixel (metres per pixel where orthographic).
    pixel: f32,
    orthographic: u32,
    // The clearance table: its least slope (as v = m / (1 + |m|)), and bins per unit of v.
    slopes: vec2<f32>,
    // Its first column, how many there are (none: no table), and columns in each quadrant.
    columns: vec3<u32>,
    // Its rings: the radius that the first would have, and the binary logarithm of the ratio of two.
    rings: vec2<f32>,
    // 1 where the ground may have holes.
    holes: u32,
    // Towards the sun, wherever it stands.
    sun_towards: vec3<f32>,
    // 1 where the cache knows how the ground hides the sun; 2 where the ground hides all of a sun that is down.
    self_shadow: u32,
    // From the eye's offsets, along the world's axes, to clip space without jitter: now, and in the last frame.
    clip_from_offset: mat4x4<f32>,
    previous_clip_from_offset: mat4x4<f32>,
}

// Slopes in a column of the clearance table.
const BINS: u32 = 256u;

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let uv = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0;
    return vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 0.0, 1.0);
}

fn ndc_of(position: vec4<f32>) -> vec2<f32> {
    let uv = (position.xy - view.viewport.xy) / view.viewport.zw;
    return vec2<f32>(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0);
}

// The point of view space at a depth of the reverse-z buffer.
fn view_point(ndc: vec2<f32>, depth: f32) -> vec3<f32> {
    let p = view.view_from_clip * vec4<f32>(ndc, depth, 1.0);
    return p.xyz / p.w;
}

fn world_direction(v: vec3<f32>) -> vec3<f32> {
    return view.right * v.x + view.up * v.y + view.back * v.z;
}
