//! Steps neither gain nor lose light, wherever a segment is divided; empty space is skipped without a trace.

use super::density::{MODELS, VOLUME};
use crate::clouds::march::{CloudRay, Marched, Steps, seen_at};
use crate::clouds::{Cloud, CloudLayer, CloudModel, CloudPoint};
use crate::reference::random::Random;
use horizon_field::Place;

/// Light of a medium that glows, 1 per optical depth: what comes out is 1 − transmittance.
fn glowing(cloud: &Cloud<f64>, ray: &CloudRay<f64>, cut: [f64; 2], steps: u32, skips: bool) -> Marched<f64> {
    let mut marched = Marched::new();
    for span in ray.spans(cloud) {
        marched.through(
            span,
            cut,
            &Steps::even(span, steps, 0.3),
            0.0,
            |d| if skips { ray.empty_until(cloud, &VOLUME, d, &cloud.weather) } else { d },
            |d| cloud.extinction * cloud.density(&VOLUME, &ray.point(d), &cloud.weather),
            |_, _| [1.0; 3],
        );
    }
    marched
}

fn ray(random: &mut Random, radius: f64) -> CloudRay<f64> {
    let altitude = 3_500.0 * random.uniform();
    let y = [0.0, 2.0 * random.uniform() - 1.0][usize::from(random.uniform() > 0.1)];
    let (angle, flat) = (random.angle(), (1.0 - y * y).sqrt());
    let at = [(random.uniform() - 0.5) * 2e4, altitude, (random.uniform() - 0.5) * 2e4];
    let from = CloudPoint { at, up: [0.0, 1.0, 0.0], altitude };
    CloudRay { radius, from, toward: [flat * angle.cos(), y, flat * angle.sin()] }
}

#[test]
fn transmittance_does_not_depend_on_where_a_segment_is_divided() {
    let mut random = Random::new(1, 0);
    let mut met = 0;
    for model in MODELS {
        let cloud = Cloud::<f64>::new(&CloudLayer { model, ..CloudLayer::CUMULUS }, &Place::ORIGIN, 0.0);
        for i in 0..60 {
            let ray = ray(&mut random, if i % 2 == 0 { 0.0 } else { 6.36e6 });
            let end = 9_000.0;
            let whole = glowing(&cloud, &ray, [0.0, end], 48, true);
            let mut product = 1.0;
            let mut from = 0.0;
            for _ in 0..7 {
                let to = from + (end - from) * 0.4 * random.uniform();
                product *= glowing(&cloud, &ray, [from, to], 48, true).transmittance;
                from = to;
            }
            product *= glowing(&cloud, &ray, [from, end], 48, true).transmittance;
            assert!((product - whole.transmittance).abs() < 1e-9, "{model:?}: {product} {}", whole.transmittance);
            // No energy is gained or lost at any step.
            assert!((whole.light[0] - (1.0 - whole.transmittance)).abs() < 1e-9);
            met += usize::from(whole.transmittance < 0.9);
        }
    }
    assert!(met > 20, "{met}");
}

/// Seed 000's opacity, λ·s·D clamped to 1, depends on the step; so does a sum without the closed form.
#[test]
fn naive_steps_gain_light() {
    let (extinction, length) = (0.05_f64, 100.0);
    let truth = (-extinction * length).exp();
    let (mut errors, mut gained) = (Vec::new(), Vec::new());
    for steps in [3, 10, 100] {
        let step = length / f64::from(steps);
        let alpha = (extinction * step).min(1.0);
        errors.push(((1.0 - alpha).powi(steps) - truth).abs());
        // S·s times the transmittance before the step, where S(1 − e^{−σs})/σ is exact.
        gained.push((0..steps).map(|k| extinction * step * (-extinction * step * f64::from(k)).exp()).sum::<f64>());
        let mut ours = Marched::<f64>::new();
        let span = [20.0, 20.0 + length];
        ours.through(
            span,
            [0.0, 1e9],
            &Steps::even(span, steps as u32, 0.7),
            0.0,
            |d| d,
            |_| extinction,
            |_, _| [1.0; 3],
        );
        assert!((ours.transmittance - truth).abs() < 1e-12 && (ours.light[0] - (1.0 - truth)).abs() < 1e-12);
    }
    assert!(errors[0] > 0.005 && errors[2] < errors[0], "{errors:?}");
    assert!(gained[0] > 1.5 && gained[2] < 1.1, "{gained:?}");
}

#[test]
fn skipping_changes_nothing_but_the_work() {
    let mut random = Random::new(2, 0);
    let mut work = [0, 0];
    for model in MODELS {
        let layer = CloudLayer { model, coverage: 0.3, ..CloudLayer::CUMULUS };
        let cloud = Cloud::<f64>::new(&layer, &Place::ORIGIN, 0.0);
        for i in 0..80 {
            let ray = ray(&mut random, if i % 2 == 0 { 0.0 } else { 6.36e6 });
            let (with, without) =
                (glowing(&cloud, &ray, [0.0, 2e4], 256, true), glowing(&cloud, &ray, [0.0, 2e4], 256, false));
            assert!((with.transmittance - without.transmittance).abs() < 1e-12, "{model:?} {ray:?}");
            assert!((with.depth - without.depth).abs() < 1e-6);
            if model == CloudModel::Billow {
                work[0] += with.samples;
                work[1] += without.samples;
            }
        }
    }
    assert!(2 * work[0] < work[1], "{work:?}");
}

#[test]
fn no_ray_and_no_density_breaks_it() {
    let mut random = Random::new(4, 0);
    for (extinction, coverage) in [(0.0, 1.0), (10.0, 1.0), (0.04, 0.0)] {
        let layer = CloudLayer { extinction, coverage, ..CloudLayer::CUMULUS };
        let cloud = Cloud::<f64>::new(&layer, &Place::ORIGIN, 0.0);
        for i in 0..200 {
            let mut ray = ray(&mut random, if i % 2 == 0 { 0.0 } else { 6.36e6 });
            if i % 5 == 0 {
                ray.from.altitude = f64::from([layer.base, layer.top][i % 2]);
            }
            let marched = glowing(&cloud, &ray, [0.0, 1e5], 32, true);
            assert!((0.0..=1.0).contains(&marched.transmittance) && marched.depth.is_finite(), "{marched:?}");
            assert!(marched.light.iter().all(|light| (0.0..=1.0 + 1e-12).contains(light)), "{marched:?}");
            assert!(marched.depth >= 0.0 && marched.samples <= 64, "{marched:?}");
            assert!(extinction > 0.0 && coverage > 0.0 || marched.transmittance == 1.0);
        }
    }
}

#[test]
fn cells_follow_each_other() {
    for (growth, jitter) in [(0.0, 0.0), (0.5, 0.3), (3.0, 0.99)] {
        let steps = Steps::<f32> { first: 5.0, growth, jitter };
        let mut seen = Marched::<f32>::new();
        let mut places = Vec::new();
        let even = |d: f32, places: &mut Vec<f32>| {
            places.push(d);
            1e-4
        };
        seen.through([100.0, 2_100.0], [0.0, 1e9], &steps, 0.0, |d| d, |d| even(d, &mut places), |_, _| [0.0; 3]);
        assert!(places.windows(2).all(|pair| pair[1] > pair[0]), "{places:?}");
        assert!((seen.transmittance - (-0.2_f32).exp()).abs() < 1e-5, "{growth}: {}", seen.transmittance);
    }
}

/// A cell's source is asked where it is seen: at the mean of what leaves it.
#[test]
fn cells_are_seen_at_their_centroid() {
    for x in [0.0_f64, 1e-3, 0.0999, 0.1001, 1.0, 5.0, 300.0, 1e4] {
        let n = 200_000;
        let (mut sum, mut moment) = (0.0, 0.0);
        for i in 0..n {
            let t = (f64::from(i) + 0.5) / f64::from(n);
            sum += (-x * t).exp();
            moment += t * (-x * t).exp();
        }
        if sum > 1.0 {
            assert!((seen_at(x) - moment / sum).abs() < 1e-4, "{x}: {} {}", seen_at(x), moment / sum);
        }
        assert!((f64::from(seen_at(x as f32)) - seen_at(x)).abs() < 1e-5, "{x}");
    }
}
