//! What the ground looks like: a list of layers, each a surface and the rules that say where it lies. Of every texel it
//! makes albedo, roughness and reflectance, as Bevy's standard material means them.
//!
//! Data flows through the files in this order: [`nodes`] (parameters) → [`check`] (refusal) → `resolve` (which noises and
//! masks there are, each once) → [`compile`] (fields, rows of the uniform, kernel) → [`eval`] (the look of a place, and its
//! twin `material.wgsl`).

pub mod check;
pub mod compile;
pub mod eval;
pub mod nodes;

mod resolve;

#[doc(hidden)]
pub mod arbitrary;
#[cfg(test)]
mod tests;

pub use check::MaterialError;
pub use compile::{CompiledMaterial, MaterialAnchors, ROWS};
pub use eval::{GroundPoint, Look};
pub use nodes::{
    CurvatureRule, HeightRule, MaskRule, MaterialLayer, NoiseLayer, NoiseRule, SlopeRule, StrataRule, Surface,
    TerrainMaterial,
};

/// How many layers a material may have over its base.
pub const MAX_LAYERS: usize = 16;
/// How many different noises and masks a material may use.
pub const MAX_FIELDS: usize = 16;
