//! Places of the world: a 64-bit cell plus an f64 offset, so that no absolute coordinate is ever rounded.

use serde::{Deserialize, Serialize};

/// The edge of a world cell, in metres. A power of two: multiplying by it is exact.
pub const CELL: f64 = 4096.0;

/// A place of the world: `cell · CELL + offset`, in metres; x and z lie in the plane, y is up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Place {
    /// The cell, per axis. Any value.
    pub cell: [i64; 3],
    /// The offset from the cell's corner, in metres; finite. [`Place::new`] brings it into `[0, CELL)`.
    pub offset: [f64; 3],
}

impl Place {
    /// The world's origin.
    pub const ORIGIN: Self = Self { cell: [0; 3], offset: [0.0; 3] };

    /// The place `cell · CELL + offset`, with the offset brought into `[0, CELL)`.
    pub fn new(mut cell: [i64; 3], mut offset: [f64; 3]) -> Self {
        for axis in 0..3 {
            let carry = (offset[axis] / CELL).floor();
            cell[axis] = cell[axis].wrapping_add(carry as i64);
            offset[axis] -= carry * CELL;
        }
        Self { cell, offset }
    }

    /// The place at these metres from the world's origin; exact while f64 is.
    pub fn from_metres(metres: [f64; 3]) -> Self {
        Self::new([0; 3], metres)
    }

    /// The place that lies `by` metres from here.
    pub fn translated(&self, by: [f64; 3]) -> Self {
        let offset = core::array::from_fn(|axis| self.offset[axis] + by[axis]);
        Self::new(self.cell, offset)
    }

    /// The metres from `other` to here. Exact to f64 where the two are near, wherever in the world they are.
    pub fn minus(&self, other: &Self) -> [f64; 3] {
        core::array::from_fn(|axis| {
            self.cell[axis].wrapping_sub(other.cell[axis]) as f64 * CELL + (self.offset[axis] - other.offset[axis])
        })
    }
}
