// The ground in a shadow map: patches of quads at the cached heights, depth alone. Quads are some texels of the map wide, so that silhouettes lie where they should; what lies within a quad does not, and so every vertex is
// pushed away from the light by more than that, along the light, which moves no silhouette. Needs surface.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
// Named by surface.wgsl alone.
@group(0) @binding(2) var<storage, read> bounds: array<u32>;

struct Light {
    // From the passes' coordinates to the map's clip space.
    clip_from_ground: mat4x4<f32>,
    // Where the light is, in the passes' coordinates, or, with w = 0, the direction towards it.
    place: vec4<f32>,
}

struct Patch {
    level: u32,
    // Texels along a quad.
    quad: i32,
    // The first cell, relative to the centre's.
    cell: vec2<i32>,
}

@group(0) @binding(4) var<storage, read> patches: array<Patch>;
@group(0) @binding(5) var<uniform> light: Light;

// The texel at a vertex of a patch.
fn vertex_cell(one: Patch, vertex: u32) -> vec2<i32> {
    let l = clipmap.levels[one.level];
    let corner = one.cell + vec2<i32>(vec2<u32>(vertex % CAST_VERTICES, vertex / CAST_VERTICES)) * one.quad;
    return clamp(corner, l.low, l.high - vec2<i32>(1));
}

// Where that lies in the map.
fn in_map(one: Patch, cell: vec2<i32>) -> vec4<f32> {
    let l = clipmap.levels[one.level];
    let at = (vec2<f32>(cell) - l.fraction) * l.texel;
    let p = vec3<f32>(at.x, stored_height(l, cell), at.y);
    let to_light = normalize(light.place.xyz - p * light.place.w);
    var clip = light.clip_from_ground * vec4<f32>(p - to_light * (CAST_PUSH * f32(one.quad) * l.texel), 1.0);
    if (light.place.w == 0.0) {
        // What stands between the light and a cascade casts into it from its near plane.
        clip.z = min(clip.z, clip.w);
    }
    return clip;
}

@vertex
fn cast_ground(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4<f32> {
    let one = patches[instance];
    return in_map(one, vertex_cell(one, vertex));
}
