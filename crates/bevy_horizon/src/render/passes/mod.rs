//! The passes of a view: the ground before Bevy's opaque meshes, so that depth sorts the two; the air after them, over
//! both.

mod clearance;
mod draw;
mod pipelines;
mod scaled;

use bevy::app::SubApp;
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::core_3d::{main_opaque_pass_3d, main_transparent_pass_3d};
use bevy::core_pipeline::schedule::Core3dSystems;
use bevy::core_pipeline::tonemapping::{Tonemapping, TonemappingLuts, get_lut_bindings};
use bevy::pbr::{main_transmissive_pass_3d, screen_space_reflections};
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::render_asset::RenderAssets;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, Buffer, BufferInitDescriptor, BufferUsages, CachedRenderPipelineId,
    DynamicBindGroupEntries, PipelineCache, TextureUsages,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::texture::{FallbackImage, GpuImage, TextureCache};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewUniforms};

pub use self::clearance::{ClearancePipeline, Table, ViewClearance};
pub use self::pipelines::PassPipelines;
use self::pipelines::{Pass, PassKey, Variant};
use self::scaled::Scaled;
use super::air::{AirTables, ViewAir};
use super::cache::Caches;
use super::extract::ExtractedHorizonCamera;
use super::view::{HorizonViews, ViewGround, ViewSky};
use crate::camera::DebugView;
use crate::world::SkyModel;

/// A view's passes: pipelines, bind groups and the offsets into them.
#[derive(Component, Default)]
pub struct ViewPasses {
    ldr: bool,
    /// By [`Pass`].
    pipelines: [Option<CachedRenderPipelineId>; 5],
    groups: [Option<BindGroup>; 5],
    clearance: Option<BindGroup>,
    scaled: Option<Scaled>,
    heat: bool,
    /// Whether the ground is lit by air that has tables.
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

/// Adds the ground's pass to the schedule of 3D views.
pub fn add_ground(render_app: &mut SubApp) {
    render_app.add_systems(
        Core3d,
        draw::draw_ground.after(screen_space_reflections).before(main_opaque_pass_3d).in_set(Core3dSystems::MainPass),
    );
}

/// Adds the air's pass.
pub fn add_sky(render_app: &mut SubApp) {
    let pass =
        draw::draw_sky.after(main_opaque_pass_3d).before(main_transmissive_pass_3d).before(main_transparent_pass_3d);
    render_app.add_systems(Core3d, pass.in_set(Core3dSystems::MainPass));
}

/// The sky reads the view's depth: its texture must allow it. This is the renderer's copy of the component, not the game's.
pub fn read_depth(mut views: Query<&mut Camera3d, With<ExtractedHorizonCamera>>) {
    for mut camera in &mut views {
        let usages = TextureUsages::from(camera.depth_texture_usages) | TextureUsages::TEXTURE_BINDING;
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
    mut textures: ResMut<TextureCache>,
    device: Res<RenderDevice>,
    mut pipelines: ResMut<PassPipelines>,
    cache: Res<PipelineCache>,
    views: Views,
) {
    for (entity, ground, view, camera, horizon, msaa, tonemapping) in &views {
        let key = PassKey {
            format: view.target_format,
            samples: msaa.samples(),
            tonemapping: tonemapping.copied().filter(|_| !camera.hdr),
            heat: horizon.camera.debug != DebugView::None,
            air: ground.sky.as_ref().map_or(SkyModel::Gradient, ViewSky::model),
        };
        let air = key.air != SkyModel::Gradient;
        let scaled = ground.cache.and(ground.scaled);
        let ground_key = PassKey { samples: if scaled.is_some() { 1 } else { key.samples }, ..key };
        commands.entity(entity).insert(ViewPasses {
            ldr: key.tonemapping.is_some(),
            pipelines: [
                ground.cache.map(|_| pipelines.get(&cache, Pass::Ground, ground_key)),
                scaled.map(|_| pipelines.get(&cache, Pass::Upsample, key)),
                air.then(|| pipelines.get(&cache, Pass::Veil, PassKey { heat: false, ..key })),
                ground.sky.is_some().then(|| pipelines.get(&cache, Pass::Haze, PassKey { heat: false, ..key })),
                ground.sky.is_some().then(|| pipelines.get(&cache, Pass::Sky, PassKey { heat: false, ..key })),
            ],
            groups: [const { None }; 5],
            clearance: None,
            scaled: scaled.map(|size| Scaled::new(size, key.format, &mut textures, &device)),
            heat: key.heat,
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
    clearances: Res<ClearancePipeline>,
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
        let (heat, scaled, lit) = (passes.heat, passes.scaled.is_some(), passes.air);
        let create = |pass: Pass, entries: &[BindGroupEntry]| {
            let mut entries = entries.to_vec();
            if ldr {
                let tonemapping =
                    DynamicBindGroupEntries::new_with_indices(((10, bevy_view.clone()), (11, lut.0), (12, lut.1)));
                entries.extend_from_slice(&tonemapping);
            }
            let variant = Variant {
                ldr,
                multisampled: multisampled && !(scaled && pass == Pass::Ground),
                heat: heat && !pass.is_air(),
                air: lit,
            };
            let layout = pipeline_cache.get_bind_group_layout(pipelines.layout(pass, variant));
            device.create_bind_group("horizon_pass", &layout, &entries)
        };
        let table = match ground.sky {
            Some(ViewSky::Air { table, .. }) => airs.buffers(table),
            _ => None,
        };
        let tables = uniforms.airs.binding().zip(table);
        if let Some(cache) = ground.cache.and_then(|cache| caches.0.get(cache))
            && let Some(clipmap) = cache.buffers.clipmap.binding()
            && let Some(clearance) = clearance
        {
            let buffers = &cache.buffers;
            passes.clearance = clearances.bind(clearance, buffers, &uniforms, &pipeline_cache, &device);
            let mut entries = DynamicBindGroupEntries::new_with_indices((
                (0, clipmap),
                (1, buffers.heights.as_entire_binding()),
                (2, buffers.bounds.as_entire_binding()),
                (3, buffers.looks.as_entire_binding()),
                (4, buffers.lights.as_entire_binding()),
                (5, view.clone()),
                (6, clearance.buffer().as_entire_binding()),
            ))
            .to_vec();
            if let Some((uniform, [transmittances, _])) = &tables {
                let air = DynamicBindGroupEntries::new_with_indices((
                    (13, uniform.clone()),
                    (14, transmittances.as_entire_binding()),
                ));
                entries.extend_from_slice(&air);
            }
            let unknown = heat.then(|| ViewTruths::unknown(&device));
            if let Some(unknown) = &unknown {
                let ViewTruths(truths) = truths.unwrap_or(unknown);
                entries.push(BindGroupEntry { binding: 9, resource: truths.as_entire_binding() });
            }
            passes.groups[Pass::Ground as usize] = Some(create(Pass::Ground, &entries));
            if let Some(scaled) = &passes.scaled {
                let drawn = DynamicBindGroupEntries::new_with_indices((
                    (7, &scaled.colour.default_view),
                    (8, &scaled.depth.default_view),
                ));
                entries.extend_from_slice(&drawn);
                passes.groups[Pass::Upsample as usize] = Some(create(Pass::Upsample, &entries));
            }
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
