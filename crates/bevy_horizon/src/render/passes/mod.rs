//! The passes of a view: the ground's geometry before the main pass, so that depth sorts it among what Bevy draws; its light, before
//! Bevy's opaque meshes; the air after them, over all.

mod cast;
mod clearance;
mod draw;
mod geometry;
mod lit;
mod pipelines;
mod shade;
mod target;
mod tree_motion;
mod trees;
mod water;

use bevy::app::SubApp;
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::core_3d::{main_opaque_pass_3d, main_transparent_pass_3d};
use bevy::core_pipeline::mip_generation::experimental::depth::early_downsample_depth;
use bevy::core_pipeline::prepass::node::late_prepass;
use bevy::core_pipeline::schedule::Core3dSystems;
use bevy::core_pipeline::tonemapping::{Tonemapping, TonemappingLuts, get_lut_bindings};
use bevy::pbr::{
    LATE_SHADOW_PASS, main_transmissive_pass_3d, per_view_shadow_pass, screen_space_reflections, shared_shadow_pass,
};
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::render_asset::RenderAssets;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, Buffer, BufferInitDescriptor, BufferUsages, CachedRenderPipelineId,
    DynamicBindGroupEntries, PipelineCache, TextureUsages,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::texture::{FallbackImage, GpuImage};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewUniforms};

pub use self::cast::{
    CastPipeline, PUSH as CAST_PUSH, QUADS as CAST_QUADS, TreeCastPipeline, prepare_casts, prepare_tree_casts,
};
pub use self::clearance::{ClearancePipeline, Table, ViewClearance};
pub use self::geometry::{GeometryPipelines, ViewGeometry, bind_geometry, prepare_geometry};
pub use self::pipelines::PassPipelines;
use self::pipelines::{Pass, PassKey, Variant};
pub use self::shade::{ShadePipelines, ViewShade, bind_shade, prepare_shade};
pub use self::trees::{TreePipelines, ViewTrees, bind_trees, prepare_trees};
pub use self::water::{ViewWater, WaterPipelines, bind_waters, copy_depth, prepare_waters};
use super::air::{AirTables, ViewAir};
use super::cache::Caches;
use super::extract::ExtractedHorizonCamera;
use super::view::{HorizonViews, ViewGround, ViewSky};
use crate::camera::DebugView;
use crate::world::SkyModel;

/// A view's debug view and air: pipelines, and what they bind.
#[derive(Component, Default)]
pub struct ViewPasses {
    ldr: bool,
    /// By [`Pass`].
    pipelines: [Option<CachedRenderPipelineId>; 4],
    groups: [Option<BindGroup>; 4],
    /// Whether the air has tables.
    air: bool,
}

/// The true distance along each pixel's ray, row by row, for the debug view of errors: 0 where it is not known, infinite where
/// there is no ground.
#[derive(Component)]
pub struct ViewTruths(pub Buffer);

impl ViewTruths {
    fn unknown(device: &RenderDevice) -> Self {
        Self(device.create_buffer_with_data(&BufferInitDescriptor {
            label: Some("horizon_no_truths"),
            contents: &[0; 4],
            usage: BufferUsages::STORAGE,
        }))
    }
}

/// Adds the ground's passes to the schedule of 3D views.
pub fn add_ground(render_app: &mut SubApp) {
    render_app.add_systems(
        Core3d,
        (
            geometry::draw_geometry.after(early_downsample_depth).before(late_prepass).in_set(Core3dSystems::Prepass),
            (cast::draw_cascades, cast::draw_trees_in_cascades)
                .chain()
                .after(per_view_shadow_pass::<LATE_SHADOW_PASS>)
                .before(Core3dSystems::MainPass),
            (cast::draw_shared, cast::draw_trees_in_shared)
                .chain()
                .after(shared_shadow_pass::<LATE_SHADOW_PASS>)
                .before(Core3dSystems::MainPass),
            (
                shade::draw_shade.before(screen_space_reflections),
                trees::draw_trees.after(screen_space_reflections),
                draw::draw_heat,
            )
                .chain()
                .before(main_opaque_pass_3d)
                .in_set(Core3dSystems::MainPass),
            water::draw_water
                .after(main_opaque_pass_3d)
                .before(draw::draw_sky)
                .before(main_transmissive_pass_3d)
                .before(main_transparent_pass_3d)
                .in_set(Core3dSystems::MainPass),
        ),
    );
}

/// Adds the air's pass.
pub fn add_sky(render_app: &mut SubApp) {
    let pass =
        draw::draw_sky.after(main_opaque_pass_3d).before(main_transmissive_pass_3d).before(main_transparent_pass_3d);
    render_app.add_systems(Core3d, pass.in_set(Core3dSystems::MainPass));
}

/// The sky reads the view's depth, and plants take a copy of it: its texture must allow both. This is the renderer's copy of the component, not the game's.
pub fn read_depth(mut views: Query<&mut Camera3d, With<ExtractedHorizonCamera>>) {
    for mut camera in &mut views {
        let usages = TextureUsages::from(camera.depth_texture_usages);
        let usages = usages | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        camera.depth_texture_usages = usages.into();
    }
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static ViewGround,
        &'static ExtractedView,
        &'static ExtractedCamera,
        &'static ExtractedHorizonCamera,
        &'static Msaa,
        Option<&'static Tonemapping>,
    ),
>;

pub fn prepare_pipelines(
    mut commands: Commands,
    mut pipelines: ResMut<PassPipelines>,
    cache: Res<PipelineCache>,
    views: Views,
) {
    for (entity, ground, view, camera, horizon, msaa, tonemapping) in &views {
        let key = PassKey {
            format: view.target_format,
            samples: msaa.samples(),
            tonemapping: tonemapping.copied().filter(|_| !camera.hdr),
            air: ground.sky.as_ref().map_or(SkyModel::Gradient, ViewSky::model),
        };
        let air = key.air != SkyModel::Gradient;
        let heat = ground.cache.is_some() && horizon.camera.debug != DebugView::None;
        let mut get = |wanted: bool, pass| wanted.then(|| pipelines.get(&cache, pass, key));
        commands.entity(entity).insert(ViewPasses {
            ldr: key.tonemapping.is_some(),
            // In the order of `Pass::ALL`.
            pipelines: [
                get(heat, Pass::Heat),
                get(air, Pass::Veil),
                get(ground.sky.is_some(), Pass::Haze),
                get(ground.sky.is_some(), Pass::Sky),
            ],
            groups: [const { None }; 4],
            air,
        });
    }
}

type BindViews<'w, 's> = Query<
    'w,
    's,
    (
        &'static mut ViewPasses,
        &'static ViewGround,
        Option<&'static ViewClearance>,
        Option<&'static ViewTruths>,
        Option<&'static ViewAir>,
        &'static ViewDepthTexture,
        Option<&'static Tonemapping>,
        &'static Msaa,
    ),
>;

/// Bevy's tonemapping, for LDR views.
#[derive(bevy::ecs::system::SystemParam)]
pub struct Tonemappers<'w> {
    images: Res<'w, RenderAssets<GpuImage>>,
    luts: Res<'w, TonemappingLuts>,
    fallback: Res<'w, FallbackImage>,
    views: Res<'w, ViewUniforms>,
}

pub fn prepare_bind_groups(
    mut views: BindViews,
    uniforms: Res<HorizonViews>,
    caches: Res<Caches>,
    pipelines: Res<PassPipelines>,
    airs: Res<AirTables>,
    pipeline_cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    tonemappers: Tonemappers,
) {
    for (mut passes, ground, clearance, truths, air, depth, tonemapping, msaa) in &mut views {
        let (Some(view), Some(bevy_view)) = (uniforms.views.binding(), tonemappers.views.uniforms.binding()) else {
            continue;
        };
        let ldr = passes.ldr;
        let lut = get_lut_bindings(
            &tonemappers.images,
            &tonemappers.luts,
            tonemapping.unwrap_or(&Tonemapping::None),
            &tonemappers.fallback,
        );
        let multisampled = msaa.samples() > 1;
        let lit = passes.air;
        let create = |pass: Pass, entries: &[BindGroupEntry]| {
            let mut entries = entries.to_vec();
            if ldr {
                let tonemapping =
                    DynamicBindGroupEntries::new_with_indices(((10, bevy_view.clone()), (11, lut.0), (12, lut.1)));
                entries.extend_from_slice(&tonemapping);
            }
            let variant = Variant { ldr, multisampled, air: lit };
            let layout = pipeline_cache.get_bind_group_layout(pipelines.layout(pass, variant));
            device.create_bind_group("horizon_pass", &layout, &entries)
        };
        let table = match ground.sky {
            Some(ViewSky::Air { table, .. }) => airs.buffers(table),
            _ => None,
        };
        let tables = uniforms.airs.binding().zip(table);
        if passes.pipelines[Pass::Heat as usize].is_some()
            && let Some(cache) = ground.cache.and_then(|cache| caches.0.get(cache))
            && let Some(clipmap) = cache.buffers.clipmap.binding()
            && let Some(clearance) = clearance
        {
            let buffers = &cache.buffers;
            let unknown = ViewTruths::unknown(&device);
            let ViewTruths(truths) = truths.unwrap_or(&unknown);
            let entries = DynamicBindGroupEntries::new_with_indices((
                (0, clipmap),
                (1, buffers.heights.as_entire_binding()),
                (2, buffers.bounds.as_entire_binding()),
                (3, buffers.looks.as_entire_binding()),
                (5, view.clone()),
                (6, clearance.buffer().as_entire_binding()),
                (9, truths.as_entire_binding()),
            ));
            passes.groups[Pass::Heat as usize] = Some(create(Pass::Heat, &entries));
        }
        let shared =
            |uniform| DynamicBindGroupEntries::new_with_indices(((0, view.clone()), (1, uniform), (2, depth.view())));
        match (&ground.sky, uniforms.gradients.binding()) {
            (Some(ViewSky::Gradient(_)), Some(gradient)) => {
                let entries = shared(gradient);
                for pass in [Pass::Haze, Pass::Sky] {
                    passes.groups[pass as usize] = Some(create(pass, &entries));
                }
            }
            (Some(ViewSky::Air { .. }), _) => {
                let (Some((uniform, [transmittances, multiple])), Some(air)) = (&tables, air) else { continue };
                let (sky, light, through, sampler) = air.drawn();
                let mut entries = shared(uniform.clone()).to_vec();
                entries.extend_from_slice(&DynamicBindGroupEntries::new_with_indices((
                    (3, transmittances.as_entire_binding()),
                    (4, multiple.as_entire_binding()),
                    (5, sky.as_entire_binding()),
                    (6, light),
                    (7, through),
                    (8, sampler),
                )));
                for pass in [Pass::Veil, Pass::Haze, Pass::Sky] {
                    passes.groups[pass as usize] = Some(create(pass, &entries));
                }
            }
            _ => {}
        }
    }
}
