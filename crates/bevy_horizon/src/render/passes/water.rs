//! Water, after Bevy's opaque meshes and before the air: over a copy of what was drawn, with depth.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::ecs::query::QueryData;
use bevy::pbr::deferred::DeferredLightingLayout;
use bevy::pbr::{MeshPipelineKey, MeshViewBindGroup, ViewKeyCache};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{
    sampler, storage_buffer_read_only_sized, texture_2d, texture_2d_array, texture_3d, texture_depth_2d,
    texture_depth_2d_multisampled, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroup, BindGroupLayoutDescriptor, CachedRenderPipelineId, DynamicBindGroupEntries,
    DynamicBindGroupLayoutEntries, Extent3d, PipelineCache, RenderPassDescriptor, SamplerBindingType, ShaderStages,
    StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureSampleType, TextureUsages,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::texture::{CachedTexture, TextureCache};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewTarget};

use super::super::air::ViewAir;
use super::super::cache::Caches;
use super::super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use super::super::shaders::{Source, WaterSky};
use super::super::uniforms::{AirUniform, ClipmapUniform, GradientUniform, HorizonViewUniform};
use super::super::view::{HorizonViews, ViewGround, ViewSky};
use super::super::water::{HorizonWaters, WaterMasks, WatersUniform};
use super::super::waves::SeaTiles;
use super::lit;
use super::target::DrawnTarget;
use crate::camera::DebugView;

/// What decides which text the shader has, and what is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Variant {
    sky: WaterSky,
    multisampled: bool,
    waves: bool,
    ground: bool,
}

impl Variant {
    fn source(self) -> Source {
        let Self { sky, multisampled, waves, ground } = self;
        Source::Water { sky, multisampled, waves, ground }
    }

    fn layout(self) -> BindGroupLayoutDescriptor {
        let read = || storage_buffer_read_only_sized(false, None);
        let float = || TextureSampleType::Float { filterable: true };
        let filtering = || sampler(SamplerBindingType::Filtering);
        let mut entries = DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (2, if self.multisampled { texture_depth_2d_multisampled() } else { texture_depth_2d() }),
                (5, uniform_buffer::<HorizonViewUniform>(true)),
                (20, uniform_buffer::<WatersUniform>(true)),
                (24, texture_2d(TextureSampleType::Float { filterable: false })),
                (25, texture_2d_array(TextureSampleType::Float { filterable: false })),
            ),
        );
        if self.ground {
            entries = entries.extend_with_indices((
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (3, read()),
                (4, read()),
            ));
        }
        if self.waves {
            entries = entries.extend_with_indices((
                (21, texture_2d_array(float())),
                (22, texture_2d_array(float())),
                (23, filtering()),
            ));
        }
        match self.sky {
            WaterSky::Nothing => {}
            WaterSky::Gradient => {
                entries = entries.extend_with_indices(((13, uniform_buffer::<GradientUniform>(true)),));
            }
            WaterSky::Air => {
                entries = entries.extend_with_indices((
                    (13, uniform_buffer::<AirUniform>(true)),
                    (15, read()),
                    (16, texture_3d(float())),
                    (17, texture_3d(float())),
                    (18, filtering()),
                ));
            }
        }
        BindGroupLayoutDescriptor::new("horizon_water", &entries)
    }
}

/// The pipelines that views asked for.
#[derive(Resource, Default)]
pub struct WaterPipelines(HashMap<(MeshPipelineKey, Variant), CachedRenderPipelineId>);

impl WaterPipelines {
    fn get(
        &mut self,
        cache: &PipelineCache,
        bevy: &DeferredLightingLayout,
        key: MeshPipelineKey,
        variant: Variant,
    ) -> CachedRenderPipelineId {
        *self.0.entry((key, variant)).or_insert_with(|| {
            let shader = variant.source().handle();
            let mut descriptor = lit::pipeline(bevy, key, "horizon_water", 1, variant.layout(), shader, "water");
            descriptor.depth_stencil = lit::depth();
            let fragment = descriptor.fragment.as_mut().expect("lighting has a fragment shader");
            for target in fragment.targets.iter_mut().flatten() {
                target.blend = None;
            }
            cache.queue_render_pipeline(descriptor)
        })
    }
}

/// What draws a view's water.
#[derive(Component)]
pub struct ViewWater {
    variant: Variant,
    pipeline: CachedRenderPipelineId,
    offset: u32,
    /// What was drawn before: colour, and depth.
    colour: CachedTexture,
    depth: CachedTexture,
    group: Option<BindGroup>,
}

/// Water is drawn over copies of colour and depth: the view's textures must allow them. These are the renderer's copies of the
/// components, not the game's.
pub fn copy_depth(mut views: Query<(&mut Camera3d, &ExtractedHorizonCamera)>, world: Res<ExtractedWorld>) {
    for (mut camera, horizon) in &mut views {
        if world.has_water(&horizon.layers) {
            let usages = TextureUsages::from(camera.depth_texture_usages) | TextureUsages::COPY_SRC;
            camera.depth_texture_usages = usages.into();
        }
    }
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static ViewGround,
        &'static ExtractedView,
        &'static ExtractedHorizonCamera,
        &'static ViewTarget,
        &'static ViewDepthTexture,
        &'static Msaa,
    ),
>;

/// Asks for what draws the views' water.
pub fn prepare_waters(
    mut commands: Commands,
    mut pipelines: ResMut<WaterPipelines>,
    mut waters: ResMut<HorizonWaters>,
    mut masks: ResMut<WaterMasks>,
    mut textures: ResMut<TextureCache>,
    world: Res<ExtractedWorld>,
    tiles: Option<Res<SeaTiles>>,
    cache: Res<PipelineCache>,
    bevy: Option<Res<DeferredLightingLayout>>,
    keys: Res<ViewKeyCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Views,
) {
    waters.clear();
    if !world.waters.is_empty() {
        masks.prepare(&world, &device, &queue);
    }
    for (entity, ground, view, camera, target, depth, msaa) in &views {
        let shown = camera.camera.debug == DebugView::None && world.has_water(&camera.layers);
        let key = keys.get(&view.retained_view_entity).filter(|_| shown);
        let (Some(&key), Some(bevy)) = (key, &bevy) else {
            commands.entity(entity).remove::<ViewWater>();
            continue;
        };
        let uniform = WatersUniform::new(&world, &masks, camera, view);
        let variant = Variant {
            sky: match &ground.sky {
                None => WaterSky::Nothing,
                Some(ViewSky::Gradient(_)) => WaterSky::Gradient,
                Some(ViewSky::Air { .. }) => WaterSky::Air,
            },
            multisampled: msaa.samples() > 1,
            waves: tiles.is_some() && uniform.moves(),
            ground: ground.cache.is_some(),
        };
        let size = target.main_texture().size();
        let mut copy = |label, format: TextureFormat, samples, size: Extent3d| {
            textures.get(
                &device,
                TextureDescriptor {
                    label: Some(label),
                    size,
                    mip_level_count: 1,
                    sample_count: samples,
                    dimension: TextureDimension::D2,
                    format,
                    // Where there is more than one sample a texture must be an attachment.
                    usage: TextureUsages::COPY_DST | TextureUsages::TEXTURE_BINDING | TextureUsages::RENDER_ATTACHMENT,
                    view_formats: &[],
                },
            )
        };
        let colour = copy("horizon_drawn", target.main_texture_format(), 1, size);
        let depth = copy("horizon_drawn_depth", CORE_3D_DEPTH_FORMAT, msaa.samples(), depth.texture.size());
        let pipeline = pipelines.get(&cache, bevy, key, variant);
        let offset = waters.push(&uniform);
        commands.entity(entity).insert(ViewWater { variant, pipeline, offset, colour, depth, group: None });
    }
    waters.write(&device, &queue);
}

pub fn bind_waters(
    mut views: Query<(&mut ViewWater, &ViewGround, Option<&ViewAir>)>,
    uniforms: Res<HorizonViews>,
    waters: Res<HorizonWaters>,
    masks: Res<WaterMasks>,
    tiles: Option<Res<SeaTiles>>,
    caches: Res<Caches>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    for (mut water, ground, air) in &mut views {
        let variant = water.variant;
        let (Some(view), Some(bodies), Some(masks)) = (uniforms.views.binding(), waters.binding(), masks.view()) else {
            continue;
        };
        let mut entries = DynamicBindGroupEntries::new_with_indices((
            (2, &water.depth.default_view),
            (5, view),
            (20, bodies),
            (24, &water.colour.default_view),
            (25, masks),
        ))
        .to_vec();
        let buffers = ground.cache.and_then(|index| caches.0.get(index)).map(|cache| &cache.buffers);
        if variant.ground {
            let Some((buffers, clipmap)) = buffers.and_then(|buffers| Some((buffers, buffers.clipmap.binding()?)))
            else {
                continue;
            };
            entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices((
                (0, clipmap),
                (1, buffers.heights.as_entire_binding()),
                (3, buffers.looks.as_entire_binding()),
                (4, buffers.bounds.as_entire_binding()),
            )));
        }
        if variant.waves {
            let Some(tiles) = &tiles else { continue };
            entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices((
                (21, &tiles.surface),
                (22, &tiles.moments),
                (23, &tiles.sampler),
            )));
        }
        match variant.sky {
            WaterSky::Nothing => {}
            WaterSky::Gradient => {
                let Some(gradient) = uniforms.gradients.binding() else { continue };
                entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices(((13, gradient),)));
            }
            WaterSky::Air => {
                let (Some(uniform), Some(air)) = (uniforms.airs.binding(), air) else { continue };
                let (sky, light, through, sampler) = air.drawn();
                entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices((
                    (13, uniform),
                    (15, sky.as_entire_binding()),
                    (16, light),
                    (17, through),
                    (18, sampler),
                )));
            }
        }
        // wgpu checks dynamic offsets in the order of the entries, and takes them in that of the bindings.
        entries.sort_by_key(|entry| entry.binding);
        let layout = cache.get_bind_group_layout(&variant.layout());
        let group = device.create_bind_group("horizon_water", &layout, &entries);
        water.group = Some(group);
    }
}

/// What the pass needs of a view.
#[derive(QueryData)]
pub struct WateredView {
    drawn: DrawnTarget,
    target: &'static ViewTarget,
    depth: &'static ViewDepthTexture,
    water: &'static ViewWater,
    ground: &'static ViewGround,
    bevy: &'static MeshViewBindGroup,
}

/// Draws water over what was drawn.
pub fn draw_water(view: ViewQuery<WateredView>, pipelines: Res<PipelineCache>, mut ctx: RenderContext) {
    let WateredViewItem { drawn, target, depth, water, ground, bevy } = view.into_inner();
    let Some((pipeline, group)) = pipelines.get_render_pipeline(water.pipeline).zip(water.group.as_ref()) else {
        return;
    };
    let colour = target.main_texture();
    ctx.command_encoder().copy_texture_to_texture(
        colour.as_image_copy(),
        water.colour.texture.as_image_copy(),
        colour.size(),
    );
    ctx.command_encoder().copy_texture_to_texture(
        depth.texture.as_image_copy(),
        water.depth.texture.as_image_copy(),
        depth.texture.size(),
    );
    let diagnostics = ctx.diagnostic_recorder();
    let diagnostics = diagnostics.as_deref();
    let mut pass = ctx.begin_tracked_render_pass(RenderPassDescriptor {
        label: Some("horizon_water"),
        color_attachments: &[Some(target.get_color_attachment())],
        depth_stencil_attachment: Some(depth.get_attachment(StoreOp::Store)),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let span = diagnostics.pass_span(&mut pass, "horizon_water");
    if let Some(viewport) = drawn.viewport() {
        pass.set_camera_viewport(&viewport);
    }
    let [own, sky, _] = ground.offsets;
    // In the order of their bindings.
    let mut offsets = vec![own];
    offsets.extend((water.variant.sky != WaterSky::Nothing).then_some(sky));
    offsets.push(water.offset);
    pass.set_render_pipeline(pipeline);
    pass.set_bind_group(0, &bevy.main, &bevy.main_offsets);
    pass.set_bind_group(1, group, &offsets);
    pass.draw(0..3, 0..1);
    span.end(&mut pass);
}
