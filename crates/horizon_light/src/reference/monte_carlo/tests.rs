use super::*;
use core::f64::consts::{PI, TAU};
use std::sync::LazyLock;

static EARTH: LazyLock<Sky<'static>> = LazyLock::new(|| Sky::new(&Medium::BRUNETON));

#[test]
fn two_estimators_agree() {
    let views = [
        Ray::of_angles(2.0, 0.3, 1.1, 1.0),
        Ray::of_angles(2.0, 1.5, 1.5, 0.1),
        // The ground, from above; and from space, where it is half lit.
        Ray::of_angles(8_000.0, 2.5, 1.1, 2.0),
        Ray::of_angles(400_000.0, 2.2, 1.4, 0.5),
    ];
    for view in views {
        for wavelength in [0, 2] {
            let ours = EARTH.radiance(&view, wavelength, 20_000, 1);
            let pure = EARTH.pure(&view, wavelength, 60_000, 2);
            let error = ours.standard_error.hypot(pure.standard_error);
            assert!((ours.mean - pure.mean).abs() < 3.5 * error, "{view:?} {wavelength}: {ours:?} {pure:?}");
        }
    }
}

#[test]
fn gathering_lowers_the_noise_at_dusk() {
    // Away from a sun below the horizon most events of a path are dark.
    let view = Ray::of_angles(2.0, 88.0_f64.to_radians(), 91.5_f64.to_radians(), PI);
    let (ours, pure) = (EARTH.radiance(&view, 2, 8_192, 3), EARTH.pure(&view, 2, 8_192, 3));
    assert!(ours.standard_error < 0.5 * pure.standard_error, "{ours:?} {pure:?}");
}

#[test]
fn paths_repeat_with_their_seed() {
    let view = Ray::of_angles(2.0, 1.0, 1.0, 1.0);
    assert_eq!(EARTH.radiance(&view, 1, 640, 5), EARTH.radiance(&view, 1, 640, 5));
    assert_ne!(EARTH.radiance(&view, 1, 640, 5), EARTH.radiance(&view, 1, 640, 6));
}

#[test]
fn errors_stay_within_what_is_asked() {
    let view = Ray::of_angles(2.0, 1.3, 1.4, 2.0);
    let found = EARTH.radiance_within(&view, 2, 0.01, 1_000_000, 1);
    assert!(found.standard_error <= 0.01 * found.mean, "{found:?}");
    let stopped = EARTH.radiance_within(&view, 2, 1e-9, 1_000, 1);
    assert!(stopped.standard_error > 1e-9 * stopped.mean);
    // Dark views end at once.
    let outside = Ray { h: 1e6, mu: 0.5, mu_s: 0.5, nu: 0.0 };
    assert_eq!(EARTH.radiance_within(&outside, 0, 0.01, 1_000_000, 1).mean, 0.0);
}

#[test]
fn standard_errors_are_what_they_say() {
    // Of 40 runs, the spread of the means is the mean standard error.
    let view = Ray::of_angles(2.0, 1.4, 1.1, 2.5);
    let runs: Vec<Estimate> = (0..40).map(|seed| EARTH.radiance(&view, 2, 1_280, seed)).collect();
    let mean = runs.iter().map(|run| run.mean).sum::<f64>() / 40.0;
    let spread = (runs.iter().map(|run| (run.mean - mean).powi(2)).sum::<f64>() / 39.0).sqrt();
    let said = runs.iter().map(|run| run.standard_error).sum::<f64>() / 40.0;
    assert!((spread / said - 1.0).abs() < 0.4, "{spread} {said}");
}

#[test]
fn a_white_furnace_keeps_its_light() {
    // Light that arrives on the disc of the top leaves it again: at any angle with the sun, or straight on beside the
    // ground.
    let medium = Medium::BRUNETON.lossless();
    let sky = Sky::new(&medium);
    let top = medium.radius + medium.height;
    // Suns all around the planet and views down through the top, spread by a Kronecker sequence (powers of the root of
    // x⁴ = x + 1).
    let views = 6000;
    let leaving: f64 = (1..=views)
        .map(|i| {
            let [x, y, z] = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step: f64| (step * f64::from(i)).fract());
            // By the cosine's square, which is an even spread of the flux.
            let view = Ray::of_angles(medium.height, (-y.sqrt()).acos(), (2.0 * x - 1.0).acos(), PI * z);
            4.0 * PI * sky.pure(&view, 1, 64, 0).mean / medium.irradiance[1] / f64::from(views)
        })
        .sum();
    let n = 1000;
    let passed: f64 = (0..n)
        .map(|i| {
            let lowest = medium.height * (i as f64 + 0.5) / n as f64;
            let b = medium.radius + lowest;
            let mu = -(((medium.height - lowest) * (top + b)).sqrt() / top);
            2.0 * b * (-sky.depths[1].depth(medium.height, mu)).exp() * medium.height / n as f64 / (top * top)
        })
        .sum();
    assert!((leaving + passed - 1.0).abs() < 0.01, "{leaving} leaves, {passed} passes");
}

#[test]
fn turns_keep_their_angle() {
    let mut random = Random::new(1, 2);
    for _ in 0..1000 {
        let from = turned([0.0, 0.0, 1.0], 2.0 * random.uniform() - 1.0, TAU * random.uniform());
        let cosine = 2.0 * random.uniform() - 1.0;
        let to = turned(from, cosine, random.angle());
        assert!((dot(from, to) - cosine).abs() < 1e-9);
    }
    assert!((dot(turned([0.0, 0.0, -1.0], 0.3, 1.0), [0.0, 0.0, -1.0]) - 0.3).abs() < 1e-12);
}
