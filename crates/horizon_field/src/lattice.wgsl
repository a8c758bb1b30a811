// Lattices of noise, anchored; the twin of lattice.rs. The host takes absolute coordinates apart in fixed point into a
// 64-bit cell (two words) and a fraction; here only small offsets, in metres from the anchor, are added.

struct Layer2 {
    // Lattice units per metre, row by row: (m00, m01, m10, m11).
    matrix: vec4<f32>,
    seed: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

struct Anchor2 {
    fraction: vec2<f32>,
    lo: vec2<u32>,
    hi: vec2<u32>,
}

struct LatticePoint2 {
    lo: vec2<u32>,
    hi: vec2<u32>,
    fraction: vec2<f32>,
}

struct Layer3 {
    // The rows; the first row's w is the seed's bits.
    row0: vec3<f32>,
    seed: u32,
    row1: vec3<f32>,
    pad0: u32,
    row2: vec3<f32>,
    pad1: u32,
}

struct Anchor3 {
    fraction: vec3<f32>,
    pad0: u32,
    lo: vec3<u32>,
    pad1: u32,
    hi: vec3<u32>,
    pad2: u32,
}

struct LatticePoint3 {
    lo: vec3<u32>,
    hi: vec3<u32>,
    fraction: vec3<f32>,
}

// The high word of (hi, lo) + i, given sum = lo + i.
fn carry2(lo: vec2<u32>, hi: vec2<u32>, sum: vec2<u32>, i: vec2<i32>) -> vec2<u32> {
    let sign = bitcast<vec2<u32>>(i >> vec2<u32>(31u));
    return hi + sign + select(vec2<u32>(0u), vec2<u32>(1u), sum < lo);
}

fn carry3(lo: vec3<u32>, hi: vec3<u32>, sum: vec3<u32>, i: vec3<i32>) -> vec3<u32> {
    let sign = bitcast<vec3<u32>>(i >> vec3<u32>(31u));
    return hi + sign + select(vec3<u32>(0u), vec3<u32>(1u), sum < lo);
}

fn lattice2(layer: Layer2, anchor: Anchor2, q: vec2<f32>) -> LatticePoint2 {
    // Term by term from the fraction on, as lattice.rs adds.
    let x = anchor.fraction + layer.matrix.xz * q.x + layer.matrix.yw * q.y;
    let whole = floor(x);
    let i = vec2<i32>(whole);
    let lo = anchor.lo + bitcast<vec2<u32>>(i);
    return LatticePoint2(lo, carry2(anchor.lo, anchor.hi, lo, i), x - whole);
}

fn lattice3(layer: Layer3, anchor: Anchor3, q: vec3<f32>) -> LatticePoint3 {
    // No dot product: its order of additions is the driver's.
    let x = anchor.fraction
        + vec3<f32>(layer.row0.x, layer.row1.x, layer.row2.x) * q.x
        + vec3<f32>(layer.row0.y, layer.row1.y, layer.row2.y) * q.y
        + vec3<f32>(layer.row0.z, layer.row1.z, layer.row2.z) * q.z;
    let whole = floor(x);
    let i = vec3<i32>(whole);
    let lo = anchor.lo + bitcast<vec3<u32>>(i);
    return LatticePoint3(lo, carry3(anchor.lo, anchor.hi, lo, i), x - whole);
}

// A gradient per lattice unit, brought to metres: the transposed matrix.
fn per_metre2(layer: Layer2, g: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        layer.matrix.x * g.x + layer.matrix.z * g.y,
        layer.matrix.y * g.x + layer.matrix.w * g.y);
}

fn per_metre3(layer: Layer3, g: vec3<f32>) -> vec3<f32> {
    return layer.row0 * g.x + layer.row1 * g.y + layer.row2 * g.z;
}
