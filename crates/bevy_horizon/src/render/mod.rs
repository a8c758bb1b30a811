//! The picture. One stage a file, in data-flow order: `extract` (from the main world), `uniforms` (as shaders see it),
//! `cache` (the field, at the resolution that the screen can show), `trees` (what grows on it), `air` (its tables), `view` (a camera's
//! rays), `passes` (into the view).

pub mod able;
mod air;
pub mod cache;
pub(crate) mod extract;
mod kernel;
pub(crate) mod passes;
pub mod ready;
#[cfg(feature = "baselines")]
pub mod rivals;
mod shaders;
mod trees;
mod truth;
mod uniforms;
mod view;
mod water;
pub mod waves;

use bevy::core_pipeline::schedule::camera_driver;
use bevy::prelude::*;
use bevy::render::renderer::{RenderGraph, RenderGraphSystems};
use bevy::render::sync_component::SyncComponentPlugin;
use bevy::render::view::prepare_view_targets;
use bevy::render::{ExtractSchedule, Render, RenderApp, RenderSystems};
use bevy::shader::Shader;

use crate::HorizonSystems;
use crate::camera::HorizonCamera;

pub use air::sky_table_bytes;
pub use shaders::{shader_constants, shader_sources};

/// The picture of the worlds, in every `Camera3d` with a [`HorizonCamera`]. Nothing is built on the device before a
/// world is there.
pub struct HorizonRenderPlugin;

impl Plugin for HorizonRenderPlugin {
    fn build(&self, app: &mut App) {
        // A server under `MinimalPlugins` has no shaders: it has worlds and queries all the same.
        if !app.world().contains_resource::<Assets<Shader>>() {
            return;
        }
        app.add_message::<ready::WorldReady>()
            .add_message::<ready::WorldProgress>()
            .init_resource::<cache::CacheSettings>()
            .init_resource::<kernel::Kernels>()
            .add_plugins(SyncComponentPlugin::<HorizonCamera>::default())
            .add_systems(PostUpdate, kernel::write_kernels.after(HorizonSystems::Compile))
            .add_systems(
                PostUpdate,
                truth::seek_truths.after(TransformSystems::Propagate).after(HorizonSystems::Compile),
            )
            .add_systems(PreUpdate, ready::report)
            .add_systems(
                PostUpdate,
                crate::world::shine.after(TransformSystems::Propagate).after(HorizonSystems::Compile),
            );
        shaders::add_shaders(&mut app.world_mut().resource_mut());
        let progress = ready::Progress::default();
        app.insert_resource(progress.clone());
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else {
            return;
        };
        render_app
            .insert_resource(progress)
            .init_resource::<extract::ExtractedWorld>()
            .init_resource::<cache::Caches>()
            .init_resource::<cache::CachePipelines>()
            .init_resource::<passes::PassPipelines>()
            .init_resource::<passes::GeometryPipelines>()
            .init_resource::<passes::ShadePipelines>()
            .init_resource::<passes::WaterPipelines>()
            .init_resource::<water::HorizonWaters>()
            .init_resource::<water::WaterMasks>()
            .init_resource::<waves::ExtractedSeas>()
            .init_resource::<passes::TreePipelines>()
            .init_resource::<waves::SeaClock>()
            .init_resource::<waves::SeaFiller>()
            .init_resource::<waves::SeaPipelines>()
            .init_resource::<passes::CastPipeline>()
            .init_resource::<passes::TreeCastPipeline>()
            .init_resource::<trees::Groves>()
            .init_resource::<passes::ClearancePipeline>()
            .init_resource::<air::AirTables>()
            .init_resource::<air::AirPipelines>()
            .init_resource::<view::HorizonViews>()
            .add_systems(
                ExtractSchedule,
                (
                    (extract::extract_world, extract::extract_waters, extract::extract_cameras).chain(),
                    truth::extract_truths,
                ),
            )
            .add_systems(ExtractSchedule, waves::extract_water_time)
            .add_systems(
                Render,
                able::limit_samples.after(RenderSystems::ExtractCommands).before(RenderSystems::PrepareAssets),
            )
            .add_systems(
                Render,
                (
                    (passes::read_depth, passes::copy_depth)
                        .after(prepare_view_targets)
                        .in_set(RenderSystems::PrepareViews),
                    (
                        cache::prepare_caches,
                        trees::prepare_groves,
                        air::prepare_airs,
                        waves::prepare_seas,
                        view::prepare_views,
                        (
                            passes::prepare_pipelines,
                            passes::prepare_geometry,
                            passes::prepare_shade,
                            passes::prepare_trees,
                            passes::prepare_casts,
                            passes::prepare_waters,
                            passes::prepare_tree_casts,
                        ),
                    )
                        .chain()
                        .in_set(RenderSystems::PrepareResources),
                    (
                        passes::prepare_bind_groups,
                        passes::bind_geometry,
                        passes::bind_shade,
                        passes::bind_waters,
                        passes::bind_trees,
                        air::bind_airs,
                    )
                        .in_set(RenderSystems::PrepareBindGroups),
                ),
            )
            .add_systems(
                RenderGraph,
                (cache::fill_caches, air::fill_airs, waves::fill_seas)
                    .chain()
                    .in_set(RenderGraphSystems::Render)
                    .before(camera_driver),
            );
        passes::add_ground(render_app);
    }
}

/// The air: sky and haze, in every camera with a [`HorizonCamera`] that sees an [`Atmosphere`](crate::world::Atmosphere).
pub struct HorizonSkyPlugin;

impl Plugin for HorizonSkyPlugin {
    fn build(&self, app: &mut App) {
        if let Some(render_app) = app.get_sub_app_mut(RenderApp)
            && render_app.world().contains_resource::<extract::ExtractedWorld>()
        {
            render_app.add_systems(ExtractSchedule, extract::extract_atmospheres.after(extract::extract_world));
            passes::add_sky(render_app);
        }
    }
}
