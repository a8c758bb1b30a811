//! Section 3: hashes.

use horizon_field::field::arbitrary::{BASES, Random};
use horizon_field::field::{NoImages, Noise};
use horizon_field::hash::{axis_seed, hash2, hash3, pcg};
use horizon_field::noise::Basis;
use horizon_field::{Field, LatticePoint, Layer, Place};

use super::statistics::{correlation, largest, moments};

/// The hash of countless shaders, as far as they agree on it.
fn sine_hash([x, z]: [f32; 2], dot: fn([f32; 2]) -> f32, sin: fn(f32) -> f32) -> f64 {
    let spread = sin(dot([x, z])) * 43_758.547;
    f64::from(spread - spread.floor())
}

#[test]
fn sines_differ_between_devices() {
    let plain = |[x, z]: [f32; 2]| x * 12.9898 + z * 78.233;
    let fused = |[x, z]: [f32; 2]| x.mul_add(12.9898, z * 78.233);
    let rounded = |x: f32| f64::from(x).sin() as f32;
    // A device may bring the argument into one turn first, in single precision.
    let reduced = |x: f32| {
        let turns = x * core::f32::consts::FRAC_1_PI * 0.5;
        f64::from((turns - turns.floor()) * core::f32::consts::TAU).sin() as f32
    };
    // Or have an error of 2⁻¹¹, all that WGSL and Vulkan ask for.
    let rough = |x: f32| (f64::from(x).sin() as f32 * 2048.0).round() / 2048.0;
    let cells = || (-100..100i16).flat_map(|z| (-100..100i16).map(move |x| [f32::from(x), f32::from(z)]));
    let share = |hash: &dyn Fn([f32; 2]) -> f64| {
        let apart = cells().map(|cell| (hash(cell) - sine_hash(cell, plain, rounded)).abs());
        apart.filter(|apart| apart.min(1.0 - apart) > 0.05).count() as f64 / 40_000.0
    };
    let differ = |dot: fn([f32; 2]) -> f32, sin: fn(f32) -> f32| share(&|cell| sine_hash(cell, dot, sin));
    let double = |[x, z]: [f32; 2]| {
        let spread = (f64::from(x) * 12.9898 + f64::from(z) * 78.233).sin() * 43_758.545_3;
        spread - spread.floor()
    };
    let shares = [differ(fused, rounded), differ(plain, reduced), differ(plain, rough), share(&double)];
    println!("cells whose hash differs by more than 0.05: fused, reduced, rough, in double precision: {shares:.2?}");
    assert!(shares[0] > 0.05 && shares[1..].iter().all(|share| *share > 0.2), "sines must differ: {shares:?}");
    // Ours in whole numbers, of which there is one result: here by remainders of 64-bit ones.
    let pcg64 = |v: u64| {
        let word = |x: u64| x % (1 << 32);
        let state = word(word(v) * 747_796_405 + 2_891_336_453);
        let mixed = word(((state >> ((state >> 28) + 4)) ^ state) * 277_803_737);
        mixed >> 22 ^ mixed
    };
    for [x, z] in cells() {
        let cell = [x as i64, z as i64];
        let axis = |k: usize| {
            let seed = u64::from(axis_seed(3, k as u32));
            pcg64((cell[k] as u64 & 0xffff_ffff) + pcg64((cell[k] as u64 >> 32) + seed))
        };
        let expected = pcg64(axis(0) + u64::from((axis(1) as u32).rotate_left(16)));
        assert_eq!(u64::from(hash2(cell, 3)), expected, "{cell:?}");
    }
    // So that the noise of single and of double precision is one.
    let mut random = Random::new(4);
    for _ in 0..20_000 {
        let cell = [(); 2].map(|()| i64::from(random.bits() as i32));
        let fraction = [(); 2].map(|()| random.within(0.0, 1.0) as f32);
        let single = Basis::Value.jet(&LatticePoint { cell, fraction }, 3).v;
        let double = Basis::Value.jet(&LatticePoint { cell, fraction: fraction.map(f64::from) }, 3).v;
        assert!((f64::from(single) - double).abs() < 2e-6, "{single} and {double}");
    }
}

#[test]
fn lattices_that_wrap_repeat() {
    // Perlin's table of 256 numbers, in an order drawn by lot.
    let mut table: Vec<usize> = (0..256).collect();
    let mut random = Random::new(5);
    (1..256).rev().for_each(|i| table.swap(i, random.bits() as usize % (i + 1)));
    let perlin = |[x, z]: [i64; 2]| table[(table[(x & 255) as usize] + (z & 255) as usize) & 255];
    // And cells as floats, of which single precision holds 24 bits.
    let float = |[x, z]: [i64; 2]| pcg((x as f32).to_bits()) ^ pcg((z as f32).to_bits()).rotate_left(16);
    let cells = || (-50..50).flat_map(|z| (-50..50).map(move |x| [x, z]));
    let same = |hash: &dyn Fn([i64; 2]) -> u32, [from, by]: [i64; 2]| {
        cells().map(|[x, z]| [x + from, z]).filter(|[x, z]| hash([*x, *z]) == hash([x + by, *z])).count()
    };
    assert_eq!(same(&|cell| perlin(cell) as u32, [0, 256]), 10_000, "the table must repeat");
    assert!(same(&float, [1 << 24, 1]) > 2_000, "float cells must merge with their neighbours");
    let shifts = [[0, 1], [0, 256], [0, 1 << 16], [0, 1 << 24], [1 << 24, 1], [0, 1 << 31], [0, 1 << 32], [1 << 40, 1]];
    for shift in shifts {
        let equal = same(&|cell| hash2(cell, 1), shift);
        assert!(equal <= 1, "{equal} of 10 000 cells are equal, shifted by {shift:?}");
    }
    // Coordinates that wrap at the very end, at 2⁶³ cells, join.
    for k in 0..2 {
        let at = |cell: i64, fraction: f64| {
            let mut point = LatticePoint { cell: [5, 5], fraction: [0.3, 0.3] };
            (point.cell[k], point.fraction[k]) = (cell, fraction);
            Basis::Gradient.jet(&point, 1).v
        };
        assert!((at(i64::MAX, 1.0 - 1e-12) - at(i64::MIN, 0.0)).abs() < 1e-10);
    }
}

#[test]
fn negative_coordinates_go_on() {
    let layer = Layer::<2>::new([[1.0, 0.0], [0.0, 1.0]], [0.0; 2], 9);
    let origin = layer.anchor(&Place::ORIGIN);
    let naive = |basis: Basis, cell: [i64; 2], x: [f64; 2]| {
        let fraction = [0, 1].map(|k| x[k] - cell[k] as f64);
        basis.jet(&LatticePoint { cell, fraction }, 9).v
    };
    let step = 1e-3;
    let steps =
        |f: &dyn Fn(f64) -> f64| largest((-8000..8000).map(|i| f64::from(i) * step + 5e-4).map(|x| f(x + step) - f(x)));
    for basis in BASES {
        // Per unskewed unit; simplex noise's skewed units are no longer.
        let slope = basis.bounds::<2>().slope;
        // Truncated, cell 0 is two cells wide.
        let truncated = steps(&|x| naive(basis, [x as i64, 0], [x, 0.4]));
        assert!(truncated > 0.3, "{basis:?}: truncated cells must tear: {truncated}");
        // Absolute, the world is its own mirror image.
        let mirrored = |x: f64| naive(basis, [x.abs() as i64, 0], [x.abs(), 0.4]);
        assert_eq!(mirrored(-3.3), mirrored(3.3));
        // As unsigned numbers, which negative floats become by saturation, all cells are cell 0.
        let unsigned =
            |x: f64| basis.jet(&LatticePoint { cell: [i64::from(x as u32), 0], fraction: [x - x.floor(), 0.4] }, 9).v;
        assert!((-9..0).all(|i| (unsigned(f64::from(i) + 0.5) - unsigned(-0.5)).abs() < 1e-12));

        for z in [-1e-9, 0.0, 0.4, -0.6] {
            let ours = |x: f64| basis.jet(&layer.at(&origin, [x, z]), 9).v;
            assert!(steps(&ours) <= slope * step * 1.001, "{basis:?} tears");
            let across = |x: f64| basis.jet(&layer.at(&origin, [z, x]), 9).v;
            assert!(steps(&across) <= slope * step * 1.001, "{basis:?} tears");
            let single = |x: f64| f64::from(basis.jet(&layer.at(&origin, [x as f32, z as f32]), 9).v);
            assert!(steps(&single) <= slope * step * 1.001 + 1e-5, "{basis:?} tears in single precision");
        }
        let ours = |x: f64| basis.jet(&layer.at(&origin, [x, 0.4]), 9).v;
        assert!((1..9).any(|i| (ours(f64::from(i) - 0.3) - ours(0.3 - f64::from(i))).abs() > 0.1));
        assert!((-9..0).any(|i| (ours(f64::from(i) + 0.5) - ours(-0.5)).abs() > 0.1));
    }
}

/// The hashes of a square of cells about the origin, as numbers in [0, 1).
fn square(hash: impl Fn([i64; 2]) -> u32, [dx, dz]: [i64; 2]) -> Vec<f64> {
    let cells = (-100..100).flat_map(|z| (-100..100).map(move |x| [x + dx, z + dz]));
    cells.map(|cell| f64::from(hash(cell)) / 4_294_967_296.0).collect()
}

const SEEDS: [u32; 6] = [0, 1, 2, 1 << 31, u32::MAX - 1, u32::MAX];

#[test]
fn seeds_0_and_the_largest_are_as_good_as_any() {
    // A seed that multiplies: of 0, all cells are one.
    let multiplied = |[x, z]: [i64; 2]| pcg((x as u32).wrapping_mul(0).wrapping_add(pcg((z as u32).wrapping_mul(0))));
    assert_eq!(moments(&square(multiplied, [0, 0]))[1], 0.0);
    // A seed that is added: that of 1 is the world of 0, a cell to the side; that of −1, to the other side.
    let added = |seed: u32| {
        move |[x, z]: [i64; 2]| pcg((x as u32).wrapping_add((z as u32).wrapping_mul(57)).wrapping_add(seed))
    };
    assert_eq!(square(added(1), [0, 0]), square(added(0), [1, 0]));
    assert_eq!(square(added(u32::MAX), [0, 0]), square(added(0), [-1, 0]));

    // 40 000 cells: five standard deviations.
    for seed in SEEDS {
        let plane = |cell| hash2(cell, seed);
        let space = |[x, z]: [i64; 2]| hash3([x, 0, z], seed);
        for [here, east, south, across] in [
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|by| square(plane, by)),
            [[0, 0], [1, 0], [0, 1], [-1, 1]].map(|by| square(space, by)),
        ] {
            let [mean, variance] = moments(&here);
            assert!((mean - 0.5).abs() < 5.0 * (1.0f64 / 12.0 / 40_000.0).sqrt(), "seed {seed}: mean {mean}");
            assert!((variance * 12.0 - 1.0).abs() < 0.025, "seed {seed}: variance {variance}");
            for neighbour in [east, south, across] {
                let in_common = correlation(&here, &neighbour);
                assert!(in_common.abs() < 0.025, "seed {seed}: neighbours have {in_common} in common");
            }
            let mut bins = [0u32; 256];
            here.iter().for_each(|x| bins[(x * 256.0) as usize] += 1);
            let chi: f64 = bins.iter().map(|n| (f64::from(*n) - 156.25).powi(2) / 156.25).sum();
            assert!((145.0..365.0).contains(&chi), "seed {seed}: χ² {chi} of 255 degrees of freedom");
        }
        // No other seed's world lies a few cells off.
        for other in SEEDS.into_iter().filter(|other| *other != seed) {
            for by in [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1], [2, 1]] {
                let in_common = correlation(&square(plane, [0, 0]), &square(|cell| hash2(cell, other), by));
                assert!(in_common.abs() < 0.025, "seeds {seed} and {other}: {in_common}");
            }
        }
    }
}

#[test]
fn noise_of_any_seed_is_as_high_as_any() {
    // The mean and the variance over 20 000 cells' worth of ground, of odd seeds and of a hundred drawn by lot.
    let mut random = Random::new(6);
    let mut of = |basis: Basis, seed: u32| {
        let noise = Noise { basis, wavelength: 1.0, amplitude: 1.0, rotation: 0.3, seed };
        let noise = Field::from(noise).compile::<2>(&NoImages).unwrap();
        let at = noise.anchor(&Place::ORIGIN);
        let values: Vec<f64> =
            (0..5000).map(|_| noise.value_f64(&at, [(); 2].map(|()| random.within(-400.0, 400.0)), 0.0)).collect();
        moments(&values)
    };
    for basis in BASES {
        let any: Vec<[f64; 2]> = (0..100).map(|i| of(basis, pcg(i))).collect();
        let mean = any.iter().map(|m| m[0]).sum::<f64>() / 100.0;
        let variance = any.iter().map(|m| m[1]).sum::<f64>() / 100.0;
        for seed in SEEDS {
            let found = of(basis, seed);
            assert!((found[0] - mean).abs() < 6.0 * (variance / 5000.0).sqrt(), "{basis:?} of {seed}: {found:?}");
            assert!((found[1] / variance - 1.0).abs() < 0.12, "{basis:?} of {seed}: {found:?} of {variance}");
        }
    }
}
