//! The air's tables: transmittance and diffuse light of each medium, made when it changes; and what a camera sees of them, made
//! when its altitude or the sun has changed.

mod pipelines;
mod sizes;
mod tables;
mod view;

use bevy::prelude::*;
use bevy::render::render_resource::PipelineCache;
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;

pub(crate) use self::pipelines::AirPipelines;
pub use self::sizes::sky_table_bytes;
pub(crate) use self::tables::AirTables;
pub(crate) use self::view::ViewAir;
use super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use super::ready::Progress;
use super::view::{HorizonViews, ViewGround, ViewSky};
use crate::world::SkyModel;

/// Finds each view's tables, and makes out which of them are to be made.
pub(crate) fn prepare_airs(
    mut commands: Commands,
    mut tables: ResMut<AirTables>,
    mut pipelines: ResMut<AirPipelines>,
    mut uniforms: ResMut<HorizonViews>,
    world: Res<ExtractedWorld>,
    progress: Res<Progress>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    mut views: Query<(Entity, &mut ViewGround, &ExtractedHorizonCamera, &ExtractedView, Option<&mut ViewAir>)>,
) {
    uniforms.airs.clear();
    tables.begin();
    for (entity, mut ground, camera, view, air) in &mut views {
        let found = ground.air.map(|index| &world.atmospheres[index]);
        let found = found.filter(|found| found.compiled.atmosphere.model != SkyModel::Gradient);
        let Some(found) = found else {
            if air.is_some() {
                commands.entity(entity).remove::<ViewAir>();
            }
            continue;
        };
        let atmosphere = &found.compiled.atmosphere;
        let table = tables.find(atmosphere, &mut pipelines, &cache, &device, &queue);
        let seen = view::Seen::new(&world, found, view, camera, &ground, tables.seen(table));
        ground.offsets[1] = uniforms.airs.push(&seen.uniform);
        let made = tables.made(table);
        ground.sky = made.then_some(ViewSky::Air { model: atmosphere.model, table });
        match air {
            Some(mut air) => air.look(&seen, table, tables.version(table), made),
            None => {
                let mut air = ViewAir::new(&device);
                air.look(&seen, table, tables.version(table), made);
                commands.entity(entity).insert(air);
            }
        }
    }
    tables.end();
    let (done, total) = tables.progress();
    progress.add(done, total);
    if !uniforms.airs.is_empty() {
        uniforms.airs.write_buffer(&device, &queue);
    }
}

/// The compute passes: media first, then views.
pub(crate) fn fill_airs(
    tables: Res<AirTables>,
    pipelines: Res<AirPipelines>,
    cache: Res<PipelineCache>,
    views: Query<(&ViewAir, &ViewGround)>,
    mut ctx: RenderContext,
) {
    tables.dispatch(&pipelines, &cache, &mut ctx);
    for (air, ground) in &views {
        air.dispatch(ground, &pipelines, &cache, &mut ctx);
    }
}

/// Binds what views read.
pub(crate) fn bind_airs(
    mut views: Query<&mut ViewAir>,
    tables: Res<AirTables>,
    pipelines: Res<AirPipelines>,
    uniforms: Res<HorizonViews>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
) {
    for mut air in &mut views {
        air.bind(&tables, &pipelines, &uniforms, &cache, &device);
    }
}
