use std::f64::consts::PI;
use std::sync::LazyLock;

use super::*;
use crate::reference::monte_carlo::Sky;

static EARTH: LazyLock<Orders<'static>> = LazyLock::new(|| Orders::new(&Medium::BRUNETON, Resolution::COARSE, 1e-3));

/// A grid for tests of its parts.
const SMALL: Resolution = Resolution { altitudes: 8, suns: 12, cosines: 12, azimuths: 8, steps: 8, degree: 4 };

fn point_on_small_planet() -> Point {
    let m = Medium::SMALL_PLANET;
    Point { distance: 0.0, h: 0.0, mu: 0.0, seen: [1.0; 3], rayleigh: m.rayleigh, mie: m.mie_scattering }
}

/// A field that holds `radiance` of the direction at the ground, whatever the sun.
fn field_of(orders: &Orders, radiance: impl Fn(f64) -> f64) -> Field {
    let grid = &orders.grid;
    let mut field = Field::dark(grid);
    for i in 0..grid.resolution.altitudes {
        for (mu, weight) in grid.directions(0.0) {
            let light = vec![[radiance(mu); 3]; grid.resolution.suns * grid.resolution.azimuths];
            field.gather(grid, i, mu, weight, &light);
        }
    }
    field
}

#[test]
fn scattering_density_of_published_fields() {
    let orders = Orders::new(&Medium::SMALL_PLANET, SMALL, 1.0);
    // reference-values.md B, in km⁻¹ and ± 0.2 %: 0.0325 of a radiance of 13 from everywhere.
    let source = orders.source(&field_of(&orders, |_| 13.0), &point_on_small_planet(), 1.0, 1.0);
    assert!((source[1] * 1e3 / 0.0325 - 1.0).abs() < 2e-3, "{source:?}");
    // And 5.172536e-4 of ground under an irradiance of 13, seen in the lower half of all directions.
    let ground = |mu: f64| if mu < 0.0 { 13.0 * Medium::SMALL_PLANET.albedo[1] / PI } else { 0.0 };
    let source = orders.source(&field_of(&orders, ground), &point_on_small_planet(), 1.0, 1.0);
    assert!((source[1] * 1e3 / 5.172536e-4 - 1.0).abs() < 2e-3, "{source:?}");
}

#[test]
fn irradiance_of_a_uniform_sky() {
    // reference-values.md B: π ± 0.01.
    let orders = Orders::new(&Medium::SMALL_PLANET, SMALL, 1.0);
    let field = field_of(&orders, |_| 1.0);
    assert!((field.irradiance_at(&orders.grid, 0.3)[1] - PI).abs() < 1e-3);
}

#[test]
fn orders_agree_with_paths() {
    let sky = Sky::new(&Medium::BRUNETON);
    for (h, sun) in [(2.0, 30.0_f64), (2.0, 65.0), (2.0, 80.0), (2.0, 88.0), (2.0, 91.5), (8_000.0, 65.0)] {
        for (zenith, azimuth) in [(20.0_f64, 0.0_f64), (80.0, 90.0), (88.0, 180.0)] {
            let view = Ray::of_angles(h, zenith.to_radians(), sun.to_radians(), azimuth.to_radians());
            let ours = EARTH.radiance(&view);
            for wavelength in [0, 2] {
                let paths = sky.radiance(&view, wavelength, 40_000, 11);
                let off = (ours[wavelength] - paths.mean).abs();
                assert!(
                    off <= 3.0 * paths.standard_error + 0.003 * paths.mean,
                    "sun {sun} view {zenith} {azimuth} from {h}: {} by orders, {paths:?} by paths",
                    ours[wavelength]
                );
            }
        }
    }
}

#[test]
fn orders_agree_with_paths_from_space() {
    let sky = Sky::new(&Medium::BRUNETON);
    for (zenith, azimuth) in [(180.0_f64, 0.0_f64), (130.0, 180.0), (109.0, 180.0)] {
        let view = Ray::of_angles(400_000.0, zenith.to_radians(), 80.0_f64.to_radians(), azimuth.to_radians());
        let (ours, paths) = (EARTH.radiance(&view)[2], sky.radiance(&view, 2, 40_000, 12));
        assert!((ours - paths.mean).abs() <= 3.0 * paths.standard_error + 0.003 * paths.mean, "{ours} {paths:?}");
    }
}

#[test]
fn a_white_furnace_keeps_its_light() {
    // The sun's light on the top's disc either passes beside the ground unscattered, or leaves in some order. Nothing
    // is absorbed.
    let medium = Medium::BRUNETON.lossless();
    let orders = Orders::new(&medium, Resolution { altitudes: 14, azimuths: 8, degree: 6, ..Resolution::COARSE }, 1e-3);
    let ring = passed(&medium, &orders.depths);
    for k in 0..3 {
        let each: Vec<f64> = orders.leaving.iter().map(|leaving| leaving[k]).collect();
        let whole = ring[k] + each.iter().sum::<f64>();
        assert!((whole - 1.0).abs() < 0.01, "wavelength {k}: {whole} leaves in {} orders", each.len());
        // The first order of blue light is what air sends back before the ground does: each later one must be smaller.
        assert!(each.windows(2).all(|pair| pair[1] < pair[0]), "wavelength {k}: {each:?}");
    }
    // The same sum without the ground's share of the furnace misses light, and the test sees it.
    let dark = Medium { albedo: [0.5; 3], ..medium };
    let lossy = Orders::new(&dark, SMALL, 1e-3);
    assert!(passed(&dark, &lossy.depths)[1] + lossy.leaving.iter().map(|leaving| leaving[1]).sum::<f64>() < 0.9);
}

/// The part of the top's disc's light that passes the ground without being scattered.
fn passed(medium: &Medium, depths: &[DepthTable; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let n = 4000;
    let top = medium.radius + medium.height;
    for i in 0..n {
        // The ray that comes in at the altitude `height` and passes at `lowest`.
        let lowest = medium.height * (i as f64 + 0.5) / n as f64;
        let b = medium.radius + lowest;
        let mu = -(((medium.height - lowest) * (top + b)).sqrt() / top);
        for k in 0..3 {
            let left = (-depths[k].depth(medium.height, mu)).exp();
            sum[k] += 2.0 * b * left * medium.height / n as f64 / (top * top);
        }
    }
    sum
}

#[test]
fn harmonics_are_orthonormal() {
    let grid = Grid::new(&Medium::BRUNETON, Resolution { cosines: 16, azimuths: 12, degree: 6, ..SMALL });
    let n = harmonics::count(6);
    let (mut sums, mut values) = (vec![0.0; n * n], vec![0.0; n]);
    for (mu, weight) in grid.directions(1_000.0) {
        for azimuth in (0..12).map(|k| grid.azimuth(k)) {
            harmonics::legendre(6, mu, &mut values);
            for m in 0..=6 {
                for l in m..=6 {
                    values[harmonics::index(6, l, m)] *= (m as f64 * azimuth).cos();
                }
            }
            for (i, sum) in sums.iter_mut().enumerate() {
                *sum += weight * grid.azimuth_weight() * values[i / n] * values[i % n];
            }
        }
    }
    for (i, sum) in sums.into_iter().enumerate() {
        assert!((sum - f64::from(u8::from(i / n == i % n))).abs() < 1e-9, "{i}: {sum}");
    }
}

#[test]
fn moments_of_phase_functions() {
    // Rayleigh: 1, 0, 1/10, and none above. Henyey and Greenstein's would be gˡ.
    let molecules = harmonics::moments(4, rayleigh_phase);
    for (moment, known) in molecules.into_iter().zip([1.0, 0.0, 0.1, 0.0, 0.0]) {
        assert!((moment - known).abs() < 1e-12);
    }
    let g = 0.8_f64;
    let henyey = |nu: f64| (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * nu).powf(1.5));
    for (l, moment) in harmonics::moments(12, henyey).into_iter().enumerate() {
        assert!((moment - g.powi(l as i32)).abs() < 1e-9, "{l}: {moment}");
    }
}
