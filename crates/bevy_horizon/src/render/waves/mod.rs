//! Waves on the device: the tiles of each sea, filled once a frame, before the cameras. Where there is no sea there is no pipeline,
//! buffer or texture.
//!
//! Data flows: [`ExtractedSeas`] and the time → `fill` (`transform.wgsl`: the waves at the time; `surface.wgsl`: over the plane;
//! `means.wgsl`: at every size) → [`SeaTiles`]. `horizon_field::waves` says what is computed, and computes the same.

mod fill;
mod pipelines;

use std::sync::Arc;

use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::render_resource::{PipelineCache, Sampler, Texture, TextureView};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use horizon_field::waves::{Sea, tick};

use self::fill::SeaFill;
pub(crate) use self::pipelines::SeaPipelines;
use super::ready::Progress;
use crate::world::WaterTime;

/// How many seas are there at once.
pub const MOST_SEAS: usize = 4;

/// The seas that move, each once; those after [`MOST_SEAS`] are not filled. A resource of the render world.
#[derive(Resource, Default)]
pub struct ExtractedSeas(pub Vec<Arc<Sea>>);

/// The tiles of all seas, as shaders read them. A resource of the render world, while there are seas that move; replaced when these
/// change. Flat until their pipelines are ready.
///
/// Each texture has `GRID` texels to a side, all levels of means, and the layer `CASCADES` × sea + tile. A place (x, z) is at the
/// coordinates (x, z) / side.
#[derive(Resource, Clone)]
pub struct SeaTiles {
    /// Height, slopes along x and z, foam.
    pub surface: TextureView,
    /// The slopes' squares, their product, the height's square.
    pub moments: TextureView,
    /// Linear in all respects, repeating, anisotropic.
    pub sampler: Sampler,
    /// The two textures.
    pub textures: [Texture; 2],
}

/// The time of this frame's waves.
#[derive(Resource, Default)]
pub(crate) struct SeaClock(u32);

/// What fills the tiles.
#[derive(Resource, Default)]
pub(crate) struct SeaFiller(Option<SeaFill>);

pub(crate) fn extract_water_time(mut clock: ResMut<SeaClock>, time: Extract<Res<WaterTime>>) {
    clock.0 = tick(time.0);
}

/// Makes what the seas need, and makes out whether it is to be filled.
pub(crate) fn prepare_seas(
    mut commands: Commands,
    mut filler: ResMut<SeaFiller>,
    mut pipelines: ResMut<SeaPipelines>,
    seas: Res<ExtractedSeas>,
    clock: Res<SeaClock>,
    cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    progress: Res<Progress>,
) {
    let seas = &seas.0[..seas.0.len().min(MOST_SEAS)];
    if seas.is_empty() {
        if filler.0.take().is_some() {
            commands.remove_resource::<SeaTiles>();
        }
        return;
    }
    pipelines.queue(&cache);
    if filler.0.as_ref().is_some_and(|fill| !fill.is_of(seas)) {
        filler.0 = None;
    }
    let fill = filler.0.get_or_insert_with(|| {
        let (fill, tiles) = SeaFill::new(seas, &pipelines, &cache, &device);
        commands.insert_resource(tiles);
        fill
    });
    fill.look(clock.0, pipelines.ready(&cache), &queue);
    progress.add(usize::from(fill.is_filled()), 1);
}

/// The compute passes.
pub(crate) fn fill_seas(
    filler: Res<SeaFiller>,
    pipelines: Res<SeaPipelines>,
    cache: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    if let Some(fill) = &filler.0 {
        fill.dispatch(&pipelines, &cache, &mut ctx);
    }
}
