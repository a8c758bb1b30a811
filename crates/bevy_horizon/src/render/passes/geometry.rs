//! The ground's geometry, before the main pass: depth, and what else of a prepass the view has.

use bevy::camera::Viewport;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::core_pipeline::prepass::{
    DeferredPrepass, MotionVectorPrepass, NormalPrepass, ViewPrepassTextures, prepass_target_descriptors,
};
use bevy::ecs::query::QueryData;
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{storage_buffer_read_only_sized, texture_depth_2d, uniform_buffer};
use bevy::render::render_resource::{
    BindGroup, BindGroupLayoutDescriptor, CachedRenderPipelineId, CompareFunction, DepthStencilState,
    DynamicBindGroupEntries, DynamicBindGroupLayoutEntries, Extent3d, FragmentState, LoadOp, MultisampleState,
    Operations, PipelineCache, RenderPassDepthStencilAttachment, RenderPassDescriptor, RenderPipelineDescriptor,
    ShaderStages, StoreOp, TextureDescriptor, TextureDimension, TextureUsages, VertexState,
};
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::texture::{CachedTexture, TextureCache};
use bevy::render::view::ViewDepthTexture;

use super::super::cache::Caches;
use super::super::shaders::{Beside, Source};
use super::super::uniforms::{ClipmapUniform, HorizonViewUniform};
use super::super::view::{HorizonViews, ViewGround};
use super::clearance::{ClearancePipeline, ViewClearance};
use super::target::DrawnTarget;

/// Which targets of a prepass a view has: normals, motion vectors, the G-buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
struct Targets {
    normal: bool,
    motion: bool,
    deferred: bool,
}

impl Targets {
    fn any(self) -> bool {
        self.normal || self.motion || self.deferred
    }

    fn beside(self) -> Beside {
        match self {
            Self { normal: false, motion: false, deferred: false } => Beside::Nothing,
            Self { normal: false, motion: true, deferred: false } => Beside::Motion,
            _ => Beside::Surfaces,
        }
    }
}

/// What a pipeline depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Key {
    samples: u32,
    /// Whether it starts from a lower resolution's depth.
    scaled: bool,
    targets: Targets,
}

impl Key {
    fn source(self) -> Source {
        Source::Geometry { scaled: self.scaled, beside: self.targets.beside() }
    }

    fn layout(self) -> BindGroupLayoutDescriptor {
        let read = || storage_buffer_read_only_sized(false, None);
        let mut entries = DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (2, read()),
                (3, read()),
                (5, uniform_buffer::<HorizonViewUniform>(true)),
                (6, read()),
            ),
        );
        if self.scaled {
            entries = entries.extend_with_indices(((8, texture_depth_2d()),));
        }
        BindGroupLayoutDescriptor::new("horizon_geometry", &entries)
    }
}

/// The pipelines that views asked for.
#[derive(Resource, Default)]
pub struct GeometryPipelines(HashMap<Key, CachedRenderPipelineId>);

impl GeometryPipelines {
    fn get(&mut self, cache: &PipelineCache, key: Key) -> CachedRenderPipelineId {
        *self.0.entry(key).or_insert_with(|| {
            let shader = key.source().handle();
            let Targets { normal, motion, deferred } = key.targets;
            let targets =
                if key.targets.any() { prepass_target_descriptors(normal, motion, deferred) } else { Vec::new() };
            cache.queue_render_pipeline(RenderPipelineDescriptor {
                label: Some("horizon_ground".into()),
                layout: vec![key.layout()],
                vertex: VertexState { shader: shader.clone(), entry_point: Some("fullscreen".into()), ..default() },
                depth_stencil: Some(DepthStencilState {
                    format: CORE_3D_DEPTH_FORMAT,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(CompareFunction::GreaterEqual),
                    stencil: default(),
                    bias: default(),
                }),
                multisample: MultisampleState { count: key.samples, ..default() },
                fragment: Some(FragmentState { shader, entry_point: Some("ground".into()), targets, ..default() }),
                ..default()
            })
        })
    }
}

/// A draw: what it runs, and what that binds.
struct Draw {
    key: Key,
    pipeline: CachedRenderPipelineId,
    group: Option<BindGroup>,
}

/// What draws a view's ground: at the view's resolution, and before that at a lower one, where the camera asks for it.
#[derive(Component)]
pub struct ViewGeometry {
    whole: Draw,
    low: Option<(Draw, CachedTexture)>,
    clearance: Option<BindGroup>,
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static ViewGround,
        &'static Msaa,
        Has<NormalPrepass>,
        Has<MotionVectorPrepass>,
        Has<DeferredPrepass>,
        Option<&'static ViewPrepassTextures>,
    ),
>;

/// Asks for what views draw their ground with.
pub fn prepare_geometry(
    mut commands: Commands,
    mut pipelines: ResMut<GeometryPipelines>,
    mut textures: ResMut<TextureCache>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    views: Views,
) {
    for (entity, ground, msaa, normal, motion, deferred, prepass) in &views {
        if ground.cache.is_none() {
            commands.entity(entity).remove::<ViewGeometry>();
            continue;
        }
        // A view that Bevy gives no targets, as one without size, has none.
        let targets = prepass.map_or(Targets::default(), |_| Targets { normal, motion, deferred });
        let mut draw = |key| Draw { key, pipeline: pipelines.get(&cache, key), group: None };
        let low = ground.scaled.map(|size| {
            let key = Key { samples: 1, scaled: false, targets: Targets::default() };
            let texture = TextureDescriptor {
                label: Some("horizon_scaled_depth"),
                size: Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: TextureDimension::D2,
                format: CORE_3D_DEPTH_FORMAT,
                usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            };
            (draw(key), textures.get(&device, texture))
        });
        let whole = draw(Key { samples: msaa.samples(), scaled: low.is_some(), targets });
        commands.entity(entity).insert(ViewGeometry { whole, low, clearance: None });
    }
}

pub fn bind_geometry(
    mut views: Query<(&mut ViewGeometry, &ViewGround, &ViewClearance)>,
    uniforms: Res<HorizonViews>,
    caches: Res<Caches>,
    clearances: Res<ClearancePipeline>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    for (mut geometry, ground, clearance) in &mut views {
        let Some(buffers) = ground.cache.and_then(|index| caches.0.get(index)).map(|cache| &cache.buffers) else {
            continue;
        };
        let (Some(view), Some(clipmap)) = (uniforms.views.binding(), buffers.clipmap.binding()) else { continue };
        let ViewGeometry { whole, low, clearance: table } = &mut *geometry;
        *table = clearances.bind(clearance, buffers, &uniforms, &cache, &device);
        let entries = DynamicBindGroupEntries::new_with_indices((
            (0, clipmap),
            (1, buffers.heights.as_entire_binding()),
            (2, buffers.bounds.as_entire_binding()),
            (3, buffers.looks.as_entire_binding()),
            (5, view),
            (6, clearance.buffer().as_entire_binding()),
        ))
        .to_vec();
        let bind = |draw: &mut Draw, depth: Option<&CachedTexture>| {
            let mut entries = entries.clone();
            if let Some(depth) = depth {
                entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices(((8, &depth.default_view),)));
            }
            let layout = cache.get_bind_group_layout(&draw.key.layout());
            draw.group = Some(device.create_bind_group("horizon_geometry", &layout, &entries));
        };
        bind(whole, low.as_ref().map(|(_, depth)| depth));
        if let Some((draw, _)) = low {
            bind(draw, None);
        }
    }
}

/// What the pass needs of a view.
#[derive(QueryData)]
pub struct DrawnGround {
    target: DrawnTarget,
    depth: &'static ViewDepthTexture,
    geometry: &'static ViewGeometry,
    ground: &'static ViewGround,
    prepass: Option<&'static ViewPrepassTextures>,
}

/// Draws the ground's geometry, sorted by depth among what a prepass drew.
pub fn draw_geometry(
    view: ViewQuery<DrawnGround>,
    pipelines: Res<PipelineCache>,
    clearances: Res<ClearancePipeline>,
    mut ctx: RenderContext,
) {
    let DrawnGroundItem { target, depth, geometry, ground, prepass } = view.into_inner();
    if let (Some(group), Some(table)) = (&geometry.clearance, &ground.table) {
        clearances.dispatch(group, ground.offsets[0], table, &pipelines, &mut ctx);
    }
    if let Some((low, texture)) = &geometry.low {
        let attachment = RenderPassDepthStencilAttachment {
            view: &texture.default_view,
            depth_ops: Some(Operations { load: LoadOp::Clear(0.0), store: StoreOp::Store }),
            stencil_ops: None,
        };
        draw(low, None, || attachment, None, ground.offsets[2], "horizon_ground_scaled", &pipelines, &mut ctx);
    }
    let viewport = target.viewport();
    let textures = prepass.filter(|_| geometry.whole.key.targets.any());
    draw(
        &geometry.whole,
        textures,
        || depth.get_attachment(StoreOp::Store),
        viewport.as_ref(),
        ground.offsets[0],
        "horizon_ground",
        &pipelines,
        &mut ctx,
    );
    // Effects that look at the prepass find the ground in its depth too.
    if let Some((prepass, copy)) = prepass.and_then(|prepass| Some((prepass, prepass.depth.as_ref()?))) {
        ctx.command_encoder().copy_texture_to_texture(
            depth.texture.as_image_copy(),
            copy.texture.texture.as_image_copy(),
            prepass.size,
        );
    }
}

/// The attachment is asked for late: it is cleared where it is asked for first, and a pipeline that still compiles clears nothing.
fn draw<'a>(
    draw: &Draw,
    textures: Option<&ViewPrepassTextures>,
    depth: impl FnOnce() -> RenderPassDepthStencilAttachment<'a>,
    viewport: Option<&Viewport>,
    offset: u32,
    label: &'static str,
    pipelines: &PipelineCache,
    ctx: &mut RenderContext,
) {
    let Some((pipeline, group)) = pipelines.get_render_pipeline(draw.pipeline).zip(draw.group.as_ref()) else { return };
    let colours = textures.map_or(Vec::new(), |textures| {
        let targets =
            [&textures.normal, &textures.motion_vectors, &textures.deferred, &textures.deferred_lighting_pass_id];
        targets.map(|target| target.as_ref().map(|target| target.get_attachment())).into()
    });
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some(label),
        color_attachments: &colours,
        depth_stencil_attachment: Some(depth()),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, label);
    if let Some(viewport) = viewport {
        pass.set_camera_viewport(viewport);
    }
    pass.set_render_pipeline(pipeline);
    pass.set_bind_group(0, group, &[offset]);
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
