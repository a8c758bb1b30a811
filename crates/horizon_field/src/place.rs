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

    /// The corner of a cell of a grid whose cells are `edge` metres wide and whose corner lies at the world's origin: exact
    /// while `edge` has the 24 bits of an f32, and the cell lies within ±2⁵⁵.
    pub fn of_cell(cell: [i64; 3], edge: f64) -> Self {
        // Halves of which each, times an edge, has no more bits than an f64.
        const LOW: i64 = 1 << 26;
        let halves =
            cell.map(|cell| [cell.div_euclid(LOW) as f64 * (LOW as f64 * edge), cell.rem_euclid(LOW) as f64 * edge]);
        let (mut cells, mut offset) = ([0i64; 3], [0.0; 3]);
        for axis in 0..3 {
            for metres in halves[axis] {
                let whole = (metres / CELL).floor();
                cells[axis] = cells[axis].wrapping_add(whole as i64);
                offset[axis] += metres - whole * CELL;
            }
        }
        Self::new(cells, offset)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The same in whole numbers, with an edge of `edge · 2⁻²⁰` metres.
    fn whole(cell: i64, edge: i128) -> (i64, f64) {
        const UNITS: i128 = 4096 << 20;
        let units = i128::from(cell) * edge;
        (units.div_euclid(UNITS) as i64, units.rem_euclid(UNITS) as f64 / f64::from(1 << 20))
    }

    #[test]
    fn cells_of_other_grids_are_where_they_are() {
        let far = 1i64 << 54;
        let cells = [0, 1, -1, 2, -3, 500_000, -500_000, 244_141, 1 << 40, -(1 << 40) - 1, far - 1, -far + 1];
        // 16 m, 2 km, 4096 m, and edges with all the bits of an f32: 1234.567 m and 0.1 m.
        let odd = [1234.567f32, 0.1].map(|edge| (f64::from(edge) * f64::from(1 << 20)).round() as i128);
        for edge in [16 << 20, 2000 << 20, 4096 << 20, odd[0], odd[1]] {
            let metres = edge as f64 / f64::from(1 << 20);
            for cell in cells {
                let (expected, offset) = whole(cell, edge);
                let place = Place::of_cell([cell, 0, -cell], metres);
                assert_eq!((place.cell[0], place.offset[0]), (expected, offset), "{cell} of {metres} m");
                let (expected, offset) = whole(-cell, edge);
                assert_eq!((place.cell[2], place.offset[2]), (expected, offset), "{} of {metres} m", -cell);
                assert_eq!((place.cell[1], place.offset[1]), (0, 0.0));
            }
        }
    }

    #[test]
    fn metres_alone_lose_far_cells() {
        let (cell, edge) = ((1i64 << 54) - 1, f64::from(1234.567f32));
        let naive = Place::from_metres([cell as f64 * edge, 0.0, 0.0]);
        let off = naive.minus(&Place::of_cell([cell, 0, 0], edge))[0].abs();
        assert!(off > 100.0, "{off} m");
    }

    #[test]
    fn edges_beyond_measure_make_no_nan() {
        for edge in [f64::from(f32::MAX), f64::from(f32::MIN_POSITIVE), 0.0] {
            for cell in [i64::MIN, -1, 0, i64::MAX] {
                let place = Place::of_cell([cell; 3], edge);
                assert!(place.offset.iter().all(|offset| (0.0..CELL).contains(offset)), "{cell} of {edge}: {place:?}");
            }
        }
    }
}
