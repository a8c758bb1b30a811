//! Steps that are longer than the ground's slope allows.

use core::f64::consts::TAU;

use super::grounds::Ridges;
use super::{CERTIFIED, PIXEL, ray, shoot, truth, wrong};
use crate::field::{Clamp, Compiled, Field, NoImages, Noise};
use crate::march::fixtures::{Plane, Waves};
use crate::march::{Ray, Surface};
use crate::methods::path::crossing;
use crate::methods::{Ground, HeightField, MARCH_STEPS, Method, Setting, Work};
use crate::place::Place;

const RIDGES: Ridges = Ridges { height: 80.0, slope: 10.0, spacing: 500.0 };

/// Level rays that meet the ridges near their crests, 20 to 40 cm thick there.
fn level() -> Vec<Ray> {
    (0..40).map(|i| ray([20.0 + 3.7 * f64::from(i), 78.0 + 0.025 * f64::from(i), 0.0], [1.0, 0.0, 0.0])).collect()
}

#[test]
fn c_of_1_and_more_leaps_through() {
    let by_height = |c: f64| wrong(&RIDGES, Method::FixedStep { a: 0.05, b: 0.0, c, k: 10 }, &level(), 1000.0);
    let safe = 1.0 / (1.0 + RIDGES.slope * RIDGES.slope).sqrt();
    let [safe, one, fifty] = [safe, 1.0, 50.0].map(by_height);
    assert_eq!(safe, 0, "c = 1/√(1 + L²)");
    assert!(one > 20 && fifty > 20, "c = 1 gets {one} of 40 wrong, c = 50 {fifty}");
}

#[test]
fn cliffs_steeper_than_the_step_heuristic_assumes() {
    let waves = Field::Noise(Noise { wavelength: 25.0, amplitude: 400.0, seed: 8, ..Noise::default() });
    let walls: Compiled<2> =
        Field::Clamp(Clamp { field: waves.into(), low: 0.0, high: 60.0 }).compile(&NoImages).unwrap();
    let ground = HeightField::new(&walls, &Place::ORIGIN);
    let start = |i: i32| {
        let (at, angle) = ([f64::from(i) * 13.0, f64::from(i) * -7.0], f64::from(i) * 0.157);
        ray([at[0], ground.jet(at).v + 3.0, at[1]], [angle.cos(), -0.004, angle.sin()])
    };
    let rays: Vec<_> = (0..200).map(start).collect();
    // Seed 000's experiments have a = 5, b = 0.005 and c from 0 to 100.
    for c in [0.5, 2.0, 50.0] {
        let fixed = Method::FixedStep { a: 5.0, b: 0.005, c, k: 10 };
        let leapt = wrong(&ground, fixed, &rays, 400.0);
        assert!(leapt >= 2, "{fixed} gets {leapt} wrong");
    }
    for method in CERTIFIED {
        assert_eq!(wrong(&ground, method, &rays, 400.0), 0, "{method}");
    }
}

#[test]
fn over_relaxation_falls_back() {
    // The same without a look at whether the spheres overlap.
    let reckless = |ray: &Ray| {
        let shrink = 1.0 / (1.0 + RIDGES.slope * RIDGES.slope).sqrt();
        let mut t = 0.0;
        while t < 1000.0 {
            let [x, y, z] = ray.at(t);
            let radius = shrink * (y - RIDGES.height([x, z]));
            if radius <= 0.05 * PIXEL * t {
                return Some(t);
            }
            t += 1.9 * radius;
        }
        None
    };
    let rays = level();
    let off = |ray: &&Ray| reckless(ray).is_none_or(|t| (t - truth(&RIDGES, ray, 1000.0).unwrap()).abs() > 1.0);
    let leapt = rays.iter().filter(off).count();
    assert!(leapt > 10, "{leapt} of 40");
    for omega in [1.0, 1.2, 1.6, 1.9] {
        let method = Method::SphereTracing { omega, pixel: 0.05 };
        assert_eq!(wrong(&RIDGES, method, &rays, 1000.0), 0, "{method}");
    }
}

#[test]
fn steps_that_run_out_leave_the_nearest_candidate() {
    // Some centimetres over the crests of waves, level: in far more steps than there are, and to no end.
    let waves = Waves(vec![(100.0, TAU / 1000.0)]);
    let over = ray([0.0, 99.95, 257.0], [1.0, 0.0, 0.0]);
    let sphere = Method::SphereTracing { omega: 1.0, pixel: 0.5 };
    let mut work = Work::default();
    let t = sphere.cast(&Setting::new(&waves, 1e6, 1e-9), &over, &mut work).expect("the nearest candidate");
    assert_eq!(work.steps, u64::from(MARCH_STEPS));
    let crest = (t - 250.0).rem_euclid(1000.0);
    assert!(crest.min(1000.0 - crest) < 5.0 && t > 5000.0, "{t} is not at a far crest");
}

#[test]
fn interpolation_has_the_right_signs() {
    // Seed 000 eq. 2.7 as it is printed, with H and y at t, and at t − λ: it is right only where the ray is level with 0.
    let printed = |t: f64, lambda: f64, [h, y]: [f64; 2], [h_last, y_last]: [f64; 2]| {
        t - lambda * (h - y) / (h - y - h_last - y_last)
    };
    let plane = Plane { height: 100.0, slope: [0.2, 0.0] };
    let down = ray([0.0, 140.0, 0.0], [1.0, -0.5, 0.0]);
    let expected = truth(&plane, &down, 500.0).unwrap();
    let side = |t: f64| {
        let [x, y, z] = down.at(t);
        [plane.jet([x, z]).v, y]
    };
    let (last, t) = (40.0, 80.0);
    let ([h, y], [h_last, y_last]) = (side(t), side(last));
    assert!((printed(t, t - last, [h, y], [h_last, y_last]) - expected).abs() > 10.0);
    assert!((crossing([last, t], [y_last - h_last, y - h]) - expected).abs() < 1e-9);
    let fixed = Method::FixedStep { a: 40.0, b: 0.0, c: 0.0, k: 0 };
    assert!((shoot(&plane, fixed, &down, 500.0).unwrap() - expected).abs() < 1e-9);
}
