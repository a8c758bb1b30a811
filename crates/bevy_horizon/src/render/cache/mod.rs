//! The field, at the resolution that the screen can show: clipmaps on the device, filled once per texel.

mod buffers;
pub mod clipmap;
mod pipelines;

use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::render_resource::PipelineCache;
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use horizon_field::Place;

pub use self::buffers::CacheBuffers;
use self::buffers::{FrameJobs, TEXEL_BYTES};
use self::clipmap::{COARSEST, Clipmap, DrawnLevel, FINEST, MAX_LEVELS, TILE};
pub use self::pipelines::CachePipelines;
use super::extract::{ExtractedHorizonCamera, ExtractedTerrain, ExtractedWorld};
use super::ready::Progress;
use super::uniforms::{MaterialUniform, SunUniform};
use super::view::ViewGround;
use crate::world::{Atmosphere, TerrainFields};
use std::sync::Arc;

/// How much the caches may take. A resource of the main world.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct CacheSettings {
    /// Device memory of all caches together, in MiB; 16 to 4096. Default: 128.
    pub memory: u32,
    /// Tiles of 64 × 64 texels that are filled in one frame, about; at least 1. Default: 192.
    pub tiles_per_frame: u32,
}

impl Default for CacheSettings {
    fn default() -> Self {
        Self { memory: 128, tiles_per_frame: 192 }
    }
}

/// The caches of all terrains and cameras.
#[derive(Resource, Default)]
pub struct Caches(pub Vec<Cache>);

/// The ground around one or more cameras.
pub struct Cache {
    terrain: Entity,
    clipmap: Clipmap,
    centre: Place,
    /// What the tiles are filled with, once the pipeline for it is ready.
    fields: Arc<TerrainFields>,
    structure: u64,
    material: MaterialUniform,
    sun: Option<(Vec3, f32)>,
    pub buffers: CacheBuffers,
    pub drawn: Vec<DrawnLevel>,
    jobs: FrameJobs,
    used: bool,
    /// Tiles filled since the cache was made.
    pub filled: u64,
}

/// What a view asks of its cache.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Demand {
    side: u32,
    capacity: usize,
    finest: i32,
    coarsest: i32,
}

/// The field of view for which a level's size is chosen: of the target's height alone, so that zooming does not
/// rebuild the cache.
const NOMINAL_FOV: f32 = 60.0;

impl Demand {
    fn new(
        camera: &ExtractedHorizonCamera,
        height_px: u32,
        pixel: f32,
        altitude: f64,
        fields: &TerrainFields,
        share: u32,
    ) -> Self {
        // At the inner side of a level's ring, (outer · inner part) / 2 texels from the centre, a texel may be as large as
        // twice the budget in pixels: its bow and the octaves left out are a fraction of it.
        let budget = camera.camera.error_budget.clamp(0.1, 16.0);
        let nominal = 2.0 * (NOMINAL_FOV.to_radians() / 2.0).tan() / height_px.max(1) as f32;
        let texels = 2.0 * (1.0 / (0.8 * nominal * 2.0 * budget) + 34.0);
        let even_tiles = |texels: f32| ((texels / (2 * TILE) as f32).ceil() as u32 * 2).max(4);
        let mut side = even_tiles(texels);
        // Below an eighth of the field's finest wave, a patch is as smooth as what it stands for; a colour needs a quarter.
        let finest = (fields.height.finest_wavelength() / 8.0)
            .min(fields.edge.finest_wavelength() / 4.0)
            .min(fields.tint.finest_wavelength() / 4.0);
        let detail = finest.log2().floor().clamp(FINEST.into(), COARSEST.into()) as i32;
        let far = camera.camera.far.clamp(1.0, 1e6);
        loop {
            let reach = (side as i64 * TILE / 2 - 34) as f32;
            let coarsest = ((far / reach).log2().ceil() as i32).clamp(FINEST, COARSEST);
            let capacity = (coarsest - detail.min(coarsest) + 1).clamp(1, MAX_LEVELS as i32) as usize;
            let level_bytes = (i64::from(side) * TILE).pow(2) as u64 * TEXEL_BYTES / 4096;
            let affordable = (u64::from(share) << 20) / level_bytes;
            if affordable >= capacity as u64 || side <= 6 {
                let capacity = capacity.min(affordable.max(1) as usize);
                // Nothing is nearer than the ground below.
                let nearest = f64::from(pixel) * altitude.max(1.0) * 2.0 * f64::from(budget);
                let finest = (nearest.log2().floor() as i32).clamp(detail.min(coarsest), coarsest);
                return Self { side, capacity, finest, coarsest };
            }
            side -= 2;
        }
    }
}

/// Radians per pixel, or metres per pixel of an orthographic view.
pub fn pixel_size(view: &ExtractedView, height_px: u32) -> f32 {
    2.0 / (view.clip_from_view.y_axis.y.abs().max(1e-9) * height_px.max(1) as f32)
}

type Views<'w, 's> =
    Query<'w, 's, (Entity, &'static ExtractedHorizonCamera, &'static ExtractedView, &'static ExtractedCamera)>;

/// Finds each view's cache, moves it along, and makes out what is to be filled.
pub fn prepare_caches(
    mut commands: Commands,
    mut caches: ResMut<Caches>,
    mut pipelines: ResMut<CachePipelines>,
    world: Res<ExtractedWorld>,
    pipeline_cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    progress: Res<Progress>,
    views: Views,
) {
    let caches = &mut caches.0;
    for cache in caches.iter_mut() {
        cache.used = false;
        cache.jobs = FrameJobs::default();
    }
    let terrain_of = |camera: &ExtractedHorizonCamera| {
        world.terrains.iter().find(|terrain| camera.layers.intersects(&terrain.layers))
    };
    let drawing = views.iter().filter(|(_, camera, ..)| terrain_of(camera).is_some()).count();
    let share = world.settings.memory.clamp(16, 4096) / drawing.max(1) as u32;
    for (entity, camera, view, extracted) in &views {
        let sky = world.sky(&camera.layers);
        let terrain = terrain_of(camera);
        if terrain.is_none() && sky.is_none() {
            commands.entity(entity).remove::<ViewGround>();
            continue;
        }
        let from = view.world_from_view.translation() - terrain.map_or(Vec3::ZERO, |terrain| terrain.translation);
        let eye = world.origin.translated(from.to_array().map(f64::from));
        let cache = terrain.map(|terrain| {
            let height_px = extracted.physical_viewport_size.map_or(1, |size| size.y);
            let altitude =
                (eye.cell[1] as f64 * horizon_field::CELL + eye.offset[1] - ground_height(terrain, &eye)).abs();
            let demand = Demand::new(camera, height_px, pixel_size(view, height_px), altitude, &terrain.fields, share);
            let index = find_cache(caches, terrain, &eye, &demand).unwrap_or_else(|| {
                caches.push(Cache::new(terrain, &demand, &device));
                caches.len() - 1
            });
            let cache = &mut caches[index];
            if !cache.used {
                cache.used = true;
                cache.centre = eye;
                cache.clipmap.recentre(&eye, demand.finest, demand.coarsest);
            }
            index
        });
        commands.entity(entity).insert(ViewGround { cache, eye, sky, offsets: [0; 2] });
    }
    // A cache that no camera looks at goes; views name caches by index, so the order of the rest must not change.
    while caches.last().is_some_and(|cache| !cache.used) {
        caches.pop();
    }
    let (mut done, mut total) = (0, 0);
    for cache in caches.iter_mut().filter(|cache| cache.used) {
        let Some(terrain) = world.terrains.iter().find(|terrain| terrain.entity == cache.terrain) else { continue };
        pipelines.queue(&pipeline_cache, terrain);
        cache.prepare(terrain, &world, &pipelines, &pipeline_cache, &device, &queue);
        let (cache_done, cache_total) = cache.clipmap.progress();
        done += cache_done;
        total += cache_total.max(1);
    }
    progress.set(done, total);
}

fn ground_height(terrain: &ExtractedTerrain, eye: &Place) -> f64 {
    let height = &terrain.fields.height;
    height.value(&height.anchor(eye), [0.0, 0.0], 0.0f64)
}

/// A cache of this terrain and size: one that is used by a camera nearby, or else one that is free.
fn find_cache(caches: &[Cache], terrain: &ExtractedTerrain, eye: &Place, demand: &Demand) -> Option<usize> {
    let fits = |cache: &Cache| {
        cache.terrain == terrain.entity
            && cache.clipmap.side().abs_diff(demand.side) <= 1
            && cache.clipmap.capacity() == demand.capacity
    };
    let near = |cache: &Cache| {
        let [x, y, z] = eye.minus(&cache.centre);
        cache.drawn.iter().find(|level| level.outer > 0.0).is_some_and(|finest| {
            let reach = f64::from(finest.outer) * f64::from(finest.exponent).exp2() / 4.0;
            x.abs().max(y.abs()).max(z.abs()) < reach
        })
    };
    let shared = caches.iter().position(|cache| fits(cache) && cache.used && near(cache));
    shared.or_else(|| {
        let free = caches.iter().enumerate().filter(|(_, cache)| fits(cache) && !cache.used);
        let distance = |cache: &Cache| eye.minus(&cache.centre).iter().map(|d| d * d).sum::<f64>();
        free.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b))).map(|(i, _)| i)
    })
}

impl Cache {
    fn new(terrain: &ExtractedTerrain, demand: &Demand, device: &RenderDevice) -> Self {
        Self {
            terrain: terrain.entity,
            clipmap: Clipmap::new(demand.side, demand.capacity),
            centre: Place::ORIGIN,
            fields: terrain.fields.clone(),
            structure: terrain.kernel.structure,
            material: terrain.material.clone(),
            sun: None,
            buffers: CacheBuffers::new(demand.side, demand.capacity, &terrain.fields, device),
            drawn: Vec::new(),
            jobs: FrameJobs::default(),
            used: false,
            filled: 0,
        }
    }

    /// The camera's place, relative to the centre; y above the datum.
    pub fn eye(&self, eye: &Place) -> Vec3 {
        let [x, _, z] = eye.minus(&self.centre);
        let y = eye.cell[1] as f64 * horizon_field::CELL + eye.offset[1];
        Vec3::new(x as f32, y as f32, z as f32)
    }

    fn prepare(
        &mut self,
        terrain: &ExtractedTerrain,
        world: &ExtractedWorld,
        pipelines: &CachePipelines,
        pipeline_cache: &PipelineCache,
        device: &RenderDevice,
        queue: &RenderQueue,
    ) {
        // While a new kernel compiles, the old picture stays.
        if pipelines.ready(pipeline_cache, terrain.kernel.structure) {
            let changed = !Arc::ptr_eq(&self.fields, &terrain.fields) || self.material != terrain.material;
            if changed {
                self.fields = terrain.fields.clone();
                self.material = terrain.material.clone();
                self.structure = terrain.kernel.structure;
                self.buffers.set_fields(&self.fields, device);
                self.clipmap.invalidate();
            }
            let sun = self.sun(world);
            let budget = world.settings.tiles_per_frame.max(1) as usize;
            let work = self.clipmap.work(budget, sun.is_some());
            self.filled += work.fill.len() as u64;
            self.drawn = self.clipmap.drawn();
            self.buffers.set_clipmap(&self.drawn, self.clipmap.side(), device, queue);
            self.jobs = FrameJobs::new(&work, &self.clipmap, &self.fields, &self.material, sun, device);
            self.jobs.bind(&self.buffers, pipelines, self.structure, pipeline_cache, device);
        } else {
            self.drawn = self.clipmap.drawn();
            self.buffers.set_clipmap(&self.drawn, self.clipmap.side(), device, queue);
        }
    }

    /// The sun that the ground is lit by. It is followed in steps of a fifth of its radius, which no penumbra shows, and
    /// none while it is down.
    fn sun(&mut self, world: &ExtractedWorld) -> Option<SunUniform> {
        let Some(sun) = world.sun else {
            self.sun = None;
            return None;
        };
        let radius = world.atmospheres.first().map_or(Atmosphere::EARTH_SUN_RADIUS, |(_, radius, _)| *radius);
        if sun.direction.y < -radius.sin() {
            self.sun = None;
            return None;
        }
        // A sun that moves on before all is lit waits, so that the fine levels have their turn.
        let moved = |(direction, last_radius): (Vec3, f32)| {
            last_radius != radius || direction.angle_between(sun.direction) > 0.2 * radius
        };
        if self.sun.is_none_or(|last| moved(last) && self.clipmap.is_lit()) {
            self.sun = Some((sun.direction, radius));
            self.clipmap.invalidate_light();
        }
        let (direction, radius) = self.sun?;
        Some(SunUniform::new(direction, radius, self.fields.height.range().1 as f32))
    }
}

/// The compute passes of all caches, before any camera draws.
pub fn fill_caches(
    caches: Res<Caches>,
    pipelines: Res<CachePipelines>,
    pipeline_cache: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    for cache in caches.0.iter().filter(|cache| cache.used) {
        cache.jobs.dispatch(&pipelines, cache.structure, &pipeline_cache, &mut ctx);
    }
}
