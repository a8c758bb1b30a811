use core::f64::consts::{PI, TAU};

use proptest::prelude::*;

use crate::water::rough::*;
use crate::water::surface::fresnel;

const N: f64 = 1.333;
const SUN: f64 = 0.004_675;
const UP: [f64; 3] = [0.0, 1.0, 0.0];

fn direction(cosine: f64, azimuth: f64) -> [f64; 3] {
    let sine = libm::sqrt((1.0 - cosine * cosine).max(0.0));
    [sine * libm::cos(azimuth), cosine, sine * libm::sin(azimuth)]
}

/// Fresnel's mean over the facets of Gaussian slopes that a view sees, summed facet by facet; and the sum of what is seen.
fn summed(cosine: f64, variance: f64, index: f64) -> [f64; 2] {
    const STEPS: i32 = 200;
    let (sigma, sine) = (libm::sqrt(variance), libm::sqrt(1.0 - cosine * cosine));
    let [mut reflected, mut seen, mut all] = [0.0; 3];
    for i in 0..STEPS {
        for j in 0..STEPS {
            let [p, q] = [i, j].map(|k| sigma * 7.0 * (f64::from(2 * k + 1) / f64::from(STEPS) - 1.0));
            let chance = libm::exp(-0.5 * (p * p + q * q) / variance);
            let facing = (cosine - p * sine).max(0.0);
            all += chance;
            seen += chance * facing;
            reflected += chance * facing * fresnel(facing / libm::sqrt(1.0 + p * p + q * q), index);
        }
    }
    [reflected / seen, seen / all]
}

#[test]
fn mean_reflectance_is_the_integral_s() {
    let bruneton = |c: f64, sigma: f64| {
        let away = libm::pow(1.0 - c, 5.0 * libm::exp(-2.69 * sigma)) / (1.0 + 22.7 * libm::pow(sigma, 1.5));
        0.02037 + 0.97963 * away
    };
    let [mut ours, mut published, mut flat] = [0.0_f64; 3];
    for variance in [1e-5, 1e-4, 1e-3, 0.005, 0.02, 0.05, 0.1, 0.2] {
        for c in [0.0, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0] {
            let [truth, _] = summed(c, variance, N);
            ours = ours.max((reflectance(c, variance, N) - truth).abs());
            published = published.max((bruneton(c, libm::sqrt(variance)) - truth).abs());
            flat = flat.max((fresnel(c, N) - truth).abs());
            let single = f64::from(reflectance(c as f32, variance as f32, N as f32));
            assert!((single - reflectance(c, variance, N)).abs() < 1e-4);
        }
    }
    println!("off the integral by {ours:.4}; Bruneton et al. {published:.4}; a flat surface {flat:.4}");
    assert!(ours < FIT_ERROR, "{ours}");
    assert!(published > 0.1 && flat > 0.8, "naive: {published}, {flat}");
}

#[test]
fn a_smooth_surface_reflects_as_a_flat_one() {
    for i in 0..=100 {
        let c = f64::from(i) / 100.0;
        let level = if i == 0 { 0.01 } else { 1e-5 };
        assert!((reflectance(c, 0.0, N) - fresnel(c, N)).abs() < level, "{c}");
    }
}

/// Flat water shows the sun's own disc: its mean radiance times Fresnel's reflectance, high or low, and no more off the mirror.
#[test]
fn flat_water_mirrors_the_disc() {
    let disc = 1.0 / (PI * SUN * SUN);
    for cosine in [1.0, 0.7, 0.3, 0.1, 0.03] {
        let (sun, mirror) = (direction(cosine, 0.0), direction(cosine, PI));
        let ours = glitter(mirror, sun, UP, [0.0; 2], SUN, N);
        assert!((ours / (disc * fresnel(cosine, N)) - 1.0).abs() < 1e-6, "{cosine}: {ours}");
        let [m, s] = [mirror, sun].map(|v| v.map(|x| x as f32));
        let single = f64::from(glitter(m, s, [0.0, 1.0, 0.0], [0.0; 2], SUN as f32, N as f32));
        assert!((single / ours - 1.0).abs() < 2e-3, "{cosine}: {single}, not {ours}");
        // A variance for the disc alone is right under a high sun, and under a low one too bright by 1/cosine.
        let variance = sun_variance(SUN);
        let naive = fresnel(cosine, N) / (4.0 * cosine * TAU * variance);
        assert!((naive / ours * cosine - 1.0).abs() < 1e-6, "naive: {naive}");
        // Two radii off, the Gaussian has e⁻⁴ left.
        let beside = direction(libm::cos(libm::acos(cosine) + 2.0 * SUN), PI);
        assert!(glitter(beside, sun, UP, [0.0; 2], SUN, N) < 0.05 * ours, "{cosine}");
    }
}

/// The share of the sun's light on a level plane that comes back up: the integral over all views.
fn albedo(sun: [f64; 3], variance: [f64; 2], index: f64) -> f64 {
    // Over half vectors about the vertical, as slopes: dω = 4 (s·h) h_y³ dp dq.
    const STEPS: i32 = 400;
    let reach = variance.map(|v| 8.0 * libm::sqrt(v + 1e-5));
    let mut sum = 0.0;
    for i in 0..STEPS {
        for j in 0..STEPS {
            let at = |k: i32, reach: f64| reach * (f64::from(2 * k + 1) / f64::from(STEPS) - 1.0);
            let (p, q) = (at(i, reach[0]), at(j, reach[1]));
            let up = 1.0 / libm::sqrt(1.0 + p * p + q * q);
            let half = [-p * up, up, -q * up];
            let facing: f64 = (0..3).map(|k| half[k] * sun[k]).sum();
            let view: [f64; 3] = core::array::from_fn(|k| 2.0 * facing * half[k] - sun[k]);
            if facing > 0.0 && view[1] > 0.0 {
                let solid = 4.0 * facing * up * up * up * 4.0 * reach[0] * reach[1] / f64::from(STEPS * STEPS);
                sum += glitter(view, sun, UP, variance, SUN, index) * view[1] * solid;
            }
        }
    }
    sum / sun[1]
}

#[test]
fn no_light_is_made() {
    for variance in [[1e-4, 1e-4], [0.001, 0.004], [0.02, 0.01], [0.05, 0.05], [0.1, 0.03]] {
        for cosine in [1.0, 0.7, 0.4, 0.2, 0.1, 0.05] {
            for azimuth in [0.0, 1.0, PI / 2.0] {
                let ours = albedo(direction(cosine, azimuth), variance, N);
                // Facets that would send light down are lost, as is what they would reflect a second time.
                let around = reflectance(cosine, variance[0].max(variance[1]), N).max(fresnel(cosine, N));
                assert!(ours < 1.05 * around + 2e-3, "{variance:?}, {cosine}: {ours}, of {around}");
            }
        }
    }
}

#[test]
fn little_roughness_keeps_fresnel_s_share() {
    for cosine in [1.0, 0.7, 0.4, 0.2] {
        let ours = albedo(direction(cosine, 0.5), [1e-4; 2], N);
        assert!((ours / fresnel(cosine, N) - 1.0).abs() < 0.02, "{cosine}: {ours}, not {}", fresnel(cosine, N));
    }
    // And rough surfaces that of their facets, where none hides another.
    let ours = albedo(UP, [0.02; 2], N);
    assert!((ours / summed(1.0, 0.02, N)[0] - 1.0).abs() < 0.03, "{ours}");
}

/// Light and eye changed over, the share of light that goes from one to the other is the same.
#[test]
fn glitter_is_reciprocal() {
    let variance = [0.02, 0.005];
    for (a, b) in [(0.9, 0.3), (0.2, 0.5), (0.1, 0.12), (1.0, 0.4)] {
        let (s, v) = (direction(a, 0.3), direction(b, 2.9));
        let (there, back) = (glitter(v, s, UP, variance, SUN, N) / s[1], glitter(s, v, UP, variance, SUN, N) / v[1]);
        assert!((there / back - 1.0).abs() < 5e-3, "{there}, {back}");
    }
}

/// A tilted mean plane moves the glitter with its normal.
#[test]
fn resolved_waves_turn_the_glitter() {
    let normal = direction(libm::cos(0.1), 0.0);
    let (sun, variance) = (direction(libm::cos(0.5), 0.0), [1e-4; 2]);
    let at = |angle: f64| glitter(direction(libm::cos(angle), PI), sun, normal, variance, SUN, N);
    let brightest = (-60..60).map(|i| f64::from(i) / 100.0).max_by(|a, b| at(*a).total_cmp(&at(*b))).expect("some");
    assert!((brightest - 0.3).abs() < 0.011, "{brightest}");
}

/// Without masking, what a view sees of the sea shrinks with its cosine: infinitely bright at the horizon.
#[test]
fn the_horizon_is_as_bright_as_its_facets() {
    let sun = direction(0.05, 0.0);
    let at = |cosine: f64| glitter(direction(cosine, PI), sun, UP, [0.01; 2], SUN, N);
    for cosine in [1e-2, 1e-4, 1e-6, 0.0] {
        let naive = 0.5 / (TAU * 0.01) / (4.0 * cosine);
        assert!((at(cosine) / at(0.0) - 1.0).abs() < 0.3, "{cosine}: {}", at(cosine));
        assert!(cosine > 1e-3 || naive > 100.0 * at(cosine), "naive: {naive}");
    }
}

proptest! {
    #[test]
    fn nothing_is_nan(
        view in prop::array::uniform3(-1.0_f32..1.0),
        sun in prop::array::uniform3(-1.0_f32..1.0),
        normal in prop::array::uniform3(-1.0_f32..1.0),
        x in prop::sample::select(vec![0.0_f32, 1e-9, 1e-5, 0.01, 0.3, 1.0]),
        z in prop::sample::select(vec![0.0_f32, 1e-9, 1e-5, 0.01, 0.3, 1.0]),
        radius in prop::sample::select(vec![0.0_f32, 1e-6, 0.004_675, 0.5]),
        index in 1.0_f32..1.6,
        opposite in 0..4,
    ) {
        let unit = |v: [f32; 3]| {
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length < 1e-3 { [0.0, 1.0, 0.0] } else { v.map(|x| x / length) }
        };
        let (view, mut sun, normal) = (unit(view), unit(sun), unit(normal));
        match opposite {
            0 => sun = view.map(|x| -x),
            1 => sun = [-view[0], view[1], -view[2]],
            _ => {}
        }
        let l = glitter(view, sun, normal, [x, z], radius, index);
        prop_assert!(l.is_finite() && l >= 0.0, "{l}");
        for variance in [x, z] {
            let f = reflectance(view[1], variance, index);
            prop_assert!((0.0..=1.0).contains(&f), "{f}");
        }
    }
}
