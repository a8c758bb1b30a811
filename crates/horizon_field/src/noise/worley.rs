//! Cellular noise after Worley (1996): the distance F₁ to the nearest feature point, one point in each cell.
//! `worley.wgsl` is the twin.
//!
//! A point is its cell's centre plus half the jitter j times a random vector in (−1, 1)ᴰ. Searching the 3ᴰ cells around
//! a place is exact when no point outside can be nearer than the farthest that the nearest point inside can be. With
//! t_k in [0, ½] the distance from the own cell's centre, axis by axis, the own point is at most t_k + j/2 away. A point
//! two cells off along axis 1 is at least 2 − t_1 − j/2 away along it, and max(0, t_k − j/2) along the others. Now
//! (t_k + j/2)² − max(0, t_k − j/2)² ≤ j for j ≤ 1, and (2 − t_1 − j/2)² − (t_1 + j/2)² = 4(1 − t_1 − j/2) ≥ 2(1 − j).
//! So (D − 1)j ≤ 2(1 − j) suffices: j = 2/(D + 1).

use super::axes::Axes;
use super::bounds::BasisBounds;
use super::corner::{vector2, vector3};
use crate::hash::{mix2, mix3};
use crate::real::{Jet, Real, axes};

/// The value is 2 F₁ / max F₁ − 1. F₁ ≤ √D (½ + j/2) by the own cell's point, and has slope 1, so the slope is
/// 2 / max F₁, exactly. The gradient jumps between cells and at feature points.
pub(super) const PLANE: BasisBounds = BasisBounds::unit(PLANE_SLOPE, f64::INFINITY);
/// As in the plane.
pub(super) const SPACE: BasisBounds = BasisBounds::unit(SPACE_SLOPE, f64::INFINITY);

/// 2 / max F₁ = 2 / (√2 · 5/6), of j = 2/3.
const PLANE_SLOPE: f64 = 1.697_056_274_847_714;
/// 2 / max F₁ = 2 / (√3 · 3/4), of j = 1/2.
const SPACE_SLOPE: f64 = 1.539_600_717_839_002;

/// j/2 in the plane.
const PLANE_REACH: f64 = 1.0 / 3.0;
/// j/2 in space.
const SPACE_REACH: f64 = 0.25;

/// The noise in the plane.
#[inline(always)]
pub(super) fn plane<T: Real>(cell: &impl Axes<2>, fraction: [T; 2]) -> Jet<T, 2> {
    let [hx, hy] = neighbours(cell);
    let mut nearest = Nearest::none();
    for (j, hy) in hy.into_iter().enumerate() {
        for (i, hx) in hx.into_iter().enumerate() {
            nearest.offer(fraction, [i, j], vector2(mix2(hx, hy)), T::of(PLANE_REACH));
        }
    }
    nearest.jet(T::of(PLANE_SLOPE))
}

/// The noise in space.
#[inline(always)]
pub(super) fn space<T: Real>(cell: &impl Axes<3>, fraction: [T; 3]) -> Jet<T, 3> {
    let [hx, hy, hz] = neighbours(cell);
    let mut nearest = Nearest::none();
    for (k, hz) in hz.into_iter().enumerate() {
        for (j, hy) in hy.into_iter().enumerate() {
            for (i, hx) in hx.into_iter().enumerate() {
                nearest.offer(fraction, [i, j, k], vector3(mix3(hx, hy, hz)), T::of(SPACE_REACH));
            }
        }
    }
    nearest.jet(T::of(SPACE_SLOPE))
}

/// The hashes of each axis at the cell before, the cell and the cell after.
#[inline(always)]
fn neighbours<const D: usize>(cell: &impl Axes<D>) -> [[u32; 3]; D] {
    axes(|k| [cell.hash(k, -1), cell.hash(k, 0), cell.hash(k, 1)])
}

/// The nearest feature point so far.
struct Nearest<T, const D: usize> {
    /// From the point to the place.
    d: [T; D],
    /// The square of its length.
    square: T,
}

impl<T: Real, const D: usize> Nearest<T, D> {
    /// Farther than any feature point.
    #[inline(always)]
    fn none() -> Self {
        Self { d: [T::ZERO; D], square: T::of(100.0) }
    }

    /// Takes the point of the cell `i` − 1 cells away, if it is nearer.
    #[inline(always)]
    fn offer(&mut self, fraction: [T; D], i: [usize; D], vector: [T; D], reach: T) {
        let d: [T; D] = axes(|k| fraction[k] - (T::of_u32(i[k] as u32) - T::of(0.5)) - vector[k] * reach);
        let mut square = d[0] * d[0];
        for d in &d[1..] {
            square += *d * *d;
        }
        if square < self.square {
            *self = Self { d, square };
        }
    }

    /// The value and the gradient; at the point itself the gradient is 0.
    #[inline(always)]
    fn jet(self, slope: T) -> Jet<T, D> {
        let distance = self.square.sqrt();
        let per_length = slope / distance.max(T::of(1e-20));
        Jet { v: distance * slope - T::ONE, g: self.d.map(|d| d * per_length) }
    }
}
