//! The field, at the resolution that the screen can show: clipmaps on the device, filled once per texel.

mod buffers;
pub(crate) mod clipmap;
mod demand;
mod grain;
mod pipelines;

use bevy::camera::visibility::RenderLayers;
use bevy::math::DVec3;
use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::render_resource::PipelineCache;
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use horizon_field::march::{Anchored, Surface};
use horizon_field::stamp::Area;
use horizon_field::{Place, Stamps};

pub(crate) use self::buffers::CacheBuffers;
use self::buffers::FrameJobs;
use self::clipmap::{Clipmap, DrawnLevel, TILE};
use self::demand::Demand;
pub(crate) use self::demand::pixel_size;
pub(crate) use self::grain::grain;
pub(crate) use self::pipelines::CachePipelines;
use super::air::ViewAir;
use super::extract::{ExtractedAtmosphere, ExtractedHorizonCamera, ExtractedTerrain, ExtractedWorld};
use super::passes::{ClearancePipeline, ViewClearance, ViewGeometry, ViewPasses, ViewShade, ViewTrees, ViewWater};
use super::ready::Progress;
use super::trees::ViewGrove;
use super::uniforms::{GradientUniform, SunUniform};
use super::view::{ViewBefore, ViewGround, ViewSky};
use crate::world::{SkyModel, TerrainFields};
use std::sync::Arc;

/// How much the caches may take. A resource of the main world.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct CacheSettings {
    /// Device memory of all caches together, in MiB; 16 to 4096. Default: 128.
    pub memory: u32,
    /// Tiles of 64 × 64 texels that are filled in one frame, about; at least 1. After a jump or an edit there are more, so
    /// that all is done within eight frames. Default: 192.
    pub tiles_per_frame: u32,
}

impl Default for CacheSettings {
    fn default() -> Self {
        Self { memory: 128, tiles_per_frame: 192 }
    }
}

/// The caches of all terrains and cameras. A resource of the render world.
#[derive(Resource, Default)]
pub struct Caches(pub(crate) Vec<Cache>);

impl Caches {
    /// How many tiles were filled since the caches of this frame were made: what a moving camera costs, exactly.
    pub fn tiles_filled(&self) -> u64 {
        self.0.iter().map(|cache| cache.filled).sum()
    }
}

/// Of more stamps that change at once, no shadow is followed: all is lit again.
const MOST_SHADOWS: usize = 16;

/// The ground around one or more cameras.
pub(crate) struct Cache {
    terrain: Entity,
    clipmap: Clipmap,
    centre: Place,
    /// The exponents of the finest and the coarsest level that its cameras want.
    range: [i32; 2],
    /// What the tiles are filled with, once the pipeline for it is ready.
    fields: Arc<TerrainFields>,
    structure: u64,
    stamps: Arc<Stamps>,
    sun: Option<(Vec3, f32)>,
    pub buffers: CacheBuffers,
    pub drawn: Vec<DrawnLevel>,
    jobs: FrameJobs,
    used: bool,
    /// Tiles filled since the cache was made.
    filled: u64,
}

type Views<'w, 's> = Query<
    'w,
    's,
    (Entity, &'static ExtractedHorizonCamera, &'static ExtractedView, &'static ExtractedCamera, Has<ViewClearance>),
>;

/// Finds each view's cache, moves it along, and makes out what is to be filled.
pub(crate) fn prepare_caches(
    mut commands: Commands,
    mut caches: ResMut<Caches>,
    mut pipelines: ResMut<CachePipelines>,
    mut clearances: ResMut<ClearancePipeline>,
    world: Res<ExtractedWorld>,
    pipeline_cache: Res<PipelineCache>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    progress: Res<Progress>,
    views: Views,
) {
    let caches = &mut caches.0;
    // What no camera looked at goes; views name caches by index, anew in each frame.
    caches.retain(|cache| cache.used);
    for cache in caches.iter_mut() {
        cache.used = false;
        cache.jobs = FrameJobs::default();
    }
    let terrain_of = |camera: &ExtractedHorizonCamera| {
        world.terrains.iter().find(|terrain| camera.layers.intersects(&terrain.layers))
    };
    let drawing = views.iter().filter(|(_, camera, ..)| camera.cached && terrain_of(camera).is_some()).count();
    let share = world.settings.memory.clamp(16, 4096) / drawing.max(1) as u32;
    for (entity, camera, view, extracted, has_clearance) in &views {
        let air = world.air(&camera.layers);
        let terrain = terrain_of(camera);
        if terrain.is_none() && air.is_none() && !world.has_water(&camera.layers) {
            commands.entity(entity).remove::<(
                ViewGround,
                ViewBefore,
                ViewAir,
                ViewPasses,
                ViewGeometry,
                ViewShade,
                ViewClearance,
                ViewWater,
                ViewGrove,
                ViewTrees,
            )>();
            continue;
        }
        if terrain.is_some() && camera.cached {
            clearances.queue(&pipeline_cache);
            if !has_clearance {
                commands.entity(entity).insert(ViewClearance::new(&device));
            }
        }
        let terrain_at = terrain.map_or(DVec3::ZERO, |terrain| terrain.translation.as_dvec3());
        let eye = world.origin.translated((view.world_from_view.translation().as_dvec3() - terrain_at).to_array());
        let cache = terrain.filter(|_| camera.cached).map(|terrain| {
            let demand = Demand::new(camera, view, extracted, &eye, terrain, share, &device);
            let index = find_cache(caches, terrain, &eye, &demand).unwrap_or_else(|| {
                caches.push(Cache::new(terrain, &demand, &device));
                caches.len() - 1
            });
            caches[index].look(&eye, &demand);
            index
        });
        commands.entity(entity).insert(ViewGround {
            cache,
            eye,
            air,
            sky: air.and_then(|air| gradient_of(&world.atmospheres[air])),
            pixel: 0.0,
            table: None,
            scaled: None,
            offsets: [0; 3],
        });
    }
    let (mut done, mut total) = (0, 0);
    for cache in caches.iter_mut().filter(|cache| cache.used) {
        let Some(terrain) = world.terrains.iter().find(|terrain| terrain.entity == cache.terrain) else { continue };
        pipelines.queue(&pipeline_cache, terrain);
        cache.prepare(terrain, &world, &pipelines, &pipeline_cache, &device, &queue);
        let (cache_done, cache_total) = cache.clipmap.progress();
        // One more, for the light and for a kernel that still compiles.
        let finished = cache.clipmap.is_lit() && Arc::ptr_eq(&cache.fields, &terrain.fields);
        done += cache_done + usize::from(finished);
        total += cache_total + 1;
    }
    progress.set(done, total);
}

/// What draws an atmosphere whose model is a gradient; the others have tables, which are looked for later.
fn gradient_of(atmosphere: &ExtractedAtmosphere) -> Option<ViewSky> {
    let atmosphere = &atmosphere.compiled.atmosphere;
    (atmosphere.model == SkyModel::Gradient).then(|| ViewSky::Gradient(GradientUniform::new(atmosphere)))
}

/// A cache of this terrain and size: one that is used by a camera nearby, or else one that is free.
fn find_cache(caches: &[Cache], terrain: &ExtractedTerrain, eye: &Place, demand: &Demand) -> Option<usize> {
    let fits = |cache: &Cache| {
        cache.terrain == terrain.entity
            && cache.clipmap.side() == demand.side
            && cache.clipmap.capacity() == demand.capacity
    };
    // Well inside the finest level that either wants.
    let near = |cache: &Cache| {
        let finest = demand.finest.min(cache.range[0]);
        let reach = f64::from(finest).exp2() * (i64::from(demand.side) * TILE) as f64 / 8.0;
        eye.minus(&cache.centre).iter().all(|d| d.abs() < reach)
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
            range: [demand.finest, demand.coarsest],
            fields: terrain.fields.clone(),
            structure: terrain.kernel.structure,
            stamps: terrain.stamps.clone(),
            sun: None,
            buffers: CacheBuffers::new(demand.side, demand.capacity, &terrain.fields, device),
            drawn: Vec::new(),
            jobs: FrameJobs::default(),
            used: false,
            filled: 0,
        }
    }

    /// A camera looks at it: the first one is its centre, the others add the levels that they want.
    fn look(&mut self, eye: &Place, demand: &Demand) {
        if self.used {
            self.range = [self.range[0].min(demand.finest), self.range[1].max(demand.coarsest)];
        } else {
            self.used = true;
            self.centre = *eye;
            self.range = [demand.finest, demand.coarsest];
        }
        self.clipmap.recentre(&self.centre, self.range[0], self.range[1]);
    }

    /// The camera's place, relative to the centre; y above the datum.
    pub fn eye(&self, eye: &Place) -> Vec3 {
        let [x, _, z] = eye.minus(&self.centre);
        let y = eye.cell[1] as f64 * horizon_field::CELL + eye.offset[1];
        Vec3::new(x as f32, y as f32, z as f32)
    }

    /// The terrain that it is of.
    pub fn terrain(&self) -> Entity {
        self.terrain
    }

    /// What the passes' coordinates are relative to, in x and z.
    pub fn centre(&self) -> &Place {
        &self.centre
    }

    /// The layers of its terrain.
    pub fn layers<'a>(&self, world: &'a ExtractedWorld) -> Option<&'a RenderLayers> {
        world.terrains.iter().find(|terrain| terrain.entity == self.terrain).map(|terrain| &terrain.layers)
    }

    /// The lowest and the highest that the ground may be, in metres above the datum.
    pub fn heights(&self) -> [f32; 2] {
        let (low, high) = self.stamps.range(self.fields.height.range());
        [low as f32, high as f32]
    }

    /// Whether its ground may have holes.
    pub fn holes(&self) -> bool {
        self.stamps.has_holes()
    }

    /// From the finest texels that are drawn out to where the ground ends, at most `far`, in metres.
    pub fn reach(&self, far: f32) -> [f32; 2] {
        let mut drawn = self.drawn.iter().filter(|level| level.outer > 0.0).map(|level| (level.exponent as f32).exp2());
        let near = drawn.next().unwrap_or(1.0);
        [8.0 * near, far]
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
        // While a new kernel compiles, the old one goes on.
        let changed = !Arc::ptr_eq(&self.fields, &terrain.fields);
        if changed && pipelines.ready(pipeline_cache, terrain.kernel.structure) {
            self.fields = terrain.fields.clone();
            self.structure = terrain.kernel.structure;
            self.buffers.set_fields(&self.fields, device);
            self.clipmap.invalidate();
        }
        if !Arc::ptr_eq(&self.stamps, &terrain.stamps) {
            self.stamp(&terrain.stamps);
        }
        if pipelines.ready(pipeline_cache, self.structure) {
            let sun = self.sun(world);
            let budget = world.settings.tiles_per_frame.max(1) as usize;
            let work = self.clipmap.work(budget, sun.is_some());
            self.filled += work.fill.len() as u64;
            self.jobs = FrameJobs::new(&work, &self.clipmap, &self.fields, &self.stamps, sun, device);
        }
        self.drawn = self.clipmap.drawn();
        self.buffers.set_clipmap(&self.drawn, self.clipmap.side(), device, queue);
        self.jobs.bind(&self.buffers, pipelines, pipeline_cache, device);
    }

    /// The ground has other stamps: what they change is filled again, and lit as far as its shadow may reach.
    fn stamp(&mut self, stamps: &Arc<Stamps>) {
        let areas = self.stamps.changes(stamps);
        let few = areas.len() <= MOST_SHADOWS;
        for area in areas {
            let shadow = self.sun.filter(|_| few).map_or([0.0; 2], |sun| self.shadow(sun, &area, stamps));
            self.clipmap.invalidate_area(&area, shadow);
        }
        if !few {
            self.clipmap.relight();
        }
        self.stamps = stamps.clone();
    }

    /// How far the shadow of an area may reach along x and z, in metres, with the stamps that it has and with those to come: to
    /// where the ground is proven to rise over the lowest ray that grazes the area's highest point.
    fn shadow(&self, (direction, radius): (Vec3, f32), area: &Area, stamps: &Stamps) -> [f64; 2] {
        let grounds = [&*self.stamps, stamps].map(|stamps| Anchored::stamped(&self.fields.height, stamps, &area.place));
        let half = area.size.map(|size| 0.5 * size);
        let top = grounds.iter().map(|ground| ground.bound(half, half).high).fold(f64::NEG_INFINITY, f64::max);
        let lowest = grounds.iter().map(|ground| ground.range().0).fold(f64::INFINITY, f64::min);
        let sun = SunUniform::new(direction, radius, top as f32);
        let away = [sun.towards.x, sun.towards.y].map(|towards| -f64::from(towards));
        let fall = f64::from(sun.low).max(1e-3);
        let mut reach = 0.0;
        // Steps grow by a quarter: sixty of them are out of the world.
        for _ in 0..60 {
            let step = area.size[0].max(area.size[1]).max(0.25 * reach);
            let centre = [0, 1].map(|i| half[i] + away[i] * (reach + 0.5 * step));
            let extent = [0, 1].map(|i| half[i] + 0.5 * step * away[i].abs());
            let low = grounds.iter().map(|ground| ground.bound(centre, extent).low).fold(f64::INFINITY, f64::min);
            let ray = top - fall * reach;
            if low > ray || lowest > ray {
                break;
            }
            reach += step;
        }
        away.map(|away| away * reach)
    }

    /// The sun that casts shadows. It is followed in steps of a fifth of its radius, which no penumbra shows, and
    /// none while it is down.
    fn sun(&mut self, world: &ExtractedWorld) -> Option<SunUniform> {
        let Some((sun, radius)) = world.shading_sun() else {
            self.sun = None;
            return None;
        };
        // A sun that moves on before all is lit waits, so that the fine levels have their turn.
        let moved = |(direction, last_radius): (Vec3, f32)| {
            last_radius != radius || direction.angle_between(sun.direction) > 0.2 * radius
        };
        if self.sun.is_none_or(|last| moved(last) && self.clipmap.is_lit()) {
            self.sun = Some((sun.direction, radius));
            self.clipmap.invalidate_light();
        }
        let (direction, radius) = self.sun?;
        Some(SunUniform::new(direction, radius, self.heights()[1]))
    }
}

/// The compute passes of all caches, before any camera draws.
pub(crate) fn fill_caches(
    caches: Res<Caches>,
    pipelines: Res<CachePipelines>,
    pipeline_cache: Res<PipelineCache>,
    mut ctx: RenderContext,
) {
    for cache in caches.0.iter().filter(|cache| cache.used) {
        cache.jobs.dispatch(&pipelines, cache.structure, &pipeline_cache, &mut ctx);
    }
}
