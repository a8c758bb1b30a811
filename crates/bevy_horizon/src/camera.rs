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
    /// How large the ground is drawn, as a part of the view's width and height; then it is brought to full size with edges
    /// kept. 0.25 to 1. Default: 1.
    #[reflect(@Param { min: 0.25, max: 1.0, unit: "", help: "How large the ground is drawn before it is scaled up" })]
    pub render_scale: f32,
    /// What is shown in place of the picture. Default: the picture.
    pub debug: DebugView,
}

impl HorizonCamera {
    /// For slow devices: half the resolution, two pixels of error.
    pub const LOW: Self = Self { error_budget: 2.0, render_scale: 0.5, ..Self::HIGH };
    /// Between low and high: three quarters of the resolution, one pixel of error.
    pub const MEDIUM: Self = Self { error_budget: 1.0, render_scale: 0.75, ..Self::HIGH };
    /// The default: every pixel, half a pixel of error.
    pub const HIGH: Self = Self { error_budget: 0.5, far: 60_000.0, render_scale: 1.0, debug: DebugView::None };
    /// For pictures: a quarter of a pixel of error. It is worth more device memory than the default, see
    /// [`CacheSettings`](crate::render::cache::CacheSettings).
    pub const ULTRA: Self = Self { error_budget: 0.25, ..Self::HIGH };
}

impl Default for HorizonCamera {
    fn default() -> Self {
        Self::HIGH
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
    /// Turns of the march's loop: red is 64 and more.
    Steps,
    /// The level of the clipmap, finest in blue.
    Level,
    /// How much of the sun's disc the ground sees.
    Light,
    /// The ground's albedo.
    Albedo,
    /// Distance, logarithmic.
    Distance,
    /// Heights and bounds that a ray loads: red is 96 and more.
    Loads,
    /// How far the drawn depth is from the truth, in pixels: red is 1 and more. The truth is computed on the CPU while the
    /// camera stands still; what is not yet known is grey, and pixels that miss, or invent, ground are magenta.
    Error,
    /// For programs: turns in red, loads in green, as numbers.
    Work,
    /// The ground's perceptual roughness.
    Roughness,
    /// How far the ground moved since the last frame: grey stands still, red moves to the right, green down, full at 32 pixels.
    Motion,
}
