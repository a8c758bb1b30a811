//! Plants in Bevy's shadow maps: so meshes have their shadows, and the ground dapples beside the analytic ones. Nothing is built before
//! a light casts shadows over plants.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::ecs::entity::EntityHashMap;
use bevy::math::Vec3;
use bevy::pbr::{ExtractedPointLight, LightEntity, ShadowView, ViewLightEntities};
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, uniform_buffer, uniform_buffer_sized,
};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, BufferInitDescriptor, BufferUsages,
    CachedRenderPipelineId, CompareFunction, DepthStencilState, DynamicUniformBuffer, FragmentState, PipelineCache,
    RenderPassDescriptor, RenderPipelineDescriptor, ShaderStages, StoreOp, VertexState,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::view::ExtractedView;

use super::super::super::cache::Caches;
use super::super::super::shaders::Source;
use super::super::super::trees::{Grove, GroveUniform, Groves, ViewGrove};
use super::super::super::view::ViewGround;
use super::LightUniform;
use super::patches::LightView;

/// The most plants in one map: the nearest tiles' to the eye.
const MOST: usize = 1 << 15;
/// Vertices of a plant: a quad for each of the crown's ellipsoids, and one for the trunk.
const VERTICES: u32 = 6 * 5;

/// What plants draw into one shadow map.
#[derive(Component)]
pub struct TreeCast {
    /// Which bind group: its view's.
    group: usize,
    offset: u32,
    first: u32,
    count: u32,
}

/// The pipeline, and what it binds; none before a light asks.
#[derive(Resource)]
pub struct TreeCastPipeline {
    layout: BindGroupLayoutDescriptor,
    id: Option<CachedRenderPipelineId>,
    lights: DynamicUniformBuffer<LightUniform>,
    /// By view that sees plants.
    groups: Vec<BindGroup>,
}

impl Default for TreeCastPipeline {
    fn default() -> Self {
        let read = || storage_buffer_read_only_sized(false, None);
        let layout = BindGroupLayoutEntries::with_indices(
            ShaderStages::VERTEX,
            (
                (4, read()),
                (5, uniform_buffer::<LightUniform>(true)),
                (6, uniform_buffer::<GroveUniform>(false)),
                (7, read()),
                (8, uniform_buffer_sized(false, None)),
            ),
        );
        Self {
            layout: BindGroupLayoutDescriptor::new("horizon_cast_trees", &layout),
            id: None,
            lights: DynamicUniformBuffer::default(),
            groups: Vec::new(),
        }
    }
}

impl TreeCastPipeline {
    fn queue(&mut self, cache: &PipelineCache) {
        self.id.get_or_insert_with(|| {
            let shader = Source::CastTrees.handle();
            cache.queue_render_pipeline(RenderPipelineDescriptor {
                label: Some("horizon_cast_trees".into()),
                layout: vec![self.layout.clone()],
                vertex: VertexState { shader: shader.clone(), entry_point: Some("cast_plant".into()), ..default() },
                depth_stencil: Some(DepthStencilState {
                    format: CORE_3D_DEPTH_FORMAT,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(CompareFunction::GreaterEqual),
                    stencil: default(),
                    bias: default(),
                }),
                fragment: Some(FragmentState { shader, entry_point: Some("keep_crown".into()), ..default() }),
                ..default()
            })
        });
    }
}

/// A view whose plants cast: its grove, its eye and the centre of its cache in Bevy's coordinates, and what it binds.
struct Caster<'a> {
    grove: &'a Grove,
    seen: &'a ViewGrove,
    centre: Vec3,
    eye: Vec3,
    /// The cell that holds the centre, and where that lies in it.
    cell: [i64; 2],
    shift: [f64; 2],
}

type Maps<'w, 's> =
    Query<'w, 's, (Entity, &'static ExtractedView, &'static LightEntity, Has<TreeCast>), With<ShadowView>>;

/// Makes out which plants each shadow map may show: cascades from their own camera's grove, point and spot lights from that of the
/// nearest camera.
pub fn prepare_tree_casts(
    mut commands: Commands,
    mut pipeline: ResMut<TreeCastPipeline>,
    caches: Res<Caches>,
    groves: Res<Groves>,
    pipelines: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Query<(&ViewGround, &ViewGrove, &ExtractedView, Option<&ViewLightEntities>)>,
    points: Query<&ExtractedPointLight>,
    maps: Maps,
) {
    let pipeline = &mut *pipeline;
    pipeline.lights.clear();
    pipeline.groups.clear();
    let mut casters = Vec::new();
    let mut owned = EntityHashMap::default();
    for (ground, seen, view, lights) in &views {
        let cache = ground.cache.and_then(|cache| caches.0.get(cache));
        let (Some(cache), Some(grove), true) = (cache, groves.0.get(seen.grove), seen.grown) else { continue };
        let eye = view.world_from_view.translation();
        for light in lights.iter().flat_map(|lights| &lights.lights) {
            owned.insert(*light, casters.len());
        }
        let (cell, shift) = grove.woods().cell(cache.centre());
        casters.push(Caster { grove, seen, centre: eye - cache.eye(&ground.eye), eye, cell, shift });
    }
    let mut all = Vec::new();
    for (entity, view, light, was) in &maps {
        let (caster, range) = match light {
            LightEntity::Directional { .. } => (owned.get(&entity).copied(), f32::INFINITY),
            LightEntity::Point { light_entity, .. } | LightEntity::Spot { light_entity } => {
                let place = view.world_from_view.translation();
                let far = |i: &usize| casters[*i].eye.distance_squared(place);
                let nearest = (0..casters.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
                (nearest, points.get(*light_entity).map_or(f32::INFINITY, |point| point.range))
            }
        };
        let first = all.len() as u32;
        let light = caster.map(|group| {
            let caster = &casters[group];
            let light = LightView::new(view, caster.centre, range);
            caster.gather(&light, &mut all);
            (group, light)
        });
        let count = all.len() as u32 - first;
        match light.filter(|_| count > 0) {
            Some((group, LightView { clip_from_ground, place, .. })) => {
                let offset = pipeline.lights.push(&LightUniform { clip_from_ground, place });
                commands.entity(entity).insert(TreeCast { group, offset, first, count });
            }
            None if was => {
                commands.entity(entity).remove::<TreeCast>();
            }
            None => {}
        }
    }
    if all.is_empty() {
        return;
    }
    pipeline.queue(&pipelines);
    pipeline.lights.write_buffer(&device, &queue);
    let standing = device.create_buffer_with_data(&BufferInitDescriptor {
        label: Some("horizon_cast_standing"),
        contents: bytemuck::cast_slice(&all),
        usage: BufferUsages::STORAGE,
    });
    let Some(lights) = pipeline.lights.binding() else { return };
    let layout = pipelines.get_bind_group_layout(&pipeline.layout);
    for caster in &casters {
        let entries = BindGroupEntries::with_indices((
            (4, standing.as_entire_binding()),
            (5, lights.clone()),
            (6, caster.seen.window.as_entire_binding()),
            (7, caster.grove.tiles.as_entire_binding()),
            (8, caster.grove.forest.as_entire_binding()),
        ));
        pipeline.groups.push(device.create_bind_group("horizon_cast_trees", &layout, &entries));
    }
}

impl Caster<'_> {
    /// The cells of the plants that a light may see, relative to the centre's, of the tiles nearest to the eye.
    fn gather(&self, light: &LightView, all: &mut Vec<u32>) {
        let spacing = self.grove.woods().spacing();
        let from_centre =
            |cell: i64, axis: usize| (cell.wrapping_sub(self.cell[axis]) as f64 * spacing - self.shift[axis]) as f32;
        let eye = self.eye - self.centre;
        let mut tiles: Vec<_> = self
            .grove
            .standing()
            .filter_map(|tile| {
                let [x, z] = [0, 1].map(|axis| from_centre(tile.corner[axis], axis));
                // Crowns reach half a cell out.
                let (out, width) = (0.5 * spacing as f32, 32.5 * spacing as f32);
                let low = Vec3::new(x - out, tile.heights[0], z - out);
                let high = Vec3::new(x + width, tile.heights[1], z + width);
                light.sees(low, high).then(|| (eye.clamp(low, high).distance_squared(eye), tile))
            })
            .collect();
        tiles.sort_by(|a, b| a.0.total_cmp(&b.0));
        let end = all.len() + MOST;
        for (_, tile) in tiles {
            let corner = [0, 1].map(|axis| tile.corner[axis].wrapping_sub(self.cell[axis]));
            for cell in &tile.cells {
                let [x, z] = [corner[0] + i64::from(cell % 32), corner[1] + i64::from(cell / 32)];
                if let (Ok(x), Ok(z), true) = (i16::try_from(x), i16::try_from(z), all.len() < end) {
                    all.push(u32::from(x as u16) | u32::from(z as u16) << 16);
                }
            }
        }
    }
}

/// Plants in a camera's cascades.
pub fn draw_trees_in_cascades(
    view: ViewQuery<&ViewLightEntities>,
    maps: Query<(&ShadowView, &TreeCast)>,
    pipeline: Res<TreeCastPipeline>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    for map in &view.into_inner().lights {
        if let Ok((map, cast)) = maps.get(*map) {
            draw(map, cast, &pipeline, &pipelines, &mut ctx);
        }
    }
}

/// Plants in the maps of point and spot lights.
pub fn draw_trees_in_shared(
    view: ViewQuery<(&ShadowView, &TreeCast)>,
    pipeline: Res<TreeCastPipeline>,
    pipelines: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    let (map, cast) = view.into_inner();
    draw(map, cast, &pipeline, &pipelines, &mut ctx);
}

fn draw(
    map: &ShadowView,
    cast: &TreeCast,
    pipeline: &TreeCastPipeline,
    pipelines: &PipelineCache,
    ctx: &mut RenderContext,
) {
    let made = pipeline.id.and_then(|id| pipelines.get_render_pipeline(id));
    let Some((group, made)) = pipeline.groups.get(cast.group).zip(made) else { return };
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_cast_trees"),
        color_attachments: &[],
        depth_stencil_attachment: Some(map.depth_attachment.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_cast_trees");
    pass.set_render_pipeline(made);
    pass.set_bind_group(0, group, &[cast.offset]);
    pass.draw(0..VERTICES, cast.first..cast.first + cast.count);
    span.end(&mut pass);
}
