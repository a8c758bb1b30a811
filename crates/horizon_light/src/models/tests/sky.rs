//! The sky against the Monte Carlo, and aerial perspective against the sky.

use super::{Sky, earth};
use crate::geometry::horizon_cosine;
use crate::medium::Medium;
use crate::models::planar::planar;
use crate::models::scatter::{Once, Scattered, SkyRay, VIEW_STEPS};
use crate::models::sky_view::SkyView;
use crate::reference::Ray;
use crate::reference::monte_carlo;

/// The sun's zenith angle in degrees, the altitude in metres, and the RMS relative error that the default model may have.
const CASES: [(f64, f64, f64); 6] =
    [(30.0, 2.0, 0.02), (65.0, 2.0, 0.02), (80.0, 2.0, 0.03), (88.0, 2.0, 0.05), (91.5, 2.0, 0.20), (65.0, 8e3, 0.03)];

/// Zenith and azimuth in degrees.
const DIRECTIONS: [(f64, f64); 7] =
    [(5.0, 90.0), (50.0, 30.0), (50.0, 150.0), (80.0, 0.0), (80.0, 90.0), (88.0, 45.0), (88.5, 180.0)];

fn f32_ray(ray: &Ray) -> SkyRay<f32> {
    SkyRay { h: ray.h as f32, mu: ray.mu as f32, mu_s: ray.mu_s as f32, nu: ray.nu as f32 }
}

#[test]
fn the_models_against_monte_carlo() {
    let Sky { air, moments, isotropic, .. } = earth();
    let truth = monte_carlo::Sky::new(&Medium::BRUNETON);
    for (zenith, h, allowed) in CASES {
        let mu_s = zenith.to_radians().cos() as f32;
        let table = SkyView::new(&earth().scene(moments), h as f32, mu_s, VIEW_STEPS);
        // Of the default model from its table, of the fast one, of single scattering, and of single scattering over flat ground.
        let mut squares = [[0.0_f64; 3]; 4];
        for (view, azimuth) in DIRECTIONS {
            let ray = Ray::of_angles(h, view.to_radians(), f64::to_radians(zenith), azimuth.to_radians());
            let view = f32_ray(&ray);
            let of = |sum: Scattered<f32>| sum.radiance(air, view.nu);
            let ours = [
                table.radiance(air, view.mu, view.nu),
                of(earth().scene(isotropic).sky(&view, VIEW_STEPS)),
                of(earth().scene(&Once).sky(&view, VIEW_STEPS)),
                of(planar(air, &view, f32::MAX, VIEW_STEPS)),
            ];
            for k in 0..3 {
                let mean = truth.radiance_within(&ray, k, 0.005, 100_000, 1).mean;
                for (squares, ours) in squares.iter_mut().zip(ours) {
                    squares[k] += (ours[k] as f64 / mean - 1.0).powi(2);
                }
            }
        }
        let [moments, isotropic, once, flat] = squares.map(|s| s.map(|s| (s / DIRECTIONS.len() as f64).sqrt()));
        println!("{zenith} at {h} m: {moments:.4?} {isotropic:.4?} {once:.4?} {flat:.4?}");
        for k in 0..3 {
            assert!(moments[k] < allowed, "sun at {zenith}, {h} m up: {moments:?}");
            // Light that was scattered twice is not to be left out.
            assert!(
                once[k] > 2.0 * allowed.min(0.05) && flat[k] > 2.0 * allowed.min(0.05),
                "{zenith}: {once:?} {flat:?}"
            );
            assert!(isotropic[k] < 0.15 && moments[2] < isotropic[2], "{zenith}: {isotropic:?}");
        }
    }
}

fn rays() -> impl Iterator<Item = SkyRay<f32>> {
    let altitudes = [0.1, 2.0, 900.0, 8e3, 5.9e4, 4e5, 6e6];
    altitudes
        .into_iter()
        .flat_map(|h| {
            let horizon = horizon_cosine(Medium::BRUNETON.radius as f32, h);
            [0.9, 0.3, 0.05, horizon + 1e-3, horizon - 1e-3, -0.5, -1.0].map(|mu| (h, mu))
        })
        .flat_map(|(h, mu)| {
            [0.9_f32, 0.3, 0.01, -0.03].map(|mu_s| {
                let sine = |c: f32| ((1.0 - c) * (1.0 + c)).sqrt();
                SkyRay { h, mu, mu_s, nu: mu * mu_s + 0.4 * sine(mu) * sine(mu_s) }
            })
        })
}

fn relative(a: f32, b: f32) -> f32 {
    (a - b).abs() / a.max(b).max(1e-9)
}

#[test]
fn aerial_perspective_ends_as_the_sky() {
    let scene = earth().scene(&earth().moments);
    for view in rays() {
        let far = scene.in_scatter(&view, 1e9, VIEW_STEPS);
        let sky = scene.sky(&view, VIEW_STEPS);
        assert_eq!((far.mie, far.transmittance), (sky.mie, sky.transmittance), "{view:?}");
        for k in 0..3 {
            // The sky has the ground's light too.
            assert!(far.soft[k] <= sky.soft[k], "{view:?}");
            assert!(crate::geometry::hits_ground(earth().air.radius, view.h, view.mu) || far.soft[k] == sky.soft[k]);
        }
    }
}

#[test]
fn air_adds_and_takes_light_with_distance() {
    let scene = earth().scene(&earth().moments);
    for view in rays().filter(|view| view.h < 6e4) {
        assert_eq!(scene.in_scatter(&view, 0.0, 8), Scattered::nothing());
        let mut before = Scattered::nothing();
        let mut distance = 1.0;
        while distance < 1e6 {
            let now = scene.in_scatter(&view, distance, VIEW_STEPS);
            for k in 0..3 {
                // As far as the midpoint rule's own error goes.
                assert!(
                    now.transmittance[k] <= before.transmittance[k] * 1.003,
                    "{view:?} {distance} {now:?} {before:?}"
                );
                assert!(now.soft[k] >= before.soft[k] * 0.97, "{view:?} {distance} {now:?} {before:?}");
            }
            before = now;
            distance *= 2.0;
        }
    }
}

/// A stretch of air, and what is behind it, is the same as both at once.
#[test]
fn stretches_of_air_compose() {
    let scene = earth().scene(&earth().moments);
    for view in rays().filter(|view| view.h < 6e4 && view.mu > 0.0) {
        let near = scene.in_scatter(&view, 2e4, 32);
        let moved = view.advanced(earth().air.radius, 2e4);
        if moved.h >= earth().air.height {
            continue;
        }
        let (far, whole) = (scene.sky(&moved, 32), scene.sky(&view, 32));
        for k in 0..3 {
            let joined = near.soft[k] + near.transmittance[k] * far.soft[k];
            assert!(relative(joined, whole.soft[k]) < 0.02, "{view:?} {joined} {whole:?}");
        }
    }
}

/// From just above the air's top all is as from just below it.
#[test]
fn no_step_at_the_top_of_the_air() {
    let scene = earth().scene(&earth().moments);
    for mu in [-1.0_f32, -0.5, -0.2, -0.14] {
        let at = |h: f32| scene.sky(&SkyRay { h, mu, mu_s: 0.4, nu: 0.3 }, VIEW_STEPS);
        let (below, above) = (at(59_990.0), at(60_010.0));
        for k in 0..3 {
            assert!(relative(below.soft[k], above.soft[k]) < 0.01, "{mu}: {below:?} {above:?}");
        }
    }
}

/// Twilight is blue overhead, sunset is red at the horizon, and night is dark.
#[test]
fn colours_of_the_day() {
    let Sky { air, moments, .. } = earth();
    let look = |zenith: f32, mu: f32| {
        let mu_s = zenith.to_radians().cos();
        let nu = mu * mu_s + ((1.0 - mu * mu) * (1.0 - mu_s * mu_s)).sqrt();
        earth().scene(moments).sky(&SkyRay { h: 2.0, mu, mu_s, nu }, VIEW_STEPS).radiance(air, nu)
    };
    let [noon, twilight, sunset] = [look(30.0, 1.0), look(94.0, 1.0), look(90.0, 0.02)];
    println!("noon {noon:?}, twilight {twilight:?}, sunset {sunset:?}");
    assert!(noon[2] > 2.0 * noon[0] && twilight[2] > 1.5 * twilight[0] && sunset[0] > 2.0 * sunset[2]);
    assert!(twilight[2] < 0.01 * noon[2]);
    for zenith in [110.0, 150.0, 180.0] {
        assert!(
            look(zenith, 1.0).iter().chain(&look(zenith, 0.02)).all(|&light| (0.0..1e-7).contains(&light)),
            "{zenith}"
        );
    }
}
