//! The ground in Bevy's shadow maps: every cascade, face of a cube and cone in which it may stand, as a grid displaced from the cache.
//! Nothing is built before a light casts shadows over a terrain.

use bevy::camera::visibility::RenderLayers;
use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::ecs::entity::EntityHashMap;
use bevy::math::{Mat4, Vec3Swizzles, Vec4};
use bevy::pbr::{ExtractedPointLight, LightEntity, ShadowView, ViewLightEntities};
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{storage_buffer_read_only_sized, uniform_buffer};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, Buffer, BufferInitDescriptor,
    BufferUsages, CachedRenderPipelineId, CompareFunction, DepthStencilState, DynamicUniformBuffer, FragmentState,
    IndexFormat, PipelineCache, PrimitiveState, RenderPassDescriptor, RenderPipelineDescriptor, ShaderStages,
    ShaderType, StoreOp, VertexState,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::view::ExtractedView;
use bytemuck::{Pod, Zeroable};

use super::super::cache::clipmap::DrawnLevel;
use super::super::cache::{Cache, Caches};
use super::super::extract::ExtractedWorld;
use super::super::shaders::Source;
use super::super::uniforms::ClipmapUniform;
use super::super::view::ViewGround;

/// Quads along a patch's side.
const QUADS: u16 = 16;
/// The most texels along a quad's side: a patch is then a tile.
const WIDEST: i32 = 4;
/// How wide a quad should be, in texels of the shadow map: silhouettes bend by a hundredth of that over a hill that is a hundred wide.
const QUAD_IN_MAP: f32 = 16.0;
/// Quads that a vertex is pushed away from the light; as in `cast.wgsl`.
const PUSH: f32 = 2.0;

/// `Light` of `cast.wgsl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct LightUniform {
    clip_from_ground: Mat4,
    place: Vec4,
}

/// `Patch` of `cast.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Patch {
    level: u32,
    quad: i32,
    cell: [i32; 2],
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

/// The pipelines of ground without holes and with, and what they bind; none before a light asks.
#[derive(Resource)]
pub struct CastPipeline {
    layout: BindGroupLayoutDescriptor,
    ids: [Option<CachedRenderPipelineId>; 2],
    indices: Option<Buffer>,
    lights: DynamicUniformBuffer<LightUniform>,
    /// The patches of all maps of this frame.
    patches: Option<Buffer>,
    /// By cache.
    groups: Vec<Option<BindGroup>>,
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
            patches: None,
            groups: Vec::new(),
        }
    }
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

/// A light's view of the ground.
struct LightView {
    clip_from_ground: Mat4,
    place: Vec4,
    /// Metres of a texel of the map; at a metre from the light where that is a point.
    texel: f32,
    /// How far it reaches, in metres.
    range: f32,
}

impl LightView {
    /// As seen from a terrain's cache, whose centre is at `centre` in Bevy's coordinates.
    fn new(view: &ExtractedView, centre: Vec3, range: f32) -> Self {
        let clip_from_world =
            view.clip_from_world.unwrap_or_else(|| view.clip_from_view * view.world_from_view.to_matrix().inverse());
        let orthographic = view.clip_from_view.w_axis.w == 1.0;
        let place = if orthographic {
            view.world_from_view.back().extend(0.0)
        } else {
            (view.world_from_view.translation() - centre).extend(1.0)
        };
        let size = view.viewport.z.max(1) as f32;
        Self {
            clip_from_ground: clip_from_world * Mat4::from_translation(centre),
            place,
            texel: 2.0 / (view.clip_from_view.x_axis.x.abs().max(1e-9) * size),
            range,
        }
    }

    fn is_sun(&self) -> bool {
        self.place.w == 0.0
    }

    /// How wide quads should be around a point, in metres.
    fn quad_at(&self, at: Vec3) -> f32 {
        let distance = if self.is_sun() { 1.0 } else { self.place.truncate().distance(at).max(1.0) };
        QUAD_IN_MAP * self.texel * distance
    }

    /// Whether the map is of where a box stands: not only of what it may cast on.
    fn covers(&self, low: Vec3, high: Vec3) -> bool {
        let middle = self.clip_from_ground * (0.5 * (low + high)).extend(1.0);
        !self.is_sun() || middle.z <= middle.w
    }

    /// Whether a box may be seen in the map, or cast into it from before its near plane.
    fn sees(&self, low: Vec3, high: Vec3) -> bool {
        if !self.is_sun() {
            let place = self.place.truncate();
            if place.distance_squared(place.clamp(low, high)) > self.range * self.range {
                return false;
            }
        }
        let corners = (0..8).map(|i| {
            let pick = |bit: i32, low: f32, high: f32| if i & bit == 0 { low } else { high };
            self.clip_from_ground
                * Vec4::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z), 1.0)
        });
        // Outside when all corners lie beyond the same plane.
        let mut beyond = [true; 5];
        for corner in corners {
            let [x, y, z, w] = corner.to_array();
            // Reverse-z: 0 is far.
            for (all, out) in beyond.iter_mut().zip([x > w, x < -w, y > w, y < -w, z < 0.0]) {
                *all &= out;
            }
        }
        !beyond.contains(&true)
    }
}

/// The patches that a light may see, of levels whose quads are not much finer than the map. Where texels are wider than quads should
/// be, as under smooth ground, every texel is a quad; ground that only casts into the map from far away has wider ones.
fn patches(cache: &Cache, light: &LightView, heights: [f32; 2], patches: &mut Vec<Patch>) {
    let metres = |exponent: i32| (exponent as f32).exp2();
    let coarsest = cache.drawn.iter().rposition(|level| level.outer > 0.0);
    let mut inner = 0.0;
    for (i, level) in cache.drawn.iter().enumerate() {
        let texel = metres(level.exponent);
        let too_fine = light.is_sun() && WIDEST as f32 * texel < light.quad_at(Vec3::ZERO) && Some(i) != coarsest;
        if level.outer <= 0.0 || too_fine {
            continue;
        }
        let finest = inner == 0.0;
        let rim = level.outer * texel;
        let tile = i32::from(QUADS) * WIDEST;
        for corner in squares(level.low, level.high, tile) {
            let (low, high) = bounds(level, corner, tile, heights);
            // What a finer level has whole, and some to spare, so that the two overlap; and what lies beyond the rim.
            let spare = inner - 8.0 * texel;
            let hidden = low.xz().min_element() > -spare && high.xz().max_element() < spare;
            let outside = low.xz().max_element() > rim || high.xz().min_element() < -rim;
            if hidden || outside || !light.sees(low, high) {
                continue;
            }
            let wanted = light.quad_at(light.place.truncate().clamp(low, high));
            let least = if finest && light.covers(low, high) { 1 } else { WIDEST };
            let quad = [WIDEST, 2].into_iter().find(|quad| *quad as f32 * texel <= wanted).unwrap_or(1).max(least);
            let side = i32::from(QUADS) * quad;
            let end = corner.map(|c| c + tile);
            for cell in squares(corner, end, side) {
                let (low, high) = bounds(level, cell, side, heights);
                if side == tile || light.sees(low, high) {
                    patches.push(Patch { level: i as u32, quad, cell });
                }
            }
        }
        inner = rim;
    }
}

/// The first cells of the squares of so many texels in a rectangle of cells.
fn squares(low: [i32; 2], high: [i32; 2], side: i32) -> impl Iterator<Item = [i32; 2]> {
    let rows = (low[1]..high[1]).step_by(side as usize);
    rows.flat_map(move |z| (low[0]..high[0]).step_by(side as usize).map(move |x| [x, z]))
}

/// The box that a square of so many texels may fill, as it is pushed.
fn bounds(level: &DrawnLevel, cell: [i32; 2], side: i32, heights: [f32; 2]) -> (Vec3, Vec3) {
    let texel = (level.exponent as f32).exp2();
    let [x, z] = [0, 1].map(|k| (cell[k] as f32 - level.fraction[k]) * texel);
    let (width, push) = (side as f32 * texel, PUSH * WIDEST as f32 * texel);
    (Vec3::new(x, heights[0], z) - push, Vec3::new(x + width, heights[1], z + width) + push)
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
    pipeline.patches = None;
    pipeline.groups.clear();
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
        return;
    }
    pipeline.queue(&pipelines, &device, false);
    if caches.0.iter().any(Cache::holes) {
        pipeline.queue(&pipelines, &device, true);
    }
    pipeline.lights.write_buffer(&device, &queue);
    pipeline.patches = Some(device.create_buffer_with_data(&BufferInitDescriptor {
        label: Some("horizon_cast_patches"),
        contents: bytemuck::cast_slice(&all),
        usage: BufferUsages::STORAGE,
    }));
    let layout = pipelines.get_bind_group_layout(&pipeline.layout);
    for cache in &caches.0 {
        let buffers = &cache.buffers;
        let bound = (buffers.clipmap.binding(), pipeline.lights.binding(), &pipeline.patches);
        let (Some(clipmap), Some(lights), Some(patches)) = bound else { return };
        let entries = BindGroupEntries::with_indices((
            (0, clipmap),
            (1, buffers.heights.as_entire_binding()),
            (3, buffers.looks.as_entire_binding()),
            (4, patches.as_entire_binding()),
            (5, lights),
        ));
        pipeline.groups.push(Some(device.create_bind_group("horizon_cast", &layout, &entries)));
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
    let group = pipeline.groups.get(cast.cache).and_then(Option::as_ref);
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
