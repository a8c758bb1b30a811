//! The passes as Bevy's schedule runs them, once for each view: a triangle over the viewport.

use bevy::camera::{MainPassResolutionOverride, Viewport};
use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{PipelineCache, RenderPassDepthStencilAttachment, RenderPassDescriptor, StoreOp};
use bevy::render::renderer::{RenderContext, ViewQuery};
use bevy::render::view::{ViewDepthTexture, ViewTarget, ViewUniformOffset};

use super::super::view::ViewGround;
use super::{ClearancePipeline, Pass, ViewPasses};

/// What both passes need of a view.
#[derive(QueryData)]
pub struct DrawnView {
    camera: &'static ExtractedCamera,
    target: &'static ViewTarget,
    depth: &'static ViewDepthTexture,
    passes: &'static ViewPasses,
    ground: &'static ViewGround,
    offset: &'static ViewUniformOffset,
    resolution: Option<&'static MainPassResolutionOverride>,
}

/// The ground, before Bevy's opaque meshes: one ray a pixel; colour and depth. At a lower resolution first, where the
/// camera asks for that.
pub fn draw_ground(
    view: ViewQuery<DrawnView>,
    pipelines: Res<PipelineCache>,
    clearances: Res<ClearancePipeline>,
    mut ctx: RenderContext,
) {
    let view = view.into_inner();
    if let (Some(group), Some(table)) = (&view.passes.clearance, &view.ground.table) {
        clearances.dispatch(group, view.ground.offsets[0], table, &pipelines, &mut ctx);
    }
    draw(Pass::Ground, &view, &pipelines, &mut ctx);
    draw(Pass::Upsample, &view, &pipelines, &mut ctx);
}

/// The air, after Bevy's opaque meshes: sky where nothing was drawn, haze over what was; where it has tables, first what it takes, then
/// what it adds. One fragment a sample, so that
/// the edges of meshes keep their antialiasing.
pub fn draw_sky(view: ViewQuery<DrawnView>, pipelines: Res<PipelineCache>, mut ctx: RenderContext) {
    let view = view.into_inner();
    draw(Pass::Veil, &view, &pipelines, &mut ctx);
    draw(Pass::Haze, &view, &pipelines, &mut ctx);
    draw(Pass::Sky, &view, &pipelines, &mut ctx);
}

fn draw(pass: Pass, view: &DrawnViewItem, pipelines: &PipelineCache, ctx: &mut RenderContext) {
    let passes = view.passes;
    let (Some(id), Some(group)) = (passes.pipelines[pass as usize], &passes.groups[pass as usize]) else {
        return;
    };
    let Some(pipeline) = pipelines.get_render_pipeline(id) else { return };
    let scaled = passes.scaled.as_ref().filter(|_| pass == Pass::Ground);
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let (colour, depth) = match scaled {
        Some(scaled) => (scaled.colour_attachment(), scaled.depth_attachment()),
        None => (view.target.get_color_attachment(), view.depth.get_attachment(StoreOp::Store)),
    };
    let mut render_pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some(pass.label()),
        color_attachments: &[Some(colour)],
        // The air also reads the depth as a texture, and so must not write it.
        depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
            depth_ops: depth.depth_ops.filter(|_| !pass.is_air()),
            ..depth
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut render_pass, pass.label());
    let viewport = Viewport::from_viewport_and_override(view.camera.viewport.as_ref(), view.resolution);
    if let Some(viewport) = viewport.filter(|_| scaled.is_none()) {
        render_pass.set_camera_viewport(&viewport);
    }
    let [own, sky, low] = view.ground.offsets;
    let mut offsets = vec![if scaled.is_some() { low } else { own }];
    // In the order of their bindings.
    offsets.extend(pass.is_air().then_some(sky));
    offsets.extend(passes.ldr.then_some(view.offset.offset));
    offsets.extend((passes.air && !pass.is_air()).then_some(sky));
    render_pass.set_render_pipeline(pipeline);
    render_pass.set_bind_group(0, group, &offsets);
    render_pass.draw(0..3, 0..1);
    span.end(&mut render_pass);
}
