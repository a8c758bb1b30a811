//! Tests.

mod casting;
mod foliage;
#[cfg(feature = "baselines")]
mod naive;
mod placement;
mod random;
#[cfg(feature = "reflect")]
mod reflection;
mod refusal;
mod shader;
mod truths;

use super::{Felled, Forest, PlantGround, PlantShape, Planting, Solid, Species, Wind};
use crate::field::{Compiled, Fractal, NoImages};
use crate::march::Ray;
use crate::stamp::Stamps;
use crate::{Field, Place};

/// A world to plant.
struct World {
    field: Compiled<2>,
    stamps: Stamps,
    planting: Planting,
    felled: Felled,
}

impl World {
    fn new(ground: &Field, forest: &Forest) -> Self {
        Self {
            field: ground.compile(&NoImages).unwrap(),
            stamps: Stamps::default(),
            planting: forest.compile("forest", &NoImages).unwrap_or_else(|error| panic!("{error}")),
            felled: Felled::default(),
        }
    }

    fn ground(&self) -> PlantGround<'_> {
        PlantGround { field: &self.field, stamps: &self.stamps }
    }

    /// The ground's height at a place.
    fn height(&self, place: &Place) -> f64 {
        self.field.value_f64(&self.field.anchor(place), [0.0; 2], 0.0)
    }

    /// All plants of a square around a place, as solids seen from it.
    fn solids(&self, place: &Place, half: f64) -> Vec<Solid<f64>> {
        let corner = place.translated([-half, 0.0, -half]);
        let plants = self.planting.plants_in(self.ground(), &self.felled, &corner, [2.0 * half; 2]).unwrap();
        let solid = |plant: &super::Plant| {
            let [x, _, z] = plant.place.minus(place);
            let species = &self.planting.forest().species[usize::from(plant.species)];
            Solid::new(plant, species, [x, plant.foot(), z], &Wind::default())
        };
        plants.iter().map(solid).collect()
    }
}

/// Hills some 40 m high.
fn hills() -> Field {
    Fractal { wavelength: 300.0, amplitude: 40.0, octaves: 8.0, seed: 5, ..Fractal::default() }.into()
}

/// A forest that stands everywhere, of every shape, as wide as it may be.
fn dense() -> Forest {
    let of = |shape, height, radius| Species { shape, height, radius, lean: 0.02, ..Species::default() };
    Forest {
        density: Field::Constant(1.0),
        species_of: Field::Constant(0.5),
        mixing: 1.0,
        jitter: 1.0,
        steepest: 100.0,
        level: -1e6,
        shore: 0.0,
        sway: 0.1,
        species: vec![
            of(PlantShape::Broadleaf, [3.0, 9.0], 0.35),
            of(PlantShape::Conifer, [4.0, 13.0], 0.23),
            of(PlantShape::Bush, [0.6, 2.0], 0.7),
            of(PlantShape::Rock, [0.3, 1.5], 0.9),
        ],
        ..Forest::default()
    }
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray::new(origin, direction).unwrap()
}
