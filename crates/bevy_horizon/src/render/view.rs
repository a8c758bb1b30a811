//! A camera's rays, relative to its cache.

use bevy::camera::MainPassResolutionOverride;
use bevy::math::Vec4Swizzles;
use bevy::prelude::*;
use bevy::render::camera::{ExtractedCamera, TemporalJitter};
use bevy::render::render_resource::{DynamicUniformBuffer, PipelineCache};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use horizon_field::Place;

use super::cache::{Caches, pixel_size};
use super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use super::passes::{ClearancePipeline, Table};
use super::uniforms::{AirUniform, GradientUniform, HorizonViewUniform};
use crate::camera::DebugView;
use crate::world::SkyModel;

/// What a view draws.
#[derive(Component, Clone)]
pub struct ViewGround {
    /// Its cache; `None` where only the sky is drawn.
    pub cache: Option<usize>,
    /// The camera's place, relative to the terrain.
    pub eye: Place,
    /// The atmosphere over it, by its index among those of this frame.
    pub air: Option<usize>,
    /// How that is drawn.
    pub sky: Option<ViewSky>,
    /// Radians per pixel, or metres per pixel where orthographic.
    pub pixel: f32,
    /// What its clearance table holds, if it has one: perspective views of a terrain do.
    pub table: Option<Table>,
    /// The size at which the ground is drawn, if it is not the view's own.
    pub scaled: Option<UVec2>,
    /// The offsets of its uniforms: the view's, the air's, and the view's at the lower resolution.
    pub offsets: [u32; 3],
}

/// How a view stood in the last frame: for motion vectors.
#[derive(Component, Clone, Copy)]
pub struct ViewBefore {
    eye: Place,
    clip_from_offset: Mat4,
}

/// How a view's air is drawn.
#[derive(Clone, Debug)]
pub enum ViewSky {
    /// As a gradient.
    Gradient(GradientUniform),
    /// From tables, by their index.
    Air { model: SkyModel, table: usize },
}

impl ViewSky {
    /// The model.
    pub fn model(&self) -> SkyModel {
        match self {
            Self::Gradient(_) => SkyModel::Gradient,
            Self::Air { model, .. } => *model,
        }
    }
}

/// The views' uniforms; no buffer before a view draws a world.
#[derive(Resource, Default)]
pub struct HorizonViews {
    pub views: DynamicUniformBuffer<HorizonViewUniform>,
    pub gradients: DynamicUniformBuffer<GradientUniform>,
    pub airs: DynamicUniformBuffer<AirUniform>,
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
        Option<&'static mut ViewBefore>,
        Entity,
    ),
>;

pub fn prepare_views(
    mut commands: Commands,
    mut uniforms: ResMut<HorizonViews>,
    world: Res<ExtractedWorld>,
    caches: Res<Caches>,
    clearances: Res<ClearancePipeline>,
    pipelines: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut views: Views,
) {
    uniforms.views.clear();
    uniforms.gradients.clear();
    for (mut ground, camera, view, extracted, jitter, resolution, before, entity) in &mut views {
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
        let view_from_clip = clip_from_view.inverse();
        let orthographic = clip_from_view.w_axis.w == 1.0;
        let pixel = pixel_size(view, size.y);
        ground.pixel = pixel;
        let cache = ground.cache.filter(|_| !orthographic && clearances.ready(&pipelines));
        ground.table = cache.map(|cache| {
            let ray = |ndc: Vec2| rotation * view_from_clip.project_point3(ndc.extend(1.0));
            Table::new(ray, pixel, caches.0[cache].reach(camera.camera.far))
        });
        let table = ground.table.unwrap_or_default();
        let now = ViewBefore {
            eye: ground.eye,
            clip_from_offset: view.clip_from_view * Mat4::from_mat3(rotation.transpose()),
        };
        let last = before.as_deref().copied().unwrap_or(now);
        let moved = Vec3::from(now.eye.minus(&last.eye).map(|d| d as f32));
        match before {
            Some(mut before) => *before = now,
            None => {
                commands.entity(entity).insert(now);
            }
        }
        let uniform = HorizonViewUniform {
            view_from_clip,
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
            pixel,
            orthographic: u32::from(orthographic),
            slopes: table.slopes,
            columns: table.columns,
            rings: table.rings,
            holes: u32::from(ground.cache.is_some_and(|cache| caches.0[cache].holes())),
            sun_towards: world.sun.map_or(Vec3::Y, |sun| sun.direction),
            self_shadow: world.self_shadow(),
            clip_from_offset: now.clip_from_offset,
            previous_clip_from_offset: last.clip_from_offset * Mat4::from_translation(moved),
        };
        ground.offsets[0] = uniforms.views.push(&uniform);
        // `clamp` keeps NaN, which the comparison then takes for the whole size.
        let shown = camera.camera.debug == DebugView::None;
        let scale = if shown { camera.camera.render_scale.clamp(0.25, 1.0) } else { 1.0 };
        ground.scaled = (scale < 1.0).then(|| (size.as_vec2() * scale).ceil().as_uvec2());
        if let Some(size) = ground.scaled {
            let viewport = Vec4::new(0.0, 0.0, size.x as f32, size.y as f32);
            ground.offsets[2] = uniforms.views.push(&HorizonViewUniform { viewport, ..uniform });
        }
        if let Some(ViewSky::Gradient(gradient)) = ground.sky.clone() {
            ground.offsets[1] = uniforms.gradients.push(&gradient);
        }
    }
    if !uniforms.views.is_empty() {
        uniforms.views.write_buffer(&device, &queue);
    }
    if !uniforms.gradients.is_empty() {
        uniforms.gradients.write_buffer(&device, &queue);
    }
}
