//! Whatever is allowed gives finite answers, in time.

use proptest::prelude::*;

use super::{World, hills, ray};
use crate::Field;
use crate::Place;
use crate::trees::{Cone, Forest, Grove, PlantShape, PlantWork, Species, Wind};

fn species() -> impl Strategy<Value = Species> {
    let shape =
        prop::sample::select(vec![PlantShape::Broadleaf, PlantShape::Conifer, PlantShape::Bush, PlantShape::Rock]);
    (shape, 0.1..200.0, 0.0..1.0, 0.02..4.0, 0.0..0.5, 0.0..0.3, 0.0..0.8, 0.02..20.0).prop_map(
        |(shape, high, low, radius, trunk, lean, foliage, clump)| Species {
            shape,
            height: [f64::max(high * low, 0.1), high],
            radius,
            trunk,
            lean,
            foliage,
            clump,
            ..Species::default()
        },
    )
}

fn forest() -> impl Strategy<Value = Forest> {
    let fields = (-0.5..1.5, -1.0..2.0);
    (prop::collection::vec(species(), 1..5), fields, 0.0..1.0, 0.0..1.0, any::<u32>(), 0.0..1.0f64).prop_map(
        |(species, (density, kind), mixing, jitter, seed, sway)| {
            let reach = species.iter().map(Species::reach).fold(0.0, f64::max);
            // As near as it may be; what is wider than the widest spacing is scaled down.
            let spacing = (2.001 * (reach + sway)).clamp(0.1, 500.0);
            let share = f64::min(1.0, 0.49 * spacing / (reach + sway));
            let smaller = |mut s: Species| {
                s.radius = (s.radius * share).max(0.02);
                s.lean *= share;
                s
            };
            Forest {
                spacing,
                seed,
                density: Field::Constant(density),
                species_of: Field::Constant(kind),
                mixing,
                jitter,
                steepest: 100.0,
                level: -1e6,
                sway: sway * share,
                species: species.into_iter().map(smaller).collect(),
                ..Forest::default()
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_cast_makes_a_nan_or_hangs(
        forest in forest(),
        origin in [-50.0..50.0f64, -60.0..150.0, -50.0..50.0],
        direction in prop_oneof![
            [-1.0..1.0f64, -1.0..1.0, -1.0..1.0],
            (-1.0..1.0f64).prop_map(|x| [x, 0.0, 0.0]),
            (-1.0..1.0f64).prop_map(|y| [0.0, y, 0.0]),
            (-1.0..1.0f64).prop_map(|z| [-0.0, 1e-300, z]),
        ],
        cell in prop_oneof![Just(0i64), any::<i32>().prop_map(i64::from), Just(1 << 50)],
        start in 0.0..2.0f64, growth in 0.0..0.1f64,
        wind in [-1e9..1e9f64, -2.0..2.0],
    ) {
        prop_assume!(direction.iter().any(|d| d.abs() > 1e-3));
        prop_assume!(forest.check("forest").is_ok());
        let world = World::new(&hills(), &forest);
        let mut grove =
            Grove::new(&world.planting, world.ground(), &world.felled).in_wind(&Wind { sway: wind, gust: wind[0] });
        let place = Place::new([cell, 0, -cell], [12.0, 0.0, 4000.0]);
        let ray = ray(origin, direction);
        let cone = Cone { start, growth };
        let mut work = PlantWork::default();
        let far = 60.0 * forest.spacing;
        let hit = grove.cast_as::<f64>(&place, &ray, far, cone, &mut work);
        let single = grove.cast_as::<f32>(&place, &ray, far, cone, &mut work);
        for hit in [hit, single].into_iter().flatten() {
            prop_assert!((0.0..=far * 1.000_001).contains(&hit.t), "{}", hit.t);
            let length: f64 = hit.normal.iter().map(|n| n * n).sum();
            prop_assert!((length - 1.0).abs() < 1e-6, "{:?}", hit.normal);
        }
        prop_assert!(work.steps < 96 * 1000, "{work:?}");
    }
}

#[test]
fn rays_without_end_end() {
    let world = World::new(&hills(), &Forest { density: Field::Constant(0.0), ..super::dense() });
    let mut grove = Grove::new(&world.planting, world.ground(), &world.felled);
    for t_max in [f64::INFINITY, f64::MAX, -1.0, f64::NAN] {
        let level = ray([0.0, 0.0, 0.0], [1.0, 0.0, 0.3]);
        assert_eq!(grove.cast(&Place::ORIGIN, &level, t_max.min(3e3), Cone::FINE), None);
        let up = ray([0.0, 0.0, 0.0], [0.1, 1.0, 0.3]);
        assert_eq!(grove.cast(&Place::ORIGIN, &up, t_max, Cone::FINE), None);
    }
}
