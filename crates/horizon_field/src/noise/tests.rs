//! One suite, instantiated for every basis in the plane and in space.

mod suprema;

use super::Basis;
use crate::hash::{axis, axis_seed, mix2, mix3, pcg};
use crate::lattice::LatticePoint;
use crate::real::{Jet, Real};

/// A reproducible stream of random numbers.
struct Random(u32);

impl Random {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        pcg(pcg(self.0))
    }

    /// In [0, 1), exact in f32, and off the cell's faces by more than a difference step.
    fn fraction(&mut self) -> f64 {
        (f64::from(self.word() >> 9) + 512.0) / 8_389_632.0
    }

    fn unit<const D: usize>(&mut self) -> [f64; D] {
        let v: [f64; D] = core::array::from_fn(|_| self.fraction() * 2.0 - 1.0);
        v.map(|x| x / length(v))
    }

    fn point<const D: usize>(&mut self) -> LatticePoint<f64, D> {
        LatticePoint {
            cell: core::array::from_fn(|_| i64::from(self.word() as i32) << (self.word() & 31)),
            fraction: core::array::from_fn(|_| f64::from(self.fraction() as f32)),
        }
    }
}

fn length<const D: usize>(v: [f64; D]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn minus<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    core::array::from_fn(|k| a[k] - b[k])
}

/// A gradient per unskewed lattice unit, which is what the bounds are in: the transposed skew.
fn unskewed<const D: usize>(basis: Basis, g: [f64; D]) -> [f64; D] {
    let skew = basis.skew::<D>();
    core::array::from_fn(|k| skew.iter().zip(g).map(|(row, g)| row[k] * g).sum())
}

/// The point moved within its cell (or, by a step, a little out of it) by an unskewed displacement.
fn moved<const D: usize>(basis: Basis, at: LatticePoint<f64, D>, by: [f64; D]) -> LatticePoint<f64, D> {
    let skew = basis.skew::<D>();
    let fraction = core::array::from_fn(|row| at.fraction[row] + (0..D).map(|k| skew[row][k] * by[k]).sum::<f64>());
    LatticePoint { fraction, ..at }
}

fn gradient_is_the_derivative<const D: usize>(basis: Basis) {
    let (mut random, step, slope) = (Random(1), 1e-5, basis.bounds::<D>().slope);
    let (mut skipped, count) = (0, 4000);
    for seed in 0..count {
        let at = random.point::<D>();
        let n = basis.jet(&at, seed);
        for k in 0..D {
            let value = |by: f64| {
                let mut fraction = at.fraction;
                fraction[k] += by;
                basis.jet(&LatticePoint { fraction, ..at }, seed).v
            };
            let (before, after) = (value(-step), value(step));
            // Worley's gradient jumps between cells, and turns fast at a feature point.
            if basis == Basis::Worley && (before + after - 2.0 * n.v).abs() > 1e-9 {
                skipped += 1;
                continue;
            }
            let difference = (after - before) / (2.0 * step);
            assert!((difference - n.g[k]).abs() < 2e-8 * slope, "{at:?} {k}: {difference} {:?}", n.g);
        }
    }
    assert!(skipped * 20 < count * D as u32, "{skipped} of {count}");
}

fn cells_join<const D: usize>(basis: Basis) {
    let mut random = Random(2);
    for cell in [i64::MIN, i64::MIN + 1, -(1 << 32), -1, 0, 1, u32::MAX as i64, i64::MAX - 1, i64::MAX] {
        for seed in [0, 1, u32::MAX] {
            for k in 0..D {
                let mut low = random.point::<D>();
                low.cell[k] = cell;
                let mut high = low;
                low.fraction[k] = 1.0 - 1e-12;
                high.cell[k] = cell.wrapping_add(1);
                high.fraction[k] = 0.0;
                let (low, high) = (basis.jet(&low, seed), basis.jet(&high, seed));
                assert!((low.v - high.v).abs() < 1e-10, "{cell} {seed} {k}: {low:?} {high:?}");
                assert!(length(minus(low.g, high.g)) < 1e-9, "{cell} {seed} {k}: {low:?} {high:?}");
            }
        }
    }
}

fn bounds_hold_and_are_reached<const D: usize>(basis: Basis) {
    let (mut random, step, bounds) = (Random(3), 1e-6, basis.bounds::<D>());
    let (mut low, mut high, mut slope, mut curvature) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..100_000 {
        let (at, seed) = (random.point::<D>(), random.word());
        let n = basis.jet(&at, seed);
        let g = unskewed(basis, n.g);
        let next = basis.jet(&moved(basis, at, random.unit().map(|x| x * step)), seed);
        (low, high) = (low.min(n.v), high.max(n.v));
        slope = slope.max(length(g));
        curvature = curvature.max(length(minus(unskewed(basis, next.g), g)) / step);
    }
    assert!(bounds.low - 1e-12 <= low && low < 0.4 * bounds.low, "low {low}");
    assert!(bounds.high + 1e-12 >= high && high > 0.4 * bounds.high, "high {high}");
    assert!(slope <= bounds.slope + 1e-9 && slope > 0.4 * bounds.slope, "slope {slope}");
    assert!(curvature <= bounds.curvature + 1e-4, "curvature {curvature}");
    assert!(curvature > 0.4 * bounds.curvature || basis == Basis::Worley, "curvature {curvature}");
}

fn f32_is_near_f64<const D: usize>(basis: Basis) {
    let (mut random, bounds) = (Random(4), basis.bounds::<D>());
    for _ in 0..20_000 {
        let (at, seed) = (random.point::<D>(), random.word());
        let exact = basis.jet(&at, seed);
        let single: Jet<f32, D> =
            basis.jet(&LatticePoint { cell: at.cell, fraction: at.fraction.map(|x| x as f32) }, seed);
        assert!((exact.v - single.v.f64()).abs() < 2e-6, "{exact:?} {single:?}");
        // Near a feature point the unit vector to it is as uncertain as the point's offset.
        let near = if basis == Basis::Worley { 1e-7 / (exact.v + 1.0) } else { 0.0 };
        assert!(length(minus(exact.g, single.g.map(Real::f64))) < (1e-5 + near) * bounds.slope, "{exact:?} {single:?}");
    }
}

fn worlds_differ<const D: usize>(basis: Basis) {
    let mut random = Random(5);
    let count = 20_000;
    // The sums of n, n², and n times that of another seed, of the neighbouring cell, and of exchanged axes.
    let mut sums = [0.0; 5];
    for _ in 0..count {
        let (at, seed) = (random.point::<D>(), random.word());
        // The difference of two worlds: without the mean that all worlds have at this place of the cell.
        let n = |at: &LatticePoint<f64, D>, seed: u32| basis.jet(at, seed).v - basis.jet(at, !seed).v;
        let mut far = at;
        far.cell[0] = far.cell[0].wrapping_add(3);
        let mut exchanged = at;
        exchanged.cell.swap(0, 1);
        let here = n(&at, seed);
        let other = [1.0, here, n(&at, seed.wrapping_add(1)), n(&far, seed), n(&exchanged, seed)];
        for (sum, other) in sums.iter_mut().zip(other) {
            *sum += here * other / f64::from(count);
        }
    }
    let [mean, square, others @ ..] = sums;
    assert!(mean * mean < 0.001 * square, "{sums:?}");
    for other in others {
        assert!(other.abs() < 0.04 * square, "{sums:?}");
    }
}

/// The nearest feature point of a search twice as wide: the jitter's proof, tried.
#[test]
fn worley_searches_far_enough() {
    let mut random = Random(6);
    for _ in 0..20_000 {
        let (at, seed) = (random.point::<2>(), random.word());
        let mut nearest = f64::INFINITY;
        for dy in -3..=3_i64 {
            for dx in -3..=3_i64 {
                let cell = [at.cell[0].wrapping_add(dx), at.cell[1].wrapping_add(dy)];
                let [x, y] = super::corner::vector2::<f64>(crate::hash::hash2(cell, seed));
                let d = [dx as f64 + 0.5 + x / 3.0 - at.fraction[0], dy as f64 + 0.5 + y / 3.0 - at.fraction[1]];
                nearest = nearest.min(length(d));
            }
        }
        let n = Basis::Worley.jet(&at, seed).v;
        assert!((n - (nearest * 2.0 / (2.0_f64.sqrt() * 5.0 / 6.0) - 1.0)).abs() < 1e-12);
    }
}

#[test]
fn hashes_fill_their_bins_evenly() {
    let (x, y, z) = (axis_seed(7, 0), axis_seed(7, 1), axis_seed(7, 2));
    for shift in [0, 8, 16, 24] {
        let (mut plane, mut space) = ([0_u32; 256], [0_u32; 256]);
        for j in -128..128 {
            for i in -128..128 {
                plane[(mix2(axis(i, x), axis(j, y)) >> shift & 255) as usize] += 1;
                space[(mix3(axis(i, x), axis(j, y), axis(i ^ j, z)) >> shift & 255) as usize] += 1;
            }
        }
        // χ² of 255 degrees of freedom: 255 ± 22.6.
        for bins in [plane, space] {
            let chi: f64 = bins.iter().map(|n| (f64::from(*n) - 256.0).powi(2) / 256.0).sum();
            assert!((165.0..345.0).contains(&chi), "{shift}: {chi}");
        }
    }
}

macro_rules! suite {
    ($($name:ident: $basis:ident, $dimensions:literal;)*) => {$(
        mod $name {
            use super::super::Basis;

            #[test]
            fn gradient_is_the_derivative() {
                super::gradient_is_the_derivative::<$dimensions>(Basis::$basis);
            }

            #[test]
            fn cells_join() {
                super::cells_join::<$dimensions>(Basis::$basis);
            }

            #[test]
            fn bounds_hold_and_are_reached() {
                super::bounds_hold_and_are_reached::<$dimensions>(Basis::$basis);
            }

            #[test]
            fn f32_is_near_f64() {
                super::f32_is_near_f64::<$dimensions>(Basis::$basis);
            }

            #[test]
            fn worlds_differ() {
                super::worlds_differ::<$dimensions>(Basis::$basis);
            }
        }
    )*};
}
suite! {
    value2: Value, 2;
    value3: Value, 3;
    gradient2: Gradient, 2;
    gradient3: Gradient, 3;
    simplex2: Simplex, 2;
    simplex3: Simplex, 3;
    worley2: Worley, 2;
    worley3: Worley, 3;
}

/// Near cells' hashes are those of the cells, wherever low words wrap or change their sign.
#[test]
fn near_cells_hash_like_any_cell() {
    use super::axes::{Axes, Cell, NearCell, Words};
    let mut random = Random(8);
    for anchor in
        [0, -1, 1, 1 << 31, -(1 << 31), 1 << 32, -(1 << 32), (1 << 32) - 7, i64::MAX, i64::MIN, 0x1234_5678_9abc]
    {
        for _ in 0..400 {
            let (seed, by) = (random.word(), i64::from(random.word() as i32 >> (random.word() & 31)));
            let words = Words::of(anchor);
            let low = i64::from(words.low) + by;
            if low <= i64::from(i32::MIN) || low >= i64::from(i32::MAX) {
                continue;
            }
            let near = NearCell { low: [low as u32], high: [words.hashes(seed)] };
            let any = Cell { cell: [anchor.wrapping_add(by)], seeds: [seed] };
            for i in [-1, 0, 1] {
                assert_eq!(near.hash(0, i), any.hash(0, i), "{anchor} {by} {i}");
            }
        }
    }
}
