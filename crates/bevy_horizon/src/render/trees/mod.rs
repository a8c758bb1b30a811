//! Plants on the device: around each camera a window of the forest's lattice, filled on the CPU in the background with the very
//! plants that queries know.

mod foliage;
mod pack;
mod window;

use std::sync::Arc;

use bevy::prelude::*;
use bevy::render::camera::ExtractedCamera;
use bevy::render::render_resource::{Buffer, BufferDescriptor, BufferInitDescriptor, BufferUsages, ShaderType, encase};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use bevy::tasks::{AsyncComputeTaskPool, Task, block_on, poll_once};
use horizon_field::Place;
use horizon_field::trees::{UNIFORM_BYTES, Wind};

pub use self::foliage::FoliageTexture;
use self::pack::{Extents, Packed, TILE_WORDS, pack};
use self::window::{TILE, Window};
use super::cache::{Caches, pixel_size};
use super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use super::ready::Progress;
use super::view::ViewGround;
use crate::world::{Woods, WoodsChange};

/// Crowns are drawn down to this width, in pixels.
const LEAST_CROWN: f32 = 1.5;
/// The least and the most tiles along a window's side; powers of two.
const SIDES: [u32; 2] = [8, 32];
/// Tiles in a job of the background, and how many of those run at a time.
const TILES_IN_JOB: usize = 8;
const JOBS: usize = 2;

/// Plants around one or more cameras.
pub(crate) struct Grove {
    terrain: Entity,
    window: Window,
    /// The cell around which tiles are filled first.
    cell: [i64; 2],
    woods: Arc<Woods>,
    pub tiles: Buffer,
    /// `PlantForest` of the solids' WGSL, and the bytes that are in it.
    pub forest: Buffer,
    numbers: Vec<u8>,
    jobs: Vec<Task<Filled>>,
    /// What stands in each slot: its tile's cells, and from where to where they reach.
    standing: Vec<Standing>,
    used: bool,
}

/// What stands in a tile.
#[derive(Clone, Debug, Default)]
pub(crate) struct Standing {
    /// The tile's corner.
    pub corner: [i64; 2],
    /// 32 z + x, of each cell in which a plant stands.
    pub cells: Vec<u16>,
    /// The lowest and the highest of the plants, in metres above the datum.
    pub heights: [f32; 2],
}

/// What a job brings: the version that its tiles are of, and their words.
struct Filled {
    version: u64,
    tiles: Vec<([i64; 2], Packed)>,
}

/// The groves of all terrains and cameras. A resource of the render world.
#[derive(Resource, Default)]
pub struct Groves(pub(crate) Vec<Grove>);

/// What a view sees of plants. A view that sees none has no such component.
#[derive(Component)]
pub struct ViewGrove {
    pub grove: usize,
    /// `Grove` of `grove.wgsl`.
    pub window: Buffer,
    /// Whether there is something to draw.
    pub grown: bool,
}

/// `Grove` of `grove.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct GroveUniform {
    pub base: IVec2,
    pub shift: Vec2,
    pub low: IVec2,
    pub high: IVec2,
    pub eye: Vec2,
    pub fades: f32,
    pub reach: f32,
    pub side: u32,
}

type Views<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static ViewGround,
        &'static ExtractedHorizonCamera,
        &'static ExtractedView,
        &'static ExtractedCamera,
        Has<ViewGrove>,
    ),
>;

/// Finds each view's grove, moves it along, and takes what the background has filled.
pub(crate) fn prepare_groves(
    mut commands: Commands,
    mut groves: ResMut<Groves>,
    world: Res<ExtractedWorld>,
    caches: Res<Caches>,
    progress: Res<Progress>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    views: Views,
) {
    let groves = &mut groves.0;
    groves.retain(|grove| grove.used);
    for grove in groves.iter_mut() {
        grove.used = false;
    }
    for (entity, ground, camera, view, extracted, had) in &views {
        let cache = ground.cache.and_then(|cache| caches.0.get(cache));
        let terrain = cache.and_then(|cache| world.terrains.iter().find(|terrain| terrain.entity == cache.terrain()));
        let woods = terrain.and_then(|terrain| Some((terrain.entity, terrain.woods.as_ref()?)));
        let (Some(cache), Some((terrain, woods))) = (cache, woods) else {
            if had {
                commands.entity(entity).remove::<ViewGrove>();
            }
            continue;
        };
        let side = side_of(woods, view, extracted, camera.camera.far);
        let (cell, _) = woods.cell(&ground.eye);
        let index = find(groves, terrain, woods, side, cell).unwrap_or_else(|| {
            groves.push(Grove::new(terrain, woods, side, &device));
            groves.len() - 1
        });
        let grove = &mut groves[index];
        grove.look(cell, &queue);
        let uniform = grove.uniform(cache.centre(), cache.eye(&ground.eye));
        let mut bytes = encase::UniformBuffer::new(Vec::new());
        bytes.write(&uniform).expect("a vector takes any size");
        let window = device.create_buffer_with_data(&BufferInitDescriptor {
            label: Some("horizon_grove"),
            contents: bytes.as_ref(),
            usage: BufferUsages::UNIFORM,
        });
        commands.entity(entity).insert(ViewGrove { grove: index, window, grown: grove.grown() });
    }
    let (mut done, mut total) = (0, 0);
    for grove in groves.iter_mut().filter(|grove| grove.used) {
        let Some(terrain) = world.terrains.iter().find(|terrain| terrain.entity == grove.terrain) else { continue };
        let Some(woods) = &terrain.woods else { continue };
        grove.prepare(woods, &terrain.wind, &queue);
        let (grove_done, grove_total) = grove.window.progress();
        done += grove_done;
        total += grove_total;
    }
    if total > 0 {
        progress.add(done, total);
    }
}

/// Tiles along the side of a window that holds all crowns of this view that are wide enough.
fn side_of(woods: &Woods, view: &ExtractedView, extracted: &ExtractedCamera, far: f32) -> u32 {
    let size = extracted.physical_viewport_size.unwrap_or(UVec2::ONE).max(UVec2::ONE);
    let pixel = pixel_size(view, size.y);
    let reach = if view.clip_from_view.w_axis.w == 1.0 {
        pixel * size.max_element() as f32
    } else {
        woods.widest() as f32 / (LEAST_CROWN * pixel)
    };
    let cells = f64::from(reach.min(far)) / woods.spacing();
    let tiles = 2.0 * (cells / TILE as f64 + 1.0).ceil();
    (tiles.min(f64::from(SIDES[1])) as u32).next_power_of_two().clamp(SIDES[0], SIDES[1])
}

/// A grove of this terrain and size: one that is used by a camera nearby, or else one that is free.
fn find(groves: &[Grove], terrain: Entity, woods: &Woods, side: u32, cell: [i64; 2]) -> Option<usize> {
    let fits = |grove: &Grove| {
        grove.terrain == terrain && grove.window.side() == i64::from(side) && grove.woods.spacing() == woods.spacing()
    };
    let near = |grove: &Grove| {
        let most = (Window::reach(side) / 4) as u64;
        (0..2).all(|axis| grove.cell[axis].abs_diff(cell[axis]) <= most)
    };
    let shared = groves.iter().position(|grove| fits(grove) && grove.used && near(grove));
    shared.or_else(|| groves.iter().position(|grove| fits(grove) && !grove.used))
}

impl Grove {
    fn new(terrain: Entity, woods: &Arc<Woods>, side: u32, device: &RenderDevice) -> Self {
        let buffer = |label, size, usage| {
            let descriptor = BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
            device.create_buffer(&descriptor)
        };
        // New buffers hold zeros: no plants.
        let tiles = u64::from(side).pow(2) * TILE_WORDS as u64 * 4;
        Self {
            terrain,
            window: Window::new(side),
            cell: [0; 2],
            woods: woods.clone(),
            tiles: buffer("horizon_plants", tiles, BufferUsages::STORAGE | BufferUsages::COPY_DST),
            forest: buffer("horizon_forest", UNIFORM_BYTES as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST),
            numbers: Vec::new(),
            jobs: Vec::new(),
            standing: vec![Standing::default(); side.pow(2) as usize],
            used: false,
        }
    }

    /// A camera looks at it: the first one is its middle.
    fn look(&mut self, cell: [i64; 2], queue: &RenderQueue) {
        if self.used {
            return;
        }
        self.used = true;
        self.cell = cell;
        for slot in self.window.follow(cell) {
            self.standing[slot] = Standing::default();
            self.store(slot, &vec![0; TILE_WORDS], queue);
        }
    }

    fn store(&self, slot: usize, words: &[u32], queue: &RenderQueue) {
        queue.write_buffer(&self.tiles, (slot * TILE_WORDS * 4) as u64, bytemuck::cast_slice(words));
    }

    /// What grows there.
    pub fn woods(&self) -> &Woods {
        &self.woods
    }

    /// The tiles in which plants stand.
    pub fn standing(&self) -> impl Iterator<Item = &Standing> {
        self.standing.iter().filter(|tile| !tile.cells.is_empty())
    }

    /// Whether any tile is filled.
    fn grown(&self) -> bool {
        !self.numbers.is_empty() && self.window.any()
    }

    /// As a view sees it whose passes are relative to a place, and whose eye is there.
    fn uniform(&self, centre: &Place, eye: Vec3) -> GroveUniform {
        let side = self.window.side();
        let (cell, shift) = self.woods.cell(centre);
        let shift = Vec2::from_array(shift.map(|shift| shift as f32));
        let [low, high] = self.window.cells().map(|corner| {
            let from_here = [0, 1].map(|axis| corner[axis].wrapping_sub(cell[axis]));
            // Far away in either direction is as far as can be.
            IVec2::from_array(from_here.map(|cells| cells.clamp(-(1 << 24), 1 << 24) as i32))
        });
        let reach = (Window::reach(side as u32) as f64 * self.woods.spacing()) as f32;
        GroveUniform {
            base: IVec2::from_array(cell.map(|cell| cell.rem_euclid(side * TILE) as i32)),
            shift,
            low,
            high,
            eye: eye.xz() + shift,
            fades: 0.8 * reach,
            reach,
            side: side as u32,
        }
    }

    fn prepare(&mut self, woods: &Arc<Woods>, wind: &Wind, queue: &RenderQueue) {
        if !Arc::ptr_eq(&self.woods, woods) {
            match woods.change(&self.woods) {
                WoodsChange::Everywhere => self.window.invalidate(),
                WoodsChange::Cells(areas) => {
                    areas.iter().for_each(|[low, high]| self.window.invalidate_cells(*low, *high));
                }
            }
            self.woods = woods.clone();
        }
        let numbers = woods.forest().uniform_bytes(wind);
        if self.numbers != numbers {
            queue.write_buffer(&self.forest, 0, &numbers);
            self.numbers = numbers;
        }
        let (mut running, mut filled) = (Vec::new(), Vec::new());
        for mut job in self.jobs.drain(..) {
            match block_on(poll_once(&mut job)) {
                Some(tiles) => filled.push(tiles),
                None => running.push(job),
            }
        }
        self.jobs = running;
        for Filled { version, tiles } in filled {
            for (tile, packed) in tiles {
                if let Some(slot) = self.window.fill(tile, version) {
                    self.store(slot, &packed.words, queue);
                    let corner = tile.map(|tile| tile.wrapping_mul(TILE));
                    self.standing[slot] = Standing { corner, cells: packed.standing, heights: packed.heights };
                }
            }
        }
        while self.jobs.len() < JOBS {
            let tiles = self.window.ask(self.cell, TILES_IN_JOB);
            if tiles.is_empty() {
                break;
            }
            let (woods, version) = (self.woods.clone(), self.window.version());
            self.jobs.push(AsyncComputeTaskPool::get().spawn(async move {
                let extents = Extents::new(woods.forest());
                let fill = |tile: [i64; 2]| {
                    let low = tile.map(|tile| tile.wrapping_mul(TILE));
                    (tile, pack(tile, &woods.plants(low, [TILE as u32 + 1; 2]), &extents))
                };
                Filled { version, tiles: tiles.into_iter().map(fill).collect() }
            }));
        }
    }
}
