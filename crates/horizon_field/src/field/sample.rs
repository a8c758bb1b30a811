//! What is taken at a point: the value alone, or with its gradient. The value is the same, bit for bit: it never depends
//! on a gradient, and what is not taken is not computed.

use super::curve::Curve;
use super::walk::Function;
use crate::real::{Jet, Real};

/// A value, with or without its gradient.
pub(super) trait Sample<T: Real, const D: usize>: Function<Scalar = T> {
    /// The same in the plane.
    type Flat: Sample<T, 2>;

    /// What is taken of a value and gradient.
    fn of(jet: Jet<T, D>) -> Self;

    /// The value.
    fn value(self) -> T;

    /// A field at a point that is displaced, from what it is there: ∇f(q + w(q)) = (I + ∇w)ᵀ ∇f.
    fn displaced(self, by: [Option<Self>; D]) -> Self;

    /// A field of a plane, which these axes span.
    fn lifted(flat: Self::Flat, axes: [usize; 2]) -> Self;
}

impl<T: Real> Function for T {
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    #[inline(always)]
    fn curve(self, curve: &Curve) -> Self {
        curve.at(self)[0]
    }
}

impl<T: Real, const D: usize> Sample<T, D> for T {
    type Flat = T;

    #[inline(always)]
    fn of(jet: Jet<T, D>) -> Self {
        jet.v
    }

    #[inline(always)]
    fn value(self) -> T {
        self
    }

    #[inline(always)]
    fn displaced(self, _: [Option<Self>; D]) -> Self {
        self
    }

    #[inline(always)]
    fn lifted(flat: T, _: [usize; 2]) -> Self {
        flat
    }
}

impl<T: Real, const D: usize> Function for Jet<T, D> {
    #[inline]
    fn smaller(self, other: Self) -> Self {
        if other.v < self.v { other } else { self }
    }

    #[inline]
    fn larger(self, other: Self) -> Self {
        if other.v > self.v { other } else { self }
    }

    #[inline]
    fn curve(self, curve: &Curve) -> Self {
        let [v, slope] = curve.at(self.v);
        Self { v, g: self.g.map(|g| slope * g) }
    }
}

impl<T: Real, const D: usize> Sample<T, D> for Jet<T, D> {
    type Flat = Jet<T, 2>;

    #[inline(always)]
    fn of(jet: Self) -> Self {
        jet
    }

    #[inline(always)]
    fn value(self) -> T {
        self.v
    }

    #[inline]
    fn displaced(self, by: [Option<Self>; D]) -> Self {
        let mut g = self.g;
        for (slope, by) in self.g.into_iter().zip(by) {
            let Some(by) = by else { continue };
            for (sum, along) in g.iter_mut().zip(by.g) {
                *sum += slope * along;
            }
        }
        Self { v: self.v, g }
    }

    #[inline]
    fn lifted(flat: Jet<T, 2>, axes: [usize; 2]) -> Self {
        let mut jet = Self::constant(flat.v);
        for (axis, g) in axes.into_iter().zip(flat.g) {
            jet.g[axis] = g;
        }
        jet
    }
}
