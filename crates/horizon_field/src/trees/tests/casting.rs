//! The walk through the dual cells, against all plants and against the truth.

use super::placement::cliff;
use super::truths::rays;
use super::{World, dense, hills, ray};
use crate::Place;
use crate::field::Noise;
use crate::field::arbitrary::Random;
use crate::trees::{Cone, DualCells, Forest, Grove, Part, PlantWork, Wind, nearest_truth};
use crate::truth::{Projection, TruthCamera};

#[test]
fn dual_cells_follow_one_another_and_hold_the_ray() {
    let mut random = Random::new(1);
    for _ in 0..3000 {
        let origin = [random.within(-90.0, 90.0), random.within(-90.0, 90.0)];
        let angle = random.within(0.0, 7.0);
        let direction = random.pick(&[[angle.cos(), angle.sin()], [1.0, 0.0], [0.0, -1.0], [0.0, 0.0], [-1e-12, 1.0]]);
        let spacing = random.magnitude(0.5, 30.0);
        let mut last: Option<([i64; 2], f64)> = None;
        for (cell, [enter, leave]) in DualCells::new(origin, direction, spacing, [0.0, 100.0]) {
            let middle = 0.5 * (enter + leave);
            for k in 0..2 {
                let at = (origin[k] + middle * direction[k]) / spacing - 0.5 - cell[k] as f64;
                assert!((-1e-9..=1.0 + 1e-9).contains(&at), "{at}");
            }
            if let Some((before, left)) = last {
                assert_eq!(left, enter, "no gap");
                assert_eq!((0..2).map(|k| (cell[k] - before[k]).abs()).sum::<i64>(), 1, "neighbours");
            }
            last = Some((cell, leave));
        }
        assert_eq!(last.map(|last| last.1), Some(100.0));
    }
}

/// Worlds that make it hard: crowns across all borders, far from the origin, on cliffs, at the edges of groves and at the
/// shore.
fn worlds() -> Vec<(World, Place)> {
    let far = Place::new([244_140, 0, -244_141], [100.0, 0.0, 4000.0]);
    let grove = Noise { wavelength: 40.0, amplitude: 1.0, seed: 4, ..Noise::default() };
    let edges = Forest { density: grove.into(), ..dense() };
    let near = World::new(&hills(), &dense()).height(&Place::ORIGIN);
    let shore = Forest { level: near - 2.0, shore: 0.5, ..dense() };
    vec![
        (World::new(&hills(), &dense()), Place::ORIGIN),
        (World::new(&hills(), &dense()), far),
        (World::new(&cliff(), &dense()), Place::ORIGIN),
        (World::new(&hills(), &edges), Place::ORIGIN),
        (World::new(&hills(), &shore), Place::ORIGIN),
    ]
}

#[test]
fn four_plants_in_each_dual_cell_are_as_good_as_all() {
    for (world, place) in worlds() {
        let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
        let solids = world.solids(&place, 75.0);
        let (mut hits, mut across) = (0, 0);
        for ray in rays(&world, &place, 11, 1500, 20.0) {
            let found = grove.cast(&place, &ray, 45.0, Cone::FINE);
            let all = nearest_truth(&solids, ray.origin(), ray.direction(), 45.0, Cone::FINE);
            assert_eq!(found.is_some(), all.is_some(), "{found:?} for {all:?}");
            if let (Some(found), Some((_, t, part))) = (found, all) {
                assert!((found.t - t).abs() < 1e-5 && found.part == part, "{found:?} for {t}");
                hits += 1;
                let [x, _, z] = ray.at(t);
                across += usize::from(world.planting.cell_of(&place.translated([x, 0.0, z])) != found.plant.id.0);
            }
        }
        println!("{hits} hits, {across} of them in another cell than the plant's");
        // A search of the ray's own cells would lose those.
        assert!(hits > 40 && across > 5);
    }
}

/// What became of a camera's pixels.
#[derive(Debug, Default)]
struct Tally {
    pixels: usize,
    hits: usize,
    silhouettes: usize,
    missed: usize,
    false_hits: usize,
    /// Hits more than a pixel's width off.
    off: usize,
    worst: f64,
}

/// A camera in the forest, by lot.
fn camera(random: &mut Random, world: &World, [width, height]: [usize; 2]) -> TruthCamera {
    let at = [random.within(-60.0, 60.0), random.within(-60.0, 60.0)];
    let ground = world.height(&Place::from_metres([at[0], 0.0, at[1]]));
    let eye = [at[0], ground + random.magnitude(1.0, 60.0), at[1]];
    let angle = random.within(0.0, 6.3);
    let target = [eye[0] + angle.cos(), eye[1] + random.within(-1.2, 0.4), eye[2] + angle.sin()];
    TruthCamera::looking_at(eye, target, Projection::Perspective { fov: random.within(0.2, 1.4) }, [width, height])
}

/// Compares a camera's picture with the truth about it, of all plants within `far` metres.
fn compare(world: &World, camera: &TruthCamera, far: f64, single: bool, tally: &mut Tally) {
    let eye = Place::from_metres([camera.position[0], 0.0, camera.position[2]]);
    let camera = TruthCamera { position: [0.0, camera.position[1], 0.0], ..*camera };
    let solids = world.solids(&eye, far + 8.0);
    let cone = Cone { start: 0.0, growth: camera.footprint(1.0) };
    let width = 2 * camera.width + 1;
    let truth = |x: usize, y: usize| {
        let ray = camera.ray([x, y]);
        nearest_truth(&solids, ray.origin(), ray.direction(), far, cone).map(|(_, t, _)| t)
    };
    let grid: Vec<_> = (0..2 * camera.height + 1).flat_map(|y| (0..width).map(move |x| (x, y))).collect();
    let grid: Vec<_> = grid.into_iter().map(|(x, y)| truth(x, y)).collect();
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    for y in 0..camera.height {
        for x in 0..camera.width {
            let centre = grid[(2 * y + 1) * width + 2 * x + 1];
            let around = (0..9).map(|i| grid[(2 * y + i / 3) * width + 2 * x + i % 3]);
            let footprint = cone.at(centre.unwrap_or(far));
            let jump = |t: Option<f64>| match (t, centre) {
                (Some(t), Some(centre)) => (t - centre).abs() > 6.0 * footprint,
                (t, centre) => t.is_some() != centre.is_some(),
            };
            let silhouette = around.clone().any(jump);
            let ray = camera.ray([2 * x + 1, 2 * y + 1]);
            let mut work = PlantWork::default();
            let found = if single {
                grove.cast_as::<f32>(&eye, &ray, far, cone, &mut work)
            } else {
                grove.cast_as::<f64>(&eye, &ray, far, cone, &mut work)
            };
            tally.pixels += 1;
            tally.hits += usize::from(centre.is_some());
            tally.silhouettes += usize::from(silhouette);
            if silhouette {
                continue;
            }
            match (found, centre) {
                (None, Some(_)) => tally.missed += 1,
                (Some(_), None) => tally.false_hits += 1,
                (Some(found), Some(t)) => {
                    let error = (found.t - t).abs() / footprint;
                    tally.off += usize::from(error > 1.0);
                    tally.worst = tally.worst.max(error);
                }
                (None, None) => {}
            }
        }
    }
}

fn cameras(count: usize, size: [usize; 2], single: bool) {
    let world = World::new(&hills(), &dense());
    let mut random = Random::new(12);
    let mut tally = Tally::default();
    for _ in 0..count {
        let camera = camera(&mut random, &world, size);
        compare(&world, &camera, 120.0, single, &mut tally);
    }
    println!("{count} cameras: {tally:?}");
    assert_eq!((tally.missed, tally.false_hits), (0, 0), "{tally:?}");
    assert!(tally.off * 1000 <= tally.hits && tally.worst < 12.0 && tally.hits > tally.pixels / 20, "{tally:?}");
    assert!(tally.silhouettes < tally.pixels / 2, "{tally:?}");
}

#[test]
fn some_cameras_by_lot_miss_nothing() {
    cameras(5, [24, 16], false);
    cameras(3, [24, 16], true);
}

#[test]
#[ignore = "some minutes"]
fn fifty_cameras_by_lot_miss_nothing() {
    cameras(50, [125, 80], false);
    cameras(50, [125, 80], true);
}

#[test]
fn single_precision_sees_the_same() {
    let world = World::new(&hills(), &dense());
    let place = Place::new([244_140, 0, -244_141], [100.0, 0.0, 4000.0]);
    let mut grove =
        Grove::new(&world.planting, world.ground(), &world.felled).in_wind(&Wind { sway: [0.1, 0.05], gust: 2.0 });
    let cone = Cone { start: 0.01, growth: 0.002 };
    let (mut apart, mut hits) = (0, 0);
    for ray in rays(&world, &place, 13, 4000, 2000.0) {
        let mut work = PlantWork::default();
        let double = grove.cast_as::<f64>(&place, &ray, 150.0, cone, &mut work);
        let single = grove.cast_as::<f32>(&place, &ray, 150.0, cone, &mut work);
        hits += usize::from(double.is_some());
        let same = match (double, single) {
            (Some(a), Some(b)) => (a.t - b.t).abs() < cone.at(a.t),
            (a, b) => a.is_some() == b.is_some(),
        };
        apart += usize::from(!same);
    }
    println!("{apart} of {hits} apart");
    assert!(hits > 1200 && apart * 200 < hits, "{apart} of {hits}");
}

#[test]
fn a_ray_along_the_borders_and_straight_down_loses_nothing() {
    let world = World::new(&hills(), &dense());
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    let solids = world.solids(&Place::ORIGIN, 150.0);
    let spacing = world.planting.forest().spacing;
    let mut hits = 0;
    for i in -20..20 {
        let line = f64::from(i) * 0.5 * spacing;
        for (origin, direction) in [
            ([line, 3.0, -60.0], [0.0, -0.02, 1.0]),
            ([-60.0, 3.0, line], [1.0, 0.0, 0.0]),
            ([line, 60.0, -line], [0.0, -1.0, 0.0]),
            ([line, 60.0, line], [1e-9, -1.0, 1e-9]),
            ([line, -60.0, line], [0.0, 1.0, 0.0]),
        ] {
            let ground = world.height(&Place::from_metres([origin[0], 0.0, origin[2]]));
            let ray = ray([origin[0], ground + origin[1], origin[2]], direction);
            let found = grove.cast(&Place::ORIGIN, &ray, 120.0, Cone::FINE);
            let truth = nearest_truth(&solids, ray.origin(), ray.direction(), 120.0, Cone::FINE);
            assert_eq!(found.is_some(), truth.is_some(), "{origin:?} {direction:?}");
            if let (Some(found), Some((_, t, _))) = (found, truth) {
                assert!((found.t - t).abs() < 1e-5, "{} for {t}", found.t);
                hits += 1;
            }
        }
    }
    assert!(hits > 50, "{hits}");
}

#[test]
fn a_ray_that_starts_in_a_crown_is_met_at_once() {
    let world = World::new(&hills(), &dense());
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    let plants = world.planting.plants_in(world.ground(), &world.felled, &Place::ORIGIN, [100.0; 2]).unwrap();
    for plant in plants.iter().filter(|plant| plant.species == 3) {
        let [x, _, z] = plant.place.minus(&Place::ORIGIN);
        let up = 0.35 * f64::from(plant.height);
        let hit = grove.cast(&Place::ORIGIN, &ray([x, plant.foot() + up, z], [0.0, 1.0, 0.0]), 10.0, Cone::FINE);
        assert!(hit.is_some_and(|hit| hit.t < 0.4 * f64::from(plant.height)), "{hit:?} in {plant:?}");
    }
}

#[test]
fn grazing_rays_that_leave_to_the_sky_meet_what_they_graze() {
    // Seed 000 looks for trees only where the ground was hit: these rays never hit it.
    let world = World::new(&hills(), &dense());
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    let plants = world.planting.plants_in(world.ground(), &world.felled, &Place::ORIGIN, [100.0; 2]).unwrap();
    let mut hits = 0;
    for plant in plants.iter().filter(|plant| plant.species == 0) {
        let [x, _, z] = plant.place.minus(&Place::ORIGIN);
        let middle = plant.foot() + 0.6 * f64::from(plant.height);
        let hit = grove.cast(&Place::ORIGIN, &ray([x - 10.0, middle - 4.0, z], [1.0, 0.4, 0.0]), 300.0, Cone::FINE);
        hits += usize::from(hit.is_some_and(|hit| hit.part == Part::Crown));
    }
    assert!(hits > 30, "{hits}");
}

#[test]
#[ignore = "prints times"]
fn what_a_cast_costs() {
    let place = Place::ORIGIN;
    let world = World::new(&hills(), &dense());
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    let some = rays(&world, &place, 31, 4000, 40.0);
    let solids = world.solids(&place, 120.0);
    for cone in [Cone::FINE, Cone { start: 0.0, growth: 0.001 }, Cone { start: 0.0, growth: 0.01 }] {
        for _ in 0..2 {
            let mut work = PlantWork::default();
            let start = std::time::Instant::now();
            let hits =
                some.iter().filter(|ray| grove.cast_as::<f64>(&place, ray, 60.0, cone, &mut work).is_some()).count();
            println!("{cone:?}: {:.1} µs a ray, {hits} hits, {work:?}", start.elapsed().as_nanos() as f64 / 4e6);
        }
        let near: Vec<_> = some
            .iter()
            .flat_map(|ray| solids.iter().take(400).map(move |solid| (ray, solid)))
            .filter(|(ray, solid)| {
                solid
                    .crown_chord(solid.own(ray.origin()), solid.own_direction(ray.direction()))
                    .is_some_and(|c| c[0] > 0.0)
            })
            .collect();
        let start = std::time::Instant::now();
        let hits = near
            .iter()
            .filter(|(ray, solid)| solid.truth(ray.origin(), ray.direction(), [0.0, 100.0], cone.at(10.0)).is_some())
            .count();
        println!(
            "truth: {:.1} µs a plant, {hits} of {}",
            start.elapsed().as_nanos() as f64 / 1e3 / near.len() as f64,
            near.len()
        );
    }
}
