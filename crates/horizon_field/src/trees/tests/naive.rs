//! Where the textbook way fails, beside ours, which holds.

use super::truths::rays;
use super::{World, dense, hills};
use crate::Place;
use crate::field::arbitrary::Random;
use crate::trees::{Cone, Distance, Grove, NineCells, PlantWork, nearest_truth};

/// How many of some rays a search loses, and how many it stops with more than 0.3 m between it and the truth.
fn lost(world: &World, search: Option<NineCells>, count: usize) -> [usize; 3] {
    let solids = world.solids(&Place::ORIGIN, 110.0);
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    let (mut missed, mut off, mut hits) = (0, 0, 0);
    let mut work = PlantWork::default();
    for ray in rays(world, &Place::ORIGIN, 21, count, 30.0) {
        let found = match search {
            Some(search) => {
                search.cast(&mut grove, &Place::ORIGIN, &ray, 60.0, Cone { start: 0.01, growth: 0.0 }, &mut work)
            }
            None => grove
                .cast_as::<f64>(&Place::ORIGIN, &ray, 60.0, Cone { start: 0.01, growth: 0.0 }, &mut work)
                .map(|hit| hit.t),
        };
        let truth = nearest_truth(&solids, ray.origin(), ray.direction(), 60.0, Cone { start: 0.01, growth: 0.0 });
        match (found, truth) {
            (None, Some(_)) => missed += 1,
            (Some(t), Some((_, truth, _))) => off += usize::from((t - truth).abs() > 0.3),
            (Some(_), None) => off += 1,
            (None, None) => {}
        }
        hits += usize::from(truth.is_some());
    }
    println!(
        "{search:?}: {missed} missed, {off} off, of {hits} hits; {:.1} steps a ray",
        work.steps as f64 / count as f64
    );
    [missed, off, hits]
}

#[test]
fn nine_cells_as_printed_lose_plants_and_dual_cells_do_not() {
    let world = World::new(&hills(), &dense());
    let [missed, off, hits] = lost(&world, None, 800);
    assert!(100 * (missed + off) < hits, "ours: {missed} missed, {off} off of {hits}");
    let [missed, off, _] = lost(&world, Some(NineCells::SURE), 800);
    assert!(30 * (missed + off) < hits, "the sure search: {missed} missed, {off} off of {hits}");
    let [missed, off, _] = lost(&world, Some(NineCells::PRINTED), 800);
    assert!(missed + off > hits / 4, "as printed: {missed} missed, {off} off of {hits}");
    // What is wrong with it, one by one.
    let [missed, off, _] = lost(&world, Some(NineCells { shared: true, ..NineCells::SURE }), 800);
    assert!(missed + off > hits / 4, "one offset for all: {missed} missed, {off} off of {hits}");
}

#[test]
fn foliage_that_steps_are_not_divided_for_is_leapt_through() {
    let mut forest = dense();
    for species in &mut forest.species {
        (species.foliage, species.clump) = (0.8, 0.3);
    }
    let world = World::new(&hills(), &forest);
    let [missed, off, hits] = lost(&world, None, 800);
    assert!(100 * (missed + off) < hits, "ours: {missed} missed, {off} off of {hits}");
    for distance in [Distance::Printed, Distance::Estimate, Distance::Bound] {
        let [missed, off, _] = lost(&world, Some(NineCells { divided: false, distance, ..NineCells::SURE }), 800);
        assert!(missed + off > hits / 50, "{distance:?}: {missed} missed, {off} off of {hits}");
    }
}

/// The estimate k₀ (k₀ − 1) / k₁ of eq. 3.7 as it was meant, and the bound, at a point of an ellipsoid of radii r.
fn distances(p: [f64; 2], r: [f64; 2]) -> [f64; 2] {
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    let k0 = length([p[0] / r[0], p[1] / r[1]]);
    let k1 = length([p[0] / (r[0] * r[0]), p[1] / (r[1] * r[1])]);
    [k0 * (k0 - 1.0) / k1, r[0].min(r[1]) * (k0 - 1.0)]
}

/// The true distance from an ellipse, signed.
fn true_distance(p: [f64; 2], r: [f64; 2]) -> f64 {
    let at = |i: u32| f64::from(i) * core::f64::consts::TAU / 20_000.0;
    let nearest =
        (0..20_000).map(|i| (p[0] - r[0] * at(i).cos()).hypot(p[1] - r[1] * at(i).sin())).fold(f64::MAX, f64::min);
    if (p[0] / r[0]).hypot(p[1] / r[1]) < 1.0 { -nearest } else { nearest }
}

#[test]
fn the_ellipsoids_estimate_oversteps_and_the_bound_does_not() {
    let r = [1.0, 3.0];
    let mut random = Random::new(22);
    let (mut deepest, mut steepest) = (0.0f64, [0.0f64; 2]);
    for i in 0..20_000 {
        let p = [random.within(-4.0, 4.0), random.within(-6.0, 6.0)];
        let [estimate, bound] = distances(p, r);
        if i < 300 {
            let truth = true_distance(p, r);
            // Both are of the right sign; outside the bound never says too much, and inside it is less deep.
            assert!(bound.abs() <= truth.abs() + 1e-6, "{bound} for {truth}");
            if truth < 0.0 {
                deepest = deepest.max(estimate.abs() / truth.abs());
            }
        }
        let turn = random.within(0.0, 6.3);
        let step = 1e-6;
        let there = distances([p[0] + step * turn.cos(), p[1] + step * turn.sin()], r);
        if distances(p, r)[0] > 0.0 {
            for (steepest, (a, b)) in steepest.iter_mut().zip([estimate, bound].into_iter().zip(there)) {
                *steepest = steepest.max((a - b).abs() / step);
            }
        }
    }
    assert!(steepest[0] > 1.3, "the estimate's slope {steepest:?}");
    assert!(steepest[1] <= 1.0 + 1e-6, "the bound's slope {steepest:?}");
    assert!(deepest > 1.2, "inside the estimate is {deepest} of the truth");
    assert!(distances([0.0; 2], r)[0].is_nan(), "0/0 in the middle");
    // As printed it counts in radii: of an ellipsoid a hand wide it says some ten times as far as it is.
    let small = [0.1, 0.1];
    let printed = (1.0f64 / 0.1) - 1.0;
    assert!(printed > 9.0 * true_distance([1.0, 0.0], small));
}

/// Whether nine cells around a point hold a crown that covers it, of plants that reach `radius` cells and stand up to `offset`
/// cells from their cell's middle.
#[test]
fn nine_cells_hold_what_reaches_no_farther_than_one_and_a_half() {
    let mut random = Random::new(23);
    let mut lost = |radius: f64, offset: f64| {
        (0..20_000)
            .filter(|_| {
                let p = [random.within(0.0, 1.0), random.within(0.0, 1.0)];
                // A plant two cells on, at its nearest.
                let trunk = [2.5 - offset, random.within(0.0, 1.0)];
                (p[0] - trunk[0]).hypot(p[1] - trunk[1]) < radius
            })
            .count()
    };
    assert_eq!(lost(1.0, 0.5), 0);
    assert!(lost(1.2, 0.5) > 100, "radius and offset of 1.7 cells");
}
