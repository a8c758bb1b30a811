// The hash of lattice cells; the twin of hash.rs, equal bit for bit. A 64-bit coordinate is two words, lo and hi.

fn pcg(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn hash_axis(lo: u32, hi: u32, seed: u32) -> u32 {
    return pcg(lo + pcg(hi + seed));
}

fn hash_axis_seed(seed: u32, axis: u32) -> u32 {
    return pcg(seed + axis * 0x9e3779b9u);
}

fn hash_rotate(v: u32, by: u32) -> u32 {
    return (v << by) | (v >> (32u - by));
}

fn hash_mix2(x: u32, y: u32) -> u32 {
    return pcg(x + hash_rotate(y, 16u));
}

fn hash_mix3(x: u32, y: u32, z: u32) -> u32 {
    return pcg(x + hash_rotate(y, 11u) + hash_rotate(z, 22u));
}

fn hash2(lo: vec2<u32>, hi: vec2<u32>, seed: u32) -> u32 {
    return hash_mix2(
        hash_axis(lo.x, hi.x, hash_axis_seed(seed, 0u)),
        hash_axis(lo.y, hi.y, hash_axis_seed(seed, 1u)));
}

fn hash3(lo: vec3<u32>, hi: vec3<u32>, seed: u32) -> u32 {
    return hash_mix3(
        hash_axis(lo.x, hi.x, hash_axis_seed(seed, 0u)),
        hash_axis(lo.y, hi.y, hash_axis_seed(seed, 1u)),
        hash_axis(lo.z, hi.z, hash_axis_seed(seed, 2u)));
}
