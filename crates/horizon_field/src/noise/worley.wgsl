// Cellular noise; the twin of worley.rs, which derives the jitter. Returns (value, gradient per lattice unit).

// 2 / max F1, and half the jitter.
const WORLEY_SLOPE2: f32 = 1.697056274847714;
const WORLEY_SLOPE3: f32 = 1.539600717839002;
const WORLEY_REACH2: f32 = 0.3333333333333333;
const WORLEY_REACH3: f32 = 0.25;

// The nearer one of the nearest point so far and the point of one more cell, whose centre is at `centre`: the vector
// from the point to the place, and the square of its length.
fn worley_offer2(nearest: vec3<f32>, f: vec2<f32>, centre: vec2<f32>, hash: u32) -> vec3<f32> {
    let v = (vec2<f32>(f32(hash & 0xffffu), f32(hash >> 16u)) - 32767.5) * (1.0 / 32768.0);
    let d = f - centre - v * WORLEY_REACH2;
    let square = d.x * d.x + d.y * d.y;
    return select(nearest, vec3<f32>(d, square), square < nearest.z);
}

fn worley_offer3(nearest: vec4<f32>, f: vec3<f32>, centre: vec3<f32>, hash: u32) -> vec4<f32> {
    let bits = vec3<f32>(f32(hash & 0x7ffu), f32((hash >> 11u) & 0x7ffu), f32(hash >> 22u));
    let v = (bits - vec3<f32>(1023.5, 1023.5, 511.5)) * vec3<f32>(1.0 / 1024.0, 1.0 / 1024.0, 1.0 / 512.0);
    let d = f - centre - v * WORLEY_REACH3;
    let square = d.x * d.x + d.y * d.y + d.z * d.z;
    return select(nearest, vec4<f32>(d, square), square < nearest.w);
}

// The hash of the axis at the coordinate (lo, hi) + i - 1.
fn worley_axis(lo: u32, hi: u32, i: u32, seed: u32) -> u32 {
    let sum = lo + i;
    let carry = select(0u, 1u, sum < lo);
    let borrow = select(0u, 1u, sum == 0u);
    return hash_axis(sum - 1u, hi + carry - borrow, seed);
}

fn worley2(p: LatticePoint2, seed: u32) -> vec3<f32> {
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let x0 = worley_axis(p.lo.x, p.hi.x, 0u, seed_x);
    let x1 = worley_axis(p.lo.x, p.hi.x, 1u, seed_x);
    let x2 = worley_axis(p.lo.x, p.hi.x, 2u, seed_x);
    var nearest = vec3<f32>(0.0, 0.0, 100.0);
    for (var j = 0u; j < 3u; j++) {
        let hash_y = worley_axis(p.lo.y, p.hi.y, j, seed_y);
        let y = f32(j) - 0.5;
        nearest = worley_offer2(nearest, p.fraction, vec2<f32>(-0.5, y), hash_mix2(x0, hash_y));
        nearest = worley_offer2(nearest, p.fraction, vec2<f32>(0.5, y), hash_mix2(x1, hash_y));
        nearest = worley_offer2(nearest, p.fraction, vec2<f32>(1.5, y), hash_mix2(x2, hash_y));
    }
    let distance = sqrt(nearest.z);
    return vec3<f32>(distance * WORLEY_SLOPE2 - 1.0, nearest.xy * (WORLEY_SLOPE2 / max(distance, 1e-20)));
}

fn worley3(p: LatticePoint3, seed: u32) -> vec4<f32> {
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let seed_z = hash_axis_seed(seed, 2u);
    let x0 = worley_axis(p.lo.x, p.hi.x, 0u, seed_x);
    let x1 = worley_axis(p.lo.x, p.hi.x, 1u, seed_x);
    let x2 = worley_axis(p.lo.x, p.hi.x, 2u, seed_x);
    var nearest = vec4<f32>(0.0, 0.0, 0.0, 100.0);
    for (var k = 0u; k < 3u; k++) {
        let hash_z = worley_axis(p.lo.z, p.hi.z, k, seed_z);
        let z = f32(k) - 0.5;
        for (var j = 0u; j < 3u; j++) {
            let hash_y = worley_axis(p.lo.y, p.hi.y, j, seed_y);
            let y = f32(j) - 0.5;
            nearest = worley_offer3(nearest, p.fraction, vec3<f32>(-0.5, y, z), hash_mix3(x0, hash_y, hash_z));
            nearest = worley_offer3(nearest, p.fraction, vec3<f32>(0.5, y, z), hash_mix3(x1, hash_y, hash_z));
            nearest = worley_offer3(nearest, p.fraction, vec3<f32>(1.5, y, z), hash_mix3(x2, hash_y, hash_z));
        }
    }
    let distance = sqrt(nearest.w);
    return vec4<f32>(distance * WORLEY_SLOPE3 - 1.0, nearest.xyz * (WORLEY_SLOPE3 / max(distance, 1e-20)));
}
