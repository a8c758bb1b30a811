//! The passes of a view: the ground before Bevy's opaque meshes, so that depth sorts the two; the air after them, over
//! both.

mod draw;
mod pipelines;

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
    BindGroup, BindGroupEntry, CachedRenderPipelineId, DynamicBindGroupEntries, PipelineCache, TextureUsages,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::texture::{FallbackImage, GpuImage};
use bevy::render::view::{ExtractedView, ViewDepthTexture, ViewUniforms};

pub use self::pipelines::PassPipelines;
use self::pipelines::{Pass, PassKey};
use super::cache::Caches;
use super::view::{HorizonViews, ViewGround};

/// A view's passes: pipelines, bind groups and the offsets into them.
#[derive(Component, Default)]
pub struct ViewPasses {
    ldr: bool,
    pipelines: [Option<CachedRenderPipelineId>; 2],
    groups: [Option<BindGroup>; 2],
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
pub fn read_depth(mut views: Query<&mut Camera3d, With<super::extract::ExtractedHorizonCamera>>) {
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
    for (entity, ground, view, camera, msaa, tonemapping) in &views {
        let key = PassKey {
            format: view.target_format,
            samples: msaa.samples(),
            tonemapping: tonemapping.copied().filter(|_| !camera.hdr),
        };
        let sky = ground.sky.is_some().then(|| pipelines.get(&cache, Pass::Sky, key));
        let ground = ground.cache.map(|_| pipelines.get(&cache, Pass::Ground, key));
        commands.entity(entity).insert(ViewPasses {
            ldr: key.tonemapping.is_some(),
            pipelines: [ground, sky],
            groups: [None, None],
        });
    }
}

type BindViews<'w, 's> = Query<
    'w,
    's,
    (
        &'static mut ViewPasses,
        &'static ViewGround,
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
    pipeline_cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    tonemappers: Tonemappers,
) {
    for (mut passes, ground, depth, tonemapping, msaa) in &mut views {
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
        let create = |pass: Pass, entries: &[BindGroupEntry]| {
            let mut entries = entries.to_vec();
            if ldr {
                let tonemapping =
                    DynamicBindGroupEntries::new_with_indices(((10, bevy_view.clone()), (11, lut.0), (12, lut.1)));
                entries.extend_from_slice(&tonemapping);
            }
            let layout = pipeline_cache.get_bind_group_layout(pipelines.layout(pass, ldr, msaa.samples() > 1));
            device.create_bind_group("horizon_pass", &layout, &entries)
        };
        if let Some(cache) = ground.cache.and_then(|cache| caches.0.get(cache))
            && let Some(clipmap) = cache.buffers.clipmap.binding()
        {
            let buffers = &cache.buffers;
            passes.groups[0] = Some(create(
                Pass::Ground,
                &DynamicBindGroupEntries::new_with_indices((
                    (0, clipmap),
                    (1, buffers.heights.as_entire_binding()),
                    (2, buffers.bounds.as_entire_binding()),
                    (3, buffers.looks.as_entire_binding()),
                    (4, buffers.lights.as_entire_binding()),
                    (5, view.clone()),
                )),
            ));
        }
        if ground.sky.is_some()
            && let Some(sky) = uniforms.skies.binding()
        {
            passes.groups[1] = Some(create(
                Pass::Sky,
                &DynamicBindGroupEntries::new_with_indices(((0, view), (1, sky), (2, depth.view()))),
            ));
        }
    }
}
