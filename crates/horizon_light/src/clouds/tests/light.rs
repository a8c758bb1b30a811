//! Phase functions, and light where nothing should break.

use super::density::{MODELS, VOLUME};
use crate::clouds::light::{CloudQuality, OCTAVES, seen, source};
use crate::clouds::march::CloudRay;
use crate::clouds::phase::Phase;
use crate::clouds::{Cloud, CloudLayer, CloudPhase, CloudPoint};
use crate::reference::quadrature::integrate;
use crate::reference::random::Random;
use core::f64::consts::TAU;
use horizon_field::Place;

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

/// In, on, above and below the layer; level rays; no density and much; any sun, below the horizon too; plane and planet.
#[test]
fn light_is_finite_everywhere() {
    let mut random = Random::new(21, 0);
    let quality = CloudQuality { steps: 24, sun_samples: 4, reach: 3e3, jitter: 0.4, least: 1e-3, octaves: OCTAVES };
    for i in 0..600 {
        let layer = CloudLayer {
            model: MODELS[i % 3],
            extinction: [0.0, 1e-4, 0.04, 10.0][i % 4],
            coverage: [0.0, 0.5, 1.0][i / 3 % 3],
            ..CloudLayer::CUMULUS
        };
        let cloud = Cloud::<f32>::new(&layer, &Place::ORIGIN, 1e6);
        let altitude = [0.0, layer.base, 1_700.0, layer.top, 3_000.0, 4e5][i % 6];
        let direction = |random: &mut Random, level: bool| {
            let y = if level { 0.0 } else { 2.0 * random.uniform() - 1.0 };
            let (flat, turn) = ((1.0 - y * y).sqrt(), random.angle());
            [flat * turn.cos(), y, flat * turn.sin()].map(|x| x as f32)
        };
        let (toward, sun) = (direction(&mut random, i % 7 == 0), direction(&mut random, i % 11 == 0));
        let from = CloudPoint { at: [0.0, altitude, 0.0], up: [0.0, 1.0, 0.0], altitude };
        let ray = CloudRay { radius: [0.0, 6.36e6][i % 2], from, toward };
        let found = seen(&cloud, &VOLUME, &ray, [0.0, 1e9], sun, &quality, |_| cloud.weather, &cloud.weather);
        let light = found.light[0];
        assert!(light.is_finite() && light >= 0.0 && (0.0..=1.0).contains(&found.transmittance), "{layer:?} {ray:?}");
        assert!(found.depth.is_finite() && (layer.extinction > 0.0 || light == 0.0));
    }
}

/// More octaves, more light; none is lost in a thin cloud that was not there to be scattered.
#[test]
fn octaves_add_up() {
    let phase = Phase::<f64>::new(&CloudLayer::CUMULUS);
    for depth in [0.0, 0.3, 3.0, 30.0] {
        let by: Vec<f64> = (0..6).map(|octaves| source(&phase, 0.3, depth, 1.0, octaves)).collect();
        assert!(by[0] == by[1] && by[1] < by[2] && by[2] < by[3] && by[3] < by[4] && by[4] == by[5], "{by:?}");
        assert_eq!(source(&phase, 0.3, depth, 0.0, OCTAVES), by[1]);
    }
}
