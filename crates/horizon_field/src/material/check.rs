//! Refusal: what a material must not be, found before anything is computed from it, and named by its path.

use super::nodes::{NoiseLayer, Surface, TerrainMaterial};
use super::resolve::Resolved;
use super::{MAX_FIELDS, MAX_LAYERS};
use crate::field::FieldError;
use crate::field::check::check_numbers;
use crate::field::param::Params;

/// Why a material is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each message says what its fields are")]
pub enum MaterialError {
    /// A parameter is out of its range, or a range does not rise. The path is the parameter's, such as
    /// `material.layers[2].height.soft`.
    #[error(transparent)]
    Value(#[from] FieldError),
    /// A mask's field makes no sense.
    #[error("{path}: {source}")]
    Mask { path: String, source: FieldError },
    /// There are too many layers.
    #[error("material.layers has {count} layers, more than {MAX_LAYERS}")]
    TooManyLayers { count: usize },
    /// The layers use too many noises and masks.
    #[error("material.layers uses {count} different noises and masks, more than {MAX_FIELDS}")]
    TooManyFields { count: usize },
}

fn numbers(node: &dyn Params, path: &str) -> Result<(), MaterialError> {
    check_numbers(node, &|| path.to_owned()).map_err(MaterialError::Value)
}

fn surface(surface: &Surface, path: &str) -> Result<(), MaterialError> {
    numbers(surface, path)?;
    noise(surface.tint.as_ref(), &format!("{path}.tint"))
}

fn noise(layer: Option<&NoiseLayer>, path: &str) -> Result<(), MaterialError> {
    layer.map_or(Ok(()), |layer| numbers(layer, path))
}

/// A rule's numbers, and that its range rises.
fn band(rule: &dyn Params, low: f64, high: f64, path: &str) -> Result<(), MaterialError> {
    numbers(rule, path)?;
    if low < high { Ok(()) } else { Err(FieldError::Empty { path: path.to_owned(), low, high }.into()) }
}

impl TerrainMaterial {
    /// Refuses a material that can't be computed. Images are not looked at: [`TerrainMaterial::compile`] loads them.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), MaterialError> {
        let count = self.layers.len();
        if count > MAX_LAYERS {
            return Err(MaterialError::TooManyLayers { count });
        }
        numbers(self, "material")?;
        surface(&self.base, "material.base")?;
        noise(Some(&self.edge), "material.edge")?;
        noise(Some(&self.tint), "material.tint")?;
        for (at, layer) in self.layers.iter().enumerate() {
            let path = |part: &str| format!("material.layers[{at}].{part}");
            surface(&layer.surface, &path("surface"))?;
            if let Some(rule) = &layer.height {
                band(rule, rule.low, rule.high, &path("height"))?;
                noise(rule.noise.as_ref(), &path("height.noise"))?;
            }
            if let Some(rule) = &layer.slope {
                band(rule, rule.low, rule.high, &path("slope"))?;
            }
            if let Some(rule) = &layer.curvature {
                band(rule, rule.low, rule.high, &path("curvature"))?;
            }
            if let Some(rule) = &layer.noise {
                band(rule, rule.low, rule.high, &path("noise"))?;
                noise(Some(&rule.noise), &path("noise.noise"))?;
            }
            if let Some(rule) = &layer.mask {
                band(rule, rule.low, rule.high, &path("mask"))?;
                rule.field.check().map_err(|source| MaterialError::Mask { path: path("mask"), source })?;
            }
            if let Some(rule) = &layer.strata {
                numbers(rule, &path("strata"))?;
            }
        }
        let count = Resolved::new(self).fields.len();
        if count > MAX_FIELDS { Err(MaterialError::TooManyFields { count }) } else { Ok(()) }
    }
}
