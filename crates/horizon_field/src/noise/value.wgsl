// Value noise; the twin of value.rs. Returns (value, gradient per lattice unit).

// A number in [-1, 1), from the hash's top 24 bits.
fn value_signed(hash: u32) -> f32 {
    return f32(hash >> 8u) * (1.0 / 8388608.0) - 1.0;
}

// Along an edge from a to b: (value, derivative).
fn value_edge(a: f32, b: f32, t: f32, dt: f32) -> vec2<f32> {
    return vec2<f32>(a + t * (b - a), (b - a) * dt);
}

fn value2(p: LatticePoint2, seed: u32) -> vec3<f32> {
    let lo = p.lo + 1u;
    let hi = p.hi + select(vec2<u32>(0u), vec2<u32>(1u), lo == vec2<u32>(0u));
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let x0 = hash_axis(p.lo.x, p.hi.x, seed_x);
    let x1 = hash_axis(lo.x, hi.x, seed_x);
    let y0 = hash_axis(p.lo.y, p.hi.y, seed_y);
    let y1 = hash_axis(lo.y, hi.y, seed_y);

    let f = p.fraction;
    let r = f - 1.0;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let dt = 30.0 * f * f * r * r;
    let row = value_edge(value_signed(hash_mix2(x0, y0)), value_signed(hash_mix2(x1, y0)), t.x, dt.x);
    let next = value_edge(value_signed(hash_mix2(x0, y1)), value_signed(hash_mix2(x1, y1)), t.x, dt.x);
    return vec3<f32>(row + t.y * (next - row), (next.x - row.x) * dt.y);
}

// One layer of corners in space: (value, d/dx, d/dy).
fn value_layer(x0: u32, x1: u32, y0: u32, y1: u32, z: u32, t: vec3<f32>, dt: vec3<f32>) -> vec3<f32> {
    let row = value_edge(value_signed(hash_mix3(x0, y0, z)), value_signed(hash_mix3(x1, y0, z)), t.x, dt.x);
    let next = value_edge(value_signed(hash_mix3(x0, y1, z)), value_signed(hash_mix3(x1, y1, z)), t.x, dt.x);
    return vec3<f32>(row + t.y * (next - row), (next.x - row.x) * dt.y);
}

fn value3(p: LatticePoint3, seed: u32) -> vec4<f32> {
    let lo = p.lo + 1u;
    let hi = p.hi + select(vec3<u32>(0u), vec3<u32>(1u), lo == vec3<u32>(0u));
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let seed_z = hash_axis_seed(seed, 2u);
    let x0 = hash_axis(p.lo.x, p.hi.x, seed_x);
    let x1 = hash_axis(lo.x, hi.x, seed_x);
    let y0 = hash_axis(p.lo.y, p.hi.y, seed_y);
    let y1 = hash_axis(lo.y, hi.y, seed_y);

    let f = p.fraction;
    let r = f - 1.0;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let dt = 30.0 * f * f * r * r;
    let near = value_layer(x0, x1, y0, y1, hash_axis(p.lo.z, p.hi.z, seed_z), t, dt);
    let far = value_layer(x0, x1, y0, y1, hash_axis(lo.z, hi.z, seed_z), t, dt);
    return vec4<f32>(near + t.z * (far - near), (far.x - near.x) * dt.z);
}
