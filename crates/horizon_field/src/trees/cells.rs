//! The lattice's cells: which one holds a place, and blocks of them.

use super::check::ForestError;
use crate::{CELL, Place};

/// How many cells a question may look at.
pub const MAX_CELLS: u64 = 1 << 24;

/// A block of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// The cell of the least x and z.
    pub corner: [i64; 2],
    /// How many cells along x and z.
    pub size: [u32; 2],
}

impl Block {
    /// The cells that a rectangle of the plane touches, from its corner of the least x and z on, in metres.
    ///
    /// # Errors
    /// A rectangle of more than [`MAX_CELLS`], or whose size is not a number.
    pub fn over(corner: &Place, size: [f64; 2], spacing: f64) -> Result<Self, ForestError> {
        let size = size.map(|size| size.max(0.0));
        let cells = (size[0] / spacing + 2.0) * (size[1] / spacing + 2.0);
        if cells.is_nan() || cells > MAX_CELLS as f64 {
            return Err(ForestError::Area { cells, max: MAX_CELLS });
        }
        let (first, within) = cell_of(corner, spacing);
        let last = [0, 1].map(|k| ((within[k] + size[k]) / spacing).floor() as u32);
        Ok(Self { corner: first, size: last.map(|last| last + 1) })
    }

    /// Whether a cell is one of them.
    pub fn holds(&self, cell: [i64; 2]) -> bool {
        (0..2).all(|k| cell[k].wrapping_sub(self.corner[k]) as u64 <= u64::from(self.size[k]).wrapping_sub(1))
            && !self.size.contains(&0)
    }
}

/// The corner of a cell, at height 0.
pub fn cell_corner(cell: [i64; 2], spacing: f64) -> Place {
    Place::of_cell([cell[0], 0, cell[1]], spacing)
}

/// The cell that holds a place, and the metres from the cell's corner, along x and z.
pub fn cell_of(place: &Place, spacing: f64) -> ([i64; 2], [f64; 2]) {
    let metres = |k: usize| place.cell[k] as f64 * CELL + place.offset[k];
    let mut cell = [0, 2].map(|k| (metres(k) / spacing).floor() as i64);
    let mut within = [0.0; 2];
    // Far from the origin the quotient is some cells off; each round brings it as near as the rest is exact.
    for _ in 0..4 {
        let [x, _, z] = place.minus(&cell_corner(cell, spacing));
        within = [x, z];
        let off = within.map(|within| (within / spacing).floor());
        if off == [0.0; 2] {
            break;
        }
        cell = [0, 1].map(|k| cell[k].wrapping_add(off[k] as i64));
    }
    (cell, within.map(|within| within.clamp(0.0, spacing)))
}
