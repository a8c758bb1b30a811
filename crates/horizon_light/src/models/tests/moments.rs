use super::Sky;
use crate::medium::Medium;
use crate::models::air::Air;
use crate::models::directions::{AZIMUTHS, POLAR};
use crate::models::moments::{HARMONICS, Moments, Resolution, harmonics, sun_coordinate, sun_cosine};
use crate::models::scatter::Multiple;
use crate::models::scatter::SkyRay;
use crate::models::transmittance::Transmittance;
use crate::phase::{mie_phase, rayleigh_phase};
use crate::reference::quadrature::gauss_legendre;

#[test]
fn harmonics_are_orthonormal_over_our_directions() {
    let mut products = [[0.0_f64; HARMONICS]; HARMONICS];
    for sign in [1.0, -1.0] {
        for [node, weight] in POLAR {
            for azimuth in AZIMUTHS {
                let mu = sign * node;
                let y = harmonics(mu, (1.0 - mu * mu).sqrt() * azimuth);
                for (row, a) in products.iter_mut().zip(y) {
                    for (product, b) in row.iter_mut().zip(y) {
                        *product += a * b * weight * core::f64::consts::FRAC_PI_2;
                    }
                }
            }
        }
    }
    for (i, row) in products.iter().enumerate() {
        for (j, product) in row.iter().enumerate() {
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-12, "{i} {j}: {product}");
        }
    }
}

#[test]
fn directions_are_gausss() {
    for ([node, weight], (x, w)) in POLAR.into_iter().zip(gauss_legendre(6)) {
        assert!((2.0 * node - 1.0 - x).abs() < 1e-14 && (2.0 * weight - w).abs() < 1e-14, "{node} {weight}");
    }
}

/// ∫ p P_l over the sphere by quadrature, against the closed forms that the models have.
#[test]
fn phase_functions_have_these_moments() {
    let moment = |phase: &dyn Fn(f64) -> f64, degree: usize| -> f64 {
        let legendre = |x: f64| [1.0, x, 1.5 * x * x - 0.5][degree];
        gauss_legendre(200).iter().map(|&(x, w)| 2.0 * core::f64::consts::PI * w * legendre(x) * phase(x)).sum()
    };
    assert!((moment(&rayleigh_phase, 1)).abs() < 1e-12 && (moment(&rayleigh_phase, 2) - 0.1).abs() < 1e-12);
    for g in [-0.5, 0.0, 0.3, 0.8] {
        let [first, second] = Air::<f64>::new(&Medium { mie_asymmetry: g, ..Medium::BRUNETON }).mie_moments;
        assert!((moment(&|x| mie_phase(g, x), 1) - first).abs() < 1e-9, "{g}");
        assert!((moment(&|x| mie_phase(g, x), 2) - second).abs() < 1e-9, "{g}");
    }
}

#[test]
fn sun_coordinates_invert() {
    for medium in [Medium::BRUNETON, Medium::SMALL_PLANET, Medium { height: 1.0, ..Medium::BRUNETON }] {
        let air = Air::<f64>::new(&medium);
        for i in 0..=100 {
            let u = f64::from(i) / 100.0;
            assert!((sun_coordinate(&air, sun_cosine(&air, u)) - u).abs() < 1e-12);
        }
        assert!((sun_cosine(&air, 1.0) - 1.0_f64).abs() < 1e-12 && (sun_cosine(&air, 0.0) - air.night).abs() < 1e-12);
    }
}

/// The largest difference of sources of multiple scattering near the ground, as a part of the larger.
fn difference(air: &Air<f64>, a: &Moments<f64>, b: &Moments<f64>) -> f64 {
    let mut worst = 0.0_f64;
    for h in [2.0, 500.0, 4e3, 9e3] {
        for zenith in [0.0_f64, 40.0, 70.0, 85.0, 89.0] {
            for (mu, azimuth) in [(1.0_f64, 0.0), (0.3, 0.9), (0.0, -0.9), (-0.6, 0.2)] {
                let mu_s = zenith.to_radians().cos();
                let nu = mu * mu_s + ((1.0 - mu * mu) * (1.0 - mu_s * mu_s)).sqrt() * azimuth;
                let of = |m: &Moments<f64>| m.source(air, air.densities(h), &SkyRay { h, mu, mu_s, nu });
                for (a, b) in of(a).into_iter().zip(of(b)) {
                    worst = worst.max((a - b).abs() / a.max(b));
                }
            }
        }
    }
    worst
}

#[test]
fn the_table_is_fine_enough() {
    let air = Air::<f64>::new(&Medium::BRUNETON);
    let transmittance = Transmittance::new(&air);
    let ours = Moments::new(&air, &transmittance);
    let fine = Resolution { suns: 64, altitudes: 20, steps: 16, passes: 4 };
    let fine = Moments::resolved(&air, &transmittance, fine);
    let error = difference(&air, &ours, &fine);
    assert!(error < 0.03, "{error}");
    // As many orders without the geometric series lack light.
    let mut bare = Moments::orders(&air, &transmittance, Resolution::DEFAULT).into_iter();
    let mut sum = bare.next().unwrap();
    for order in bare {
        for (sum, more) in sum.0.texels.iter_mut().zip(&order.0.texels) {
            for (sum, more) in sum.iter_mut().zip(more) {
                for k in 0..3 {
                    sum[k] += more[k];
                }
            }
        }
    }
    let naive = difference(&air, &sum, &fine);
    assert!(naive > 0.05 && error < 0.5 * naive, "{error} {naive}");
}

#[test]
fn single_precision_is_enough() {
    let (narrow, wide) = (super::earth(), Sky::<f64>::new(&Medium::BRUNETON));
    for (a, b) in narrow.moments.0.texels.iter().zip(&wide.moments.0.texels) {
        for k in 0..3 {
            let (a, b) = (f64::from(a[0][k]), b[0][k]);
            assert!((a - b).abs() < 2e-3 * b + 1e-6, "{a} {b}");
        }
    }
}
