//! Plants: trees, bushes and rocks, one at most in each cell of a lattice, as ellipsoids that foliage eats into.
//!
//! Data flows through the files in this order: `species` and `forest` (parameters) → `check` (refusal) → `planting` (what
//! stands where) → `plant` (one plant, and its record for the device) → `solid` (its ellipsoids, with the table of
//! `foliage`) → `cast` (a ray and one plant, and the cells on its way), `grove` (all on its way) and `truth` (the same, proven).
//!
//! A plant reaches no farther than half a cell from its trunk. So a point of the dual cell, which is half a cell off, can be
//! touched by the plants of four cells and no others: a ray that walks dual cells and tests four plants in each misses none.

mod cast;
mod cells;
mod check;
mod felled;
mod foliage;
mod forest;
mod grove;
mod plant;
mod planting;
#[cfg(feature = "baselines")]
mod rivals;
mod solid;
mod species;
mod truth;
mod uniform;

pub use cast::{Cone, DualCells, PLANT_HURRY, PLANT_PATIENCE, PLANT_STEP, PLANT_STEPS, PlantHit, PlantWork};
pub use cells::{Block, MAX_CELLS, cell_corner, cell_of};
pub use check::ForestError;
pub use felled::Felled;
pub use foliage::{Foliage, MIPS, TEXELS};
pub use forest::{Forest, MAX_SPECIES};
pub use grove::{FARTHEST, Grove};
pub use plant::{Plant, PlantId, RECORD_WORDS};
pub use planting::{PlantGround, Planting};
#[cfg(feature = "baselines")]
pub use rivals::{Distance, NineCells, RIVAL_STEPS};
pub use solid::{Ellipsoid, Part, Solid};
pub use species::{PlantShape, Species};
pub use truth::{CERTAIN, nearest_truth};
pub use uniform::{UNIFORM_BYTES, Wind};

/// The WGSL twin.
pub const WGSL: &str = include_str!("trees/solids.wgsl");

#[cfg(test)]
mod tests;
