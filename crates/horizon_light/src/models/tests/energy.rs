//! The white furnace: where nothing absorbs and the ground is white, what comes in goes out.

use crate::medium::Medium;
use crate::models::air::Air;
use crate::models::moments::{Moments, Resolution};
use crate::models::scatter::{Scene, SkyRay};
use crate::models::transmittance::{Transmittance, optical_depth};
use crate::reference::quadrature::gauss_legendre;

/// Light that leaves a whole planet over light that comes to it, at each wavelength.
fn returned(air: &Air<f64>, transmittance: &Transmittance<f64>, moments: &Moments<f64>) -> [f64; 3] {
    let scene = Scene { air, transmittance, multiple: moments, sunlit: true };
    let horizon = crate::geometry::horizon_cosine(air.radius, air.height);
    let between = |a: f64, b: f64, n| {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        gauss_legendre(n).into_iter().map(move |(x, w)| (middle + half * x, w * half))
    };
    let mut out = [0.0; 3];
    // Every place of the top, every way out of it: downward views, split where they begin to meet the ground.
    for (mu_s, area) in between(air.night, 0.0, 6).chain(between(0.0, 1.0, 10)) {
        for (mu, weight) in between(-1.0, horizon, 8).chain(between(horizon, 0.0, 8)) {
            for i in 0..16 {
                let azimuth = ((f64::from(i) + 0.5) * core::f64::consts::PI / 16.0).cos();
                let nu = mu * mu_s + ((1.0 - mu * mu) * (1.0 - mu_s * mu_s)).sqrt() * azimuth;
                let view = SkyRay { h: air.height, mu, mu_s, nu };
                let light = scene.sky(&view, 48).radiance(air, nu);
                for k in 0..3 {
                    // Flux through 2πR² dμ_s of the top, over πR² of sunlight.
                    out[k] +=
                        2.0 * light[k] * -mu * weight * area * 2.0 * core::f64::consts::PI / 16.0 / air.irradiance[k];
                }
            }
        }
    }
    // Sunlight that passes through the limb without any event; 2μ dμ is its part of the disc.
    for (mu, weight) in between(0.0, -horizon, 24) {
        let chord = 2.0 * (air.radius + air.height) * mu;
        let depth = optical_depth(air, air.height, -mu, chord, 200);
        for k in 0..3 {
            out[k] += 2.0 * mu * weight * (-depth[k]).exp();
        }
    }
    out
}

#[test]
fn a_white_furnace_loses_nothing() {
    let air = Air::<f64>::new(&Medium::BRUNETON.lossless());
    let transmittance = Transmittance::new(&air);
    let long = Resolution { passes: 24, ..Resolution::DEFAULT };
    let orders = Moments::orders(&air, &transmittance, long);
    let total = |m: &Moments<f64>| -> f64 { m.0.texels.iter().map(|texel| texel[0].iter().sum::<f64>()).sum() };
    let sum: f64 = orders.iter().map(total).sum();
    for pair in orders.windows(2) {
        assert!(total(&pair[1]) < total(&pair[0]), "{} after {}", total(&pair[1]), total(&pair[0]));
    }
    assert!(total(&orders[24]) < 1e-3 * sum, "{} of {sum}", total(&orders[24]));
    let whole = returned(&air, &transmittance, &Moments::resolved(&air, &transmittance, long));
    assert!(whole.iter().all(|part| (part - 1.0).abs() < 0.01), "{whole:?}");
    // With the few passes that a picture has, the geometric series stands for the rest.
    let quick = returned(&air, &transmittance, &Moments::new(&air, &transmittance));
    assert!(quick.iter().all(|part| (part - 1.0).abs() < 0.05), "{quick:?}");
}
