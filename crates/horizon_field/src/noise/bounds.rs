//! What is known of a function without evaluating it: its range, its slope, its curvature; and how these combine.
//! They are the real bounds, in f64 without outward rounding: whoever proves with them pads for rounding.

use crate::fractal::Algebra;

/// Proven bounds of a function, in lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BasisBounds {
    /// No value is below.
    pub low: f64,
    /// No value is above.
    pub high: f64,
    /// A bound of the Euclidean norm of the gradient, and so a Lipschitz constant.
    pub slope: f64,
    /// A bound of the operator norm of the Hessian; infinite where the gradient jumps.
    pub curvature: f64,
}

impl BasisBounds {
    /// A function within [−1, 1].
    pub(crate) const fn unit(slope: f64, curvature: f64) -> Self {
        Self { low: -1.0, high: 1.0, slope, curvature }
    }

    /// The largest absolute value.
    pub fn magnitude(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Bounds of both functions, and of every blend of them by a constant.
    pub fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            slope: self.slope.max(other.slope),
            curvature: self.curvature.max(other.curvature),
        }
    }

    /// These bounds, of a function whose gradient may jump.
    fn creased(self) -> Self {
        Self { curvature: f64::INFINITY, ..self }
    }
}

/// The product of two magnitudes, 0 · ∞ being 0: what vanishes everywhere stays so.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Algebra for BasisBounds {
    type Scalar = f64;

    fn constant(v: f64) -> Self {
        Self { low: v, high: v, slope: 0.0, curvature: 0.0 }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
            slope: self.slope + other.slope,
            curvature: self.curvature + other.curvature,
        }
    }

    /// ∇(ab) = a∇b + b∇a; ∇²(ab) = a∇²b + ∇a∇bᵀ + ∇b∇aᵀ + b∇²a.
    fn times(self, other: Self) -> Self {
        let ends = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        let (a, b) = (self.magnitude(), other.magnitude());
        Self {
            low: ends.into_iter().fold(f64::INFINITY, f64::min),
            high: ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
            slope: product(a, other.slope) + product(b, self.slope),
            curvature: product(a, other.curvature)
                + 2.0 * product(self.slope, other.slope)
                + product(b, self.curvature),
        }
    }

    fn scaled(self, by: f64) -> Self {
        let (a, b) = (self.low * by, self.high * by);
        Self {
            low: a.min(b),
            high: a.max(b),
            slope: product(self.slope, by.abs()),
            curvature: product(self.curvature, by.abs()),
        }
    }

    fn shifted(self, by: f64) -> Self {
        Self { low: self.low + by, high: self.high + by, ..self }
    }

    fn squared(self) -> Self {
        let square = self.times(self);
        Self { low: self.abs().low * self.abs().low, ..square }
    }

    fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            self.scaled(-1.0)
        } else {
            Self { low: 0.0, high: self.magnitude(), ..self }.creased()
        }
    }

    fn at_most(self, limit: f64) -> Self {
        if self.high <= limit {
            self
        } else if self.low >= limit {
            Self::constant(limit)
        } else {
            Self { high: limit, ..self }.creased()
        }
    }

    fn at_least(self, limit: f64) -> Self {
        self.scaled(-1.0).at_most(-limit).scaled(-1.0)
    }
}
