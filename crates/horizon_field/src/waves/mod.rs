//! Waves on water. Whatever the model, they become the same data: up to [`CASCADES`] periodic square tiles, each a sum of
//! travelling waves, and these add up.
//!
//! A tile of side L holds the waves a, n, b, φ, where n is a pair of whole numbers and b, the beats, is one: wave vectors
//! lie on the tile's lattice, k = 2π n / L, and frequencies are multiples of 2π / [`PERIOD`]. Space and time are periodic, and
//! days of game time cost no precision. With choppiness c, water that rests at x₀ is at the time t
//!
//! h(x₀, t) = Σ a cos(2π (n·x₀ / L − b t / P) + φ) high, and displaced by D(x₀, t) = −c Σ (n/|n|) a sin(the same).
//!
//! What is drawn, and answered, is the height over a place of the plane: for each of [`GRID`]² texels the point x₀ is sought
//! with x₀ + D(x₀) = x, and between texels it is bilinear. CPU and device do the same.
//!
//! Data flows through the files in this order: `models` (parameters) → `sines`, `fbm`, `spectrum` (waves of a model) → `sea`
//! (checked) → `transform` (a tile at a time, by a fast Fourier transform) → `resolve` (over the plane) → `tiles` (heights and
//! slopes) → `moments` (through a filter), `surface` (answers). `exact` is the truth that tiles are held against.
//!
//! All is computed from hashes, exact operations and `libm`, in an order that does not depend on the machine: values are equal bit
//! for bit on every platform, for servers and saved games.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

mod cascade;
mod exact;
mod fbm;
mod lattice;
mod models;
mod moments;
mod resolve;
mod sea;
mod sines;
mod spectrum;
mod surface;
mod tiles;
mod transform;

#[cfg(test)]
mod tests;

pub use cascade::{Cascade, Wave};
pub use exact::Exact;
pub use models::{FbmWaves, Gerstner, Sines, Spectrum};
pub use moments::{Chain, Chains, Moments};
pub use sea::Sea;
pub use surface::SeaSurface;
pub use tiles::{STEEPEST, Tile, Tiles, tick};
pub use transform::roots;

use crate::FieldError;
use crate::field::check::check_numbers;
use crate::field::param::Params;

/// Texels along the side of a tile.
pub const GRID: usize = 128;
/// One period of the animation, in seconds.
pub const PERIOD: f64 = 256.0;
/// How many tiles, of falling size, add up.
pub const CASCADES: usize = 3;
/// The largest |n| of a tile's waves: six texels to the shortest.
pub const REACH: usize = 20;

/// How water moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
#[serde(deny_unknown_fields)]
pub enum Waves {
    /// Not at all.
    Still,
    /// A few sines.
    Sines(Sines),
    /// A few trochoidal waves.
    Gerstner(Gerstner),
    /// Drifting octaves of noise.
    Fbm(FbmWaves),
    /// A wind sea.
    Spectrum(Spectrum),
}

impl Default for Waves {
    fn default() -> Self {
        Self::breeze()
    }
}

impl Waves {
    /// A lake of 1 km in a light breeze: waves of a hand's breadth.
    pub fn lake() -> Self {
        Self::Spectrum(Spectrum { wind: 4.0, fetch: 1e3, ..Spectrum::default() })
    }

    /// The sea in a pleasant breeze, 20 km off the shore: half a metre of waves.
    pub fn breeze() -> Self {
        Self::Spectrum(Spectrum::default())
    }

    /// The open sea in a gale: waves as high as houses.
    pub fn gale() -> Self {
        Self::Spectrum(Spectrum { wind: 20.0, fetch: 3e5, ..Spectrum::default() })
    }

    /// The model's name, as files spell it.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Still => "Still",
            Self::Sines(_) => "Sines",
            Self::Gerstner(_) => "Gerstner",
            Self::Fbm(_) => "Fbm",
            Self::Spectrum(_) => "Spectrum",
        }
    }

    /// Refuses what can't be computed; `path` is what messages call the waves.
    ///
    /// # Errors
    /// The first parameter that is not a finite number within its range, by its path.
    pub fn check(&self, path: &str) -> Result<(), WavesError> {
        let node: &dyn Params = match self {
            Self::Still => return Ok(()),
            Self::Sines(node) => node,
            Self::Gerstner(node) => node,
            Self::Fbm(node) => node,
            Self::Spectrum(node) => node,
        };
        Ok(check_numbers(node, &|| format!("{path}.{}", self.name()))?)
    }
}

/// Why waves are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WavesError {
    /// A parameter is not finite, or outside its range.
    #[error(transparent)]
    Param(#[from] FieldError),
}

/// What Rust and shaders both count by, as the shaders have it.
pub fn constants() -> String {
    use resolve::{FARTHEST, LEAST, STEPS};
    let (rows, stages) = (2 * REACH + 1, GRID.ilog2());
    format!(
        "const GRID: u32 = {GRID}u;\nconst REACH: i32 = {REACH};\nconst ROWS: u32 = {rows}u;\n\
         const STAGES: u32 = {stages}u;\nconst LINEAR_STEPS: u32 = {STEPS}u;\nconst LEAST_DETERMINANT: f32 = {LEAST:?};\n\
         const FARTHEST_STEP: f32 = {FARTHEST:?};\nconst STEEPEST: f32 = {STEEPEST:?};\n"
    )
}

/// The unit vector of a heading, as x and z.
pub(crate) fn towards(heading: f64) -> [f64; 2] {
    [libm::sin(heading), -libm::cos(heading)]
}
