//! The rival's pass: a triangle over the viewport.

use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{PipelineCache, RenderPassDescriptor, StoreOp};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::{ViewDepthTexture, ViewTarget};

use super::super::view::ViewGround;
use super::prepare::ViewRival;

pub fn draw_rival(
    view: ViewQuery<(&ViewTarget, &ViewDepthTexture, &ViewGround, &ViewRival)>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let (target, depth, ground, rival) = view.into_inner();
    let Some(pipeline) = pipelines.get_render_pipeline(rival.pipeline) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_rival"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: Some(depth.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_rival");
    pass.set_render_pipeline(pipeline);
    pass.set_bind_group(0, &rival.groups[0], &[ground.offsets[0]]);
    pass.set_bind_group(1, &rival.groups[1], &[]);
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
