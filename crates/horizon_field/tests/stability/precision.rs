//! Section 2: single precision and overflow.

use horizon_field::field::arbitrary::Random;
use horizon_field::field::{Fractal, NoImages};
use horizon_field::march::Ray;
use horizon_field::methods::{HeightField, Method, Setting, Work};
use horizon_field::noise::Basis;
use horizon_field::{CELL, Compiled, Field, LatticePoint, Layer, Place};

use super::statistics::{correlation, largest, rms};

/// Cells of a quarter of a metre: the 2³¹st of them is 5.4 · 10⁸ m from the origin.
fn quarters() -> Layer<2> {
    Layer::new([[4.0, 0.0], [0.0, 4.0]], [0.0; 2], 7)
}

/// The noise of a cell as `cell` takes it from the true one.
fn noise(at: LatticePoint<f64, 2>, cell: impl Fn(i64) -> i64) -> f64 {
    Basis::Gradient.jet(&LatticePoint { cell: at.cell.map(cell), ..at }, 7).v
}

/// The noise over 1000 points, up to 50 m from a place at x = z = `metres`.
fn around(metres: f64, cell: impl Fn(i64) -> i64) -> Vec<f64> {
    let (layer, mut random) = (quarters(), Random::new(1));
    let anchor = layer.anchor(&Place::from_metres([metres, 0.0, metres]));
    let mut point = || [(); 2].map(|()| random.within(-50.0, 50.0));
    (0..1000).map(|_| noise(layer.at(&anchor, point()), &cell)).collect()
}

#[test]
fn cells_that_wrap_at_32_bits_repeat_the_world() {
    // 2³² cells apart, both within 10⁹ m of the origin.
    let places = [-5e8, -5e8 + 1_073_741_824.0];
    let [a, b] = places.map(|metres| around(metres, |cell| i64::from(cell as i32)));
    assert_eq!(a, b, "of the low word alone, two places must have one ground");
    let [a, b] = places.map(|metres| around(metres, |cell| cell));
    let in_common = correlation(&a, &b);
    assert!(in_common.abs() < 0.15, "{in_common}");
}

#[test]
fn cells_that_saturate_at_32_bits_are_all_the_same() {
    // What a conversion of a float to `i32` does, in Rust and on devices.
    let saturated = |cell: i64| cell.clamp(i64::from(i32::MIN), i64::from(i32::MAX));
    let (layer, place) = (quarters(), Place::from_metres([1e9, 0.0, -1e9]));
    let anchor = layer.anchor(&place);
    let row = |cell: &dyn Fn(i64) -> i64| -> Vec<f64> {
        (0..400).map(|i| noise(layer.at(&anchor, [0.1 + 0.25 * f64::from(i), 0.1]), cell)).collect()
    };
    let naive = row(&saturated);
    assert!(naive.iter().all(|v| (v - naive[0]).abs() < 1e-9), "a row of cells must be one cell");
    let ours = row(&|cell| cell);
    assert!(rms(ours.windows(2).map(|pair| pair[1] - pair[0])) > 0.2, "cells differ from their neighbours");
}

#[test]
fn low_words_carry_into_high_words_within_the_view() {
    // The 2³²nd cell, seen from 10 m before it and from 10 m behind it: the ground is one.
    let (layer, border) = (quarters(), 1_073_741_824.0);
    let from = [-10.0, 10.0].map(|by| (layer.anchor(&Place::from_metres([border + by, 0.0, 3.0])), by));
    let mut apart = [0.0f64; 2];
    for i in 0..2000 {
        let x = 0.02 * (f64::from(i) - 1000.0);
        let [[naive_a, a], [naive_b, b]] = from.map(|(anchor, by)| {
            let at = layer.at(&anchor, [x - by, 1.0]);
            // The naive way adds to the low word, and keeps the anchor's high word.
            let high = anchor.cell[0] >> 32 << 32;
            let kept = LatticePoint { cell: [high | i64::from(at.cell[0] as u32), at.cell[1]], ..at };
            [noise(kept, |cell| cell), noise(at, |cell| cell)]
        });
        apart = [apart[0].max((naive_a - naive_b).abs()), apart[1].max((a - b).abs())];
    }
    assert!(apart[0] > 0.5, "without a carry two views must have two grounds: {apart:?}");
    assert!(apart[1] < 1e-9, "{apart:?}");
}

/// The cell and the fraction of m · x without any rounding: f64 is a whole number times a power of two.
fn exact(m: f64, x: i128) -> f64 {
    let exponent = (m.to_bits() >> 52 & 0x7ff) as i32 - 1075;
    let product = i128::from(m.to_bits() & ((1 << 52) - 1) | 1 << 52) * x;
    let rest = product & ((1 << -exponent) - 1);
    rest as f64 * 2.0f64.powi(exponent)
}

#[test]
fn fractions_of_a_high_octaves_coordinates() {
    // The fourteenth octave of 3 km. Errors in cells; half a cell is as wrong as can be.
    let m = 8192.0 / 3000.0;
    let layer = Layer::<2>::new([[m, 0.0], [0.0, m]], [0.0; 2], 7);
    let off = |fraction: f64, truth: f64| (fraction - truth).abs().min(1.0 - (fraction - truth).abs());
    for (metres, single_exceeds, double_exceeds) in
        [(1e4, 5e-4, 0.0), (1e6, 0.05, 0.0), (1e9, 0.3, 1e-7), (1e15, 0.3, 0.1)]
    {
        let [mut single, mut double, mut ours, mut ours_single] = [0.0f64; 4];
        for i in 0..500 {
            let x = metres as i128 + 37 * i;
            let truth = exact(m, x);
            let naive = x as f32 * m as f32;
            single = single.max(off(f64::from(naive - naive.floor()), truth));
            let naive = x as f64 * m;
            double = double.max(off(naive - naive.floor(), truth));
            // Whole cells of the world, and the rest in metres; then as the device has it, 20 m from an anchor.
            let cell = CELL as i128;
            let place = |x: i128| Place::new([(x / cell) as i64, 0, 0], [(x % cell) as f64, 0.0, 0.0]);
            ours = ours.max(off(layer.anchor(&place(x)).fraction[0], truth));
            let near = layer.at(&layer.anchor(&place(x - 20)), [20.0f32, 0.0]).fraction[0];
            ours_single = ours_single.max(off(f64::from(near), truth));
        }
        println!("at {metres:e} m: naive f32 {single:.1e}, f64 {double:.1e}; ours {ours:.1e}, f32 {ours_single:.1e}");
        assert!(single > single_exceeds && double >= double_exceeds, "the naive way must fail: {single}, {double}");
        assert!(ours < 1e-11 && ours_single < 1e-5, "{ours}, {ours_single}");
    }
}

fn meadow() -> Compiled<2> {
    let meadow = Fractal { wavelength: 500.0, amplitude: 60.0, octaves: 12.0, seed: 21, ..Fractal::default() };
    Field::from(meadow).compile(&NoImages).unwrap()
}

#[test]
fn heights_and_slopes_far_from_the_origin() {
    let meadow = meadow();
    let origin = meadow.anchor(&Place::ORIGIN);
    for (metres, height_exceeds, slope_exceeds) in [(1e4, 4e-4, 2e-3), (1e6, 0.03, 0.1), (1e9, 5.0, 0.5)] {
        let here = meadow.anchor(&Place::from_metres([metres, 0.0, -metres]));
        let [mut naive, mut ours] = [[0.0f64; 2]; 2];
        for i in 0..1000 {
            let q = [f64::from(i) * 0.037, f64::from(i) * 0.053];
            let truth = meadow.jet_f64(&here, q, 0.0);
            let absolute = [(metres + q[0]) as f32, (q[1] - metres) as f32];
            for (worst, jet) in [
                (&mut naive, meadow.jet_f32(&origin, absolute, 0.0)),
                (&mut ours, meadow.jet_f32(&here, q.map(|q| q as f32), 0.0)),
            ] {
                worst[0] = worst[0].max((f64::from(jet.v) - truth.v).abs());
                worst[1] = worst[1].max(largest([0, 1].map(|k| f64::from(jet.g[k]) - truth.g[k])));
            }
        }
        println!("at {metres:e} m, in metres and as slopes: naive off by {naive:?}, ours by {ours:?}");
        assert!(naive[0] > height_exceeds && naive[1] > slope_exceeds, "the naive way must fail: {naive:?}");
        assert!(ours[0] < 1e-4 && ours[1] < 1e-4, "{ours:?}");
    }
}

#[test]
fn rays_far_from_the_origin() {
    // One march in single precision, with absolute coordinates and with those relative to the camera's place.
    let meadow = meadow();
    let march = Method::FixedStep { a: 0.2, b: 0.002, c: 0.2, k: 12 };
    for (metres, naive_exceeds) in [(1e6, 0.02), (1e9, 1.0)] {
        let place = Place::from_metres([metres, 0.0, metres]);
        let (near, far) = (HeightField::new(&meadow, &place), HeightField::new(&meadow, &Place::ORIGIN));
        let [near, far] = [near, far].map(|ground| (ground, 400.0));
        let eye = meadow.value_f64(&meadow.anchor(&place), [0.0; 2], 0.0) + 30.0;
        let [mut naive, mut ours] = [0.0f64; 2];
        for i in 0..40 {
            let (turn, fall) = (f64::from(i) * 0.157, -0.4 - 0.01 * f64::from(i));
            let ray = |x: f64| Ray::new([x, eye, x], [turn.cos(), fall, turn.sin()]).unwrap();
            let cast = |(ground, far): &(HeightField<'_>, f64), x: f64| {
                march.cast_f32(&Setting::new(ground, *far, 0.002), &ray(x), &mut Work::default()).map(f64::from)
            };
            let setting = Setting::new(&near.0, near.1, 0.002);
            let truth = march.cast(&setting, &ray(0.0), &mut Work::default()).expect("down from above");
            naive = naive.max((cast(&far, metres).unwrap_or(400.0) - truth).abs());
            ours = ours.max((cast(&near, 0.0).expect("as in double precision") - truth).abs());
        }
        println!("at {metres:e} m: hits off by {naive:.3} m with absolute coordinates, by {ours:.1e} m with ours");
        assert!(naive > naive_exceeds, "the naive way must fail: {naive}");
        assert!(ours < 5e-3, "{ours}");
    }
}

#[test]
fn a_camera_that_moves_a_millimetre() {
    let meadow = meadow();
    let origin = meadow.anchor(&Place::ORIGIN);
    for metres in [1e5, 1e6, 1e9] {
        let start = Place::from_metres([metres, 0.0, metres]);
        // The ground below the camera, and at a stone 3 m before its start, frame by frame.
        let frame = |i: i32| {
            let moved = 0.001 * f64::from(i);
            let absolute = [(metres + moved) as f32, metres as f32];
            let naive = f64::from(meadow.value_f32(&origin, absolute, 0.0));
            let camera = meadow.anchor(&start.translated([moved, 0.0, 0.0]));
            let ours = f64::from(meadow.value_f32(&camera, [0.0; 2], 0.0));
            let stone = f64::from(meadow.value_f32(&camera, [(3.0 - moved) as f32, 0.0], 0.0));
            let truth = meadow.value_f64(&meadow.anchor(&start), [moved, 0.0], 0.0);
            (naive, ours - truth, stone)
        };
        let frames: Vec<_> = (0..500).map(frame).collect();
        let still = frames.windows(2).filter(|pair| pair[0].0 == pair[1].0).count();
        let off = largest(frames.iter().map(|frame| frame.1));
        let drift = largest(frames.iter().map(|frame| frame.2 - frames[0].2));
        println!("at {metres:e} m: the naive camera stands still in {still} of 499 frames; ours is off by {off:.1e} m");
        assert!(still > 400, "the naive camera must stand still: {still}");
        assert!(off < 5e-5 && drift < 5e-5, "{off}, {drift}");
        // And a velocity that is added up in single precision never gets anywhere.
        let eye = (0..1000).fold(metres as f32, |eye, _| eye + 0.001);
        assert_eq!(eye, metres as f32);
        let eye = (0..1000).fold(start, |eye, _| eye.translated([0.001, 0.0, 0.0]));
        assert!((eye.minus(&start)[0] - 1.0).abs() < 1e-9);
    }
}
