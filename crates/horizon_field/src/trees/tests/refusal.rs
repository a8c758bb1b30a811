//! What is refused, and how it is named.

use super::dense;
use crate::field::NoImages;
use crate::trees::{Forest, Species};
use crate::{Field, Place};

fn refused(change: impl FnOnce(&mut Forest)) -> String {
    let mut forest = dense();
    change(&mut forest);
    forest.compile("forest", &NoImages).expect_err("refused").to_string()
}

#[test]
fn the_default_is_good_and_survives_files() {
    let forest = Forest::default();
    forest.compile("forest", &NoImages).unwrap_or_else(|error| panic!("{error}"));
    for forest in [forest, dense()] {
        let text = ron::to_string(&forest).unwrap();
        assert_eq!(ron::from_str::<Forest>(&text).unwrap(), forest);
    }
    assert_eq!(ron::from_str::<Forest>("(spacing: 9.0)").unwrap(), Forest { spacing: 9.0, ..Forest::default() });
    assert!(ron::from_str::<Forest>("(spacing: 9.0, sapling: 1)").is_err());
}

#[test]
fn each_refusal_names_the_field() {
    for (message, name) in [
        (refused(|forest| forest.spacing = f64::NAN), "forest.spacing is NaN"),
        (refused(|forest| forest.spacing = 0.0), "forest.spacing is 0"),
        (refused(|forest| forest.jitter = 1.5), "forest.jitter is 1.5"),
        (refused(|forest| forest.steepest = f64::INFINITY), "forest.steepest is inf"),
        (refused(|forest| forest.species.clear()), "forest.species holds 0"),
        (refused(|forest| forest.species = vec![Species::default(); 5]), "forest.species holds 5"),
        (refused(|forest| forest.species[1].height = [3.0, 2.0]), "forest.species[1].height"),
        (refused(|forest| forest.species[2].foliage = -1.0), "forest.species[2].foliage is -1"),
        (refused(|forest| forest.species[0].young[1] = 2.0), "forest.species[0].young is 2"),
        (refused(|forest| forest.species[3].radius = 3.0), "forest.species[3].radius: the largest plant reaches"),
        (refused(|forest| forest.sway = 2.0), "forest.species[0].radius: the largest plant reaches"),
        (refused(|forest| forest.species[1].lean = 0.3), "forest.species[1].radius: the largest plant reaches"),
        (refused(|forest| forest.density = Field::Add(vec![])), "forest.density: field.Add holds no field"),
        (refused(|forest| forest.species_of = Field::Constant(1e9)), "forest.species_of: field.Constant is 1"),
    ] {
        assert!(message.starts_with(name), "{message}");
    }
}

#[test]
fn areas_beyond_measure_are_refused() {
    let world = super::World::new(&super::hills(), &dense());
    for size in [[1e9, 1.0], [1e5, 1e5], [f64::INFINITY, 1.0]] {
        let asked = world.planting.plants_in(world.ground(), &world.felled, &Place::ORIGIN, size);
        assert!(asked.is_err_and(|error| error.to_string().contains("cells")), "{size:?}");
    }
    for size in [[f64::NAN, 5.0], [-3.0, 5.0], [0.0, 0.0]] {
        assert!(world.planting.plants_in(world.ground(), &world.felled, &Place::ORIGIN, size).unwrap().is_empty());
    }
}
