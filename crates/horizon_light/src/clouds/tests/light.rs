//! Phase functions.

use crate::clouds::phase::Phase;
use crate::clouds::{CloudLayer, CloudPhase};
use crate::reference::quadrature::integrate;
use crate::reference::random::Random;
use core::f64::consts::TAU;

fn phases() -> Vec<Phase<f64>> {
    let droplets = [5.0, 10.0, 20.0, 50.0].map(|droplet| CloudLayer {
        phase: CloudPhase::Droplets,
        droplet,
        ..CloudLayer::CUMULUS
    });
    [CloudLayer::CUMULUS, CloudLayer::CIRRUS].iter().chain(&droplets).map(Phase::new).collect()
}

#[test]
fn phase_functions_hold_all_light() {
    for phase in phases() {
        let ends = [-1.0, 0.0, 0.9, 0.99, 0.999, 0.9999, 1.0];
        let [whole, cosine] = integrate(|nu| [TAU * phase.at(nu), TAU * nu * phase.at(nu)], &ends, 1e-10);
        assert!((whole - 1.0).abs() < 1e-7, "{phase:?}: {whole}");
        assert!((cosine - phase.mean_cosine()).abs() < 1e-7, "{phase:?}: {cosine} {}", phase.mean_cosine());
    }
}

/// The mean cosine of water droplets in visible light is 0.85 to 0.87 (Hu and Stamnes 1993).
#[test]
fn droplets_scatter_as_far_forward_as_measured() {
    for phase in &phases()[3..] {
        assert!((phase.mean_cosine() - 0.86).abs() < 0.04, "{}", phase.mean_cosine());
    }
    assert!((phases()[0].mean_cosine() - 0.84).abs() < 0.02, "{}", phases()[0].mean_cosine());
}

#[test]
fn draws_follow_the_phase_functions() {
    for phase in phases() {
        let mut random = Random::new(9, 0);
        let n = 100_000;
        let mut counts = [0.0; 10];
        for _ in 0..n {
            let nu = phase.draw(|| random.uniform());
            counts[(((nu + 1.0) * 5.0) as usize).min(9)] += 1.0;
        }
        for (bin, count) in counts.into_iter().enumerate() {
            let start = bin as f64 / 5.0 - 1.0;
            let ends = if bin == 9 { vec![0.8, 0.99, 0.999, 0.9999, 1.0] } else { vec![start, start + 0.2] };
            let [chance] = integrate(|nu| [TAU * phase.at(nu)], &ends, 1e-9);
            let expected = chance * n as f64;
            assert!((count - expected).abs() < 4.5 * expected.sqrt() + 1.0, "{phase:?} {bin}: {count} of {expected}");
        }
    }
}
