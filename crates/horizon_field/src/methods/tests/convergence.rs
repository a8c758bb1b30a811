//! On smooth ground all methods come to the truth as their settings get finer; and f32 comes near to f64.

use super::{PIXEL, ray, truth};
use crate::field::{Compiled, Field, Fractal, NoImages};
use crate::march::Ray;
use crate::methods::{HeightField, Method, Setting, Work};
use crate::place::Place;

const FAR: f64 = 4000.0;

/// Hills of two octaves, and rays down at them from above: nothing thin, nothing grazed.
fn hills() -> Compiled<2> {
    let fractal = Fractal { wavelength: 1500.0, amplitude: 100.0, octaves: 2.0, seed: 3, ..Fractal::default() };
    Field::Fractal(fractal).compile(&NoImages).unwrap()
}

fn rays() -> Vec<Ray> {
    let turned = |i: i32| (f64::from(i) * 2.4, -0.25 - 0.01 * f64::from(i));
    let one = |i: i32| {
        let (turn, fall) = turned(i);
        ray([0.0, 300.0, 0.0], [turn.cos(), fall, turn.sin()])
    };
    (0..60).map(one).collect()
}

/// The mean error over the rays, in metres; every one must meet the ground.
fn error(method: Method) -> f64 {
    let compiled = hills();
    let ground = HeightField::new(&compiled, &Place::ORIGIN);
    let setting = Setting::new(&ground, FAR, PIXEL);
    let off = |ray: &Ray| {
        let t = method.cast(&setting, ray, &mut Work::default());
        let t = t.unwrap_or_else(|| panic!("{method} misses {ray:?}"));
        (t - truth(&ground, ray, FAR).unwrap()).abs()
    };
    let rays = rays();
    rays.iter().map(off).sum::<f64>() / rays.len() as f64
}

/// Errors fall by at least `ratio` from each setting to the next, and end below a millimetre.
fn assert_converges(ratio: f64, methods: [Method; 4]) {
    let errors = methods.map(error);
    for (pair, methods) in errors.windows(2).zip(methods.windows(2)) {
        assert!(pair[1] * ratio <= pair[0] || pair[0] < 1e-6, "{} to {}: {errors:?}", methods[0], methods[1]);
    }
    assert!(errors[3] < 1e-3, "{}: {errors:?}", methods[3]);
}

#[test]
fn fixed_steps() {
    // Linear interpolation is of second order, a bisection more halves what it is applied to.
    assert_converges(8.0, [32.0, 8.0, 2.0, 0.5].map(|a| Method::FixedStep { a, b: 0.0, c: 0.0, k: 0 }));
    assert_converges(8.0, [0, 2, 4, 6].map(|k| Method::FixedStep { a: 32.0, b: 0.0, c: 0.0, k }));
    assert_converges(1.0, [0.4, 0.2, 0.1, 0.05].map(|c| Method::FixedStep { a: 0.5, b: 0.0, c, k: 4 }));
}

#[test]
fn steps_in_proportion_to_the_distance() {
    assert_converges(8.0, [0.2, 0.05, 0.0125, 0.003].map(|delta| Method::Linear { delta }));
}

#[test]
fn sphere_tracing() {
    for omega in [1.0, 1.6] {
        assert_converges(6.0, [1.0, 0.1, 0.01, 0.0004].map(|pixel| Method::SphereTracing { omega, pixel }));
    }
}

#[test]
fn segments_and_intervals() {
    assert_converges(2.0, [16.0, 4.0, 1.0, 0.0].map(|pixel| Method::Segment { pixel }));
    assert_converges(2.0, [16.0, 4.0, 1.0, 0.0].map(|pixel| Method::Bisection { pixel }));
}

#[test]
fn single_precision_comes_near() {
    let compiled = hills();
    // Far from the world's origin, too: coordinates are relative to the camera's place.
    for place in [Place::ORIGIN, Place::from_metres([1e9, 0.0, -1e9])] {
        let ground = HeightField::new(&compiled, &place);
        let setting = Setting::new(&ground, FAR, PIXEL);
        for method in [
            Method::FixedStep { a: 1.0, b: 0.004, c: 0.5, k: 6 },
            Method::Linear { delta: 0.01 },
            Method::SphereTracing { omega: 1.6, pixel: 0.5 },
        ] {
            for ray in rays() {
                let (mut single, mut double) = (Work::default(), Work::default());
                let t = method.cast_f32(&setting, &ray, &mut single).map(f64::from);
                let expected = method.cast(&setting, &ray, &mut double);
                let off = (t.unwrap() - expected.unwrap()).abs();
                assert!(off < 0.02, "{method}: {off} m");
                assert!(single.evaluations.abs_diff(double.evaluations) <= 2, "{method}: {single:?}, {double:?}");
            }
        }
        let segment = Method::Segment { pixel: 1.0 };
        assert_eq!(segment.cast_f32(&setting, &rays()[0], &mut Work::default()), None);
    }
}
