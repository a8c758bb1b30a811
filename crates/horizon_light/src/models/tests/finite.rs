//! No NaN, no infinity, nothing negative: whatever the air, the place and the direction.

use proptest::prelude::*;

use crate::geometry::horizon_cosine;
use crate::medium::Medium;
use crate::models::air::Air;
use crate::models::isotropic::Isotropic;
use crate::models::moments::{Moments, Resolution};
use crate::models::planar::planar;
use crate::models::scatter::{Multiple, Once, Scattered, Scene, SkyRay};
use crate::models::sky_view::SkyView;
use crate::models::transmittance::Transmittance;
use crate::reference::random::Random;

/// Rays to each medium; a hundred media make 10⁵.
const RAYS: usize = 1000;

/// From nothing at all, over Earth's, to so much that light hardly enters.
fn coefficients() -> impl Strategy<Value = [f64; 3]> {
    let one = || prop_oneof![1 => Just(0.0), 4 => (-9.0..-3.0).prop_map(|x: f64| 10.0_f64.powf(x)), 1 => Just(1e3)];
    [one(), one(), one()]
}

fn media() -> impl Strategy<Value = Medium> {
    let lengths = (3.0..8.0_f64, 1.0..6.0_f64, 1.0..6.0_f64, 1.0..6.0_f64);
    let layers = (coefficients(), coefficients(), coefficients(), coefficients());
    let rest = (-0.99..0.99_f64, 0.0..=1.0_f64, 0.0..1e5_f64, 1.0..1e5_f64);
    (lengths, layers, rest).prop_map(|((radius, height, molecules, aerosols), layers, rest)| Medium {
        radius: 10.0_f64.powf(radius),
        height: 10.0_f64.powf(height),
        rayleigh_height: 10.0_f64.powf(molecules),
        mie_height: 10.0_f64.powf(aerosols),
        rayleigh: layers.0,
        mie_scattering: layers.1,
        mie_absorption: layers.2,
        absorption: layers.3,
        mie_asymmetry: rest.0,
        albedo: [rest.1; 3],
        absorption_peak: rest.2,
        absorption_width: rest.3,
        ..Medium::BRUNETON
    })
}

/// A cosine: any, straight, level, or the horizon's to the last bits.
fn cosine(random: &mut Random, horizon: f32) -> f32 {
    let ulps = (random.uniform() * 9.0) as i32 - 4;
    match (random.uniform() * 8.0) as u32 {
        0 => [1.0, -1.0, 0.0, -0.0][(random.uniform() * 4.0) as usize],
        1 | 2 => f32::from_bits(horizon.to_bits().wrapping_add_signed(ulps)).clamp(-1.0, 1.0),
        _ => (2.0 * random.uniform() - 1.0) as f32,
    }
}

/// From 0.1 m to 100 radii, and under any sun.
fn ray(random: &mut Random, medium: &Medium) -> SkyRay<f32> {
    let (low, high) = (0.1_f64.ln(), (100.0 * medium.radius).ln());
    let h = (low + (high - low) * random.uniform()).exp() as f32;
    let horizon = horizon_cosine(medium.radius as f32, h);
    let (mu, mu_s) = (cosine(random, horizon), cosine(random, horizon));
    let sines = ((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s)).sqrt();
    let azimuth = cosine(random, 1.0);
    SkyRay { h, mu, mu_s, nu: (mu * mu_s + sines * azimuth).clamp(-1.0, 1.0) }
}

fn sound(scattered: &Scattered<f32>) -> bool {
    let light = scattered.soft.iter().chain(&scattered.mie);
    light.clone().all(|x| x.is_finite() && *x >= 0.0) && scattered.transmittance.iter().all(|t| (0.0..=1.0).contains(t))
}

fn check(scene: &Scene<f32, impl Multiple<f32>>, ray: &SkyRay<f32>, distance: f32) -> Result<(), TestCaseError> {
    let sky = scene.sky(ray, 8);
    prop_assert!(sound(&sky), "{ray:?} {sky:?}");
    let near = scene.in_scatter(ray, distance, 4);
    prop_assert!(sound(&near), "{ray:?} {distance} {near:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]
    #[test]
    fn light_is_finite_and_never_negative(medium in media(), seed in any::<u64>()) {
        prop_assert_eq!(medium.check(), Ok(()));
        let air = Air::<f32>::new(&medium);
        let transmittance = Transmittance::sized(&air, 16, 8);
        let small = Resolution { suns: 8, altitudes: 4, steps: 4, passes: 1 };
        let moments = Moments::resolved(&air, &transmittance, small);
        prop_assert!(moments.0.texels.iter().flatten().flatten().all(|x| x.is_finite()));
        let random = &mut Random::new(seed, 0);
        let isotropic = (random.uniform() < 0.1).then(|| Isotropic::new(&air, &transmittance));
        let scene = Scene { air: &air, transmittance: &transmittance, multiple: &moments, sunlit: true };
        let inside = ray(random, &medium);
        let table = SkyView::sized(&scene, inside.h.min(air.height), inside.mu_s, 8, [6, 6, 4]);
        for _ in 0..RAYS {
            let ray = ray(random, &medium);
            let distance = (random.uniform() * 30.0 - 5.0).exp() as f32;
            check(&scene, &ray, distance)?;
            check(&Scene { air: &air, transmittance: &transmittance, multiple: &Once, sunlit: true }, &ray, distance)?;
            if let Some(isotropic) = &isotropic {
                let scene = Scene { air: &air, transmittance: &transmittance, multiple: isotropic, sunlit: true };
                check(&scene, &ray, distance)?;
            }
            let flat = planar(&air, &ray, distance, 4);
            prop_assert!(sound(&flat), "{ray:?} {distance} {flat:?}");
            let ambient = moments.irradiance(&air, ray.h, ray.mu_s, ray.mu, ray.nu);
            prop_assert!(ambient.iter().all(|x| x.is_finite() && *x >= 0.0), "{ray:?} {ambient:?}");
            let drawn = table.radiance(&air, ray.mu, ray.nu);
            prop_assert!(drawn.iter().all(|x| x.is_finite() && *x >= 0.0), "{ray:?} {drawn:?}");
        }
    }
}
