//! The ground, before Bevy's opaque meshes.

use bevy::camera::{MainPassResolutionOverride, Viewport};
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{PipelineCache, RenderPassDescriptor, StoreOp};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::{ViewDepthTexture, ViewTarget, ViewUniformOffset};

use super::super::view::ViewGround;
use super::ViewPasses;

/// One ray a pixel; colour and depth.
pub fn draw_ground(
    view: ViewQuery<(
        &ExtractedCamera,
        &ViewTarget,
        &ViewDepthTexture,
        &ViewPasses,
        &ViewGround,
        &ViewUniformOffset,
        Option<&MainPassResolutionOverride>,
    )>,
    pipeline_cache: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let (camera, target, depth, passes, ground, view_offset, resolution) = view.into_inner();
    let (Some(id), Some(group)) = (passes.pipelines[0], &passes.groups[0]) else { return };
    let Some(pipeline) = pipeline_cache.get_render_pipeline(id) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_ground"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: Some(depth.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_ground");
    if let Some(viewport) = Viewport::from_viewport_and_override(camera.viewport.as_ref(), resolution) {
        pass.set_camera_viewport(&viewport);
    }
    pass.set_render_pipeline(pipeline);
    if passes.ldr {
        pass.set_bind_group(0, group, &[ground.offsets[0], view_offset.offset]);
    } else {
        pass.set_bind_group(0, group, &[ground.offsets[0]]);
    }
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
