//! The air.

use bevy::prelude::*;
use horizon_field::field::Param;
use horizon_light::medium::Medium;
use horizon_light::models::gradient::GradientSky;
use horizon_light::night::MOONLESS_NIGHT;
use serde::{Deserialize, Serialize};

use super::{ParamError, check_params};

/// The air: sky, sun disc and aerial perspective over ground and meshes alike, in every camera that draws worlds. The ground lies
/// at the height of the entity's transform.
///
/// Without it there is neither sky nor haze, and what the camera cleared to, Bevy's own skybox, or Bevy's own `Atmosphere`,
/// shows. Put a [`Sunlight`](super::Sunlight) on the scene's `DirectionalLight`, and the air dims and colours that too.
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
#[serde(default, deny_unknown_fields)]
pub struct Atmosphere {
    /// How its light is computed. Default: all orders of scattering.
    pub model: SkyModel,
    /// What it is made of; [`SkyModel::Gradient`] takes the sun's size from it alone. Default: Earth's.
    pub medium: Medium,
    /// The colours of [`SkyModel::Gradient`].
    pub gradient: SkyGradient,
    /// Luminance of a moonless night, in cd/m²: airglow and stars. Default: 0.0002.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of a moonless night" })]
    pub night: f32,
}

/// How the light of the air is computed, from the cheapest to the most exact. The README says how far each is off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
pub enum SkyModel {
    /// A gradient by view and sun, and exponential haze: no table, no integral.
    Gradient,
    /// Sunlight that is scattered once.
    Single,
    /// Once exactly, and then as if evenly to all sides (Hillaire 2020).
    Fast,
    /// All orders, each with the directions that molecules scatter it to.
    #[default]
    Full,
}

/// The colours of the simplest sky.
#[derive(Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct SkyGradient {
    /// Luminance of the zenith under a high sun, in cd/m², linear RGB. Default: a clear blue.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the zenith under a high sun" })]
    pub zenith: [f32; 3],
    /// Luminance of the horizon under a high sun, and of the haze, in cd/m², linear RGB. Default: a pale blue.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the horizon and of the haze" })]
    pub horizon: [f32; 3],
    /// Luminance of the horizon towards a setting sun, in cd/m², before it is dimmed with the whole sky. Default: warm.
    #[reflect(@Param { min: 0.0, max: 1e6, unit: "cd/m²", help: "Luminance of the horizon towards a setting sun" })]
    pub sunset: [f32; 3],
    /// Extinction of the haze at height 0, per metre: contrast falls to 1/e over its inverse. Default: 1/28 000.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "1/m", help: "Extinction of the haze at height 0" })]
    pub haze: f32,
    /// Height over which the haze thins to 1/e, in metres. Default: 1600.
    #[reflect(@Param { min: 1.0, max: 1e6, unit: "m", help: "Height over which the haze thins to 1/e" })]
    pub haze_height: f32,
}

impl SkyGradient {
    /// Earth's.
    pub const EARTH: Self = {
        const fn single([r, g, b]: [f64; 3]) -> [f32; 3] {
            [r as f32, g as f32, b as f32]
        }
        let sky = GradientSky::EARTH;
        Self {
            zenith: single(sky.zenith),
            horizon: single(sky.horizon),
            sunset: single(sky.sunset),
            haze: 1.0 / 28_000.0,
            haze_height: 1600.0,
        }
    };
}

impl Default for SkyGradient {
    fn default() -> Self {
        Self::EARTH
    }
}

impl Atmosphere {
    /// Earth's air, at wavelengths that give its colours.
    pub const EARTH: Self = Self::of(Medium::EARTH);
    /// Earth's air as published, at 680, 550 and 440 nm (Bruneton 2017): to compare with; its twilight is purple.
    pub const BRUNETON: Self = Self::of(Medium::BRUNETON);
    /// Hazy air without ozone.
    pub const LEEDS: Self = Self::of(Medium::LEEDS);
    /// Mars', with its dust.
    pub const MARS: Self = Self::of(Medium::MARS);
    /// A thick and strange one.
    pub const ALIEN: Self = Self::of(Medium::ALIEN);

    /// Air of a medium, computed by all orders of scattering.
    pub const fn of(medium: Medium) -> Self {
        Self { model: SkyModel::Full, medium, gradient: SkyGradient::EARTH, night: MOONLESS_NIGHT as f32 }
    }

    /// The sun's angular radius as seen from Earth, in radians (Bruneton 2017).
    pub const EARTH_SUN_RADIUS: f32 = Medium::EARTH.sun_radius as f32;
}

/// [`check_params`] for the air, whose wavelengths must also fall: their ranges alone do not say so.
pub(crate) fn check_atmosphere(atmosphere: &Atmosphere) -> Result<(), ParamError> {
    check_params("atmosphere", atmosphere)?;
    let ([min, max], value) = (atmosphere.medium.green_range(), atmosphere.medium.wavelengths[1]);
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(ParamError { field: "atmosphere.medium.wavelengths[1]".into(), value, min, max, unit: "nm" })
}

impl Default for Atmosphere {
    fn default() -> Self {
        Self::EARTH
    }
}
