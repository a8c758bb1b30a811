//! From a model to its tiles.

use super::fbm::fbm;
use super::sines::{gerstner, sines};
use super::spectrum::spectrum;
use super::{Cascade, Waves, WavesError};

/// Waves, checked and taken apart into tiles.
#[derive(Clone, Debug, PartialEq)]
pub struct Sea {
    /// The tiles, which add up, from the largest on: [`CASCADES`](super::CASCADES) of them, or none where nothing moves.
    pub cascades: Vec<Cascade>,
    /// The slope's variance, along x and z together, of waves that are too short for the tiles: a roughness. Only a spectrum
    /// knows of any.
    pub rest: f64,
}

impl Sea {
    /// The sea of a model.
    ///
    /// # Errors
    /// The first parameter that is not a finite number within its range, by its path.
    pub fn new(waves: &Waves) -> Result<Self, WavesError> {
        waves.check("waves")?;
        let (mut cascades, rest) = match waves {
            Waves::Still => (Vec::new(), 0.0),
            Waves::Sines(model) => (sines(model), 0.0),
            Waves::Gerstner(model) => (gerstner(model), 0.0),
            Waves::Fbm(model) => (fbm(model), 0.0),
            Waves::Spectrum(model) => spectrum(model),
        };
        if cascades.iter().all(|cascade| cascade.bound == 0.0) {
            cascades.clear();
        }
        Ok(Self { cascades, rest })
    }

    /// Whether nothing moves.
    pub fn is_still(&self) -> bool {
        self.cascades.is_empty()
    }

    /// No height is further from 0, in metres.
    pub fn bound(&self) -> f32 {
        self.cascades.iter().map(|cascade| cascade.bound).sum()
    }
}
