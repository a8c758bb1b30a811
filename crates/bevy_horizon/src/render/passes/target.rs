//! Where in its target a view draws.

use bevy::camera::{MainPassResolutionOverride, Viewport};
use bevy::ecs::query::QueryData;
use bevy::render::camera::ExtractedCamera;

/// What of a view says where it draws.
#[derive(QueryData)]
pub struct DrawnTarget {
    camera: &'static ExtractedCamera,
    resolution: Option<&'static MainPassResolutionOverride>,
}

impl DrawnTargetItem<'_, '_> {
    /// The part of the target, if it is not the whole.
    pub fn viewport(&self) -> Option<Viewport> {
        Viewport::from_viewport_and_override(self.camera.viewport.as_ref(), self.resolution)
    }
}
