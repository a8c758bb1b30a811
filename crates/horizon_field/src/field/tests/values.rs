//! Values and gradients.

use crate::field::arbitrary::{KINDS, Pictures, Random, every_kind, field};
use crate::field::{Compiled, Field, Fractal, ImageField, NoImages};
use crate::place::Place;

/// A random point of the domain, up to this far from the anchor on each axis.
fn point<const D: usize>(random: &mut Random, reach: f64) -> [f64; D] {
    core::array::from_fn(|_| random.within(-reach, reach))
}

/// The share of points at which a gradient is not the central difference. Fields with creases have some: where a crease
/// falls between the two samples.
fn wrong_gradients<const D: usize>(field: &Compiled<D>, seed: u32) -> f64 {
    const POINTS: u32 = 400;
    const STEP: f64 = 1e-4;
    let mut random = Random::new(seed);
    let at = field.anchor(&Place::new([3, 2, -5], [100.0, 900.0, 4000.0]));
    let mut wrong = 0;
    for _ in 0..POINTS {
        let q = point::<D>(&mut random, 3000.0);
        let jet = field.jet_f64(&at, q, 0.0);
        assert!(jet.v.is_finite() && jet.g.iter().all(|g| g.is_finite()), "{jet:?}");
        let moved = |axis: usize, by: f64| {
            let mut q = q;
            q[axis] += by;
            field.value_f64(&at, q, 0.0)
        };
        let differs = (0..D).any(|axis| {
            let difference = (moved(axis, STEP) - moved(axis, -STEP)) / (2.0 * STEP);
            (difference - jet.g[axis]).abs() > 1e-4 * (1.0 + difference.abs())
        });
        wrong += u32::from(differs);
    }
    f64::from(wrong) / f64::from(POINTS)
}

#[test]
fn gradients_are_those_of_the_value() {
    for seed in 0..8 {
        for (name, field) in every_kind(seed) {
            let plane = wrong_gradients(&field.compile::<2>(&Pictures).unwrap(), seed);
            assert!(plane <= 0.01, "{name} in the plane, seed {seed}: {plane} wrong\n{field:?}");
            let space = wrong_gradients(&field.compile::<3>(&Pictures).unwrap(), seed);
            assert!(space <= 0.01, "{name} in space, seed {seed}: {space} wrong\n{field:?}");
        }
    }
}

#[test]
fn single_precision_agrees_with_double() {
    for (name, field) in every_kind(20) {
        let compiled = field.compile::<2>(&Pictures).unwrap();
        let at = compiled.anchor(&Place::new([1 << 40, 0, -5], [10.0, 0.0, 40.0]));
        let (low, high) = compiled.range();
        let mut random = Random::new(21);
        for _ in 0..500 {
            let q = point::<2>(&mut random, 200.0).map(|q| q as f32);
            let double = compiled.value_f64(&at, q.map(f64::from), 0.0);
            let single = f64::from(compiled.value_f32(&at, q, 0.0));
            let tolerance = 2e-5 * (1.0 + high - low + low.abs());
            assert!((single - double).abs() < tolerance, "{name}: {single} and {double}");
        }
    }
}

#[test]
fn a_place_has_one_height_whatever_the_anchor() {
    let mut random = Random::new(5);
    for case in 0..60 {
        let field = field(&mut random, 3);
        let compiled = field.compile::<3>(&Pictures).unwrap();
        let cell = core::array::from_fn(|_| (i64::from(random.bits()) - (1 << 31)) << random.pick(&[0, 8]));
        let place = Place::new(cell, [17.5, 33.25, 4090.125]);
        let by = [random.within(-9.0, 9.0), random.within(-9.0, 9.0), random.within(-9.0, 9.0)]
            .map(|x| (x * 1024.0).round() / 8.0);
        let here = compiled.value_f64(&compiled.anchor(&place), by, 0.0);
        let there = compiled.value_f64(&compiled.anchor(&place.translated(by)), [0.0; 3], 0.0);
        // Worley's and Ridged's creases are continuous too, so rounding of the lattice moves no value far.
        assert!((here - there).abs() < 1e-9 * (1.0 + here.abs()), "case {case}: {here} and {there} of {field:?}");
    }
}

#[test]
fn far_from_the_origin_is_like_at_the_origin() {
    let field = Field::default().compile::<2>(&NoImages).unwrap();
    let statistics = |metres: f64| {
        let at = field.anchor(&Place::from_metres([metres, 0.0, -metres]));
        let mut random = Random::new(9);
        let (mut sum, mut squares, mut steepest) = (0.0, 0.0, 0.0_f64);
        for _ in 0..4000 {
            let q = point::<2>(&mut random, 60_000.0);
            let near = field.value_f64(&at, [q[0] + 1e-3, q[1]], 0.0);
            let v = field.value_f64(&at, q, 0.0);
            steepest = steepest.max((near - v).abs());
            sum += v / 4000.0;
            squares += v * v / 4000.0;
        }
        (sum, (squares - sum * sum).sqrt(), steepest)
    };
    let (mean, deviation, steepest) = statistics(0.0);
    for metres in [1e4, 1e6, 1e9] {
        let far = statistics(metres);
        assert!((far.0 - mean).abs() < 0.2 * deviation, "mean {} and {mean}", far.0);
        assert!((far.1 / deviation - 1.0).abs() < 0.15, "deviation {} and {deviation}", far.1);
        assert!(far.2 < 2.0 * steepest && steepest < 0.02, "steps of {} and {steepest} m per mm", far.2);
    }
}

#[test]
fn fields_of_different_seeds_differ() {
    let of = |seed| Field::from(Fractal { seed, ..Fractal::default() }).compile::<2>(&NoImages).unwrap();
    let (a, b) = (of(0), of(u32::MAX));
    let place = Place::ORIGIN;
    let (at_a, at_b) = (a.anchor(&place), b.anchor(&place));
    let mut random = Random::new(3);
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for _ in 0..3000 {
        let q = point::<2>(&mut random, 1e6);
        let (x, y) = (a.value_f64(&at_a, q, 0.0), b.value_f64(&at_b, q, 0.0));
        (ab, aa, bb) = (ab + x * y, aa + x * x, bb + y * y);
    }
    let correlation = ab / (aa * bb).sqrt();
    assert!(correlation.abs() < 0.08, "{correlation}");
}

#[test]
fn a_cut_off_leaves_out_no_more_than_said() {
    let mut random = Random::new(12);
    for case in 0..200 {
        let field = field(&mut random, 3);
        let compiled = field.compile::<2>(&Pictures).unwrap();
        let at = compiled.anchor(&Place::ORIGIN);
        let (low, high) = compiled.range();
        let rounding = 1e-9 * (1.0 + low.abs() + high.abs());
        assert_eq!(compiled.left_out(0.0), 0.0);
        for cutoff in [1.0, 30.0, 1000.0, 1e5] {
            let allowed = compiled.left_out(cutoff);
            for _ in 0..20 {
                let q = point::<2>(&mut random, 5000.0);
                let (whole, cut) = (compiled.value_f64(&at, q, 0.0), compiled.value_f64(&at, q, cutoff));
                assert!((whole - cut).abs() <= allowed + rounding, "case {case}: {whole}, {cut}, {allowed}: {field:?}");
                assert!(cut >= low - rounding && cut <= high + rounding, "case {case}: {cut} outside {low} to {high}");
            }
        }
    }
}

#[test]
fn octaves_fade_without_a_jump() {
    let field = Field::default().compile::<2>(&NoImages).unwrap();
    let at = field.anchor(&Place::ORIGIN);
    let mut last = field.value_f64(&at, [123.0, 456.0], 0.5);
    for step in 1..4000 {
        let value = field.value_f64(&at, [123.0, 456.0], 0.5 * 1.003_f64.powi(step));
        assert!((value - last).abs() < 6.0, "{last} to {value}");
        last = value;
    }
    assert_eq!(last, 0.0);
}

#[test]
fn no_octaves_and_no_amplitude_are_level() {
    for fractal in [Fractal { octaves: 0.0, ..Fractal::default() }, Fractal { amplitude: 0.0, ..Fractal::default() }] {
        let field = Field::from(fractal).compile::<2>(&NoImages).unwrap();
        let jet = field.jet_f64(&field.anchor(&Place::ORIGIN), [3.0, 4.0], 0.0);
        assert_eq!((jet.v, jet.g), (0.0, [0.0; 2]));
        let (low, high) = field.range();
        assert!(low <= 0.0 && high >= 0.0 && high - low < 1e-6, "{low} to {high}");
    }
}

#[test]
fn images_lie_where_they_are_put() {
    let image = ImageField {
        path: "large".into(),
        centre: [100.0, -50.0],
        size: [770.0, 1310.0],
        low: 0.0,
        high: 65535.0,
        ..ImageField::default()
    };
    let field = Field::from(image).compile::<2>(&Pictures).unwrap();
    let at = field.anchor(&Place::ORIGIN);
    let picture = crate::field::ImageSource::load(&Pictures, "large").unwrap();
    // At a texel's centre a cubic B-spline weighs 1, 4, 1 over 6 along each axis.
    let weights = [1.0, 4.0, 1.0];
    let (x, z) = (20, 70);
    let mut expected = 0.0;
    for (j, wz) in weights.iter().enumerate() {
        for (i, wx) in weights.iter().enumerate() {
            expected += wx * wz / 36.0 * f64::from(picture.texels[(z + j - 1) * 77 + x + i - 1]);
        }
    }
    let q = [100.0 - 385.0 + (x as f64 + 0.5) * 10.0, -50.0 - 655.0 + (z as f64 + 0.5) * 10.0];
    let value = field.value_f64(&at, q, 0.0);
    assert!((value - expected).abs() < 1e-6, "{value} and {expected}");
    // Beyond the edge the outermost texels go on.
    let corner = f64::from(picture.texels[0]);
    assert!((field.value_f64(&at, [-1e7, -1e7], 0.0) - corner).abs() < 1e-6);
}

#[test]
fn every_kind_of_node_is_tested() {
    for (kind, (name, field)) in KINDS.iter().zip(every_kind(1)) {
        assert_eq!(*kind, name);
        assert_eq!(*kind, field.name());
    }
}
