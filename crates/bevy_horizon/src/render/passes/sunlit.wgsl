// How much of the sun's disc a point on or above the ground sees. Needs surface.wgsl, sun_seen.wgsl, and look.wgsl (for the buffer).

fn light_word(l: Level, cell: vec2<i32>) -> u32 {
    let at = wrapped(l, cell);
    let texel = (at & vec2<u32>(TILE - 1u)) >> vec2<u32>(1u);
    let i = (texel.y << 5u) + texel.x;
    return (looks[tile_of(l, at) * TILE_LOOKS + LIGHTS_AT + (i >> 1u)] >> (16u * (i & 1u))) & 0xffffu;
}

// What one level holds: its lattice has every other texel.
fn level_sun(l: Level, p: vec2<f32>, above: f32) -> f32 {
    let at = p * l.per_metre + l.fraction;
    let cell = vec2<i32>(floor(at));
    let odd = (l.base + cell) & vec2<i32>(1);
    let even = cell - odd;
    let g = 0.5 * (vec2<f32>(odd) + at - floor(at));
    return between_corners(vec4<f32>(
        unpacked_sun(light_word(l, even), above), unpacked_sun(light_word(l, even + vec2<i32>(2, 0)), above),
        unpacked_sun(light_word(l, even + vec2<i32>(0, 2)), above), unpacked_sun(light_word(l, even + vec2<i32>(2, 2)), above)), g.x, g.y);
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
