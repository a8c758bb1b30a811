//! Light on the ground, by Bevy's own functions: in the forward route where its geometry left its depth, in the deferred one on
//! all that the G-buffer holds, meshes included, in place of Bevy's pass.

use bevy::core_pipeline::deferred::copy_lighting_id::DeferredLightingIdDepthTexture;
use bevy::core_pipeline::prepass::DeferredPrepass;
use bevy::ecs::query::QueryData;
use bevy::pbr::deferred::{DeferredLightingLayout, DeferredLightingPipeline};
use bevy::pbr::{MeshPipelineKey, MeshViewBindGroup, ViewKeyCache};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, texture_depth_2d, texture_depth_2d_multisampled, uniform_buffer,
    uniform_buffer_sized,
};
use bevy::render::render_resource::{
    BindGroup, BindGroupLayoutDescriptor, CachedRenderPipelineId, DynamicBindGroupEntries,
    DynamicBindGroupLayoutEntries, LoadOp, Operations, PipelineCache, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, ShaderStages, SpecializedRenderPipeline, StoreOp,
};
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewTarget};

use super::super::air::AirTables;
use super::super::cache::Caches;
use super::super::extract::ExtractedHorizonCamera;
use super::super::shaders::Source;
use super::super::trees::{GroveUniform, Groves, ViewGrove};
use super::super::uniforms::{AirUniform, ClipmapUniform, HorizonViewUniform};
use super::super::view::{HorizonViews, ViewGround, ViewSky};
use super::lit;
use super::target::DrawnTarget;
use crate::camera::DebugView;

/// What decides which text the shader has, and what is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Variant {
    deferred: bool,
    multisampled: bool,
    /// Whether the air has tables.
    air: bool,
    /// Whether plants stand in the light.
    trees: bool,
}

impl Variant {
    fn layout(self) -> BindGroupLayoutDescriptor {
        let read = || storage_buffer_read_only_sized(false, None);
        let mut entries = DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (2, if self.multisampled { texture_depth_2d_multisampled() } else { texture_depth_2d() }),
                (3, read()),
                (5, uniform_buffer::<HorizonViewUniform>(true)),
            ),
        );
        if self.trees {
            entries = entries.extend_with_indices((
                (6, uniform_buffer::<GroveUniform>(false)),
                (7, read()),
                (8, uniform_buffer_sized(false, None)),
            ));
        }
        if self.air {
            entries = entries.extend_with_indices(((13, uniform_buffer::<AirUniform>(true)), (14, read())));
        }
        BindGroupLayoutDescriptor::new("horizon_shade", &entries)
    }
}

/// The pipelines that views asked for.
#[derive(Resource, Default)]
pub struct ShadePipelines {
    made: HashMap<(MeshPipelineKey, Variant), CachedRenderPipelineId>,
    /// Whether it was said that Bevy's lighting is missing.
    said: bool,
}

impl ShadePipelines {
    fn get(
        &mut self,
        cache: &PipelineCache,
        bevy: &DeferredLightingLayout,
        key: MeshPipelineKey,
        variant: Variant,
    ) -> CachedRenderPipelineId {
        *self.made.entry((key, variant)).or_insert_with(|| {
            let Variant { deferred, multisampled, air, trees } = variant;
            let shader = Source::Shade { deferred, multisampled, air, trees }.handle();
            if !deferred {
                let layout = variant.layout();
                let forward = lit::pipeline(bevy, key, "horizon_shade", 2, layout, shader, "shade");
                return cache.queue_render_pipeline(forward);
            }
            // As Bevy's own, for all that is in the G-buffer.
            let mut descriptor = bevy.specialize(key);
            descriptor.label = Some("horizon_shade".into());
            descriptor.layout.truncate(2);
            descriptor.layout.push(variant.layout());
            descriptor.multisample.count = key.msaa_samples();
            descriptor.vertex.shader = shader.clone();
            descriptor.vertex.entry_point = Some("fullscreen_of_id".into());
            let fragment = descriptor.fragment.as_mut().expect("lighting has a fragment shader");
            fragment.shader = shader;
            fragment.entry_point = Some("shade".into());
            cache.queue_render_pipeline(descriptor)
        })
    }
}

/// What lights a view's ground.
#[derive(Component)]
pub struct ViewShade {
    variant: Variant,
    pipeline: CachedRenderPipelineId,
    group: Option<BindGroup>,
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static ViewGround,
        Option<&'static ViewGrove>,
        &'static ExtractedView,
        &'static ExtractedHorizonCamera,
        &'static Msaa,
        Has<DeferredPrepass>,
    ),
>;

/// Asks for what lights the views' ground.
pub fn prepare_shade(
    mut commands: Commands,
    mut pipelines: ResMut<ShadePipelines>,
    cache: Res<PipelineCache>,
    bevy: Option<Res<DeferredLightingLayout>>,
    keys: Res<ViewKeyCache>,
    views: Views,
) {
    for (entity, ground, grove, view, camera, msaa, deferred) in &views {
        let shown = deferred || camera.camera.debug == DebugView::None;
        let key = keys.get(&view.retained_view_entity).filter(|_| ground.cache.is_some() && shown);
        if key.is_some() && bevy.is_none() && !pipelines.said {
            pipelines.said = true;
            error!("the ground stays dark: it needs `PbrPlugin` with `add_default_deferred_lighting_plugin: true`");
        }
        let (Some(&key), Some(bevy)) = (key, &bevy) else {
            commands.entity(entity).remove::<ViewShade>();
            continue;
        };
        let air = matches!(ground.sky, Some(ViewSky::Air { .. }));
        let trees = grove.is_some_and(|grove| grove.grown);
        let mut variant = Variant { deferred, multisampled: msaa.samples() > 1, air, trees };
        let mut pipeline = pipelines.get(&cache, bevy, key, variant);
        if trees && cache.get_render_pipeline(pipeline).is_none() {
            // While that with plants compiles, the ground is lit without.
            variant.trees = false;
            pipeline = pipelines.get(&cache, bevy, key, variant);
        }
        if deferred && cache.get_render_pipeline(pipeline).is_some() {
            // Bevy's own pass, which it asks for in each frame, would light the same once more. Until ours is there, it does.
            commands.entity(entity).remove::<DeferredLightingPipeline>();
        }
        commands.entity(entity).insert(ViewShade { variant, pipeline, group: None });
    }
}

pub fn bind_shade(
    mut views: Query<(&mut ViewShade, &ViewGround, Option<&ViewGrove>, &ViewDepthTexture)>,
    uniforms: Res<HorizonViews>,
    caches: Res<Caches>,
    groves: Res<Groves>,
    airs: Res<AirTables>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    for (mut shade, ground, grove, depth) in &mut views {
        let Some(buffers) = ground.cache.and_then(|index| caches.0.get(index)).map(|cache| &cache.buffers) else {
            continue;
        };
        let (Some(view), Some(clipmap)) = (uniforms.views.binding(), buffers.clipmap.binding()) else { continue };
        let mut entries = DynamicBindGroupEntries::new_with_indices((
            (0, clipmap),
            (1, buffers.heights.as_entire_binding()),
            (2, depth.view()),
            (3, buffers.looks.as_entire_binding()),
            (5, view),
        ))
        .to_vec();
        if shade.variant.trees {
            let Some(seen) = grove else { continue };
            let Some(grove) = groves.0.get(seen.grove) else { continue };
            entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices((
                (6, seen.window.as_entire_binding()),
                (7, grove.tiles.as_entire_binding()),
                (8, grove.forest.as_entire_binding()),
            )));
        }
        if let Some(ViewSky::Air { table, .. }) = ground.sky {
            let tables = uniforms.airs.binding().zip(airs.buffers(table));
            let Some((uniform, [transmittances, _])) = tables else { continue };
            let air =
                DynamicBindGroupEntries::new_with_indices(((13, uniform), (14, transmittances.as_entire_binding())));
            entries.extend_from_slice(&air);
        }
        let layout = cache.get_bind_group_layout(&shade.variant.layout());
        shade.group = Some(device.create_bind_group("horizon_shade", &layout, &entries));
    }
}

/// What the pass needs of a view.
#[derive(QueryData)]
pub struct ShadedView {
    drawn: DrawnTarget,
    target: &'static ViewTarget,
    shade: &'static ViewShade,
    ground: &'static ViewGround,
    bevy: &'static MeshViewBindGroup,
    ids: Option<&'static DeferredLightingIdDepthTexture>,
}

/// Lights the ground, and where there is a G-buffer what else is in it.
pub fn draw_shade(view: ViewQuery<ShadedView>, pipelines: Res<PipelineCache>, mut ctx: RenderContext) {
    let ShadedViewItem { drawn, target, shade, ground, bevy, ids } = view.into_inner();
    let Some((pipeline, group)) = pipelines.get_render_pipeline(shade.pipeline).zip(shade.group.as_ref()) else {
        return;
    };
    let ids = ids.filter(|_| shade.variant.deferred);
    if shade.variant.deferred && ids.is_none() {
        return;
    }
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_shade"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: ids.map(|ids| RenderPassDepthStencilAttachment {
            view: &ids.texture.default_view,
            depth_ops: Some(Operations { load: LoadOp::Load, store: StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_shade");
    if let Some(viewport) = drawn.viewport() {
        pass.set_camera_viewport(&viewport);
    }
    let [own, air, _] = ground.offsets;
    let offsets = [own, air];
    pass.set_render_pipeline(pipeline);
    pass.set_bind_group(0, &bevy.main, &bevy.main_offsets);
    pass.set_bind_group(1, &bevy.binding_array, &[]);
    pass.set_bind_group(2, group, &offsets[..1 + usize::from(shade.variant.air)]);
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
