//! A camera's rays, relative to its cache.

use bevy::camera::MainPassResolutionOverride;
use bevy::math::Vec4Swizzles;
use bevy::prelude::*;
use bevy::render::camera::{ExtractedCamera, TemporalJitter};
use bevy::render::render_resource::DynamicUniformBuffer;
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use horizon_field::Place;

use super::cache::{Caches, pixel_size};
use super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use super::uniforms::{HorizonViewUniform, SkyUniform};

/// What a view draws.
#[derive(Component, Clone)]
pub struct ViewGround {
    /// Its cache; `None` where only the sky is drawn.
    pub cache: Option<usize>,
    /// The camera's place, relative to the terrain.
    pub eye: Place,
    /// The sky over it.
    pub sky: Option<SkyUniform>,
    /// The offsets of its uniforms: the view's, the sky's.
    pub offsets: [u32; 2],
}

/// The views' uniforms; no buffer before a view draws a world.
#[derive(Resource, Default)]
pub struct HorizonViews {
    pub views: DynamicUniformBuffer<HorizonViewUniform>,
    pub skies: DynamicUniformBuffer<SkyUniform>,
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        &'static mut ViewGround,
        &'static ExtractedHorizonCamera,
        &'static ExtractedView,
        &'static ExtractedCamera,
        Option<&'static TemporalJitter>,
        Option<&'static MainPassResolutionOverride>,
    ),
>;

pub fn prepare_views(
    mut uniforms: ResMut<HorizonViews>,
    world: Res<ExtractedWorld>,
    caches: Res<Caches>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut views: Views,
) {
    uniforms.views.clear();
    uniforms.skies.clear();
    for (mut ground, camera, view, extracted, jitter, resolution) in &mut views {
        let size = resolution.map(|size| size.0).or(extracted.physical_viewport_size);
        let size = size.unwrap_or(UVec2::ONE).max(UVec2::ONE);
        let mut clip_from_view = view.clip_from_view;
        if let Some(jitter) = jitter {
            jitter.jitter_projection(&mut clip_from_view, size.as_vec2());
        }
        let y = ground.eye.cell[1] as f64 * horizon_field::CELL + ground.eye.offset[1];
        let eye = ground.cache.map_or(Vec3::new(0.0, y as f32, 0.0), |cache| caches.0[cache].eye(&ground.eye));
        let rotation = Mat3::from_quat(view.world_from_view.rotation());
        let sun = world.risen_sun().map(|(sun, _)| sun);
        ground.offsets[0] = uniforms.views.push(&HorizonViewUniform {
            view_from_clip: clip_from_view.inverse(),
            clip_from_view,
            right: rotation.x_axis,
            up: rotation.y_axis,
            back: rotation.z_axis,
            eye,
            viewport: view.viewport.xy().extend(size.x).extend(size.y).as_vec4(),
            sun_direction: sun.map_or(Vec3::Y, |sun| sun.direction),
            exposure: extracted.exposure,
            sun: sun.map_or(Vec3::ZERO, |sun| sun.illuminance),
            far: camera.camera.far,
            ambient: camera.ambient,
            debug: camera.camera.debug as u32,
            pixel: pixel_size(view, size.y),
            orthographic: u32::from(clip_from_view.w_axis.w == 1.0),
        });
        if let Some(sky) = ground.sky.clone() {
            ground.offsets[1] = uniforms.skies.push(&sky);
        }
    }
    if !uniforms.views.is_empty() {
        uniforms.views.write_buffer(&device, &queue);
    }
    if !uniforms.skies.is_empty() {
        uniforms.skies.write_buffer(&device, &queue);
    }
}
