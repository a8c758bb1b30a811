use super::{Sky, earth};
use crate::models::planar::planar;
use crate::models::scatter::{Once, SkyRay};

/// Over a sphere and over flat ground the sky is alike overhead, under a high sun.
#[test]
fn flat_ground_is_enough_overhead() {
    let Sky { air, .. } = earth();
    for (mu, mu_s) in [(1.0_f32, 0.9_f32), (0.7, 0.9), (0.7, 0.4)] {
        let nu = mu * mu_s;
        let view = SkyRay { h: 2.0, mu, mu_s, nu };
        let flat = planar(air, &view, f32::MAX, 32).radiance(air, nu);
        let round = earth().scene(&Once).sky(&view, 32).radiance(air, nu);
        for k in 0..3 {
            assert!((flat[k] / round[k] - 1.0).abs() < 0.02, "{mu} {mu_s}: {flat:?} {round:?}");
        }
    }
}

/// The plane's air mass 1/μ divides by 0 for a level ray and under a level sun; the march ends before.
#[test]
fn level_rays_and_level_suns() {
    let Sky { air, .. } = earth();
    for h in [0.0, 2.0, 6e4, 1e6] {
        for mu in [0.0, -0.0, 1e-30, -1e-30, 1e-3, -1e-3, 1.0, -1.0] {
            for mu_s in [1.0, 1e-30, 0.0, -0.0, -1.0] {
                let light = planar(air, &SkyRay { h, mu, mu_s, nu: mu * mu_s }, f32::MAX, 16);
                let all = light.soft.iter().chain(&light.mie).chain(&light.transmittance);
                assert!(all.clone().all(|x| x.is_finite() && *x >= 0.0), "{h} {mu} {mu_s}: {light:?}");
                assert!(mu_s > 0.0 || light.soft == [0.0; 3]);
            }
        }
    }
    let near = |mu| planar(air, &SkyRay { h: 2.0, mu, mu_s: 0.5, nu: 0.2 }, f32::MAX, 64).soft;
    assert!((near(0.0)[1] / near(1e-4)[1] - 1.0).abs() < 0.05, "{:?} {:?}", near(0.0), near(1e-4));
}
