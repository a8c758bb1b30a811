//! Which tiles of which levels hold the ground around a camera, and which to fill next. Pure bookkeeping: no device.
//!
//! Clipmaps after Losasso & Hoppe 2004: levels of n × n texels around a centre, each twice as coarse as the last,
//! stored toroidally, so that a centre that moves needs only new strips. Tiles lie on a grid fixed to the world: the
//! same tile is always computed in the same way, wherever the camera and Bevy's origin are.

use std::collections::HashSet;

use horizon_field::Place;
use horizon_field::material::compile::CUTOFF;
use horizon_field::stamp::Area;

use self::tiles::texel_of;
pub use self::tiles::{BOUNDS_HEAD, LIGHTS_AT, TILE, TILE_BOUNDS, TILE_LOOKS, TILE_TEXELS, Tile, TileRect, place_of};

mod tiles;

/// The most levels that a clipmap can have.
pub const MAX_LEVELS: usize = 20;
/// log2 of the coarsest texel, in metres: a world cell.
pub const COARSEST: i32 = 12;
/// log2 of the finest texel, in metres: 4 mm.
pub const FINEST: i32 = -8;
/// Frames within which a jump or an edit is done.
const FRAMES: usize = 8;
/// Where a level begins to blend into the next, as a part of its radius.
const INNER: f32 = 0.8;

/// One level of a clipmap.
#[derive(Clone, Debug)]
pub struct Level {
    /// log2 of metres per texel.
    pub exponent: i32,
    /// The texel that holds the centre, by its index in the world.
    pub centre: [i64; 2],
    /// Where in that texel the centre lies, 0 to 1.
    pub fraction: [f64; 2],
    /// The tiles that hold ground.
    pub valid: TileRect,
    /// The tiles that should.
    target: TileRect,
    /// By stored tile: its ground is out of date; its light was never made; its light is out of date.
    stale: Vec<bool>,
    dark: Vec<bool>,
    dim: Vec<bool>,
}

/// What is to be done in a frame.
#[derive(Clone, Debug, Default)]
pub struct Work {
    /// Tiles to fill with the field.
    pub fill: Vec<Tile>,
    /// Tiles whose pyramid is to be made: those, and their neighbours whose last patches reach into them.
    pub pyramid: Vec<Tile>,
    /// Tiles to light.
    pub light: Vec<Tile>,
}

/// The levels around a centre.
#[derive(Clone, Debug)]
pub struct Clipmap {
    /// Tiles along a level's side; even.
    side: i64,
    /// How many levels can be stored.
    capacity: usize,
    /// Finest first.
    levels: Vec<Level>,
    /// Light was made before all the ground that may shadow it was there: it is made again once it is, everywhere or
    /// in some areas.
    relight: bool,
    shaded: Vec<Area>,
    /// The most tiles that were missing or out of date since all was done.
    backlog: usize,
}

/// A level as the shader sees it, in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnLevel {
    pub exponent: i32,
    pub inner: f32,
    pub outer: f32,
    /// The centre's texel, modulo the side.
    pub base: [i32; 2],
    pub fraction: [f32; 2],
    /// The cells that hold ground, relative to the centre's.
    pub low: [i32; 2],
    pub high: [i32; 2],
    pub slot: u32,
}

/// Where a level of `side` × `side` tiles stores a tile.
fn stored_in_level(side: i64, index: [i64; 2]) -> usize {
    let [x, z] = index.map(|i| i.rem_euclid(side) as usize);
    z * side as usize + x
}

impl Level {
    /// Whether a grid of this level's texels shows what changed in an area: as the fill pass has it.
    fn shows(&self, area: &Area) -> bool {
        area.narrow > CUTOFF * f64::from(self.exponent).exp2()
    }

    /// The tiles that hold ground of an area.
    fn tiles_of(&self, area: &Area) -> TileRect {
        let last = area.place.translated([area.size[0], 0.0, area.size[1]]);
        let [min, max] = [&area.place, &last].map(|corner| texel_of(corner, self.exponent).0);
        let area = TileRect { min: min.map(|i| i.div_euclid(TILE)), max: max.map(|i| i.div_euclid(TILE) + 1) };
        area.intersection(&self.valid)
    }
}

impl Clipmap {
    /// An empty clipmap of `side` tiles along each side, an even number of at least 4, and at most `capacity` levels.
    pub fn new(side: u32, capacity: usize) -> Self {
        assert!(side >= 4 && side.is_multiple_of(2), "a clipmap has an even number of tiles, at least 4");
        Self {
            side: i64::from(side),
            capacity: capacity.clamp(1, MAX_LEVELS),
            levels: Vec::new(),
            relight: false,
            shaded: Vec::new(),
            backlog: 0,
        }
    }

    /// Tiles along a level's side.
    pub fn side(&self) -> u32 {
        self.side as u32
    }

    /// How many levels can be stored.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// The index of a tile in the buffers.
    pub fn stored(&self, tile: Tile) -> u32 {
        let [x, z] = tile.index.map(|i| i.rem_euclid(self.side) as u32);
        (self.slot(tile.exponent) * self.side() + z) * self.side() + x
    }

    fn slot(&self, exponent: i32) -> u32 {
        exponent.rem_euclid(self.capacity as i32) as u32
    }

    fn stored_in_level(&self, index: [i64; 2]) -> usize {
        stored_in_level(self.side, index)
    }

    /// Moves the centre, and chooses the levels from `finest` to `coarsest` (exponents of their texels). What of a
    /// level still lies in reach stays.
    pub fn recentre(&mut self, centre: &Place, finest: i32, coarsest: i32) {
        let coarsest = coarsest.clamp(FINEST, COARSEST);
        let least = (coarsest + 1 - self.capacity as i32).max(FINEST);
        let finest = finest.clamp(least, coarsest);
        // One level finer than needed stays where it is there already: a camera that bobs fills it once.
        let spare = finest > least && self.levels.iter().any(|level| level.exponent == finest - 1);
        let finest = finest - i32::from(spare);
        self.levels.retain(|level| (finest..=coarsest).contains(&level.exponent));
        for exponent in finest..=coarsest {
            if !self.levels.iter().any(|level| level.exponent == exponent) {
                let tiles = (self.side * self.side) as usize;
                self.levels.push(Level {
                    exponent,
                    centre: [0; 2],
                    fraction: [0.0; 2],
                    valid: TileRect::default(),
                    target: TileRect::default(),
                    stale: vec![false; tiles],
                    dark: vec![false; tiles],
                    dim: vec![false; tiles],
                });
            }
        }
        self.levels.sort_by_key(|level| level.exponent);
        for level in &mut self.levels {
            (level.centre, level.fraction) = texel_of(centre, level.exponent);
            let middle = level.centre.map(|c| (c + TILE / 2).div_euclid(TILE));
            level.target = TileRect { min: middle.map(|m| m - self.side / 2), max: middle.map(|m| m + self.side / 2) };
            level.valid = level.valid.intersection(&level.target);
        }
    }

    /// Everything is out of date: it is drawn on until it is filled again.
    pub fn invalidate(&mut self) {
        for level in &mut self.levels {
            level.stale.fill(true);
        }
        self.relight = true;
    }

    /// The ground of an area is out of date, and with it the light from there to as far as `shadow` metres along x and z. Grids
    /// that are too coarse to show what changed stay as they are.
    pub fn invalidate_area(&mut self, area: &Area, shadow: [f64; 2]) {
        for level in self.levels.iter_mut().filter(|level| level.shows(area)) {
            for index in level.tiles_of(area).tiles() {
                level.stale[stored_in_level(self.side, index)] = true;
            }
        }
        let low = shadow.map(|by| by.min(0.0));
        let size = [0, 1].map(|i| area.size[i] + shadow[i].abs());
        self.shaded.push(Area { place: area.place.translated([low[0], 0.0, low[1]]), size, ..*area });
    }

    /// The light has changed, and is made anew once all the ground is there.
    pub fn relight(&mut self) {
        self.relight = true;
    }

    /// The light has changed.
    pub fn invalidate_light(&mut self) {
        for level in &mut self.levels {
            level.dim.fill(true);
        }
    }

    /// The next work, at most about `budget` tiles filled and as many lit, and more after a jump: what is missing or out of
    /// date is done within [`FRAMES`] frames. First the middle of every level that has nothing, so that the ground is
    /// sharp at once where the camera stands; then what else is missing, coarse to fine, each level outwards from its
    /// centre by whole strips, so that what it holds stays a rectangle; then what is out of date.
    pub fn work(&mut self, budget: usize, lit: bool) -> Work {
        let mut work = Work::default();
        let (done, total) = self.progress();
        self.backlog = if done == total { 0 } else { self.backlog.max(total - done) };
        let budget = budget.max(self.backlog.div_ceil(FRAMES));
        for i in (0..self.levels.len()).rev() {
            if self.levels[i].valid.is_empty() {
                self.grow(i, work.fill.len() + 1, &mut work);
            }
        }
        for i in (0..self.levels.len()).rev() {
            self.grow(i, budget, &mut work);
        }
        for i in (0..self.levels.len()).rev() {
            let level = &self.levels[i];
            let stale: Vec<_> = level.valid.tiles().filter(|tile| level.stale[self.stored_in_level(*tile)]).collect();
            for index in stale {
                if work.fill.len() >= budget {
                    break;
                }
                self.fill(i, index, &mut work);
            }
        }
        let mut pyramids = HashSet::new();
        for tile in &work.fill {
            for [dx, dz] in [[0, 0], [-1, 0], [0, -1], [-1, -1]] {
                let neighbour = Tile { exponent: tile.exponent, index: [tile.index[0] + dx, tile.index[1] + dz] };
                let valid =
                    self.levels.iter().any(|l| l.exponent == tile.exponent && l.valid.contains(neighbour.index));
                if valid && pyramids.insert(neighbour) {
                    work.pyramid.push(neighbour);
                }
            }
        }
        let (done, total) = self.progress();
        if self.relight && done == total {
            self.relight = false;
            self.invalidate_light();
        }
        if done == total {
            for area in std::mem::take(&mut self.shaded) {
                for level in self.levels.iter_mut().filter(|level| level.shows(&area)) {
                    for index in level.tiles_of(&area).tiles() {
                        level.dim[stored_in_level(self.side, index)] = true;
                    }
                }
            }
        }
        // What never was lit first: it holds the light of another place.
        let drawn = self.drawn();
        for dark in [true, false] {
            for i in (0..self.levels.len()).rev().filter(|i| drawn[*i].outer > 0.0) {
                let tiles: Vec<_> = self.levels[i].valid.tiles().collect();
                for index in tiles {
                    let at = self.stored_in_level(index);
                    let level = &mut self.levels[i];
                    let wanted = if dark { level.dark[at] } else { level.dim[at] };
                    if wanted && (!lit || work.light.len() < budget.max(work.fill.len())) {
                        (level.dark[at], level.dim[at]) = (false, false);
                        work.light.push(Tile { exponent: level.exponent, index });
                    }
                }
            }
        }
        work
    }

    fn fill(&mut self, level: usize, index: [i64; 2], work: &mut Work) {
        let at = self.stored_in_level(index);
        let level = &mut self.levels[level];
        level.stale[at] = false;
        level.dark[at] = true;
        work.fill.push(Tile { exponent: level.exponent, index });
    }

    fn grow(&mut self, level: usize, budget: usize, work: &mut Work) {
        while work.fill.len() < budget && self.levels[level].valid != self.levels[level].target {
            let Level { valid, target, centre, .. } = &self.levels[level];
            let (valid, target) = (*valid, *target);
            let grown = if valid.is_empty() {
                self.relight = true;
                let middle = centre.map(|c| (c + TILE / 2).div_euclid(TILE));
                TileRect { min: middle.map(|m| m - 1), max: middle.map(|m| m + 1) }
            } else {
                // The side that stands nearest to the centre, of those that may still move.
                let (mut best, mut grown) = (i64::MAX, valid);
                for (axis, centre) in centre.iter().enumerate() {
                    let at = centre.div_euclid(TILE);
                    if valid.min[axis] > target.min[axis] && at - valid.min[axis] < best {
                        best = at - valid.min[axis];
                        grown = valid;
                        grown.min[axis] -= 1;
                    }
                    if valid.max[axis] < target.max[axis] && valid.max[axis] - 1 - at < best {
                        best = valid.max[axis] - 1 - at;
                        grown = valid;
                        grown.max[axis] += 1;
                    }
                }
                grown
            };
            for index in grown.tiles().filter(|tile| valid.is_empty() || !valid.contains(*tile)) {
                self.fill(level, index, work);
            }
            self.levels[level].valid = grown;
        }
    }

    /// Tiles that hold ground that is up to date, and tiles that should.
    pub fn progress(&self) -> (usize, usize) {
        let done = |level: &Level| level.valid.tiles().filter(|tile| !level.stale[self.stored_in_level(*tile)]).count();
        (self.levels.iter().map(done).sum(), self.levels.iter().map(|level| level.target.area()).sum())
    }

    /// Whether every tile that holds ground is lit.
    pub fn is_lit(&self) -> bool {
        self.levels.iter().all(|level| {
            !level.valid.tiles().any(|tile| {
                let at = self.stored_in_level(tile);
                level.dark[at] || level.dim[at]
            })
        })
    }

    /// All levels, finest first: each that can be drawn lies well inside the next; the others have no radius.
    pub fn drawn(&self) -> Vec<DrawnLevel> {
        let mut drawn: Vec<DrawnLevel> = Vec::new();
        for level in self.levels.iter().rev() {
            // The last texel of the rectangle has no patch; and a node may touch one more.
            let mut outer = f64::INFINITY;
            for axis in 0..2 {
                let centre = level.centre[axis] as f64 + level.fraction[axis];
                outer = outer.min(centre - (level.valid.min[axis] * TILE) as f64);
                outer = outer.min((level.valid.max[axis] * TILE - 2) as f64 - centre);
            }
            if let Some(coarser) = drawn.last() {
                outer = outer.min(2.0 * f64::from(coarser.outer) * 0.95);
            }
            if level.valid.is_empty() || outer < 8.0 {
                outer = 0.0;
            }
            let side = self.side * TILE;
            let outer = outer as f32;
            drawn.push(DrawnLevel {
                exponent: level.exponent,
                inner: if drawn.is_empty() { 2.0 * outer } else { INNER * outer },
                outer,
                base: level.centre.map(|c| c.rem_euclid(side) as i32),
                fraction: level.fraction.map(|f| f as f32),
                low: core::array::from_fn(|i| (level.valid.min[i] * TILE - level.centre[i]) as i32),
                high: core::array::from_fn(|i| (level.valid.max[i] * TILE - level.centre[i]) as i32),
                slot: self.slot(level.exponent),
            });
        }
        drawn.reverse();
        drawn
    }

    /// A tile's level, by its place in [`Self::drawn`], and its first cell relative to the centre's.
    pub fn relative(&self, tile: Tile) -> Option<(u32, [i32; 2])> {
        let at = self.levels.iter().position(|level| level.exponent == tile.exponent)?;
        let centre = self.levels[at].centre;
        Some((at as u32, core::array::from_fn(|i| (tile.index[i] * TILE - centre[i]) as i32)))
    }
}

#[cfg(test)]
mod tests;
