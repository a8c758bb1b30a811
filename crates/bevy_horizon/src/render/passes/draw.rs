//! Debug views and the air, as Bevy's schedule runs them, once for each view: a triangle over the viewport.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{PipelineCache, RenderPassDepthStencilAttachment, RenderPassDescriptor, StoreOp};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::{ViewDepthTexture, ViewTarget, ViewUniformOffset};

use super::super::view::ViewGround;
use super::target::DrawnTarget;
use super::{Pass, ViewPasses};

/// What the passes need of a view.
#[derive(QueryData)]
pub struct DrawnView {
    drawn: DrawnTarget,
    target: &'static ViewTarget,
    depth: &'static ViewDepthTexture,
    passes: &'static ViewPasses,
    ground: &'static ViewGround,
    offset: &'static ViewUniformOffset,
}

/// A debug view, in place of the ground's colour.
pub fn draw_heat(view: ViewQuery<DrawnView>, pipelines: Res<PipelineCache>, mut ctx: RenderContext) {
    draw(Pass::Heat, &view.into_inner(), &pipelines, &mut ctx);
}

/// The air, after Bevy's opaque meshes: sky where nothing was drawn, haze over what was; where it has tables, first what it takes, then
/// what it adds. One fragment a sample, so that the edges of meshes keep their antialiasing.
pub fn draw_sky(view: ViewQuery<DrawnView>, pipelines: Res<PipelineCache>, mut ctx: RenderContext) {
    let view = view.into_inner();
    for pass in [Pass::Veil, Pass::Haze, Pass::Sky] {
        draw(pass, &view, &pipelines, &mut ctx);
    }
}

fn draw(pass: Pass, view: &DrawnViewItem, pipelines: &PipelineCache, ctx: &mut RenderContext) {
    let passes = view.passes;
    let (Some(id), Some(group)) = (passes.pipelines[pass as usize], &passes.groups[pass as usize]) else {
        return;
    };
    let Some(pipeline) = pipelines.get_render_pipeline(id) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let depth = view.depth.get_attachment(StoreOp::Store);
    let mut render_pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some(pass.label()),
        color_attachments: &[Some(view.target.get_color_attachment())],
        // The air also reads the depth as a texture, and so must not write it.
        depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
            depth_ops: depth.depth_ops.filter(|_| pass == Pass::Heat),
            ..depth
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut render_pass, pass.label());
    if let Some(viewport) = view.drawn.viewport() {
        render_pass.set_camera_viewport(&viewport);
    }
    let [own, sky, _] = view.ground.offsets;
    // In the order of their bindings.
    let mut offsets = vec![own];
    offsets.extend((pass != Pass::Heat).then_some(sky));
    offsets.extend(passes.ldr.then_some(view.offset.offset));
    render_pass.set_render_pipeline(pipeline);
    render_pass.set_bind_group(0, group, &offsets);
    render_pass.draw(0..3, 0..1);
    span.end(&mut render_pass);
}
