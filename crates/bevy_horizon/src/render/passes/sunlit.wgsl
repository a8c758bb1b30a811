// How much of the sun's disc a point on or above the ground sees. Needs surface.wgsl, sun_seen.wgsl, and look.wgsl (for the buffer).

fn light_word(l: Level, cell: vec2<i32>) -> u32 {
    let at = wrapped(l, cell);
    let texel = (at & vec2<u32>(TILE - 1u)) >> vec2<u32>(1u);
    let i = (texel.y << 5u) + texel.x;
    return (looks[tile_of(l, at) * TILE_LOOKS + LIGHTS_AT + (i >> 1u)] >> (16u * (i & 1u))) & 0xffffu;
}

// What one level holds: its lattice has every other texel. Over the ground it is the shadow's depth that lies between those of the
// lattice; what the points of the lattice see of the sun from so high up would make an edge as wide as the lattice.
fn level_sun(l: Level, p: vec2<f32>, above: f32) -> f32 {
    let at = p * l.per_metre + l.fraction;
    let cell = vec2<i32>(floor(at));
    let odd = (l.base + cell) & vec2<i32>(1);
    let even = cell - odd;
    let g = 0.5 * (vec2<f32>(odd) + at - floor(at));
    let a = light_word(l, even);
    let b = light_word(l, even + vec2<i32>(2, 0));
    let c = light_word(l, even + vec2<i32>(0, 2));
    let d = light_word(l, even + vec2<i32>(2, 2));
    if (above <= 0.0) {
        return between_corners(vec4<f32>(unpacked_seen(a), unpacked_seen(b), unpacked_seen(c), unpacked_seen(d)), g.x, g.y);
    }
    let depth = between_corners(vec4<f32>(unpacked_depth(a), unpacked_depth(b), unpacked_depth(c), unpacked_depth(d)), g.x, g.y);
    let penumbra = between_corners(
        vec4<f32>(unpacked_penumbra(a), unpacked_penumbra(b), unpacked_penumbra(c), unpacked_penumbra(d)), g.x, g.y);
    return disc_above((depth - above) / penumbra);
}

fn sun_seen_from(level: u32, p: vec2<f32>, above: f32) -> f32 {
    let l = clipmap.levels[level];
    let w = blend_at(l, p * l.per_metre + l.fraction);
    let seen = level_sun(l, p, above);
    if (w <= 0.0) {
        return seen;
    }
    return mix(seen, level_sun(clipmap.levels[level + 1u], p, above), w);
}

// How high the penumbra is over a point, in metres.
fn penumbra_at(level: u32, p: vec2<f32>) -> f32 {
    let l = clipmap.levels[level];
    return unpacked_penumbra(light_word(l, vec2<i32>(floor(p * l.per_metre + l.fraction))));
}
