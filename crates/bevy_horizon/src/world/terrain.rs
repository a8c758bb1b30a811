//! The ground.

use std::sync::Arc;

use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use horizon_field::Field;
use horizon_field::field::{Fractal, HeightImage, ImageSource};
use serde::{Deserialize, Serialize};

use super::TerrainMaterial;

/// Endless ground: a height field over the plane, and its look.
///
/// The entity's `GlobalTransform` moves it (its translation; rotation and scale are not honoured), `Visibility` hides
/// it, `RenderLayers` choose the cameras that see it. One terrain is drawn for each camera: the first that it sees.
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
#[serde(default, deny_unknown_fields)]
pub struct Terrain {
    /// The height, in metres, as a function of x and z. Default: an fBm of 12 octaves, 600 m high.
    pub field: Field,
    /// The look.
    pub material: TerrainMaterial,
    /// The height images that the field names. A world file's loader fills it in.
    #[reflect(ignore)]
    #[serde(skip)]
    pub images: HeightImages,
}

impl Default for Terrain {
    fn default() -> Self {
        Self { field: Field::Fractal(Fractal::default()), material: default(), images: default() }
    }
}

impl Terrain {
    /// Ground of this field, with the default look.
    pub fn new(field: Field) -> Self {
        Self { field, ..default() }
    }
}

/// Height images by their paths.
#[derive(Clone, Debug, Default)]
pub struct HeightImages(Arc<HashMap<String, Arc<HeightImage>>>);

impl PartialEq for HeightImages {
    fn eq(&self, other: &Self) -> bool {
        let same = |(path, image): (&String, &Arc<HeightImage>)| {
            other.0.get(path).is_some_and(|other| Arc::ptr_eq(image, other))
        };
        self.0.len() == other.0.len() && self.0.iter().all(same)
    }
}

impl FromIterator<(String, HeightImage)> for HeightImages {
    fn from_iter<I: IntoIterator<Item = (String, HeightImage)>>(images: I) -> Self {
        Self(Arc::new(images.into_iter().map(|(path, image)| (path, Arc::new(image))).collect()))
    }
}

impl ImageSource for HeightImages {
    fn load(&self, path: &str) -> Result<HeightImage, String> {
        self.0.get(path).map(|image| HeightImage::clone(image)).ok_or_else(|| "it was not given to the terrain".into())
    }
}
