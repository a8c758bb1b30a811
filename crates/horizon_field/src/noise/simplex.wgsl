// Simplex noise; the twin of simplex.rs. Points come in skewed coordinates; returns (value, gradient per skewed unit).

const SIMPLEX_UNSKEW2: f32 = 0.2113248654051871;
const SIMPLEX_UNSKEW3: f32 = 0.16666666666666667;
const SIMPLEX_SCALE2: f32 = 70.0;
const SIMPLEX_SCALE3: f32 = 61.5;

// One corner's share at the distance d, k^4 (g.d) with k = max(1/2 - d^2, 0): its value, then its gradient.
fn simplex_kernel2(hash: u32, d: vec2<f32>) -> vec3<f32> {
    let g = (vec2<f32>(f32(hash & 0xffffu), f32(hash >> 16u)) - 32767.5) * (1.0 / 32768.0);
    let k1 = max(0.5 - (d.x * d.x + d.y * d.y), 0.0);
    let k3 = k1 * k1 * k1;
    let k4 = k3 * k1;
    let along = g.x * d.x + g.y * d.y;
    return vec3<f32>(k4 * along, k4 * g - (8.0 * k3 * along) * d);
}

fn simplex_kernel3(hash: u32, d: vec3<f32>) -> vec4<f32> {
    let bits = vec3<f32>(f32(hash & 0x7ffu), f32((hash >> 11u) & 0x7ffu), f32(hash >> 22u));
    let g = (bits - vec3<f32>(1023.5, 1023.5, 511.5)) * vec3<f32>(1.0 / 1024.0, 1.0 / 1024.0, 1.0 / 512.0);
    let k1 = max(0.5 - (d.x * d.x + d.y * d.y + d.z * d.z), 0.0);
    let k3 = k1 * k1 * k1;
    let k4 = k3 * k1;
    let along = g.x * d.x + g.y * d.y + g.z * d.z;
    return vec4<f32>(k4 * along, k4 * g - (8.0 * k3 * along) * d);
}

fn simplex2(p: LatticePoint2, seed: u32) -> vec3<f32> {
    let lo = p.lo + 1u;
    let hi = p.hi + select(vec2<u32>(0u), vec2<u32>(1u), lo == vec2<u32>(0u));
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let x0 = hash_axis(p.lo.x, p.hi.x, seed_x);
    let x1 = hash_axis(lo.x, hi.x, seed_x);
    let y0 = hash_axis(p.lo.y, p.hi.y, seed_y);
    let y1 = hash_axis(lo.y, hi.y, seed_y);

    // From corner (0, 0) to the second corner the path takes the longer axis first.
    let right = p.fraction.x >= p.fraction.y;
    let side_hash = hash_mix2(select(x0, x1, right), select(y1, y0, right));
    let step = select(vec2<f32>(0.0, 1.0), vec2<f32>(1.0, 0.0), right);
    let g = SIMPLEX_UNSKEW2;
    let d = p.fraction - (p.fraction.x + p.fraction.y) * g;
    let near = simplex_kernel2(hash_mix2(x0, y0), d);
    let side = simplex_kernel2(side_hash, d - step + g);
    let far = simplex_kernel2(hash_mix2(x1, y1), d - 1.0 + (g + g));
    let n = (near + side + far) * SIMPLEX_SCALE2;
    return vec3<f32>(n.x, n.yz - (n.y + n.z) * g);
}

fn simplex3(p: LatticePoint3, seed: u32) -> vec4<f32> {
    let lo = p.lo + 1u;
    let hi = p.hi + select(vec3<u32>(0u), vec3<u32>(1u), lo == vec3<u32>(0u));
    let seed_x = hash_axis_seed(seed, 0u);
    let seed_y = hash_axis_seed(seed, 1u);
    let seed_z = hash_axis_seed(seed, 2u);
    let h0 = vec3<u32>(
        hash_axis(p.lo.x, p.hi.x, seed_x), hash_axis(p.lo.y, p.hi.y, seed_y), hash_axis(p.lo.z, p.hi.z, seed_z));
    let h1 = vec3<u32>(hash_axis(lo.x, hi.x, seed_x), hash_axis(lo.y, hi.y, seed_y), hash_axis(lo.z, hi.z, seed_z));

    // The path from (0, 0, 0) to (1, 1, 1) takes the axes in falling order of the fraction; first and second are its
    // corners between.
    let f = p.fraction;
    let xy = f.x >= f.y;
    let yz = f.y >= f.z;
    let zx = f.z > f.x;
    let first = vec3<bool>(xy && !zx, yz && !xy, zx && !yz);
    let second = vec3<bool>(xy || !zx, yz || !xy, zx || !yz);
    let first_hash = select(h0, h1, first);
    let second_hash = select(h0, h1, second);
    let g = SIMPLEX_UNSKEW3;
    let d = f - (f.x + f.y + f.z) * g;
    let a = simplex_kernel3(hash_mix3(h0.x, h0.y, h0.z), d);
    let b = simplex_kernel3(
        hash_mix3(first_hash.x, first_hash.y, first_hash.z),
        d - select(vec3<f32>(0.0), vec3<f32>(1.0), first) + g);
    let c = simplex_kernel3(
        hash_mix3(second_hash.x, second_hash.y, second_hash.z),
        d - select(vec3<f32>(0.0), vec3<f32>(1.0), second) + (g + g));
    let e = simplex_kernel3(hash_mix3(h1.x, h1.y, h1.z), d - 1.0 + (g + g + g));
    let n = (a + b + c + e) * SIMPLEX_SCALE3;
    return vec4<f32>(n.x, n.yzw - (n.y + n.z + n.w) * g);
}
