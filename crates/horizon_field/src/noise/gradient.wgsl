// Gradient noise; the twin of gradient.rs. Returns (value, gradient per lattice unit).

// A corner's linear function at the distance d: its value, then its gradient, whose components lie in (-1, 1).
fn gradient_linear2(hash: u32, d: vec2<f32>) -> vec3<f32> {
    let g = (vec2<f32>(f32(hash & 0xffffu), f32(hash >> 16u)) - 32767.5) * (1.0 / 32768.0);
    return vec3<f32>(g.x * d.x + g.y * d.y, g);
}

fn gradient_linear3(hash: u32, d: vec3<f32>) -> vec4<f32> {
    let bits = vec3<f32>(f32(hash & 0x7ffu), f32((hash >> 11u) & 0x7ffu), f32(hash >> 22u));
    let g = (bits - vec3<f32>(1023.5, 1023.5, 511.5)) * vec3<f32>(1.0 / 1024.0, 1.0 / 1024.0, 1.0 / 512.0);
    return vec4<f32>(g.x * d.x + g.y * d.y + g.z * d.z, g);
}

fn gradient2(p: LatticePoint2, seed: u32) -> vec3<f32> {
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
    let a = gradient_linear2(hash_mix2(x0, y0), f);
    let b = gradient_linear2(hash_mix2(x1, y0), vec2<f32>(r.x, f.y));
    let c = gradient_linear2(hash_mix2(x0, y1), vec2<f32>(f.x, r.y));
    let d = gradient_linear2(hash_mix2(x1, y1), r);
    // Each blend moves the value by its factor's slope as well.
    let row = a + t.x * (b - a) + vec3<f32>(0.0, (b.x - a.x) * dt.x, 0.0);
    let next = c + t.x * (d - c) + vec3<f32>(0.0, (d.x - c.x) * dt.x, 0.0);
    return row + t.y * (next - row) + vec3<f32>(0.0, 0.0, (next.x - row.x) * dt.y);
}

// One layer of corners in space, at the distance z from the point along z: (value, gradient).
fn gradient_layer(
    x0: u32, x1: u32, y0: u32, y1: u32, hash_z: u32, f: vec2<f32>, z: f32, t: vec3<f32>, dt: vec3<f32>,
) -> vec4<f32> {
    let r = f - 1.0;
    let a = gradient_linear3(hash_mix3(x0, y0, hash_z), vec3<f32>(f, z));
    let b = gradient_linear3(hash_mix3(x1, y0, hash_z), vec3<f32>(r.x, f.y, z));
    let c = gradient_linear3(hash_mix3(x0, y1, hash_z), vec3<f32>(f.x, r.y, z));
    let d = gradient_linear3(hash_mix3(x1, y1, hash_z), vec3<f32>(r, z));
    let row = a + t.x * (b - a) + vec4<f32>(0.0, (b.x - a.x) * dt.x, 0.0, 0.0);
    let next = c + t.x * (d - c) + vec4<f32>(0.0, (d.x - c.x) * dt.x, 0.0, 0.0);
    return row + t.y * (next - row) + vec4<f32>(0.0, 0.0, (next.x - row.x) * dt.y, 0.0);
}

fn gradient3(p: LatticePoint3, seed: u32) -> vec4<f32> {
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
    let near = gradient_layer(x0, x1, y0, y1, hash_axis(p.lo.z, p.hi.z, seed_z), f.xy, f.z, t, dt);
    let far = gradient_layer(x0, x1, y0, y1, hash_axis(lo.z, hi.z, seed_z), f.xy, r.z, t, dt);
    let n = near + t.z * (far - near) + vec4<f32>(0.0, 0.0, 0.0, (far.x - near.x) * dt.z);
    return n * (2.0 / 3.0);
}
