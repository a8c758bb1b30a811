// The geometry's surfaces, as Bevy's prepass has them: normal, motion vector, G-buffer and lighting id. What a view has no
// target for is dropped. Needs seen_in() of whole.wgsl or upsample.wgsl, and motion.wgsl.

struct Ground {
    @location(0) normal: vec4<f32>,
    @location(1) motion: vec2<f32>,
    @location(2) surfaces: vec4<u32>,
    @location(3) lighting: u32,
    @builtin(frag_depth) depth: f32,
}

// A unit vector on the octahedron, unfolded into a square of 0 to 1 (Cigolle et al. 2014), as Bevy's G-buffer has it.
fn octahedral(v: vec3<f32>) -> vec2<f32> {
    let n = v / (abs(v.x) + abs(v.y) + abs(v.z));
    let folded = (1.0 - abs(n.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), n.xy > vec2<f32>(0.0));
    return select(folded, n.xy, n.z >= 0.0) * 0.5 + 0.5;
}

// Bevy's G-buffer: base colour and perceptual roughness; emission; reflectance, metallic, occlusion; normal and flags: lit,
// fogged, a receiver of shadows.
fn surfaces_of(look: Look) -> vec4<u32> {
    let base = pack4x8unorm(vec4<f32>(pow(look.albedo, vec3<f32>(1.0 / 2.2)), look.roughness));
    let finish = pack4x8unorm(vec4<f32>(look.reflectance, 0.0, 1.0, 0.0));
    let n = vec2<u32>(clamp(octahedral(look.normal), vec2<f32>(0.0), vec2<f32>(1.0)) * 4095.0 + 0.5);
    return vec4<u32>(base, 0u, finish, n.x | (n.y << 12u) | (6u << 24u));
}

@fragment
fn ground(@builtin(position) position: vec4<f32>) -> Ground {
    let pixel = pixel_ray(position);
    let seen = seen_in(pixel, position);
    if (seen.t < 0.0) {
        discard;
    }
    let p = pixel.ray.origin + pixel.ray.direction * seen.t;
    let look = look_at(min(level_at(p.xz), clipmap.count - 1u), p.xz);
    return Ground(vec4<f32>(look.normal * 0.5 + 0.5, 1.0), motion_of(p - view.eye), surfaces_of(look), 1u, seen.depth);
}
