//! Where noise takes the hashes of a cell's axes from.

use crate::hash::{axis, axis_high, axis_low};
use crate::real::axes;

/// The hashes of the axes of a cell and its neighbours.
pub(crate) trait Axes<const D: usize> {
    /// The hash of the coordinate `i` cells on along axis `k`; −1, 0 and 1 are asked.
    fn hash(&self, k: usize, i: i32) -> u32;

    /// The hashes of each axis at the cell's two ends; corners mix them.
    #[inline(always)]
    fn ends(&self) -> [[u32; 2]; D] {
        axes(|k| [self.hash(k, 0), self.hash(k, 1)])
    }
}

/// Any cell.
pub(crate) struct Cell<const D: usize> {
    /// The cell.
    pub cell: [i64; D],
    /// The seeds of the axes.
    pub seeds: [u32; D],
}

impl<const D: usize> Axes<D> for Cell<D> {
    #[inline(always)]
    fn hash(&self, k: usize, i: i32) -> u32 {
        axis(self.cell[k].wrapping_add(i64::from(i)), self.seeds[k])
    }
}

/// A cell within 2³¹ cells of one whose low words are 0. There a signed low word tells the high word by its sign, so
/// that high words are hashed once for many cells.
#[derive(Clone, Copy)]
pub(crate) struct NearCell<const D: usize> {
    /// The coordinates' low words, other than the smallest and the largest signed one.
    pub low: [u32; D],
    /// What the high words hash to where the low word is negative, and where it is not.
    pub high: [[u32; 2]; D],
}

impl<const D: usize> Axes<D> for NearCell<D> {
    #[inline(always)]
    fn hash(&self, k: usize, i: i32) -> u32 {
        let low = self.low[k].wrapping_add(i as u32);
        let [negative, positive] = self.high[k];
        axis_low(low, if (low as i32) < 0 { negative } else { positive })
    }
}

/// A coordinate taken apart: `high` · 2³² + `low`, with a signed low word.
#[derive(Clone, Copy)]
pub(crate) struct Words {
    /// The rounded high word.
    pub high: u32,
    /// The signed low word.
    pub low: i32,
}

impl Words {
    /// Of a coordinate.
    #[inline(always)]
    pub(crate) fn of(coordinate: i64) -> Self {
        let low = coordinate as i32;
        Self { high: (coordinate.wrapping_sub(i64::from(low)) >> 32) as u32, low }
    }

    /// [`NearCell::high`].
    #[inline(always)]
    pub(crate) fn hashes(self, seed: u32) -> [u32; 2] {
        [axis_high(self.high.wrapping_sub(1), seed), axis_high(self.high, seed)]
    }
}
