//! Tiles on a grid fixed to the world: the same tile is always computed in the same way, wherever the camera and Bevy's origin are.

use horizon_field::{CELL, Place};

/// Texels along a tile's side.
pub const TILE: i64 = 64;
/// Texels of a tile.
pub const TILE_TEXELS: u64 = (TILE * TILE) as u64;
/// Words of a tile's pyramid before its nodes: what its bounds are counted from and in, in metres.
pub const BOUNDS_HEAD: u64 = 2;
/// Words of a tile's pyramid: 32² + 16² + 8² + 4² + 2² + 1 nodes, each two numbers of 16 bits.
pub const TILE_BOUNDS: u64 = BOUNDS_HEAD + (TILE_TEXELS - 1) / 3;
/// Words of a tile's looks before its light: for each pair of texels two surfaces and their two normals.
pub const LIGHTS_AT: u64 = TILE_TEXELS / 2 * 3;
/// Words of a tile's looks: last come 16 bits of light for each 2 × 2 texels.
pub const TILE_LOOKS: u64 = LIGHTS_AT + TILE_TEXELS / 8;

/// A rectangle of tiles, `min` included, `max` not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TileRect {
    pub min: [i64; 2],
    pub max: [i64; 2],
}

impl TileRect {
    pub fn is_empty(&self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            min: [self.min[0].max(other.min[0]), self.min[1].max(other.min[1])],
            max: [self.max[0].min(other.max[0]), self.max[1].min(other.max[1])],
        }
    }

    pub fn contains(&self, tile: [i64; 2]) -> bool {
        (0..2).all(|i| self.min[i] <= tile[i] && tile[i] < self.max[i])
    }

    pub fn tiles(self) -> impl Iterator<Item = [i64; 2]> {
        (self.min[1]..self.max[1]).flat_map(move |z| (self.min[0]..self.max[0]).map(move |x| [x, z]))
    }

    pub fn area(&self) -> usize {
        if self.is_empty() { 0 } else { ((self.max[0] - self.min[0]) * (self.max[1] - self.min[1])) as usize }
    }
}

/// A tile of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Tile {
    /// The level, by the exponent of its texel.
    pub exponent: i32,
    /// The tile's index in the world.
    pub index: [i64; 2],
}

/// The texel index of a place at a level, and the fraction in it, of x and z.
pub fn texel_of(place: &Place, exponent: i32) -> ([i64; 2], [f64; 2]) {
    let texel = f64::from(exponent).exp2();
    let mut index = [0; 2];
    let mut fraction = [0.0; 2];
    for (i, axis) in [0, 2].into_iter().enumerate() {
        let local = place.offset[axis] / texel;
        let whole = local.floor();
        index[i] = place.cell[axis].wrapping_mul((CELL / texel) as i64).wrapping_add(whole as i64);
        fraction[i] = local - whole;
    }
    (index, fraction)
}

/// The place of a tile's first texel, at height 0.
pub fn place_of(tile: Tile) -> Place {
    let texel = f64::from(tile.exponent).exp2();
    let per_cell = (CELL / texel) as i64;
    let mut place = Place::ORIGIN;
    for (i, axis) in [0, 2].into_iter().enumerate() {
        let index = tile.index[i].wrapping_mul(TILE);
        place.cell[axis] = index.div_euclid(per_cell);
        place.offset[axis] = index.rem_euclid(per_cell) as f64 * texel;
    }
    place
}
