// What the passes of the waves share. A layer is a tile of a sea. Needs the constants of horizon_field's waves.

struct Layer {
    // Metres between texels.
    texel: f32,
    // No height is further from 0.
    bound: f32,
    choppiness: f32,
}

// The time, in 2⁻³² of a period.
@group(0) @binding(0) var<uniform> clock: vec4<u32>;
@group(0) @binding(1) var<storage, read> layers: array<Layer>;
// e^(2πi m / GRID).
@group(0) @binding(2) var<storage, read> roots: array<vec2<f32>>;
// Of each wave vector: the complex amplitude at the time 0, and the beats.
@group(0) @binding(3) var<storage, read> modes: array<vec4<f32>>;
// Rows of wave vectors, transformed along x.
@group(0) @binding(4) var<storage, read_write> rows: array<vec4<f32>>;
// Height, displacement along x and z, in the water's own frame.
@group(0) @binding(5) var<storage, read_write> grid: array<vec4<f32>>;
// Height and foam over the plane.
@group(0) @binding(6) var<storage, read_write> over: array<vec2<f32>>;
