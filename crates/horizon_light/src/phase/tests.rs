use super::*;
use crate::reference::quadrature::integrate;
use crate::reference::random::Random;
use core::f64::consts::TAU;

#[test]
fn every_phase_function_integrates_to_one() {
    // reference-values.md B: 1 ± 0.002 at g = 0.8.
    for g in [-0.9, -0.3, 0.0, 0.65, 0.8, 0.95] {
        let [whole] = integrate(|nu| [TAU * mie_phase(g, nu)], &[-1.0, 0.0, 1.0], 1e-10);
        assert!((whole - 1.0).abs() < 1e-8, "{g}: {whole}");
    }
    let [whole] = integrate(|nu| [TAU * rayleigh_phase(nu)], &[-1.0, 1.0], 1e-12);
    assert!((whole - 1.0).abs() < 1e-12, "{whole}");
}

#[test]
fn molecules_scatter_forward_and_backward_alike() {
    assert_eq!(rayleigh_phase(0.7_f64), rayleigh_phase(-0.7));
    assert!((rayleigh_phase(0.3_f64) - mie_phase(0.0, 0.3)).abs() < 1e-16);
}

#[test]
fn the_forward_peak_survives_single_precision() {
    // 1 + g² − 2gν as it stands loses digits near the peak, where ours is a sum of squares.
    let (g, nu) = (0.99_f32, 1.0_f32.next_down());
    let truth = mie_phase(g as f64, nu as f64);
    let base = 1.0 + g * g - 2.0 * g * nu;
    let naive =
        3.0 / (8.0 * core::f32::consts::PI) * (1.0 - g * g) * (1.0 + nu * nu) / ((2.0 + g * g) * base.powf(1.5));
    assert!((naive as f64 / truth - 1.0).abs() > 1e-4, "{naive} {truth}");
    assert!((mie_phase(g, nu) as f64 / truth - 1.0).abs() < 1e-5, "{} {truth}", mie_phase(g, nu));
}

#[test]
fn samples_follow_the_phase_functions() {
    for g in [0.0, 0.3, 0.8, -0.6] {
        let mut random = Random::new(3, 0);
        let n = 200_000;
        let mut counts = [0.0; 20];
        for _ in 0..n {
            let nu = sample_phase(g, || random.uniform());
            counts[(((nu + 1.0) * 10.0) as usize).min(19)] += 1.0;
        }
        for (bin, count) in counts.into_iter().enumerate() {
            let start = bin as f64 / 10.0 - 1.0;
            let [chance] = integrate(|nu| [TAU * mie_phase(g, nu)], &[start, start + 0.1], 1e-9);
            let expected = chance * n as f64;
            assert!((count - expected).abs() < 4.5 * expected.sqrt() + 1.0, "g {g} bin {bin}: {count} of {expected}");
        }
    }
}
