//! The truth itself: against closed forms, and against what it bounds.

use super::{World, dense, hills, ray};
use crate::Place;
use crate::field::arbitrary::Random;
use crate::march::Ray;
use crate::trees::{Cone, Foliage, Forest, Part, nearest_truth};

/// Rays through a forest, from around a place.
pub(super) fn rays(world: &World, place: &Place, seed: u32, count: usize, reach: f64) -> Vec<Ray> {
    let mut random = Random::new(seed);
    let mut one = || {
        let [x, z] = [0; 2].map(|_| random.within(-reach, reach));
        let ground = world.height(&place.translated([x, 0.0, z]));
        let origin = [x, ground + random.magnitude(0.5, 12.0), z];
        ray(origin, [random.within(-1.0, 1.0), random.within(-0.4, 0.2), random.within(-1.0, 1.0)])
    };
    (0..count).map(|_| one()).collect()
}

#[test]
fn without_foliage_the_truth_is_the_ellipsoids() {
    let mut forest = dense();
    forest.species.iter_mut().for_each(|species| species.foliage = 0.0);
    let world = World::new(&hills(), &forest);
    let solids = world.solids(&Place::ORIGIN, 60.0);
    let mut hits = 0;
    for ray in rays(&world, &Place::ORIGIN, 1, 300, 40.0) {
        for solid in &solids {
            let (o, d) = (solid.own(ray.origin()), solid.own_direction(ray.direction()));
            let entry = |part: Part| {
                let chords = solid.crown.iter().filter(|_| part == Part::Crown);
                let chords = chords.chain(solid.trunk.iter().filter(|_| part == Part::Trunk));
                let chords = chords.filter_map(|e| e.chord(o, d)).filter(|chord| chord[1] > 0.0 && chord[0] < 80.0);
                chords.map(|chord| chord[0].max(0.0)).fold(f64::INFINITY, f64::min)
            };
            let expected = entry(Part::Crown).min(entry(Part::Trunk));
            match solid.truth(ray.origin(), ray.direction(), [0.0, 80.0], 1e-4) {
                Some((t, _)) => assert!((t - expected).abs() < 1e-5, "{t} for {expected}"),
                None => assert!(expected.is_infinite(), "{expected}"),
            }
            hits += usize::from(expected.is_finite());
        }
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn nothing_before_the_truth_is_inside_and_what_is_there_is() {
    let world = World::new(&hills(), &dense());
    let solids = world.solids(&Place::ORIGIN, 40.0);
    let mut random = Random::new(4);
    for ray in rays(&world, &Place::ORIGIN, 2, 150, 30.0) {
        for solid in &solids {
            let footprint = random.pick(&[1e-4, 0.05, 0.3, 3.0]);
            let level = solid.level(footprint);
            let at = |t: f64| solid.crown(solid.own(ray.at(t)), level);
            let truth = solid.truth(ray.origin(), ray.direction(), [0.0, 60.0], footprint);
            let (o, d) = (solid.own(ray.origin()), solid.own_direction(ray.direction()));
            let Some(chord) = solid.crown_chord(o, d).filter(|chord| chord[1] > 0.0) else { continue };
            let end = truth.map_or(chord[1], |(t, _)| t).min(60.0);
            for _ in 0..50 {
                let t = random.within(chord[0].clamp(0.0, end), end);
                if t == end {
                    break;
                }
                assert!(at(t) > -1e-9, "inside by {} at {t}, before {truth:?}", at(t));
            }
            if let Some((t, Part::Crown)) = truth {
                assert!(at(t) < 1e-5, "{} at the hit", at(t));
            }
        }
    }
}

#[test]
fn crowns_are_within_their_ellipsoids_and_slopes_within_their_bound() {
    let world = World::new(&hills(), &dense());
    let solids = world.solids(&Place::ORIGIN, 25.0);
    let mut random = Random::new(5);
    let mut most = 0.0f64;
    for solid in &solids {
        for _ in 0..2000 {
            let q = [random.within(-4.0, 4.0), random.within(-1.0, 14.0), random.within(-4.0, 4.0)];
            let level = random.pick(&[0.0, 1.3, 4.0]);
            let f = solid.crown(q, level);
            let inside = solid.crown.iter().any(|e| {
                let k = e.scaled(q);
                k.iter().map(|x| x * x).sum::<f64>() <= 1.0
            });
            assert!(inside || f > 0.0);
            let by = [0; 3].map(|_| random.within(-1e-4, 1e-4));
            let length = by.iter().map(|x| x * x).sum::<f64>().sqrt();
            let slope = (solid.crown([0, 1, 2].map(|k| q[k] + by[k]), level) - f).abs() / length;
            assert!(slope <= solid.slope(level) * (1.0 + 1e-6), "{slope} of {}", solid.slope(level));
            most = most.max(slope / solid.slope(level));
        }
    }
    println!("{most} of a slope's bound was met");
    assert!(most > 0.3);
    assert!(Foliage::table().slope(0) > 1.0);
}

#[test]
fn far_crowns_are_the_ellipsoids_less_the_mean() {
    let world = World::new(&hills(), &Forest { mixing: 0.0, ..dense() });
    for solid in world.solids(&Place::ORIGIN, 20.0) {
        let level = solid.level(1e3);
        let left = 1.0 - solid.foliage * Foliage::table().mean();
        for e in &solid.crown {
            let top = [e.centre[0], e.centre[1] + left * e.radii[1], e.centre[2]];
            assert!(solid.crown(top, level) < 1e-9);
        }
    }
}

#[test]
fn the_nearest_of_all_is_the_nearest() {
    let world = World::new(&hills(), &dense());
    let solids = world.solids(&Place::ORIGIN, 60.0);
    for ray in rays(&world, &Place::ORIGIN, 6, 100, 30.0) {
        let found = nearest_truth(&solids, ray.origin(), ray.direction(), 60.0, Cone::FINE);
        let each = solids.iter().filter_map(|s| s.truth(ray.origin(), ray.direction(), [0.0, 60.0], 1e-4));
        let least = each.map(|(t, _)| t).fold(f64::INFINITY, f64::min);
        assert!(found.map_or(f64::INFINITY, |(_, t, _)| t) - least < 1e-6 || least.is_infinite());
    }
}
