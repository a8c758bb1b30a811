//! Lattice noise in the plane and in space: value, gradient, simplex and Worley, each with its exact gradient, proven
//! bounds, and its WGSL twin beside it. All are generic over `f32` and `f64`, and use the same order of operations as
//! the twin. Nothing here is periodic but [`periodic`], and no coordinate is absolute: see [`crate::lattice`].

mod axes;
mod bounds;
mod corner;
mod gradient;
mod lanes;
mod periodic;
mod simplex;
mod value;
mod worley;

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use bounds::BasisBounds;
pub(crate) use lanes::{HighWords, Lanes, high_hashes};
pub use periodic::{PERIODIC_WGSL, periodic, periodic_worley};

use axes::{Axes, Cell};

use crate::hash::axis_seed;
use crate::lattice::LatticePoint;
use crate::real::{Jet, Real, axes};

/// A noise of one octave, with values in [−1, 1] and features of about one lattice unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
pub enum Basis {
    /// Random values at lattice points, interpolated. Cheap and blobby, with visible axes.
    Value,
    /// Perlin's improved noise (2002): random slopes at lattice points, zero at each of them.
    #[default]
    Gradient,
    /// Perlin's simplex noise (2001), with kernels that end inside their simplices: fewer corners, no axes.
    Simplex,
    /// The distance to the nearest feature point (Worley 1996): cells, with a crease between each two.
    Worley,
}

impl Basis {
    /// Proven bounds, per unskewed lattice unit. `D` is 2 or 3.
    pub const fn bounds<const D: usize>(self) -> BasisBounds {
        const { assert!(D == 2 || D == 3) }
        match (self, D) {
            (Self::Value, 2) => value::PLANE,
            (Self::Value, _) => value::SPACE,
            (Self::Gradient, 2) => gradient::PLANE,
            (Self::Gradient, _) => gradient::SPACE,
            (Self::Simplex, 2) => simplex::PLANE,
            (Self::Simplex, _) => simplex::SPACE,
            (Self::Worley, 2) => worley::PLANE,
            (Self::Worley, _) => worley::SPACE,
        }
    }

    /// The value and the gradient at a lattice point, per unit of the layer's (for simplex, skewed) coordinates.
    /// `D` is 2 or 3.
    #[inline]
    pub fn jet<T: Real, const D: usize>(self, at: &LatticePoint<T, D>, seed: u32) -> Jet<T, D> {
        self.of_seeds(at, core::array::from_fn(|k| axis_seed(seed, k as u32)))
    }

    /// [`Basis::jet`], of a layer's [`axis_seeds`](crate::lattice::Layer::axis_seeds).
    #[inline(always)]
    pub(crate) fn of_seeds<T: Real, const D: usize>(self, at: &LatticePoint<T, D>, seeds: [u32; D]) -> Jet<T, D> {
        self.of_axes(&Cell { cell: at.cell, seeds }, at.fraction)
    }

    /// The noise itself. Who takes the value alone pays for the value alone: inlining removes the gradient.
    #[inline(always)]
    fn of_axes<T: Real, const D: usize>(self, cell: &impl Axes<D>, fraction: [T; D]) -> Jet<T, D> {
        const { assert!(D == 2 || D == 3) }
        // One of the two branches is left after monomorphisation; copying element-wise is what lets both compile.
        if D == 2 {
            let (cell, fraction) = (&Resized(cell), resized(fraction));
            widened(match self {
                Self::Value => value::plane(cell, fraction),
                Self::Gradient => gradient::plane(cell, fraction),
                Self::Simplex => simplex::plane(cell, fraction),
                Self::Worley => worley::plane(cell, fraction),
            })
        } else {
            let (cell, fraction) = (&Resized(cell), resized(fraction));
            widened(match self {
                Self::Value => value::space(cell, fraction),
                Self::Gradient => gradient::space(cell, fraction),
                Self::Simplex => simplex::space(cell, fraction),
                Self::Worley => worley::space(cell, fraction),
            })
        }
    }

    /// The linear map from unskewed lattice units to the layer's coordinates: the identity, but for simplex noise.
    pub fn skew<const D: usize>(self) -> [[f64; D]; D] {
        // Simplex: I + F·1 with F = (√(D + 1) − 1)/D stretches simplices along the diagonal until they fill cubes.
        let f = if self == Self::Simplex { (((D + 1) as f64).sqrt() - 1.0) / D as f64 } else { 0.0 };
        core::array::from_fn(|row| core::array::from_fn(|column| f + if row == column { 1.0 } else { 0.0 }))
    }

    /// The WGSL source, for both the plane and space; `hash.wgsl` and `lattice.wgsl` come before it.
    pub const fn wgsl(self) -> &'static str {
        match self {
            Self::Value => include_str!("value.wgsl"),
            Self::Gradient => include_str!("gradient.wgsl"),
            Self::Simplex => include_str!("simplex.wgsl"),
            Self::Worley => include_str!("worley.wgsl"),
        }
    }

    /// The function's name in WGSL, without the dimension: `value` for `value2(p: LatticePoint2, seed: u32)`, which
    /// returns the value and the gradient as a `vec3<f32>`, and `value3`, which returns a `vec4<f32>`.
    pub const fn function(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Gradient => "gradient",
            Self::Simplex => "simplex",
            Self::Worley => "worley",
        }
    }
}

/// The same coordinates, in a type of as many dimensions.
#[inline(always)]
fn resized<T: Real, const D: usize, const E: usize>(x: [T; D]) -> [T; E] {
    axes(|k| x[k.min(D - 1)])
}

/// The same axes, in a type of as many dimensions.
struct Resized<'a, A, const D: usize>(&'a A);

impl<A: Axes<D>, const D: usize, const E: usize> Axes<E> for Resized<'_, A, D> {
    #[inline(always)]
    fn hash(&self, k: usize, i: i32) -> u32 {
        self.0.hash(k.min(D - 1), i)
    }
}

/// The same jet, in a type of as many dimensions.
#[inline(always)]
fn widened<T: Real, const D: usize, const E: usize>(jet: Jet<T, D>) -> Jet<T, E> {
    Jet { v: jet.v, g: axes(|k| jet.g[k.min(D - 1)]) }
}
