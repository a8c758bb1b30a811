//! The air, after Bevy's opaque meshes: sky where nothing was drawn, haze over what was.

use bevy::camera::{MainPassResolutionOverride, Viewport};
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{PipelineCache, RenderPassDescriptor};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::{ViewTarget, ViewUniformOffset};

use super::super::view::ViewGround;
use super::ViewPasses;

/// One fragment a sample, so that the edges of meshes keep their antialiasing.
pub fn draw_sky(
    view: ViewQuery<(
        &ExtractedCamera,
        &ViewTarget,
        &ViewPasses,
        &ViewGround,
        &ViewUniformOffset,
        Option<&MainPassResolutionOverride>,
    )>,
    pipeline_cache: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let (camera, target, passes, ground, view_offset, resolution) = view.into_inner();
    let (Some(id), Some(group)) = (passes.pipelines[1], &passes.groups[1]) else { return };
    let Some(pipeline) = pipeline_cache.get_render_pipeline(id) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_sky"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: None,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_sky");
    if let Some(viewport) = Viewport::from_viewport_and_override(camera.viewport.as_ref(), resolution) {
        pass.set_camera_viewport(&viewport);
    }
    pass.set_render_pipeline(pipeline);
    let offsets = [ground.offsets[0], ground.offsets[1], view_offset.offset];
    pass.set_bind_group(0, group, if passes.ldr { &offsets } else { &offsets[..2] });
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
