//! Motion vectors and prepass depth of plants, for views that keep them: temporal effects then find the plants in both.

use bevy::core_pipeline::prepass::{MOTION_VECTOR_PREPASS_FORMAT, ViewPrepassTextures};
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{texture_depth_2d, uniform_buffer};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, BindingResource,
    CachedRenderPipelineId, ColorTargetState, ColorWrites, FragmentState, PipelineCache, RenderPassDescriptor,
    RenderPipelineDescriptor, ShaderStages, TextureView, VertexState,
};
use bevy::render::renderer::{RenderContext, RenderDevice};
use bevy::render::view::ViewDepthTexture;

use super::super::shaders::Source;
use super::super::uniforms::HorizonViewUniform;
use super::target::DrawnTargetItem;

/// The pipeline; none before a view with plants keeps motion vectors.
pub struct TreeMotion {
    layout: BindGroupLayoutDescriptor,
    id: Option<CachedRenderPipelineId>,
}

impl Default for TreeMotion {
    fn default() -> Self {
        let layout = BindGroupLayoutEntries::with_indices(
            ShaderStages::FRAGMENT,
            ((2, texture_depth_2d()), (3, texture_depth_2d()), (5, uniform_buffer::<HorizonViewUniform>(true))),
        );
        Self { layout: BindGroupLayoutDescriptor::new("horizon_trees_motion", &layout), id: None }
    }
}

impl TreeMotion {
    /// Asks for the pipeline.
    pub fn queue(&mut self, cache: &PipelineCache) {
        self.id.get_or_insert_with(|| {
            let shader = Source::TreeMotion.handle();
            let target =
                ColorTargetState { format: MOTION_VECTOR_PREPASS_FORMAT, blend: None, write_mask: ColorWrites::ALL };
            cache.queue_render_pipeline(RenderPipelineDescriptor {
                label: Some("horizon_trees_motion".into()),
                layout: vec![self.layout.clone()],
                vertex: VertexState { shader: shader.clone(), entry_point: Some("fullscreen".into()), ..default() },
                fragment: Some(FragmentState {
                    shader,
                    entry_point: Some("plants_motion".into()),
                    targets: vec![Some(target)],
                    ..default()
                }),
                ..default()
            })
        });
    }

    /// What it binds: depth before and after the plants were drawn, and the views.
    pub fn bind(
        &self,
        before: &TextureView,
        now: &TextureView,
        views: BindingResource,
        cache: &PipelineCache,
        device: &RenderDevice,
    ) -> BindGroup {
        let entries = BindGroupEntries::with_indices(((2, before), (3, now), (5, views)));
        device.create_bind_group("horizon_trees_motion", &cache.get_bind_group_layout(&self.layout), &entries)
    }

    /// Draws the motion of what was drawn since.
    pub fn draw(
        &self,
        drawn: &DrawnTargetItem,
        textures: &ViewPrepassTextures,
        group: &BindGroup,
        offset: u32,
        pipelines: &PipelineCache,
        ctx: &mut RenderContext,
    ) {
        let made = self.id.and_then(|id| pipelines.get_render_pipeline(id));
        let (Some(made), Some(motion)) = (made, &textures.motion_vectors) else { return };
        let diagnostics = ctx.diagnostic_recorder();
        let diagnostics = diagnostics.as_deref();
        let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
            label: Some("horizon_trees_motion"),
            color_attachments: &[Some(motion.get_attachment())],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let span = diagnostics.pass_span(&mut pass, "horizon_trees_motion");
        if let Some(viewport) = drawn.viewport() {
            pass.set_camera_viewport(&viewport);
        }
        pass.set_render_pipeline(made);
        pass.set_bind_group(0, group, &[offset]);
        pass.draw(0..3, 0..1);
        span.end(&mut pass);
    }
}

/// Brings the depth of plants into the prepass's.
pub fn copy_depth(depth: &ViewDepthTexture, textures: &ViewPrepassTextures, ctx: &mut RenderContext) {
    if let Some(copy) = &textures.depth {
        ctx.command_encoder().copy_texture_to_texture(
            depth.texture.as_image_copy(),
            copy.texture.texture.as_image_copy(),
            textures.size,
        );
    }
}
