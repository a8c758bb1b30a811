//! Lakes by a field: where it is above 0.

use bevy::prelude::*;
use horizon_field::field::Param;
use horizon_field::march::Anchored;
use horizon_field::{Field, FieldError, Place};
use serde::{Deserialize, Serialize};

use super::HeightImages;

/// Texels along the side of a mask's table.
pub(crate) const MASK_TEXELS: usize = 256;

/// Water where a field is above 0, within a rectangle along the axes. The field is over x and z from the water's middle, in metres, and is
/// kept as a table of 256 × 256 values, bilinear between them, for the picture and for answers alike: give it a shape that is wider
/// than a texel.
#[derive(Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct WaterMask {
    /// From its middle to the rectangle's sides along x and z, in metres. Default: 100.
    #[reflect(@Param { min: 0.01, max: 1e6, unit: "m", help: "From the middle to the sides" })]
    pub half: [f32; 2],
    /// The field. Default: 1, so that the whole rectangle is water.
    pub field: Field,
    /// The images that the field names. A world file's loader fills it in.
    #[reflect(ignore)]
    #[serde(skip)]
    pub images: HeightImages,
}

impl Default for WaterMask {
    fn default() -> Self {
        Self { half: [100.0; 2], field: Field::Constant(1.0), images: HeightImages::default() }
    }
}

/// A mask's field as a table, from the rectangle's least corner on, x first.
#[derive(Debug)]
pub(crate) struct MaskTable {
    half: [f64; 2],
    pub values: Vec<f32>,
}

impl MaskTable {
    pub fn new(mask: &WaterMask) -> Result<Self, FieldError> {
        let compiled = mask.field.compile::<2>(&mask.images)?;
        let half = mask.half.map(f64::from);
        let last = (MASK_TEXELS - 1) as f64;
        let at = |i: usize, k: usize| (2.0 * i as f64 / last - 1.0) * half[k];
        let places: Vec<_> =
            (0..MASK_TEXELS * MASK_TEXELS).map(|i| [at(i % MASK_TEXELS, 0), at(i / MASK_TEXELS, 1)]).collect();
        let mut values = vec![0.0; places.len()];
        Anchored::new(&compiled, &Place::ORIGIN).values(&places, &mut values);
        Ok(Self { half, values: values.into_iter().map(|value| value as f32).collect() })
    }

    /// Whether there is water at a place, relative to the middle.
    pub fn contains(&self, place: [f64; 2]) -> bool {
        let last = (MASK_TEXELS - 1) as f64;
        let at = [0, 1].map(|k| (place[k] / self.half[k] + 1.0) * 0.5 * last);
        if !at.iter().all(|at| (0.0..=last).contains(at)) {
            return false;
        }
        let cell = at.map(|at| at.floor().min(last - 1.0));
        let [u, v] = [0, 1].map(|k| at[k] - cell[k]);
        let [x, z] = cell.map(|cell| cell as usize);
        let value = |x: usize, z: usize| f64::from(self.values[z * MASK_TEXELS + x]);
        let low = value(x, z) * (1.0 - u) + value(x + 1, z) * u;
        let high = value(x, z + 1) * (1.0 - u) + value(x + 1, z + 1) * u;
        low * (1.0 - v) + high * v > 0.0
    }
}
