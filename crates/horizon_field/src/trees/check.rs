//! Refusal: what a forest must not be, found before anything is computed from it.

use super::forest::{Forest, MAX_SPECIES};
use crate::FieldError;
use crate::field::check::check_numbers;

/// The share of half a cell that a plant may reach: what is left takes the rounding of records to single precision.
const REACH: f64 = 0.9999;

/// Why a forest is refused, or a question about it. `path` names the parameter, such as `forest.species[1].radius`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each message says what its fields are")]
pub enum ForestError {
    /// A parameter is not finite, outside its range, or in the wrong order with another.
    #[error(transparent)]
    Param(#[from] FieldError),
    /// A field of the forest is refused.
    #[error("{path}: {error}")]
    Field { path: String, error: FieldError },
    /// Too few or too many species.
    #[error("{path} holds {count} species, outside 1 to {MAX_SPECIES}")]
    Species { path: String, count: usize },
    /// A species' largest plant would reach out of what a ray looks at.
    #[error(
        "{path}: the largest plant reaches {reach} m from its trunk, with its lean and the forest's sway: more than half of the spacing, {half} m"
    )]
    Reach { path: String, reach: f64, half: f64 },
    /// An area holds too many cells.
    #[error("the area holds {cells:e} cells, more than {max}")]
    Area { cells: f64, max: u64 },
}

impl Forest {
    /// Refuses what can't be computed; `path` is what messages call the forest. Fields are checked by
    /// [`Forest::compile`], which loads their images.
    ///
    /// # Errors
    /// The first parameter that is wrong.
    pub fn check(&self, path: &str) -> Result<(), ForestError> {
        check_numbers(self, &|| path.into())?;
        let count = self.species.len();
        if !(1..=MAX_SPECIES).contains(&count) {
            return Err(ForestError::Species { path: format!("{path}.species"), count });
        }
        let half = 0.5 * self.spacing;
        for (i, species) in self.species.iter().enumerate() {
            let path = || format!("{path}.species[{i}]");
            check_numbers(species, &path)?;
            let [low, high] = species.height;
            if low > high {
                return Err(FieldError::Empty { path: format!("{}.height", path()), low, high }.into());
            }
            let reach = species.reach() + self.sway;
            if reach > REACH * half {
                return Err(ForestError::Reach { path: format!("{}.radius", path()), reach, half });
            }
        }
        Ok(())
    }
}
