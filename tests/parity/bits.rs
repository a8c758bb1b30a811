//! What must be equal bit for bit: the hashes of cells, and the carries of lattice points.

use horizon_field::field::arbitrary::Random;
use horizon_field::{LatticePoint, Layer, hash, lattice};

use crate::device;

/// 64-bit coordinates that are hard to carry into, and random ones, small and large.
fn coordinate(random: &mut Random) -> i64 {
    const WORD: i64 = 1 << 32;
    let wild = (i64::from(random.bits()) << 32) | i64::from(random.bits());
    let near = random.pick(&[i64::MIN, i64::MAX, 0, WORD, -WORD, WORD >> 1, -(WORD >> 1)]);
    match random.bits() % 4 {
        0 => near.wrapping_add(i64::from(random.bits() % 5) - 2),
        1 => wild >> 40,
        2 => near.wrapping_add(wild >> 50),
        _ => wild,
    }
}

fn lo_hi(cell: i64) -> [u32; 2] {
    [cell as u32, (cell >> 32) as u32]
}

#[test]
fn hashes_are_equal_bit_for_bit() {
    const CELLS: usize = 1_000_000;
    let mut random = Random::new(1);
    let cells: Vec<([i64; 3], u32)> =
        (0..CELLS).map(|_| ([(); 3].map(|()| coordinate(&mut random)), random.bits())).collect();
    let words: Vec<u32> = cells
        .iter()
        .flat_map(|(cell, seed)| {
            let [[x, x_hi], [y, y_hi], [z, z_hi]] = cell.map(lo_hi);
            [x, y, z, x_hi, y_hi, z_hi, *seed, 0]
        })
        .collect();
    let main = "
@group(0) @binding(0) var<storage, read> cells: array<array<u32, 8>>;
@group(0) @binding(1) var<storage, read_write> hashes: array<vec2<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let c = cells[id.x];
    let lo = vec3<u32>(c[0], c[1], c[2]);
    let hi = vec3<u32>(c[3], c[4], c[5]);
    hashes[id.x] = vec2<u32>(hash2(lo.xy, hi.xy, c[6]), hash3(lo, hi, c[6]));
}
";
    let source = [hash::WGSL, main].join("\n");
    let bytes = device::run(&source, &[&[bytemuck::cast_slice(&words)]], 8 * CELLS, CELLS as u32 / 64);
    let hashes: &[[u32; 2]] = bytemuck::cast_slice(&bytes);
    for ((cell, seed), found) in cells.iter().zip(hashes) {
        let expected = [hash::hash2([cell[0], cell[1]], *seed), hash::hash3(*cell, *seed)];
        assert_eq!(expected, *found, "cell {cell:?}, seed {seed}");
    }
    println!("{CELLS} cells hash to the same bits in the plane and in space");
}

#[test]
fn lattices_carry_alike() {
    const POINTS: usize = 64 * 1024;
    let mut random = Random::new(2);
    // Sixteenths and eighths, which neither side rounds: what is left are the carries.
    let anchors: Vec<_> = (0..POINTS)
        .map(|_| {
            let cell = [(); 3].map(|()| coordinate(&mut random));
            let fraction = [(); 3].map(|()| f64::from(random.bits() % 16) / 16.0);
            let q = [(); 3].map(|()| (f64::from(random.bits() % 65_536) / 8.0 - 4096.0) as f32);
            (LatticePoint { cell, fraction }, q)
        })
        .collect();
    let words: Vec<u32> = anchors
        .iter()
        .flat_map(|(LatticePoint { cell, fraction }, q)| {
            let [[x, x_hi], [y, y_hi], [z, z_hi]] = cell.map(lo_hi);
            let [a, b, c] = fraction.map(|f| (f as f32).to_bits());
            let [p, q, r] = q.map(f32::to_bits);
            [x, y, z, x_hi, y_hi, z_hi, a, b, c, p, q, r]
        })
        .collect();
    let main = "
@group(0) @binding(0) var<storage, read> anchors: array<array<u32, 12>>;
@group(0) @binding(1) var<storage, read_write> points: array<array<u32, 15>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let a = anchors[id.x];
    let lo = vec3<u32>(a[0], a[1], a[2]);
    let hi = vec3<u32>(a[3], a[4], a[5]);
    let fraction = bitcast<vec3<f32>>(vec3<u32>(a[6], a[7], a[8]));
    let q = bitcast<vec3<f32>>(vec3<u32>(a[9], a[10], a[11]));
    let x = vec3<f32>(1.0, 0.0, 0.0);
    let y = vec3<f32>(0.0, 1.0, 0.0);
    let z = vec3<f32>(0.0, 0.0, 1.0);
    let s = lattice3(Layer3(x, 0u, y, 0u, z, 0u), Anchor3(fraction, 0u, lo, 0u, hi, 0u), q);
    let p = lattice2(
        Layer2(vec4<f32>(1.0, 0.0, 0.0, 1.0), 0u, 0u, 0u, 0u), Anchor2(fraction.xy, lo.xy, hi.xy), q.xy);
    let f = bitcast<vec3<u32>>(s.fraction);
    let g = bitcast<vec2<u32>>(p.fraction);
    points[id.x] = array<u32, 15>(
        s.lo.x, s.lo.y, s.lo.z, s.hi.x, s.hi.y, s.hi.z, f.x, f.y, f.z,
        p.lo.x, p.lo.y, p.hi.x, p.hi.y, g.x, g.y);
}
";
    let source = [lattice::WGSL, main].join("\n");
    let bytes = device::run(&source, &[&[bytemuck::cast_slice(&words)]], 60 * POINTS, POINTS as u32 / 64);
    let found: &[[u32; 15]] = bytemuck::cast_slice(&bytes);
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let space = Layer::<3>::new(identity, [0.0; 3], 0);
    for ((anchor, q), found) in anchors.iter().zip(found) {
        let LatticePoint { cell, fraction } = space.at(anchor, *q);
        let [[x, x_hi], [y, y_hi], [z, z_hi]] = cell.map(lo_hi);
        let [a, b, c] = fraction.map(f32::to_bits);
        let expected = [x, y, z, x_hi, y_hi, z_hi, a, b, c, x, y, x_hi, y_hi, a, b];
        assert_eq!(expected, *found, "{anchor:?} + {q:?}");
    }
}
