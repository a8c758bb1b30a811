use proptest::prelude::*;

use crate::reference::quadrature::integrate;
use crate::water::surface::*;

const N: f64 = 1.333;

/// The textbook's form, by angles; `None` where reflection is total.
fn textbook(angle: f64, eta: f64) -> Option<f64> {
    let sine = libm::sin(angle) / eta;
    (sine < 1.0).then(|| {
        let (i, t) = (libm::cos(angle), libm::sqrt(1.0 - sine * sine));
        let across = (i - eta * t) / (i + eta * t);
        let within = (eta * i - t) / (eta * i + t);
        0.5 * (across * across + within * within)
    })
}

#[test]
fn reflectance_is_the_textbook_s_at_all_angles_both_ways() {
    for eta in [N, 1.0 / N, 1.2, 1.0 / 1.2, 1.6, 1.0] {
        for tenth in 0..=900 {
            let angle = f64::from(tenth).to_radians() / 10.0;
            let cosine = libm::cos(angle).max(0.0);
            // At 1 a level ray is let through.
            let truth = if eta == 1.0 { 0.0 } else { textbook(angle, eta).unwrap_or(1.0) };
            assert!((fresnel(cosine, eta) - truth).abs() < 1e-9, "{eta}, {angle}");
            let device = f64::from(fresnel(cosine as f32, eta as f32));
            assert!((device - truth).abs() < 1e-3, "{eta}, {angle}: {device}, not {truth}");
        }
    }
}

#[test]
fn reflectance_at_known_angles() {
    let straight = (N - 1.0) / (N + 1.0) * ((N - 1.0) / (N + 1.0));
    for eta in [N, 1.0 / N] {
        assert!((fresnel(1.0, eta) - straight).abs() < 1e-12 && (straight - 0.02037).abs() < 1e-5);
        // Brewster's angle, tan θ = eta: the part within the plane of incidence is not reflected.
        let brewster = libm::atan(eta);
        let across = libm::sin(brewster - libm::asin(libm::sin(brewster) / eta));
        assert!((fresnel(libm::cos(brewster), eta) - 0.5 * across * across).abs() < 1e-12, "{eta}");
        assert_eq!(fresnel(0.0, eta), 1.0);
    }
}

/// Schlick's approximation, as commonly used for water, is off by a fifth of the reflectance, and has no total reflection.
#[test]
fn the_usual_approximation_is_off() {
    let schlick = |c: f64| 0.02037 + 0.97963 * libm::pow(1.0 - c, 5.0);
    let worst = (0..=100)
        .map(f64::from)
        .fold(0.0_f64, |worst, i| worst.max((schlick(i / 100.0) - fresnel(i / 100.0, N)).abs()));
    assert!(worst > 0.05, "{worst}");
    assert!(schlick(0.6) < 0.04 && fresnel(0.6, 1.0 / N) == 1.0);
}

#[test]
fn ways_there_and_back_are_one() {
    for i in 1..=100 {
        let above = f64::from(i) / 100.0;
        let ray = refract([libm::sqrt(1.0 - above * above), -above, 0.0], [0.0, 1.0, 0.0], N);
        let below = -ray.direction[1];
        assert!(!ray.total && (fresnel(above, N) - fresnel(below, 1.0 / N)).abs() < 1e-12);
        let passed = 1.0 - fresnel(above, N);
        assert!((crossing(above, N) * crossing(below, 1.0 / N) - passed * passed).abs() < 1e-12);
        let back = refract(ray.direction.map(|x| -x), [0.0, -1.0, 0.0], 1.0 / N);
        assert!(!back.total && (back.direction[1] - above).abs() < 1e-12);
    }
}

#[test]
fn all_of_the_sky_is_in_snell_s_window() {
    let critical = critical_cosine(N);
    assert!((libm::acos(critical).to_degrees() - 48.6).abs() < 0.01);
    let level = refract([1.0, -1e-9, 0.0], [0.0, 1.0, 0.0], N);
    assert!((-level.direction[1] - critical).abs() < 1e-9);
    for (cosine, total) in [(critical - 1e-4, true), (critical, true), (critical + 1e-4, false)] {
        let up = [libm::sqrt(1.0 - cosine * cosine), cosine, 0.0];
        let ray = refract(up, [0.0, 1.0, 0.0], 1.0 / N);
        // On the edge itself rounding decides, and either way the ray is level.
        if cosine != critical {
            assert_eq!(ray.total, total, "{cosine}");
            assert_eq!(ray.total, fresnel(cosine, 1.0 / N) == 1.0);
        }
        assert_eq!(ray.direction[1] > 0.0 || cosine == critical, !total || cosine == critical, "{cosine}");
    }
}

#[test]
fn light_of_a_whole_sky() {
    for index in [1.0, 1.05, 1.2, 1.31, N, 1.5, 1.6] {
        let [truth] = integrate(|c| [2.0 * c * fresnel(c, index)], &[0.0, 0.01, 0.1, 1.0], 1e-9);
        assert!((diffuse_reflectance(index) - truth).abs() < 2e-4, "{index}: {truth}");
        // From below 1 − (1 − R)/n² comes back: energy, and the narrower cone.
        let edge = critical_cosine(index);
        let [below] = integrate(|c| [2.0 * c * fresnel(c, 1.0 / index)], &[0.0, edge, edge + 0.01, 1.0], 1e-9);
        assert!((below - (1.0 - (1.0 - truth) / (index * index))).abs() < 1e-5, "{index}: {below}");
    }
}

proptest! {
    #[test]
    fn rays_obey_snell(
        direction in prop::array::uniform3(-1.0_f32..1.0),
        normal in prop::array::uniform3(-1.0_f32..1.0),
        index in 1.0_f32..1.6,
        leaves in any::<bool>(),
    ) {
        let unit = |v: [f32; 3]| {
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length < 1e-3 { [0.0, 1.0, 0.0] } else { v.map(|x| x / length) }
        };
        let (d, n) = (unit(direction), unit(normal));
        let eta = if leaves { 1.0 / index } else { index };
        let dot = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| f64::from(a[k]) * f64::from(b[k])).sum::<f64>();
        let sine = |a: [f32; 3]| {
            let cross: [f64; 3] = core::array::from_fn(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                f64::from(a[i]) * f64::from(n[j]) - f64::from(a[j]) * f64::from(n[i])
            });
            libm::sqrt(cross.iter().map(|x| x * x).sum())
        };
        let ray = refract(d, n, eta);
        prop_assert!((dot(ray.direction, ray.direction) - 1.0).abs() < 1e-5);
        let (before, after) = (dot(d, n), dot(ray.direction, n));
        if ray.total {
            prop_assert!(leaves && (before + after).abs() < 1e-5);
        } else {
            prop_assert!(before * after > -1e-6, "{before}, {after}");
            prop_assert!((sine(d) - f64::from(eta) * sine(ray.direction)).abs() < 1e-5);
        }
        let f = fresnel(before as f32, eta);
        prop_assert!((0.0..=1.0).contains(&f));
    }

    #[test]
    fn reflectance_is_a_share(cosine in -1.001_f32..1.001, eta in 0.6_f32..1.6) {
        let f = fresnel(cosine, eta);
        prop_assert!((0.0..=1.0).contains(&f), "{f}");
    }
}
