// The waves' tiles, as a view reads them. Needs water_bodies.wgsl, and WAVE_GRID, texels along a tile.

@group(0) @binding(21) var wave_surface: texture_2d_array<f32>;
@group(0) @binding(22) var wave_moments: texture_2d_array<f32>;
@group(0) @binding(23) var wave_sampler: sampler;

// The surface over its level, relative to the eye at `at`. Waves that a footprint swallows fade out.
fn wave_height(body: u32, at: vec2<f32>, footprint: f32) -> f32 {
    var height = 0.0;
    for (var i = 0u; i < waters.bodies[body].count; i++) {
        let cascade = waters.bodies[body].cascades[i];
        let seen = cascade.bound / max(footprint, 1e-6);
        if (seen < 0.25) {
            continue;
        }
        let texels = footprint * cascade.per_metre * WAVE_GRID;
        let uv = cascade.phase + at * cascade.per_metre;
        let h = textureSampleLevel(wave_surface, wave_sampler, uv, cascade.layer, log2(max(texels, 1.0))).x;
        height += h * smoothstep(0.25, 0.5, seen);
    }
    return height;
}

struct WaveShape {
    slope: vec2<f32>,
    // Of the slopes within the footprint.
    variance: vec2<f32>,
    foam: f32,
}

// The slopes in a footprint, by its two axes: their mean, and what is filtered away (Bruneton et al. 2010).
fn wave_shape(body: u32, at: vec2<f32>, along: vec2<f32>, across: vec2<f32>) -> WaveShape {
    var shape = WaveShape(vec2<f32>(0.0), vec2<f32>(0.0), 0.0);
    for (var i = 0u; i < waters.bodies[body].count; i++) {
        let cascade = waters.bodies[body].cascades[i];
        let uv = cascade.phase + at * cascade.per_metre;
        let dx = along * cascade.per_metre;
        let dy = across * cascade.per_metre;
        let s = textureSampleGrad(wave_surface, wave_sampler, uv, cascade.layer, dx, dy);
        let m = textureSampleGrad(wave_moments, wave_sampler, uv, cascade.layer, dx, dy);
        shape.slope += s.yz;
        shape.variance += max(m.xy - s.yz * s.yz, vec2<f32>(0.0));
        // Crests draw together long before they break.
        shape.foam = max(shape.foam, smoothstep(0.35, 0.75, s.w));
    }
    return shape;
}

// The gradient of the surface's slopes: xx, zz, xz, as seen with waves narrower than `width` smoothed away.
fn wave_bend(body: u32, at: vec2<f32>, width: f32) -> vec3<f32> {
    var bend = vec3<f32>(0.0);
    for (var i = 0u; i < waters.bodies[body].count; i++) {
        let cascade = waters.bodies[body].cascades[i];
        let texels = max(width * cascade.per_metre * WAVE_GRID, 1.0);
        if (texels > 0.25 * WAVE_GRID) {
            continue;
        }
        let lod = log2(texels);
        let uv = cascade.phase + at * cascade.per_metre;
        let h = texels / WAVE_GRID;
        let x = textureSampleLevel(wave_surface, wave_sampler, uv + vec2<f32>(h, 0.0), cascade.layer, lod).yz
            - textureSampleLevel(wave_surface, wave_sampler, uv - vec2<f32>(h, 0.0), cascade.layer, lod).yz;
        let z = textureSampleLevel(wave_surface, wave_sampler, uv + vec2<f32>(0.0, h), cascade.layer, lod).yz
            - textureSampleLevel(wave_surface, wave_sampler, uv - vec2<f32>(0.0, h), cascade.layer, lod).yz;
        bend += vec3<f32>(x.x, z.y, 0.5 * (x.y + z.x)) * (0.5 / h * cascade.per_metre);
    }
    return bend;
}

// Clumps of foam, 0 to 1: the finest waves' heights, at two scales.
fn foam_clumps(body: u32, at: vec2<f32>, footprint: f32) -> f32 {
    let cascade = waters.bodies[body].cascades[max(waters.bodies[body].count, 1u) - 1u];
    let uv = (cascade.phase + at * cascade.per_metre);
    let lod = log2(max(footprint * cascade.per_metre * WAVE_GRID, 1.0));
    let a = textureSampleLevel(wave_surface, wave_sampler, 2.0 * uv, cascade.layer, lod + 1.0).x;
    let b = textureSampleLevel(wave_surface, wave_sampler, uv.yx, cascade.layer, lod).x;
    return clamp(0.5 + 1.5 * (a + b) / max(cascade.bound, 1e-6), 0.0, 1.0);
}
