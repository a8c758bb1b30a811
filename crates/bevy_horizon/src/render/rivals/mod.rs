//! Rival ways to march, in place of the cache: what it is measured against. For charts and tests alone; only in
//! perspective views without multisampling.

mod draw;
mod prepare;

use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::core_3d::main_opaque_pass_3d;
use bevy::core_pipeline::schedule::Core3dSystems;
use bevy::pbr::screen_space_reflections;
use bevy::prelude::*;
use bevy::render::extract_component::{ExtractComponent, ExtractComponentPlugin};
use bevy::render::{Render, RenderApp, RenderSystems};
use horizon_field::methods::Method;

use super::extract::ExtractedHorizonCamera;
use super::view;

/// Put it on a camera beside [`HorizonCamera`](crate::camera::HorizonCamera), and its ground is drawn by this method: fixed steps,
/// linear interpolation or sphere tracing. Methods that need bounds draw nothing, they are for the CPU.
#[derive(Component, Clone, Copy, Debug, ExtractComponent)]
pub struct RivalMarch(pub Method);

/// Draws the ground of cameras with a [`RivalMarch`].
pub struct RivalsPlugin;

impl Plugin for RivalsPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(ExtractComponentPlugin::<RivalMarch>::default());
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .init_resource::<prepare::RivalPipelines>()
            .add_systems(Render, uncache.in_set(RenderSystems::PrepareViews))
            .add_systems(
                Render,
                prepare::prepare_rivals.after(view::prepare_views).in_set(RenderSystems::PrepareResources),
            )
            .add_systems(
                Core3d,
                draw::draw_rival
                    .after(screen_space_reflections)
                    .before(main_opaque_pass_3d)
                    .in_set(Core3dSystems::MainPass),
            );
    }
}

/// A rival draws the ground by itself.
fn uncache(mut cameras: Query<&mut ExtractedHorizonCamera, With<RivalMarch>>) {
    for mut camera in &mut cameras {
        camera.cached = false;
    }
}
