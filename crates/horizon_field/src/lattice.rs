//! Lattices of noise, anchored: a lattice coordinate is a linear map of the world's place, taken apart into a 64-bit
//! cell and a fraction before any rounding. Coordinates are Q64.64 fixed point and wrap, so a lattice has no edge, and
//! the noise at 10⁹ m is as exact as at the origin. `lattice.wgsl` is the twin: it adds small local offsets.

use crate::hash::axis_seed;
use crate::place::{CELL, Place};
use crate::real::{Real, axes};

/// The WGSL twin.
pub const WGSL: &str = include_str!("lattice.wgsl");

/// A lattice in `D` dimensions: 2 for the plane (x, z), 3 for space (x, y, z).
#[derive(Clone, Debug, PartialEq)]
pub struct Layer<const D: usize> {
    /// Lattice units per metre; row by row. Holds wavelength, rotation and, for simplex noise, the skew.
    pub matrix: [[f64; D]; D],
    /// Lattice units per world cell, fixed point.
    cell_matrix: [[i128; D]; D],
    /// The lattice coordinate of the world's origin, fixed point.
    offset: [i128; D],
    /// The seed of the cells' hashes.
    pub seed: u32,
    /// The seeds of the axes, which follow from it.
    pub(crate) axis_seeds: [u32; D],
}

/// A point of a lattice: a 64-bit cell and the fraction in it, in `[0, 1)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticePoint<T, const D: usize> {
    /// The cell.
    pub cell: [i64; D],
    /// The fraction.
    pub fraction: [T; D],
}

/// Which of a place's axes a domain of `D` dimensions takes: x and z in the plane, all three in space.
pub(crate) const fn axis_of<const D: usize>(i: usize) -> usize {
    if D == 2 { i * 2 } else { i }
}

/// Q64.64 fixed point from a float, exact below 2⁶³.
fn fixed(x: f64) -> i128 {
    let whole = x.floor();
    ((whole as i64 as i128) << 64).wrapping_add(((x - whole) * 18_446_744_073_709_551_616.0) as i128)
}

impl<const D: usize> Layer<D> {
    /// A lattice with `matrix` units per metre, whose coordinate at the world's origin is `offset`.
    pub fn new(matrix: [[f64; D]; D], offset: [f64; D], seed: u32) -> Self {
        Self {
            matrix,
            cell_matrix: matrix.map(|row| row.map(|m| fixed(m * CELL))),
            offset: offset.map(fixed),
            seed,
            axis_seeds: core::array::from_fn(|k| axis_seed(seed, k as u32)),
        }
    }

    /// The lattice point at a place of the world.
    pub fn anchor(&self, place: &Place) -> LatticePoint<f64, D> {
        let mut cell = [0; D];
        let mut fraction = [0.0; D];
        for row in 0..D {
            let mut coordinate = self.offset[row];
            let mut local = 0.0;
            for column in 0..D {
                let axis = axis_of::<D>(column);
                coordinate =
                    coordinate.wrapping_add(self.cell_matrix[row][column].wrapping_mul(place.cell[axis] as i128));
                local += self.matrix[row][column] * place.offset[axis];
            }
            coordinate = coordinate.wrapping_add(fixed(local));
            cell[row] = (coordinate >> 64) as i64;
            // The top 53 bits, so that the fraction stays below one.
            fraction[row] = ((coordinate as u64) >> 11) as f64 / 9_007_199_254_740_992.0;
        }
        LatticePoint { cell, fraction }
    }

    /// The lattice point `q` metres from an anchor.
    #[inline(always)]
    pub fn at<T: Real>(&self, anchor: &LatticePoint<f64, D>, q: [T; D]) -> LatticePoint<T, D> {
        let mut cell = [0; D];
        let mut fraction = [T::ZERO; D];
        for row in 0..D {
            let [whole, rest] = self.parts(anchor, q, row);
            cell[row] = anchor.cell[row].wrapping_add(whole.to_i64());
            fraction[row] = rest;
        }
        LatticePoint { cell, fraction }
    }

    /// One coordinate of [`Layer::at`]: whole cells from the anchor's cell, and the fraction.
    #[inline(always)]
    pub(crate) fn parts<T: Real>(&self, anchor: &LatticePoint<f64, D>, q: [T; D], row: usize) -> [T; 2] {
        let mut x = T::of(anchor.fraction[row]);
        for (m, q) in self.matrix[row].iter().zip(q) {
            x += T::of(*m) * q;
        }
        let whole = x.floor();
        [whole, x - whole]
    }

    /// Brings a gradient per lattice unit into a gradient per metre.
    #[inline(always)]
    pub fn per_metre<T: Real>(&self, g: [T; D]) -> [T; D] {
        axes(|column| {
            let mut sum = T::ZERO;
            for (row, g) in self.matrix.iter().zip(g) {
                sum += T::of(row[column]) * g;
            }
            sum
        })
    }
}
