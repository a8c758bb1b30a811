//! What stands where.

use std::collections::{BTreeMap, BTreeSet};

use super::{World, dense, hills};
use crate::field::arbitrary::Random;
use crate::field::{Clamp, Mask, Noise, Remap};
use crate::stamp::{Disc, Edit, Mode, Placed, Shape, Stamps};
use crate::trees::{Block, Felled, Forest, Plant, PlantId, cell_corner, cell_of};
use crate::{Field, Place};

fn block(corner: [i64; 2], size: [u32; 2]) -> Block {
    Block { corner, size }
}

fn plants(world: &World, corner: [i64; 2], size: [u32; 2]) -> Vec<Plant> {
    world.planting.plants(world.ground(), &world.felled, block(corner, size))
}

fn by_id(plants: Vec<Plant>) -> BTreeMap<PlantId, Plant> {
    plants.into_iter().map(|plant| (plant.id, plant)).collect()
}

#[test]
fn density_0_and_1_are_none_and_all() {
    for (density, count) in [(0.0, 0), (-3.0, 0), (1.0, 40 * 30), (7.0, 40 * 30)] {
        let world = World::new(&hills(), &Forest { density: Field::Constant(density), ..dense() });
        assert_eq!(by_id(plants(&world, [-20, -11], [40, 30])).len(), count, "density {density}");
    }
    let world = World::new(&hills(), &Forest { density: Field::Constant(0.3), ..dense() });
    let share = plants(&world, [-100, -100], [200, 200]).len() as f64 / 4e4;
    assert!((share - 0.3).abs() < 0.01, "{share}");
}

#[test]
fn a_plant_is_the_same_whoever_asks() {
    let world = World::new(&hills(), &Forest { steepest: 0.3, density: Field::Constant(0.8), ..dense() });
    let all = by_id(plants(&world, [-40, -40], [80, 80]));
    assert!((2000..5120).contains(&all.len()), "{}", all.len());
    let mut random = Random::new(3);
    for _ in 0..200 {
        let corner = [0; 2].map(|_| random.within(-40.0, 20.0) as i64);
        let size = [0; 2].map(|_| random.within(1.0, 20.0) as u32);
        let some = by_id(plants(&world, corner, size));
        let of_all = all.iter().filter(|(id, _)| block(corner, size).holds(id.0));
        assert!(some.iter().eq(of_all), "{corner:?} {size:?}");
    }
    for (id, plant) in all.iter().take(200) {
        assert_eq!(world.planting.plant(world.ground(), &world.felled, *id), Some(*plant));
        assert_eq!(world.planting.cell_of(&plant.place), id.0);
    }
}

#[test]
fn plants_stand_on_the_ground_in_their_cells_and_reach_half_a_cell() {
    let world = World::new(&hills(), &dense());
    let forest = world.planting.forest();
    for plant in plants(&world, [-30, 500], [60, 60]) {
        let height =
            world.height(&Place { offset: [plant.place.offset[0], 0.0, plant.place.offset[2]], ..plant.place });
        assert!((plant.foot() - height).abs() < 1e-9, "{} on {height}", plant.foot());
        let [x, _, z] = plant.place.minus(&cell_corner(plant.id.0, forest.spacing));
        assert!((0.0..=forest.spacing).contains(&x) && (0.0..=forest.spacing).contains(&z));
        let lean = forest.species[usize::from(plant.species)].lean * f64::from(plant.height);
        assert!(f64::from(plant.radius) + lean + forest.sway <= 0.5 * forest.spacing);
    }
}

#[test]
fn every_species_and_all_of_the_cell_are_used() {
    let world = World::new(&hills(), &dense());
    let plants = plants(&world, [0, 0], [100, 100]);
    let kinds: Vec<_> = (0..4).map(|kind| plants.iter().filter(|plant| plant.species == kind).count()).collect();
    assert!(kinds.iter().all(|count| *count > 1500), "{kinds:?}");
    let mean = |of: &dyn Fn(&Plant) -> f64| plants.iter().map(of).sum::<f64>() / plants.len() as f64;
    for k in 0..2 {
        assert!((mean(&|plant| f64::from(plant.offset[k])) / 65535.0 - 0.5).abs() < 0.01);
    }
    assert!((mean(&|plant| f64::from(plant.tint)) / 255.0 - 0.5).abs() < 0.01);
    let first = World::new(&hills(), &Forest { species_of: Field::Constant(0.0), mixing: 0.0, ..dense() });
    assert!(super::placement::plants(&first, [0, 0], [20, 20]).iter().all(|plant| plant.species == 0));
    let seeded = World::new(&hills(), &Forest { seed: 1, ..dense() });
    assert_ne!(super::placement::plants(&seeded, [0, 0], [9, 9])[0].offset, plants[0].offset);
}

/// A plain, and a tableland 30 m higher, with a cliff between them.
pub(super) fn cliff() -> Field {
    let mask = Noise { wavelength: 400.0, amplitude: 100.0, seed: 9, ..Noise::default() };
    Mask {
        mask: Field::from(mask).into(),
        low: -2.0,
        high: 2.0,
        outside: Field::Constant(0.0).into(),
        inside: Field::Constant(30.0).into(),
    }
    .into()
}

#[test]
fn nothing_stands_on_a_cliff_or_in_the_water_or_above_the_tree_line() {
    let everywhere = plants(&World::new(&cliff(), &dense()), [-50, -50], [100, 100]);
    let on_cliff = |plants: &[Plant]| plants.iter().filter(|plant| (1.0..29.0).contains(&plant.foot())).count();
    assert!(on_cliff(&everywhere) > 100, "{}", on_cliff(&everywhere));
    let forest = Forest { steepest: 0.5, ..dense() };
    let flat = plants(&World::new(&cliff(), &forest), [-50, -50], [100, 100]);
    // What is left stands where the cliff runs out.
    assert!(20 * on_cliff(&flat) < on_cliff(&everywhere) && flat.len() > 7000, "{} of {}", on_cliff(&flat), flat.len());
    let slope = |plant: &Plant| plant.normal[0].hypot(plant.normal[1]);
    assert!(flat.iter().all(|plant| slope(plant) <= 0.4473), "the sine of it");
    assert!(everywhere.iter().any(|plant| slope(plant) > 0.9));
    // Both above and below, up to the edge.
    assert!([0.0, 30.0].iter().all(|height| flat.iter().filter(|p| (p.foot() - height).abs() < 1.0).count() > 1000));

    let all = by_id(plants(&World::new(&hills(), &dense()), [-50, -50], [100, 100]));
    let shore = Forest { level: 2.0, shore: 1.5, ..dense() };
    let dry = by_id(plants(&World::new(&hills(), &shore), [-50, -50], [100, 100]));
    assert!(all.iter().filter(|(_, plant)| plant.foot() >= 3.5).eq(dry.iter()), "exactly those above the shore");
    let alpine = Forest { tree_line: 10.0, ragged: 6.0, ..dense() };
    let low = plants(&World::new(&hills(), &alpine), [-50, -50], [100, 100]);
    let between = |low: f64, high: f64, plants: &mut dyn Iterator<Item = &Plant>| {
        plants.filter(|plant| (low..high).contains(&plant.foot())).count() as f64
    };
    let share = |a: f64, b: f64| between(a, b, &mut low.iter()) / between(a, b, &mut all.values());
    assert_eq!((share(-99.0, 4.0), share(10.0, 99.0)), (1.0, 0.0));
    assert!((share(4.0, 7.0) - 0.75).abs() < 0.1 && (share(7.0, 10.0) - 0.25).abs() < 0.1);
}

#[test]
fn the_steepness_is_that_of_the_plants_own_scale() {
    // A meadow with a stone a hand high at every step is a meadow.
    let stones = Noise { wavelength: 0.3, amplitude: 0.15, ..Noise::default() };
    let forest = Forest { steepest: 0.3, ..dense() };
    let world = World::new(&stones.clone().into(), &forest);
    assert_eq!(plants(&world, [0, 0], [40, 40]).len(), 1600);
    // By the gradient at the very place most of them would be gone.
    let gradient = |plant: &Plant| world.field.jet_f64(&world.field.anchor(&plant.place), [0.0; 2], 0.0).g;
    let steep = plants(&world, [0, 0], [40, 40]).iter().filter(|p| gradient(p).iter().any(|g| g.abs() > 0.3)).count();
    assert!(steep > 500, "{steep}");
}

#[test]
fn stamps_keep_plants_away_and_lift_them() {
    let stamp = |mode, place: [f64; 3], radius, falloff| Placed {
        place: Place::from_metres(place),
        heading: 0.0,
        edit: Edit { shape: Shape::Disc(Disc { radius }), mode, falloff, order: 0 },
    };
    let mut world = World::new(&hills(), &dense());
    let before = by_id(plants(&world, [-40, -40], [80, 80]));
    world.stamps = Stamps::compile(&[
        stamp(Mode::KeepTrees, [0.0, 0.0, 0.0], 30.0, 40.0),
        stamp(Mode::Hole, [150.0, 0.0, 0.0], 20.0, 1.0),
        stamp(Mode::Flatten, [-150.0, 200.0, 0.0], 40.0, 5.0),
    ])
    .unwrap();
    let after = by_id(plants(&world, [-40, -40], [80, 80]));
    let around = |centre: f64, plant: &Plant| {
        let [x, _, z] = plant.place.minus(&Place::from_metres([centre, 0.0, 0.0]));
        x.hypot(z)
    };
    for (id, plant) in &before {
        let kept = after.get(id);
        match (around(0.0, plant), around(150.0, plant), around(-150.0, plant)) {
            (clearing, ..) if clearing < 30.0 => assert_eq!(kept, None),
            (_, hole, _) if hole < 20.0 => assert_eq!(kept, None),
            (_, _, flat) if flat < 40.0 => {
                let kept = kept.expect("it stands on the platform");
                assert_eq!((kept.foot(), kept.normal), (200.0, [0.0, 0.0]));
            }
            (clearing, hole, flat) if clearing > 71.0 && hole > 21.0 && flat > 46.0 => assert_eq!(kept, Some(plant)),
            _ => {}
        }
    }
    let thinned = before.values().filter(|p| (30.0..70.0).contains(&around(0.0, p)));
    let (left, all) = (thinned.clone().filter(|p| after.contains_key(&p.id)).count(), thinned.count());
    assert!((0.3..0.8).contains(&(left as f64 / all as f64)), "{left} of {all}: it fades out");
}

#[test]
fn what_is_felled_is_gone_and_nothing_else() {
    let mut world = World::new(&hills(), &dense());
    let before = by_id(plants(&world, [-10, -10], [20, 20]));
    let (a, b, far) = (PlantId([-3, 4]), PlantId([0, 0]), PlantId([i64::MAX, i64::MIN]));
    world.felled = [a, b, far].into_iter().collect();
    assert!(!world.felled.fell(a) && world.felled.len() == 3);
    let after = by_id(plants(&world, [-10, -10], [20, 20]));
    assert_eq!(before.keys().filter(|id| !after.contains_key(id)).copied().collect::<Vec<_>>(), [a, b]);
    assert!(after.iter().all(|(id, plant)| before[id] == *plant));
    let text = ron::to_string(&world.felled).unwrap();
    assert_eq!(ron::from_str::<Felled>(&text).unwrap(), world.felled);
    let old = world.felled.clone();
    assert!(world.felled.restore(a) && !world.felled.restore(a));
    assert_eq!(old.changes(&world.felled).collect::<Vec<_>>(), [a]);
    assert_eq!(world.planting.plant(world.ground(), &world.felled, a), Some(before[&a]));
}

#[test]
fn a_regions_edge_parts_no_crown() {
    // Plants of the region's inside only, decided where the trunk stands.
    let region = Noise { wavelength: 300.0, amplitude: 1.0, seed: 4, ..Noise::default() };
    let density = Clamp {
        field: Field::from(Remap { field: Field::from(region).into(), from: [0.0, 1e-6], to: [0.0, 1.0] }).into(),
        low: 0.0,
        high: 1.0,
    };
    let inside = Field::from(density);
    let forest = Forest { density: inside.clone(), ..dense() };
    let world = World::new(&hills(), &forest);
    let compiled = inside.compile::<2>(&crate::field::NoImages).unwrap();
    let standing = by_id(plants(&world, [-50, -50], [100, 100]));
    let all = plants(&World::new(&hills(), &dense()), [-50, -50], [100, 100]);
    assert!((3000..7000).contains(&standing.len()));
    for plant in &all {
        let density = compiled.value_f64(&compiled.anchor(&plant.place), [0.0; 2], 0.0);
        if density == 0.0 || density == 1.0 {
            assert_eq!(standing.get(&plant.id), (density == 1.0).then_some(plant));
        }
    }
}

#[test]
fn far_and_negative_cells_are_as_good_as_near_ones() {
    let world = World::new(&hills(), &dense());
    let spacing = world.planting.forest().spacing;
    let far = (1e9 / spacing) as i64;
    let mut seen = BTreeSet::new();
    for corner in [[0, 0], [-8, -8], [far, 3], [-far, far], [far, -far], [1 << 32, -(1 << 32)], [(1 << 50) + 7, 0]] {
        let plants = plants(&world, corner, [8, 8]);
        assert_eq!(plants.len(), 64);
        for plant in &plants {
            assert_eq!(cell_of(&plant.place, spacing).0, plant.id.0);
            let [x, _, z] = plant.place.minus(&cell_corner(plant.id.0, spacing));
            for (k, at) in [x, z].into_iter().enumerate() {
                assert!((at - f64::from(plant.offset[k]) / 65535.0 * spacing).abs() < 1e-9, "{at}");
            }
            let height = world.height(&Place::new(
                [plant.place.cell[0], 0, plant.place.cell[2]],
                [plant.place.offset[0], 0.0, plant.place.offset[2]],
            ));
            assert!((height - plant.foot()).abs() < 1e-8);
        }
        assert!(seen.insert(plants.iter().map(|plant| plant.offset).collect::<Vec<_>>()), "not the same again");
    }
    // A coordinate in single precision can't tell where in its cell a plant stands there.
    assert_eq!(far as f32 * spacing as f32 + 3.0, far as f32 * spacing as f32);
    for corner in [[i64::MIN; 2], [i64::MAX - 3; 2], [i64::MIN, i64::MAX - 9]] {
        for plant in plants(&world, corner, [4, 4]) {
            assert!(plant.foot().is_finite() && plant.height > 0.0 && plant.place.offset.iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn cells_of_places_are_found_everywhere() {
    let mut random = Random::new(8);
    for _ in 0..20_000 {
        let spacing = f64::from(random.magnitude(0.1, 500.0) as f32);
        let cell = [0; 2].map(|_| {
            let far = random.magnitude(1.0, 1e12) as i64;
            random.pick(&[far, -far])
        });
        let within = [0; 2].map(|_| random.within(0.001, 0.999) * spacing);
        let place = cell_corner(cell, spacing).translated([within[0], 0.0, within[1]]);
        let (found, rest) = cell_of(&place, spacing);
        assert_eq!(found, cell);
        assert!((0..2).all(|k| (rest[k] - within[k]).abs() < 1e-9));
    }
}

#[test]
#[ignore = "prints times"]
fn what_planting_costs() {
    use crate::field::Fractal;
    let ground = |octaves| Field::from(Fractal { wavelength: 4000.0, amplitude: 600.0, octaves, ..Fractal::default() });
    for (name, forest) in [("default", Forest::default()), ("dense", dense())] {
        for octaves in [6.0, 12.0] {
            let world = World::new(&ground(octaves), &Forest { level: -1e6, ..forest.clone() });
            let start = std::time::Instant::now();
            let plants = plants(&world, [-256, -256], [512, 512]);
            let each = start.elapsed().as_nanos() as f64 / (512.0 * 512.0);
            println!("{name} on {octaves} octaves: {each:.0} ns a cell, {} plants of {}", plants.len(), 512 * 512);
            let start = std::time::Instant::now();
            let words: usize = plants.iter().map(|plant| plant.to_words(0.0)[5] as usize & 1).sum();
            println!("  records: {:.1} ns each ({words})", start.elapsed().as_nanos() as f64 / plants.len() as f64);
        }
    }
}

#[test]
fn records_hold_what_the_plant_is() {
    let world = World::new(&hills(), &dense());
    for plant in plants(&world, [3, -9], [20, 20]) {
        let words = plant.to_words(17.25);
        assert_eq!([words[0] as u16, (words[0] >> 16) as u16], plant.offset);
        assert!((f64::from(f32::from_bits(words[1])) + 17.25 - plant.foot()).abs() < 1e-5);
        assert_eq!([f32::from_bits(words[2]), f32::from_bits(words[3])], [plant.height, plant.radius]);
        assert_eq!(words[4].to_le_bytes(), [plant.species | 1 << 4, plant.turn, plant.tint, 0]);
        assert_eq!((words[5], words[7]), (plant.hash, 0));
        for (k, n) in plant.normal.into_iter().enumerate() {
            assert!((f32::from((words[6] >> (16 * k)) as i16) / 32767.0 - n).abs() < 2e-5);
        }
    }
}
