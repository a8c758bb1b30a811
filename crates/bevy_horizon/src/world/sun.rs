//! The sun of a world file.

use bevy::prelude::*;
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

/// Where a world file's sun stands, and how bright it is. The scene makes it a `DirectionalLight`. Under an atmosphere whose model is
/// not a gradient, the air says how bright it is: `illuminance`, `colour` and `ambient` are not read then.
#[derive(Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct Sun {
    /// Angle from −z (north) towards +x (east), in radians. Default: 2.2.
    #[reflect(@Param { min: -10.0, max: 10.0, unit: "rad", help: "Angle from −z (north) towards +x (east)" })]
    pub azimuth: f32,
    /// Angle above the level, in radians. Default: 0.6.
    #[reflect(@Param { min: -1.6, max: 1.6, unit: "rad", help: "Angle above the level" })]
    pub elevation: f32,
    /// Illuminance of a surface that faces it, in lux. Default: 100 000, full sun.
    #[reflect(@Param { min: 0.0, max: 1e7, unit: "lx", help: "Illuminance of a surface that faces the sun" })]
    pub illuminance: f32,
    /// Its colour, linear RGB. Default: a warm white.
    #[reflect(@Param { min: 0.0, max: 10.0, unit: "", help: "The sun's colour" })]
    pub colour: [f32; 3],
    /// Luminance of the sky's ambient light, in cd/m². Default: 5000.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the ambient light" })]
    pub ambient: f32,
}

impl Default for Sun {
    fn default() -> Self {
        Self { azimuth: 2.2, elevation: 0.6, illuminance: 100_000.0, colour: [1.0, 0.94, 0.84], ambient: 5000.0 }
    }
}

impl Sun {
    /// The unit vector towards the sun.
    pub fn direction(&self) -> Vec3 {
        let (sin_azimuth, cos_azimuth) = self.azimuth.sin_cos();
        let (sin_elevation, cos_elevation) = self.elevation.sin_cos();
        Vec3::new(cos_elevation * sin_azimuth, sin_elevation, -cos_elevation * cos_azimuth)
    }

    /// A transform whose forward direction is the sunlight's.
    pub fn transform(&self) -> Transform {
        Transform::default().looking_to(-self.direction(), Vec3::Y)
    }
}
