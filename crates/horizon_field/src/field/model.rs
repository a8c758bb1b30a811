//! Arithmetic of Taylor models: how bounds combine. Notation: a box of half extents h about a centre; a function is
//! v + g·d + e with |e| ≤ rest for |dᵢ| ≤ hᵢ; S is how far it gets from v, at most Σ|gᵢ|hᵢ + rest.

use super::bound::{Bound, interval_product};
use super::curve::Curve;
use super::walk::Function;
use crate::fractal::Algebra;

/// How far rounding takes an operation, in the model's arithmetic and in the field's evaluation together, as a share of
/// the largest operand: some units in the last place. Sums may cancel, so the result says nothing of it.
const ROUNDING: f64 = 1e-15;

/// A bound, with the box that it holds for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model<const D: usize> {
    pub bound: Bound<D>,
    half: [f64; D],
}

impl<const D: usize> Model<D> {
    /// Brings what is known in agreement. A linear model whose rest alone is as large as the interval is worth less than
    /// the interval's middle; but else it is worth more, however steep, to whoever knows where in the box he is.
    pub(crate) fn new(bound: Bound<D>, half: [f64; D]) -> Self {
        let mut model = Self { bound, half };
        let spread = model.spread();
        let Bound { v, g, rest, low, high, .. } = &mut model.bound;
        if spread.is_finite() {
            let pad = ROUNDING * (v.abs() + spread);
            *rest += pad;
            *low = low.max(*v - spread - pad);
            *high = high.min(*v + spread + pad);
        }
        let reach = 0.5 * (*high - *low);
        if rest.is_nan() || *rest > reach {
            *v = 0.5 * (*low + *high);
            *g = [0.0; D];
            *rest = reach + ROUNDING * (low.abs() + high.abs());
        }
        model
    }

    /// As [`Model::new`], of what an operation made of operands that are as large as `operands`.
    fn rounded(bound: Bound<D>, operands: f64, half: [f64; D]) -> Self {
        let pad = ROUNDING * operands;
        Self::new(Bound { rest: bound.rest + pad, low: bound.low - pad, high: bound.high + pad, ..bound }, half)
    }

    /// The largest absolute value.
    fn magnitude(&self) -> f64 {
        self.bound.low.abs().max(self.bound.high.abs()).max(self.bound.v.abs())
    }

    /// How far the linear model and its rest get from v.
    fn spread(&self) -> f64 {
        self.bound.g.iter().zip(self.half).map(|(g, h)| g.abs() * h).sum::<f64>() + self.bound.rest
    }

    /// How far the function gets from v: S, or less, as the interval says.
    pub(super) fn deviation(&self) -> f64 {
        let Bound { v, low, high, .. } = self.bound;
        self.spread().min((high - v).max(v - low))
    }

    /// The same function, of which it is also known that it lies in an interval.
    pub(crate) fn within(self, low: f64, high: f64) -> Self {
        let bound = Bound { low: self.bound.low.max(low), high: self.bound.high.min(high), ..self.bound };
        Self::new(bound, self.half)
    }

    /// 1 / f, of a function that is positive on all of the box, as the interval and the linear model both say.
    pub(crate) fn reciprocal(self) -> Self {
        let [low, high] = self.reach();
        let (at, [least, most]) = (self.bound.v, [low.max(f64::MIN_POSITIVE), high].map(|u| 1.0 / u));
        let slope = [-least * least, -most * most];
        self.composed([1.0 / at, -1.0 / (at * at)], [most, least], slope, 2.0 * least * least * least)
    }

    /// The largest extents of both boxes: a constant has none.
    fn half_with(&self, other: &Self) -> [f64; D] {
        core::array::from_fn(|k| self.half[k].max(other.half[k]))
    }

    /// φ of the function. Over all its values, and v, φ' lies in `slope` and |φ''| is at most `curvature`; `at` is φ and φ'
    /// at v, `value` the range of φ.
    ///
    /// Either φ(u) = φ(v) + φ'(v)(u − v) ± ½ sup|φ''| S², or, with s the middle of the slopes and r half their width,
    /// φ(u) = φ(v) + s(u − v) ± r S, which holds across kinks.
    fn composed(self, at: [f64; 2], value: [f64; 2], slope: [f64; 2], curvature: f64) -> Self {
        let Bound { g, rest, .. } = self.bound;
        let spread = self.deviation();
        let smooth = (at[1], 0.5 * curvature * spread * spread);
        let secant = (0.5 * (slope[0] + slope[1]), 0.5 * (slope[1] - slope[0]) * spread);
        let (s, error) = if smooth.1.is_finite() && smooth.1 <= secant.1 { smooth } else { secant };
        let bound = Bound {
            v: at[0],
            g: g.map(|g| s * g),
            rest: s.abs() * rest + error,
            low: value[0],
            high: value[1],
            slope: self.bound.slope.map(|own| interval_product(own, slope)),
        };
        let steepest = slope[0].abs().max(slope[1].abs());
        let operands = self.magnitude() * steepest + value[0].abs().max(value[1].abs());
        Self::rounded(bound, operands, self.half)
    }

    /// The interval of the values, and of v, which may be outside.
    fn reach(&self) -> [f64; 2] {
        [self.bound.low.min(self.bound.v), self.bound.high.max(self.bound.v)]
    }
}

impl<const D: usize> Algebra for Model<D> {
    type Scalar = f64;

    fn constant(v: f64) -> Self {
        let pad = ROUNDING * v.abs();
        let bound = Bound { v, g: [0.0; D], rest: pad, low: v - pad, high: v + pad, slope: [[0.0; 2]; D] };
        Self { bound, half: [0.0; D] }
    }

    fn plus(self, other: Self) -> Self {
        let (a, b) = (self.bound, other.bound);
        let bound = Bound {
            v: a.v + b.v,
            g: core::array::from_fn(|k| a.g[k] + b.g[k]),
            rest: a.rest + b.rest,
            low: a.low + b.low,
            high: a.high + b.high,
            slope: core::array::from_fn(|k| [a.slope[k][0] + b.slope[k][0], a.slope[k][1] + b.slope[k][1]]),
        };
        Self::rounded(bound, self.magnitude() + other.magnitude(), self.half_with(&other))
    }

    /// (a + α)(b + β) = ab + aβ + bα + αβ, of which the linear parts of the first three are the model's.
    fn times(self, other: Self) -> Self {
        let (a, b) = (self.bound, other.bound);
        let [low, high] = interval_product([a.low, a.high], [b.low, b.high]);
        let bound = Bound {
            v: a.v * b.v,
            g: core::array::from_fn(|k| a.v * b.g[k] + b.v * a.g[k]),
            rest: a.v.abs() * b.rest + b.v.abs() * a.rest + self.deviation() * other.deviation(),
            low,
            high,
            slope: core::array::from_fn(|k| {
                let x = interval_product([a.low, a.high], b.slope[k]);
                let y = interval_product([b.low, b.high], a.slope[k]);
                [x[0] + y[0], x[1] + y[1]]
            }),
        };
        Self::rounded(bound, self.magnitude() * other.magnitude(), self.half_with(&other))
    }

    fn scaled(self, by: f64) -> Self {
        let a = self.bound;
        let [low, high] = interval_product([a.low, a.high], [by; 2]);
        let bound = Bound {
            v: a.v * by,
            g: a.g.map(|g| g * by),
            rest: a.rest * by.abs(),
            low,
            high,
            slope: a.slope.map(|slope| interval_product(slope, [by; 2])),
        };
        Self::rounded(bound, self.magnitude() * by.abs(), self.half)
    }

    fn shifted(self, by: f64) -> Self {
        self.plus(Self::constant(by))
    }

    fn squared(self) -> Self {
        let Bound { v, .. } = self.bound;
        let [low, high] = self.reach();
        let nearest = low.max(-high).max(0.0);
        let farthest = low.abs().max(high.abs());
        self.composed([v * v, 2.0 * v], [nearest * nearest, farthest * farthest], [2.0 * low, 2.0 * high], 2.0)
    }

    fn abs(self) -> Self {
        let [low, high] = self.reach();
        if low >= 0.0 {
            return self;
        }
        if high <= 0.0 {
            return self.negated();
        }
        self.composed([self.bound.v.abs(), 0.0], [0.0, high.max(-low)], [-1.0, 1.0], f64::INFINITY)
    }

    fn at_most(self, limit: f64) -> Self {
        let [low, high] = self.reach();
        if high <= limit {
            return self;
        }
        if low >= limit {
            return Self { half: self.half, ..Self::constant(limit) };
        }
        let value = [self.bound.low.min(limit), self.bound.high.min(limit)];
        self.composed([self.bound.v.min(limit), 0.0], value, [0.0, 1.0], f64::INFINITY)
    }

    fn at_least(self, limit: f64) -> Self {
        self.negated().at_most(-limit).negated()
    }
}

impl<const D: usize> Function for Model<D> {
    /// min(a, b) = b + min(a − b, 0).
    fn smaller(self, other: Self) -> Self {
        let (a, b) = (self.bound, other.bound);
        if a.high <= b.low {
            return self;
        }
        if b.high <= a.low {
            return other;
        }
        let mut least = other.plus(self.plus(other.negated()).at_most(0.0));
        least.bound.slope =
            core::array::from_fn(|k| [a.slope[k][0].min(b.slope[k][0]), a.slope[k][1].max(b.slope[k][1])]);
        least.within(a.low.min(b.low), a.high.min(b.high))
    }

    fn curve(self, curve: &Curve) -> Self {
        let [low, high] = self.reach();
        let over = curve.bound(low, high);
        let ends = [curve.at(self.bound.low)[0], curve.at(self.bound.high)[0]];
        // No curve falls, but rounding may make a level one seem to; and steps are added that cancel.
        let pad = ROUNDING * curve.scale();
        let value = [ends[0].min(ends[1]) - pad, ends[0].max(ends[1]) + pad];
        let composed = self.composed(curve.at(self.bound.v), value, over.slope, over.curvature);
        Self::rounded(composed.bound, curve.scale(), self.half)
    }

    fn blend(self, from: Self, to: Self) -> Self {
        let blend = from.plus(to.plus(from.negated()).times(self));
        let (low, high) = (from.bound.low.min(to.bound.low), from.bound.high.max(to.bound.high));
        let pad = ROUNDING * (from.magnitude() + to.magnitude());
        blend.within(low - pad, high + pad)
    }

    fn smooth_min(self, other: Self, round: &Curve) -> Self {
        let least = other.plus(self.plus(other.negated()).curve(round));
        // At most as high as either, and lower than their minimum by a quarter of the radius, where both are equal.
        let deepest = -round.at(0.0_f64)[0];
        let low = self.bound.low.min(other.bound.low) - deepest;
        let high = self.bound.high.min(other.bound.high);
        let pad = ROUNDING * (self.magnitude() + other.magnitude());
        least.within(low - pad, high + pad)
    }
}
