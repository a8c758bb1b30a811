//! The air.

use bevy::prelude::*;
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

/// The air, in the simplest model: a gradient sky and exponential haze over ground and meshes alike.
///
/// Without it there is neither sky nor haze, and what the camera cleared to, or Bevy's own skybox, shows.
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
#[serde(default, deny_unknown_fields)]
pub struct Atmosphere {
    /// Luminance of the zenith, in cd/m², linear RGB. Default: a clear blue.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the zenith" })]
    pub zenith: [f32; 3],
    /// Luminance of the horizon and of the haze, in cd/m², linear RGB. Default: a pale blue.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the horizon and of the haze" })]
    pub horizon: [f32; 3],
    /// Luminance that haze and sky add around the sun, in cd/m², linear RGB. Default: warm.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance added around the sun" })]
    pub glow: [f32; 3],
    /// Extinction of the haze at height 0, per metre: contrast falls to 1/e over its inverse. Default: 1/28 000.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "1/m", help: "Extinction of the haze at height 0" })]
    pub haze: f32,
    /// Height over which the haze thins to 1/e, in metres. Default: 1600.
    #[reflect(@Param { min: 1.0, max: 1e6, unit: "m", help: "Height over which the haze thins to 1/e" })]
    pub haze_height: f32,
    /// The sun's angular radius, in radians, for its disc and for penumbras. Default: 0.004675, Earth's.
    #[reflect(@Param { min: 1e-4, max: 0.5, unit: "rad", help: "The sun's angular radius" })]
    pub sun_radius: f32,
}

impl Atmosphere {
    /// The sun's angular radius as seen from Earth, in radians (Bruneton 2017).
    pub const EARTH_SUN_RADIUS: f32 = 0.004_675;
}

impl Default for Atmosphere {
    fn default() -> Self {
        Self {
            zenith: [1100.0, 2300.0, 5200.0],
            horizon: [5200.0, 6600.0, 8200.0],
            glow: [5200.0, 4000.0, 2200.0],
            haze: 1.0 / 28_000.0,
            haze_height: 1600.0,
            sun_radius: Self::EARTH_SUN_RADIUS,
        }
    }
}
