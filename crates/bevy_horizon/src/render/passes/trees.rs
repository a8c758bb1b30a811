//! Plants: found by a ray a pixel, and lit by Bevy's own functions, after the ground was lit and before Bevy's opaque meshes are drawn;
//! sorted by depth among both. Where a view has a prepass, they are brought into its depth and motion vectors.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::core_pipeline::prepass::{MotionVectorPrepass, ViewPrepassTextures};
use bevy::ecs::query::QueryData;
use bevy::pbr::deferred::DeferredLightingLayout;
use bevy::pbr::{MeshPipelineKey, MeshViewBindGroup, ViewKeyCache};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{
    sampler, storage_buffer_read_only_sized, texture_3d, texture_depth_2d, texture_depth_2d_multisampled,
    uniform_buffer, uniform_buffer_sized,
};
use bevy::render::render_resource::{
    BindGroup, BindGroupLayoutDescriptor, CachedRenderPipelineId, DynamicBindGroupEntries,
    DynamicBindGroupLayoutEntries, Extent3d, PipelineCache, RenderPassDescriptor, SamplerBindingType, ShaderStages,
    StoreOp, TextureDescriptor, TextureDimension, TextureSampleType, TextureUsages,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::texture::{CachedTexture, TextureCache};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewTarget};

use super::super::air::AirTables;
use super::super::cache::Caches;
use super::super::extract::ExtractedHorizonCamera;
use super::super::shaders::Source;
use super::super::trees::{FoliageTexture, GroveUniform, Groves, ViewGrove};
use super::super::uniforms::{AirUniform, ClipmapUniform, HorizonViewUniform};
use super::super::view::{HorizonViews, ViewGround, ViewSky};
use super::lit;
use super::target::DrawnTarget;
use super::tree_motion::{TreeMotion, copy_depth};
use crate::camera::DebugView;

/// What decides which text the shader has, and what is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Variant {
    multisampled: bool,
    /// Whether the air has tables.
    air: bool,
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
                (6, uniform_buffer::<GroveUniform>(false)),
                (7, read()),
                (8, uniform_buffer_sized(false, None)),
                (9, texture_3d(TextureSampleType::Float { filterable: true })),
                (10, sampler(SamplerBindingType::Filtering)),
            ),
        );
        if self.air {
            entries = entries.extend_with_indices(((13, uniform_buffer::<AirUniform>(true)), (14, read())));
        }
        BindGroupLayoutDescriptor::new("horizon_trees", &entries)
    }
}

/// The pipelines that views asked for, and the foliage; none before there are plants.
#[derive(Resource, Default)]
pub struct TreePipelines {
    made: HashMap<(MeshPipelineKey, Variant), CachedRenderPipelineId>,
    foliage: Option<FoliageTexture>,
    motion: TreeMotion,
}

impl TreePipelines {
    fn get(
        &mut self,
        cache: &PipelineCache,
        bevy: &DeferredLightingLayout,
        key: MeshPipelineKey,
        variant: Variant,
    ) -> CachedRenderPipelineId {
        *self.made.entry((key, variant)).or_insert_with(|| {
            let Variant { multisampled, air } = variant;
            let shader = Source::Trees { multisampled, air }.handle();
            let mut descriptor = lit::pipeline(bevy, key, "horizon_trees", 2, variant.layout(), shader, "plants");
            descriptor.depth_stencil = lit::depth();
            cache.queue_render_pipeline(descriptor)
        })
    }
}

/// What draws a view's plants.
#[derive(Component)]
pub struct ViewTrees {
    variant: Variant,
    pipeline: CachedRenderPipelineId,
    /// What was drawn before them: a ray needs to go no farther.
    depth: CachedTexture,
    group: Option<BindGroup>,
    /// Of views that keep motion vectors.
    motion: Option<BindGroup>,
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
        &'static ExtractedCamera,
        &'static Msaa,
        Has<MotionVectorPrepass>,
        Has<ViewTrees>,
    ),
>;

/// Asks for what draws the views' plants.
pub fn prepare_trees(
    mut commands: Commands,
    mut pipelines: ResMut<TreePipelines>,
    mut textures: ResMut<TextureCache>,
    cache: Res<PipelineCache>,
    bevy: Option<Res<DeferredLightingLayout>>,
    keys: Res<ViewKeyCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Views,
) {
    for (entity, ground, grove, view, camera, extracted, msaa, moves, had) in &views {
        let grown = grove.is_some_and(|grove| grove.grown) && camera.camera.debug == DebugView::None;
        let key = keys.get(&view.retained_view_entity).filter(|_| grown);
        let (Some(&key), Some(bevy), Some(size)) = (key, &bevy, extracted.physical_target_size) else {
            if had {
                commands.entity(entity).remove::<ViewTrees>();
            }
            continue;
        };
        let air = matches!(ground.sky, Some(ViewSky::Air { .. }));
        let variant = Variant { multisampled: msaa.samples() > 1, air };
        let pipeline = pipelines.get(&cache, bevy, key, variant);
        pipelines.foliage.get_or_insert_with(|| FoliageTexture::new(&device, &queue));
        if moves && !variant.multisampled {
            pipelines.motion.queue(&cache);
        }
        let copy = TextureDescriptor {
            label: Some("horizon_depth_before_trees"),
            size: Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: msaa.samples(),
            dimension: TextureDimension::D2,
            format: CORE_3D_DEPTH_FORMAT,
            // What has several samples must be one that can be drawn to.
            usage: TextureUsages::COPY_DST | TextureUsages::TEXTURE_BINDING | TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        };
        let depth = textures.get(&device, copy);
        commands.entity(entity).insert(ViewTrees { variant, pipeline, depth, group: None, motion: None });
    }
}

pub fn bind_trees(
    mut views: Query<(&mut ViewTrees, &ViewGround, &ViewGrove, &ViewDepthTexture, Has<MotionVectorPrepass>)>,
    uniforms: Res<HorizonViews>,
    caches: Res<Caches>,
    groves: Res<Groves>,
    airs: Res<AirTables>,
    pipelines: Res<TreePipelines>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    for (mut trees, ground, seen, now, moves) in &mut views {
        let buffers = ground.cache.and_then(|index| caches.0.get(index)).map(|cache| &cache.buffers);
        let (Some(buffers), Some(grove), Some(foliage)) = (buffers, groves.0.get(seen.grove), &pipelines.foliage)
        else {
            continue;
        };
        let (Some(view), Some(clipmap)) = (uniforms.views.binding(), buffers.clipmap.binding()) else { continue };
        let mut entries = DynamicBindGroupEntries::new_with_indices((
            (0, clipmap),
            (1, buffers.heights.as_entire_binding()),
            (2, &trees.depth.default_view),
            (3, buffers.looks.as_entire_binding()),
            (5, view.clone()),
            (6, seen.window.as_entire_binding()),
            (7, grove.tiles.as_entire_binding()),
            (8, grove.forest.as_entire_binding()),
            (9, &foliage.view),
            (10, &foliage.sampler),
        ))
        .to_vec();
        if trees.variant.air {
            let table = match ground.sky {
                Some(ViewSky::Air { table, .. }) => airs.buffers(table),
                _ => None,
            };
            let Some((uniform, [transmittances, _])) = uniforms.airs.binding().zip(table) else { continue };
            let air =
                DynamicBindGroupEntries::new_with_indices(((13, uniform), (14, transmittances.as_entire_binding())));
            entries.extend_from_slice(&air);
        }
        let layout = cache.get_bind_group_layout(&trees.variant.layout());
        let group = device.create_bind_group("horizon_trees", &layout, &entries);
        if moves && !trees.variant.multisampled {
            let motion = pipelines.motion.bind(&trees.depth.default_view, now.view(), view, &cache, &device);
            trees.motion = Some(motion);
        }
        trees.group = Some(group);
    }
}

/// What the pass needs of a view.
#[derive(QueryData)]
pub struct GrownView {
    drawn: DrawnTarget,
    target: &'static ViewTarget,
    depth: &'static ViewDepthTexture,
    trees: &'static ViewTrees,
    ground: &'static ViewGround,
    bevy: &'static MeshViewBindGroup,
    prepass: Option<&'static ViewPrepassTextures>,
}

/// Draws a view's plants.
pub fn draw_trees(
    view: ViewQuery<GrownView>,
    own: Res<TreePipelines>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let GrownViewItem { drawn, target, depth, trees, ground, bevy, prepass } = view.into_inner();
    let Some((pipeline, group)) = pipelines.get_render_pipeline(trees.pipeline).zip(trees.group.as_ref()) else {
        return;
    };
    ctx.command_encoder().copy_texture_to_texture(
        depth.texture.as_image_copy(),
        trees.depth.texture.as_image_copy(),
        depth.texture.size(),
    );
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_trees"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: Some(depth.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_trees");
    if let Some(viewport) = drawn.viewport() {
        pass.set_camera_viewport(&viewport);
    }
    let [seen, air, _] = ground.offsets;
    let offsets = [seen, air];
    pass.set_render_pipeline(pipeline);
    pass.set_bind_group(0, &bevy.main, &bevy.main_offsets);
    pass.set_bind_group(1, &bevy.binding_array, &[]);
    pass.set_bind_group(2, group, &offsets[..1 + usize::from(trees.variant.air)]);
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
    drop(pass);
    if let Some(textures) = prepass {
        copy_depth(depth, textures, &mut ctx);
        if let Some(group) = &trees.motion {
            own.motion.draw(&drawn, textures, group, seen, &pipelines, &mut ctx);
        }
    }
}
