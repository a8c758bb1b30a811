use super::{Sky, earth};
use crate::geometry::horizon_cosine;
use crate::models::scatter::{SkyRay, VIEW_STEPS};
use crate::models::sky_view::SkyView;

fn ray(h: f32, elevation: f32, azimuth: f32, mu_s: f32) -> SkyRay<f32> {
    let (mu, sine) = (elevation.to_radians().sin(), elevation.to_radians().cos());
    let nu = mu * mu_s + sine * ((1.0 - mu_s) * (1.0 + mu_s)).sqrt() * azimuth.to_radians().cos();
    SkyRay { h, mu, mu_s, nu: nu.clamp(-1.0, 1.0) }
}

/// The table against the march that it holds, on directions between its texels; at the zenith and the horizon too.
#[test]
fn the_table_stands_for_the_march() {
    let Sky { air, moments, .. } = earth();
    let scene = earth().scene(moments);
    for (h, zenith) in [(2.0_f32, 30.0_f32), (2.0, 88.0), (2.0, 93.0), (8e3, 65.0), (5e4, 80.0)] {
        let mu_s = zenith.to_radians().cos();
        let table = SkyView::new(&scene, h, mu_s, VIEW_STEPS);
        let dip = horizon_cosine(air.radius, h).asin().to_degrees();
        let (mut squares, mut count, mut worst) = (0.0, 0, 0.0_f32);
        for above in [0.02, 0.3, 1.0, 3.0, 8.0, 20.0, 45.0, 70.0, 88.0, -0.3, -2.0, -10.0, -40.0, -80.0] {
            for azimuth in [0.0, 7.0, 33.0, 90.0, 141.0, 180.0] {
                let view = ray(h, (dip + above).clamp(-90.0, 90.0), azimuth, mu_s);
                let truth = scene.sky(&view, VIEW_STEPS).radiance(air, view.nu);
                let ours = table.radiance(air, view.mu, view.nu);
                for k in 0..3 {
                    let error = (ours[k] / truth[k] - 1.0).abs();
                    squares += error * error;
                    count += 1;
                    worst = worst.max(error);
                }
            }
        }
        let rms = (squares / count as f32).sqrt();
        println!("{h} m, sun {zenith}: RMS {rms:.4}, worst {worst:.4}");
        assert!(rms < 0.02 && worst < 0.12, "{h} m, sun {zenith}: RMS {rms}, worst {worst}");
    }
}

/// Even rows across the horizon, of the same number over the same half turn, mix sky with ground.
#[test]
fn even_rows_smear_the_horizon() {
    let Sky { air, moments, .. } = earth();
    let scene = earth().scene(moments);
    let mu_s = 0.5;
    let look = |elevation: f32| {
        let view = ray(2.0, elevation, 60.0, mu_s);
        scene.sky(&view, VIEW_STEPS).radiance(air, view.nu)[2]
    };
    let truth = look(0.1);
    let view = ray(2.0, 0.1, 60.0, mu_s);
    let ours = SkyView::new(&scene, 2.0, mu_s, VIEW_STEPS).radiance(air, view.mu, view.nu)[2];
    let even = 0.54 * look(1.25) + 0.46 * look(-1.25);
    assert!((ours / truth - 1.0).abs() < 0.01 && (even / truth - 1.0).abs() > 0.05, "{ours} {even} {truth}");
}
