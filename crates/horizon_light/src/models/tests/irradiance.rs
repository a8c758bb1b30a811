use super::{Sky, earth};
use crate::models::scatter::SkyRay;
use crate::reference::quadrature::gauss_legendre;

/// Diffuse irradiance at the ground by quadrature of the sky and the ground's light, of a surface whose normal lies `tilt` from the
/// vertical towards the sun, in radians.
fn quadrature(mu_s: f32, tilt: f64) -> [f64; 3] {
    let Sky { air, moments, .. } = earth();
    let scene = earth().scene(moments);
    let mut sum = [0.0; 3];
    for side in [0.0, -1.0] {
        for (x, w) in gauss_legendre(24) {
            let mu = 0.5 * (x + 1.0) + side;
            for i in 0..48 {
                let azimuth = (f64::from(i) + 0.5) * core::f64::consts::PI / 24.0;
                let sine = (1.0 - mu * mu).sqrt();
                let nu = mu * f64::from(mu_s) + sine * (1.0 - f64::from(mu_s).powi(2)).sqrt() * azimuth.cos();
                let lambert = (mu * tilt.cos() + sine * azimuth.cos() * tilt.sin()).max(0.0);
                let view = SkyRay { h: 0.0, mu: mu as f32, mu_s, nu: nu as f32 };
                let light = scene.sky(&view, 16).radiance(air, view.nu);
                for k in 0..3 {
                    sum[k] += f64::from(light[k]) * lambert * w * 0.5 * core::f64::consts::PI / 24.0;
                }
            }
        }
    }
    sum
}

/// Level ground within 4 %, walls towards the sun and away from it within 7 % of what level ground has. A lobe's own moments give level
/// ground more than ours do, and too much.
#[test]
fn moments_give_the_ambient_light() {
    let Sky { air, moments, .. } = earth();
    for zenith in [20.0_f64, 50.0, 75.0, 88.0] {
        let mu_s = zenith.to_radians().cos() as f32;
        let level = quadrature(mu_s, 0.0);
        for (tilt, allowed) in [(0.0_f64, 0.04), (45.0, 0.05), (90.0, 0.07), (-45.0, 0.05), (-90.0, 0.07)] {
            let tilt = tilt.to_radians();
            let to_sun = (zenith.to_radians() - tilt).cos();
            let ours = moments.irradiance(air, 0.0, mu_s, tilt.cos() as f32, to_sun as f32);
            let truth = quadrature(mu_s, tilt);
            for k in 0..3 {
                let error = (f64::from(ours[k]) - truth[k]) / level[k];
                assert!(error.abs() < allowed, "sun {zenith}, tilt {tilt}, wavelength {k}: {error}");
            }
        }
        // π, 2π/3 and π/4 times the harmonics straight up.
        use core::f32::consts::PI;
        let light = moments.at(air, 0.0, mu_s).map(|moment| moment[0]);
        let [even, linear, square] = [0.25 / PI, 0.75 / PI, 1.25 / PI].map(f32::sqrt);
        let lobe = PI * (even * light[0] + linear * light[1] * (2.0 / 3.0) + square * light[3] * 0.25);
        let naive = f64::from(lobe) / level[0] - 1.0;
        assert!(naive > 0.04, "sun {zenith}: {naive}");
    }
}
