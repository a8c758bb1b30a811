//! Plants: trees, bushes and rocks, one at most in each cell of a lattice, as ellipsoids that foliage eats into.
//!
//! Data flows through the files in this order: `species` and `forest` (parameters) → `planting` (what
//! stands where) → `plant` (one plant, and its record for the device) → `solid` (its ellipsoids, with the table of
//! `foliage`) → `cast` (a ray among them) and `truth` (the same, proven). `solids.wgsl` is the twin of `solid` and `cast`.
//!
//! A plant reaches no farther than half a cell from its trunk. So a point of the dual cell, which is half a cell off, can be
//! touched by the plants of four cells and no others: a ray that walks dual cells and tests four plants in each misses none.

mod foliage;
mod forest;
mod plant;
mod species;
mod uniform;

pub use foliage::{Foliage, MIPS, TEXELS};
pub use forest::{Forest, MAX_SPECIES};
pub use plant::{Plant, PlantId, RECORD_WORDS};
pub use species::{PlantShape, Species};
pub use uniform::{UNIFORM_BYTES, Wind};

/// The WGSL twin.
pub const WGSL: &str = include_str!("trees/solids.wgsl");

#[cfg(test)]
mod tests;
