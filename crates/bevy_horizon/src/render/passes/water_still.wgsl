// Water without waves.

fn wave_height(body: u32, at: vec2<f32>, footprint: f32) -> f32 {
    return 0.0;
}

struct WaveShape {
    slope: vec2<f32>,
    // Of the slopes within the footprint.
    variance: vec2<f32>,
    foam: f32,
}

fn wave_shape(body: u32, at: vec2<f32>, along: vec2<f32>, across: vec2<f32>) -> WaveShape {
    return WaveShape(vec2<f32>(0.0), vec2<f32>(0.0), 0.0);
}

// The gradient of the surface's slopes: xx, zz, xz.
fn wave_bend(body: u32, at: vec2<f32>, width: f32) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn foam_clumps(body: u32, at: vec2<f32>, footprint: f32) -> f32 {
    return 0.5;
}
