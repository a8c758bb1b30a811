//! How a camera draws the world.

use bevy::prelude::*;
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

/// Put it on a `Camera3d`, and the world appears in it. Nothing else of the camera is altered.
#[derive(Component, Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct HorizonCamera {
    /// How far, in pixels, the picture may be off: it chooses the cache's resolution. 0.1 to 16. Default: 0.5.
    #[reflect(@Param { min: 0.1, max: 16.0, unit: "px", help: "How far the picture may be off" })]
    pub error_budget: f32,
    /// How far the world is drawn, in metres. Default: 60 000.
    #[reflect(@Param { min: 1.0, max: 1e6, unit: "m", help: "How far the world is drawn" })]
    pub far: f32,
    /// What is shown in place of the picture. Default: the picture.
    pub debug: DebugView,
}

impl Default for HorizonCamera {
    fn default() -> Self {
        Self { error_budget: 0.5, far: 60_000.0, debug: default() }
    }
}

/// What a camera shows in place of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
pub enum DebugView {
    /// The picture itself.
    #[default]
    None,
    /// The ground's normal.
    Normal,
    /// Turns of the march's loop: red is 96 and more.
    Steps,
    /// The level of the clipmap, finest in blue.
    Level,
    /// How much of the sun's disc the ground sees.
    Light,
    /// The ground's albedo.
    Albedo,
    /// Distance, logarithmic.
    Distance,
}
