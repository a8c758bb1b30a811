//! The ground in Bevy's shadow maps: every cascade, face of a cube and cone in which it may stand, as a grid displaced from the cache.
//! Nothing is built before a light casts shadows over a terrain.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::math::{Mat4, Vec4};
use bevy::pbr::{ShadowView, ViewLightEntities};
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

use super::super::cache::{Cache, Caches};
use super::super::shaders::Source;
use super::super::uniforms::ClipmapUniform;
use super::super::view::ViewGround;

/// Quads along a patch's side, and texels along a quad's: a patch is a tile.
const QUADS: u16 = 16;
const QUAD_TEXELS: f32 = 4.0;
/// How wide a quad should be, in texels of the shadow map: silhouettes bend by a hundredth of that over a hill that is a hundred wide.
const QUAD_IN_MAP: f32 = 8.0;

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
    padding: u32,
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
}

impl LightView {
    /// As seen from a terrain's cache, whose centre is at `centre` in Bevy's coordinates.
    fn new(view: &ExtractedView, centre: Vec3) -> Self {
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
        }
    }

    /// Whether a box may be seen in the map, or cast into it from before its near plane.
    fn sees(&self, low: Vec3, high: Vec3) -> bool {
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

/// The tiles that a light may see, of levels whose quads are not much finer than the map.
fn patches(cache: &Cache, light: &LightView, heights: [f32; 2], patches: &mut Vec<Patch>) {
    let drawn = &cache.drawn;
    let metres = |exponent: i32| (exponent as f32).exp2();
    let fine_enough = |exponent: i32| QUAD_TEXELS * metres(exponent) >= QUAD_IN_MAP * light.texel;
    let is_map = light.place.w == 0.0;
    let usable = |i: &usize| drawn[*i].outer > 0.0 && (!is_map || fine_enough(drawn[*i].exponent));
    let levels: Vec<usize> = (0..drawn.len()).filter(usable).collect();
    let mut inner = 0.0;
    for &i in &levels {
        let level = &drawn[i];
        let texel = metres(level.exponent);
        let [low, high] = [level.low, level.high];
        for z in (low[1]..high[1]).step_by(64) {
            for x in (low[0]..high[0]).step_by(64) {
                let from = [x, z].map(|c| c as f32);
                let fraction = level.fraction;
                let min = [0, 1].map(|k| (from[k] - fraction[k]) * texel);
                let max = min.map(|m| m + 64.0 * texel);
                // A tile that a finer level has whole, and some to spare, so that the two overlap.
                let hidden = (0..2).all(|k| min[k] > -inner + texel * 8.0 && max[k] < inner - texel * 8.0);
                let outside = (0..2).any(|k| min[k] > level.outer * texel || max[k] < -level.outer * texel);
                if hidden || outside {
                    continue;
                }
                let push = 2.0 * QUAD_TEXELS * texel;
                let low = Vec3::new(min[0], heights[0] - push, min[1]) - Vec3::new(push, 0.0, push);
                let high = Vec3::new(max[0], heights[1] + push, max[1]) + Vec3::new(push, 0.0, push);
                if light.sees(low, high) {
                    patches.push(Patch { level: i as u32, padding: 0, cell: [x, z] });
                }
            }
        }
        inner = level.outer * texel;
    }
}

type Maps<'w, 's> = Query<'w, 's, (Entity, &'static ExtractedView), With<ShadowView>>;

/// Makes out what of the ground each shadow map may show: cascades from their own camera's cache, point and spot lights from the
/// first.
pub fn prepare_casts(
    mut commands: Commands,
    mut pipeline: ResMut<CastPipeline>,
    caches: Res<Caches>,
    pipelines: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Query<(&ViewGround, &ExtractedView, Option<&ViewLightEntities>)>,
    maps: Maps,
) {
    let pipeline = &mut *pipeline;
    pipeline.lights.clear();
    pipeline.patches = None;
    pipeline.groups.clear();
    let mut all = Vec::new();
    let mut casting = Vec::new();
    let mut owned = Vec::new();
    let mut first = None;
    for (ground, view, lights) in &views {
        let Some(index) = ground.cache else { continue };
        // The cache's centre, in Bevy's coordinates.
        let centre = view.world_from_view.translation() - caches.0[index].eye(&ground.eye);
        first = first.or(Some((index, centre)));
        let lights = lights.map_or(&[][..], |lights| &lights.lights);
        owned.extend_from_slice(lights);
        casting.extend(lights.iter().map(|light| (*light, index, centre)));
    }
    let shared = maps.iter().map(|(entity, _)| entity).filter(|entity| !owned.contains(entity));
    casting.extend(shared.filter_map(|light| first.map(|(index, centre)| (light, index, centre))));
    for (entity, _) in &maps {
        commands.entity(entity).remove::<GroundCast>();
    }
    for (entity, index, centre) in casting {
        let Ok((_, view)) = maps.get(entity) else { continue };
        let light = LightView::new(view, centre);
        let from = all.len() as u32;
        let cache = &caches.0[index];
        patches(cache, &light, cache.heights(), &mut all);
        let count = all.len() as u32 - from;
        if count > 0 {
            let offset =
                pipeline.lights.push(&LightUniform { clip_from_ground: light.clip_from_ground, place: light.place });
            commands.entity(entity).insert(GroundCast {
                cache: index,
                offset,
                first: from,
                count,
                holes: cache.holes(),
            });
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
