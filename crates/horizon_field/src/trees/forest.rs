//! What grows in a world: meaning, unit, range and default of the parameters, once each.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use super::species::{PlantShape, Species};
use crate::Field;
use crate::field::param::{Numbers, Param, Params, node};
use crate::field::{Clamp, Fractal, Remap};

/// How many species a forest may have.
pub const MAX_SPECIES: usize = 4;

node! {
    /// What grows in a world. A cell of the lattice holds at most one plant, and a plant reaches no farther than half a cell
    /// from its trunk: the largest plant's radius, its lean and the sway together are at most half of the spacing.
    Forest {
        spacing: f64 = 7.0, "The edge of a cell.", in 0.1 .. 500.0 "m";
        seed: u32 = 0, "The seed.", in 0.0 .. 4294967295.0 "";
        density: Field = groves(), "The share of cells in which something grows: 0 and below for none, 1 and above for all.";
        species_of: Field = regions(), "Which species grows: from 0 for the first to 1 for the last.";
        mixing: f64 = 0.4, "How far single plants stray from what `species_of` says.", in 0.0 .. 1.0 "";
        jitter: f64 = 0.9, "How much of its cell a plant may stand in: 0 for its centre, 1 for all of it.", in 0.0 .. 1.0 "";
        steepest: f64 = 0.7, "The steepest slope on which anything grows, as rise over run.", in 0.0 .. 100.0 "";
        level: f64 = 0.0, "The height of the water's surface.", in -1e6 .. 1e6 "m";
        shore: f64 = 1.0, "How far above the water's surface the first plants stand.", in -1e6 .. 1e6 "m";
        tree_line: f64 = 1e6, "The height above which nothing grows.", in -1e6 .. 1e6 "m";
        ragged: f64 = 100.0, "How far below the tree line plants begin to thin out.", in 0.0 .. 1e5 "m";
        sway: f64 = 0.2, "How far the strongest wind moves the tops.", in 0.0 .. 20.0 "m";
        species: Vec<Species> = vec![Species::default(), spruce()], "The species, one to four.";
    }
}

/// Woods with glades.
fn groves() -> Field {
    let noise = Fractal { wavelength: 500.0, amplitude: 1.0, octaves: 3.0, seed: 101, ..Fractal::default() };
    let share = Remap { field: Field::from(noise).into(), from: [-0.35, 0.25], to: [0.0, 0.9] };
    Clamp { field: Field::from(share).into(), low: 0.0, high: 0.9 }.into()
}

/// Regions of each species.
fn regions() -> Field {
    let noise = Fractal { wavelength: 1200.0, amplitude: 1.0, octaves: 2.0, seed: 102, ..Fractal::default() };
    Remap { field: Field::from(noise).into(), from: [-0.5, 0.5], to: [0.0, 1.0] }.into()
}

/// A conifer.
fn spruce() -> Species {
    Species {
        shape: PlantShape::Conifer,
        height: [6.0, 12.0],
        radius: 0.24,
        foliage: 0.45,
        clump: 0.9,
        density: 1.4,
        translucency: 0.15,
        young: [0.05, 0.105, 0.035],
        old: [0.028, 0.062, 0.028],
        ..Species::default()
    }
}
