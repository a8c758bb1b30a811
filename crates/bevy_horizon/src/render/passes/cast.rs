//! The ground in Bevy's shadow maps: every cascade, face of a cube and cone in which it may stand, as a grid displaced from the cache.
//! Nothing is built before a light casts shadows over a terrain.

use bevy::camera::visibility::RenderLayers;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::ecs::entity::EntityHashMap;
use bevy::math::{Mat4, Vec4};
use bevy::pbr::{ExtractedPointLight, LightEntity, ShadowView, ViewLightEntities};
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{storage_buffer_read_only_sized, uniform_buffer};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, Buffer, BufferId,
    BufferInitDescriptor, BufferUsages, CachedRenderPipelineId, CompareFunction, DepthStencilState,
    DynamicUniformBuffer, FragmentState, IndexFormat, PipelineCache, PrimitiveState, RawBufferVec,
    RenderPassDescriptor, RenderPipelineDescriptor, ShaderStages, ShaderType, StoreOp, VertexState,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::view::ExtractedView;

use self::patches::{LightView, Patch, patches};
use super::super::cache::Caches;
use super::super::extract::ExtractedWorld;
use super::super::shaders::Source;
use super::super::uniforms::ClipmapUniform;
use super::super::view::ViewGround;

pub use self::patches::{PUSH, QUADS};

mod patches;
mod trees;

pub use self::trees::{TreeCastPipeline, draw_trees_in_cascades, draw_trees_in_shared, prepare_tree_casts};

/// `Light` of `cast.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct LightUniform {
    clip_from_ground: Mat4,
    place: Vec4,
}

/// What the ground draws into one shadow map.
#[derive(Component)]
pub struct GroundCast {
    cache: usize,
    offset: u32,
    first: u32,
    count: u32,
    /// Whether there may be holes in it.
    holes: bool,
}

/// What a cache's ground is drawn with, and the buffers that it was made of: it holds as long as they do.
struct Bound {
    made_of: [BufferId; 5],
    group: BindGroup,
}

/// The pipelines of ground without holes and with, and what they bind; none before a light asks.
#[derive(Resource)]
pub struct CastPipeline {
    layout: BindGroupLayoutDescriptor,
    ids: [Option<CachedRenderPipelineId>; 2],
    indices: Option<Buffer>,
    lights: DynamicUniformBuffer<LightUniform>,
    /// The patches of all maps.
    patches: RawBufferVec<Patch>,
    /// By cache.
    groups: Vec<Bound>,
}

impl Default for CastPipeline {
    fn default() -> Self {
        let read = || storage_buffer_read_only_sized(false, None);
        let layout = BindGroupLayoutEntries::with_indices(
            ShaderStages::VERTEX_FRAGMENT,
            (
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (3, read()),
                (4, read()),
                (5, uniform_buffer::<LightUniform>(true)),
            ),
        );
        Self {
            layout: BindGroupLayoutDescriptor::new("horizon_cast", &layout),
            ids: [None; 2],
            indices: None,
            lights: DynamicUniformBuffer::default(),
            patches: no_patches(),
            groups: Vec::new(),
        }
    }
}

fn no_patches() -> RawBufferVec<Patch> {
    let mut patches = RawBufferVec::new(BufferUsages::STORAGE);
    patches.set_label(Some("horizon_cast_patches"));
    patches
}

impl CastPipeline {
    fn queue(&mut self, cache: &PipelineCache, device: &RenderDevice, holes: bool) {
        self.ids[usize::from(holes)].get_or_insert_with(|| {
            let shader = Source::Cast { holes }.handle();
            let entry = if holes { "cast_pierced" } else { "cast_ground" };
            cache.queue_render_pipeline(RenderPipelineDescriptor {
                label: Some("horizon_cast".into()),
                layout: vec![self.layout.clone()],
                vertex: VertexState { shader: shader.clone(), entry_point: Some(entry.into()), ..default() },
                primitive: PrimitiveState::default(),
                depth_stencil: Some(DepthStencilState {
                    format: CORE_3D_DEPTH_FORMAT,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(CompareFunction::GreaterEqual),
                    stencil: default(),
                    bias: default(),
                }),
                fragment: holes.then(|| FragmentState { shader, entry_point: Some("keep_ground".into()), ..default() }),
                ..default()
            })
        });
        self.indices.get_or_insert_with(|| {
            let quad = |x: u16, z: u16| {
                let at = z * (QUADS + 1) + x;
                let (right, below) = (at + 1, at + QUADS + 1);
                [at, below, right, right, below, below + 1]
            };
            let indices: Vec<u16> = (0..QUADS).flat_map(|z| (0..QUADS).flat_map(move |x| quad(x, z))).collect();
            device.create_buffer_with_data(&BufferInitDescriptor {
                label: Some("horizon_cast_indices"),
                contents: bytemuck::cast_slice(&indices),
                usage: BufferUsages::INDEX,
            })
        });
    }
}

type Maps<'w, 's> = Query<
    'w,
    's,
    (Entity, &'static ExtractedView, &'static LightEntity, Option<&'static RenderLayers>, Has<GroundCast>),
    With<ShadowView>,
>;

/// Ground that casts: its cache, the cache's centre and the camera's place in Bevy's coordinates, and the terrain's layers.
struct Ground<'a> {
    cache: usize,
    centre: Vec3,
    eye: Vec3,
    layers: &'a RenderLayers,
}

/// Makes out what of the ground each shadow map may show: cascades from their own camera's cache, point and spot lights from that of
/// the nearest camera.
pub fn prepare_casts(
    mut commands: Commands,
    mut pipeline: ResMut<CastPipeline>,
    world: Res<ExtractedWorld>,
    caches: Res<Caches>,
    pipelines: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Query<(&ViewGround, &ExtractedView, Option<&ViewLightEntities>)>,
    points: Query<&ExtractedPointLight>,
    maps: Maps,
) {
    let pipeline = &mut *pipeline;
    pipeline.lights.clear();
    let mut all = Vec::new();
    let mut grounds = Vec::new();
    let mut owned = EntityHashMap::default();
    for (ground, view, lights) in &views {
        let Some(cache) = ground.cache else { continue };
        let Some(layers) = caches.0[cache].layers(&world) else { continue };
        let eye = view.world_from_view.translation();
        let centre = eye - caches.0[cache].eye(&ground.eye);
        for light in lights.iter().flat_map(|lights| &lights.lights) {
            owned.insert(*light, grounds.len());
        }
        grounds.push(Ground { cache, centre, eye, layers });
    }
    for (entity, view, light, layers, was) in &maps {
        let layers = layers.cloned().unwrap_or_default();
        let (ground, range) = match light {
            LightEntity::Directional { .. } => (owned.get(&entity).map(|index| &grounds[*index]), f32::INFINITY),
            LightEntity::Point { light_entity, .. } | LightEntity::Spot { light_entity } => {
                let place = view.world_from_view.translation();
                let near =
                    |a: &&Ground, b: &&Ground| a.eye.distance_squared(place).total_cmp(&b.eye.distance_squared(place));
                let lit = grounds.iter().filter(|ground| ground.layers.intersects(&layers));
                (lit.min_by(near), points.get(*light_entity).map_or(f32::INFINITY, |point| point.range))
            }
        };
        let from = all.len() as u32;
        let light = ground.map(|ground| {
            let light = LightView::new(view, ground.centre, range);
            let cache = &caches.0[ground.cache];
            patches(cache, &light, cache.heights(), &mut all);
            (light, ground.cache)
        });
        let count = all.len() as u32 - from;
        match light.filter(|_| count > 0) {
            Some((LightView { clip_from_ground, place, .. }, cache)) => {
                let offset = pipeline.lights.push(&LightUniform { clip_from_ground, place });
                commands.entity(entity).insert(GroundCast {
                    cache,
                    offset,
                    first: from,
                    count,
                    holes: caches.0[cache].holes(),
                });
            }
            None if was => {
                commands.entity(entity).remove::<GroundCast>();
            }
            None => {}
        }
    }
    if all.is_empty() {
        pipeline.patches = no_patches();
        pipeline.groups.clear();
        return;
    }
    pipeline.queue(&pipelines, &device, false);
    if caches.0.iter().any(|cache| cache.holes()) {
        pipeline.queue(&pipelines, &device, true);
    }
    let CastPipeline { layout, lights, patches, groups, .. } = pipeline;
    lights.write_buffer(&device, &queue);
    // Where camera and lights stand still, they are the same.
    if patches.values() != &all {
        *patches.values_mut() = all;
        patches.write_buffer(&device, &queue);
    }
    let (Some(patches), Some(of_lights), Some(light)) = (patches.buffer(), lights.buffer(), lights.binding()) else {
        return;
    };
    groups.truncate(caches.0.len());
    for (i, cache) in caches.0.iter().enumerate() {
        let buffers = &cache.buffers;
        let Some(clipmap) = buffers.clipmap.buffer() else {
            groups.truncate(i);
            return;
        };
        let made_of = [clipmap, &buffers.heights, &buffers.looks, patches, of_lights].map(Buffer::id);
        if groups.get(i).is_some_and(|bound| bound.made_of == made_of) {
            continue;
        }
        let entries = BindGroupEntries::with_indices((
            (0, clipmap.as_entire_binding()),
            (1, buffers.heights.as_entire_binding()),
            (3, buffers.looks.as_entire_binding()),
            (4, patches.as_entire_binding()),
            (5, light.clone()),
        ));
        let layout = pipelines.get_bind_group_layout(layout);
        let bound = Bound { made_of, group: device.create_bind_group("horizon_cast", &layout, &entries) };
        match groups.get_mut(i) {
            Some(last) => *last = bound,
            None => groups.push(bound),
        }
    }
}

/// The ground in a camera's cascades.
pub fn draw_cascades(
    view: ViewQuery<&ViewLightEntities>,
    maps: Query<(&ShadowView, &GroundCast)>,
    pipeline: Res<CastPipeline>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    for map in &view.into_inner().lights {
        if let Ok((map, cast)) = maps.get(*map) {
            draw(map, cast, &pipeline, &pipelines, &mut ctx);
        }
    }
}

/// The ground in the maps of point and spot lights.
pub fn draw_shared(
    view: ViewQuery<(&ShadowView, &GroundCast)>,
    pipeline: Res<CastPipeline>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let (map, cast) = view.into_inner();
    draw(map, cast, &pipeline, &pipelines, &mut ctx);
}

fn draw(
    map: &ShadowView,
    cast: &GroundCast,
    pipeline: &CastPipeline,
    pipelines: &PipelineCache,
    ctx: &mut RenderContext,
) {
    let group = pipeline.groups.get(cast.cache).map(|bound| &bound.group);
    let made = |holes: bool| pipeline.ids[usize::from(holes)].and_then(|id| pipelines.get_render_pipeline(id));
    // While that for holes compiles, the ground is whole.
    let made = made(cast.holes).or_else(|| made(false));
    let (Some(group), Some(made), Some(indices)) = (group, made, &pipeline.indices) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_cast"),
        color_attachments: &[],
        depth_stencil_attachment: Some(map.depth_attachment.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_cast");
    pass.set_render_pipeline(made);
    pass.set_bind_group(0, group, &[cast.offset]);
    pass.set_index_buffer(indices.slice(..), IndexFormat::Uint16);
    let quads = u32::from(QUADS);
    pass.draw_indexed(0..6 * quads * quads, 0, cast.first..cast.first + cast.count);
    span.end(&mut pass);
}
