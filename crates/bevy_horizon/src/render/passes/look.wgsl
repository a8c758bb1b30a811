// What the ground looks like where it was found: the cache's normal, albedo, roughness and reflectance, and how much of the sun's
// disc it sees, interpolated, each level blended into the next as the heights are. Needs surface.wgsl and sun_seen.wgsl.

@group(0) @binding(3) var<storage, read> looks: array<u32>;

struct Look {
    normal: vec3<f32>,
    albedo: vec3<f32>,
    // Perceptual, and Bevy's reflectance.
    roughness: f32,
    reflectance: f32,
}

// The first of the three words in which two texels lie side by side.
fn look_words(texel: u32) -> u32 {
    return (texel / TILE_TEXELS) * TILE_LOOKS + 3u * ((texel & (TILE_TEXELS - 1u)) >> 1u);
}

fn stored_normal(texel: u32) -> vec3<f32> {
    let word = looks[look_words(texel) + 2u] >> (16u * (texel & 1u));
    let xz = (vec2<f32>(f32((word >> 8u) & 255u), f32(word & 255u)) - 127.5) / 127.0;
    return vec3<f32>(xz.x, sqrt(max(1.0 - dot(xz, xz), 1e-4)), xz.y);
}

struct Surface {
    // The albedo's square root.
    colour: vec3<f32>,
    // Roughness and reflectance.
    finish: vec2<f32>,
}

fn stored_surface(texel: u32) -> Surface {
    let word = looks[look_words(texel) + (texel & 1u)];
    return Surface(unpack4x8unorm(word).rgb, vec2<f32>(f32(word >> 27u) / 31.0, f32((word >> 24u) & 7u) / 7.0));
}

// Whether there is no ground around a texel: its roughness is 0, which no ground's is.
fn is_hole(texel: u32) -> bool {
    return looks[look_words(texel) + (texel & 1u)] < 0x08000000u;
}

// What one level holds at a point of the ground.
fn level_look(l: Level, p: vec2<f32>) -> Look {
    let at = p * l.per_metre + l.fraction;
    let cell = vec2<i32>(floor(at));
    let f = at - floor(at);
    let w = vec4<f32>((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    let i = corner_indices(l, cell);
    let normal = w.x * stored_normal(i.x) + w.y * stored_normal(i.y) + w.z * stored_normal(i.z) + w.w * stored_normal(i.w);
    let a = stored_surface(i.x);
    let b = stored_surface(i.y);
    let c = stored_surface(i.z);
    let d = stored_surface(i.w);
    let colour = w.x * a.colour + w.y * b.colour + w.z * c.colour + w.w * d.colour;
    let finish = w.x * a.finish + w.y * b.finish + w.z * c.finish + w.w * d.finish;
    // At a hole's edge the roughness is that of the texels that have ground.
    let there = dot(w, sign(vec4<f32>(a.finish.x, b.finish.x, c.finish.x, d.finish.x)));
    return Look(normal, colour * colour, select(1.0, finish.x / there, there > 0.0), finish.y);
}

fn look_at(level: u32, p: vec2<f32>) -> Look {
    let l = clipmap.levels[level];
    var look = level_look(l, p);
    let w = blend_at(l, p * l.per_metre + l.fraction);
    if (w > 0.0) {
        let c = level_look(clipmap.levels[level + 1u], p);
        look = Look(mix(look.normal, c.normal, w), mix(look.albedo, c.albedo, w),
            mix(look.roughness, c.roughness, w), mix(look.reflectance, c.reflectance, w));
    }
    look.normal = normalize(look.normal);
    return look;
}
