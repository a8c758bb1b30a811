//! What holds everywhere: the range of a field, its slope, and how much a cut-off leaves out.

use super::compile::Compiled;
use super::curve::Curve;
use super::tree::{FractalNode, ImageNode, Node, Tree};
use super::walk::{Evaluator, Function, walk};
use crate::fractal::{Algebra, State, fade};
use crate::noise::BasisBounds;

#[cfg(feature = "baselines")]
mod octaves;

/// Bounds of a function over its whole domain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Everywhere {
    pub low: f64,
    pub high: f64,
    /// Lipschitz constant: no gradient is longer.
    slope: f64,
    /// The largest difference between the function and its cut-off form.
    pub left_out: f64,
    /// The largest absolute value of this function and of all that it is made of.
    pub peak: f64,
}

/// 0 · ∞ = 0: what vanishes everywhere stays so.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Everywhere {
    fn magnitude(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// This function's own values counted into the peak.
    fn peaked(self, of: f64) -> Self {
        // An overflow is NaN or infinite, and both must count: max would drop the NaN.
        let own = self.magnitude();
        let own = if own.is_nan() || self.low.is_nan() { f64::INFINITY } else { own };
        Self { peak: of.max(own), ..self }
    }

    /// The hull of both, as bounds of a function that may be either or lie between.
    fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            slope: self.slope.max(other.slope),
            left_out: self.left_out.max(other.left_out),
            peak: self.peak.max(other.peak),
        }
    }

    /// A function with slope between −1 and 1 of this one, which has these values.
    fn gentle(self, low: f64, high: f64) -> Self {
        Self { low, high, ..self }
    }
}

impl Algebra for Everywhere {
    type Scalar = f64;

    fn constant(v: f64) -> Self {
        Self { low: v, high: v, slope: 0.0, left_out: 0.0, peak: v.abs() }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
            slope: self.slope + other.slope,
            left_out: self.left_out + other.left_out,
            peak: 0.0,
        }
        .peaked(self.peak.max(other.peak))
    }

    fn times(self, other: Self) -> Self {
        let ends = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        let (a, b) = (self.magnitude(), other.magnitude());
        Self {
            low: ends.into_iter().fold(f64::INFINITY, f64::min),
            high: ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
            slope: product(a, other.slope) + product(b, self.slope),
            left_out: a * other.left_out + b * self.left_out + self.left_out * other.left_out,
            peak: 0.0,
        }
        .peaked(self.peak.max(other.peak).max(a * b))
    }

    fn scaled(self, by: f64) -> Self {
        let (a, b) = (self.low * by, self.high * by);
        Self {
            low: a.min(b),
            high: a.max(b),
            slope: product(self.slope, by.abs()),
            left_out: self.left_out * by.abs(),
            peak: 0.0,
        }
        .peaked(self.peak)
    }

    fn shifted(self, by: f64) -> Self {
        Self { low: self.low + by, high: self.high + by, ..self }.peaked(self.peak)
    }

    fn squared(self) -> Self {
        let square = self.times(self);
        let nearest = self.abs().low;
        Self { low: nearest * nearest, ..square }
    }

    fn abs(self) -> Self {
        let low = self.low.max(-self.high).max(0.0);
        self.gentle(low, self.magnitude())
    }

    fn at_most(self, limit: f64) -> Self {
        self.gentle(self.low.min(limit), self.high.min(limit))
    }

    fn at_least(self, limit: f64) -> Self {
        self.gentle(self.low.max(limit), self.high.max(limit))
    }
}

impl Function for Everywhere {
    fn smaller(self, other: Self) -> Self {
        self.hull(other).gentle(self.low.min(other.low), self.high.min(other.high))
    }

    fn curve(self, curve: &Curve) -> Self {
        let [low, high] = curve.bound(self.low, self.high).value;
        let steepest = curve.steepest();
        let left_out = self.left_out * steepest;
        Self { low, high, slope: product(self.slope, steepest), left_out, peak: 0.0 }
            .peaked(self.peak.max(curve.scale()))
    }

    fn blend(self, from: Self, to: Self) -> Self {
        let sum = from.plus(to.plus(from.negated()).times(self));
        sum.gentle(from.low.min(to.low), from.high.max(to.high))
    }
}

/// Bounds of everything at a cut-off.
struct CutOff<'a, const D: usize> {
    tree: &'a Tree<D>,
    cutoff: f64,
}

impl<const D: usize> Evaluator<D> for CutOff<'_, D> {
    type Value = Everywhere;

    fn fractal(&self, node: &FractalNode) -> Everywhere {
        let BasisBounds { low, high, slope, .. } = node.basis.bounds::<D>();
        let mut state = node.rule.start::<Everywhere>(node.offset);
        for octave in &node.octaves {
            let noise = Everywhere { low, high, slope: slope / octave.wavelength, left_out: 0.0, peak: 1.0 };
            let step = |state, fade| node.rule.step(state, noise, octave.weight, node.offset, fade);
            let next = step(state, octave.presence);
            // An octave adds presence · C(state); cut off, it adds fade · presence · C(state'), and what is left out is
            // (1 − fade) · presence · |C(state')| besides what was left out of the state. C of the result is what a
            // step adds to zero; the weight goes from the present one towards the next.
            let missing = octave.presence * (1.0 - fade(octave.wavelength, self.cutoff));
            let added = step(State { result: Everywhere::constant(0.0), ..state }, 1.0).result;
            let target = step(state, 1.0).weight;
            let moved = (target.high - state.weight.low).abs().max((state.weight.high - target.low).abs());
            // A cut-off fades octaves: what holds at any cut-off holds for the states without them as well.
            state.result = state.result.hull(next.result);
            state.weight = state.weight.hull(next.weight);
            state.result.left_out = next.result.left_out + missing * added.magnitude();
            state.weight.left_out = next.weight.left_out + if missing > 0.0 { missing * moved } else { 0.0 };
        }
        state.result.scaled(node.amplitude)
    }

    fn image(&self, node: &ImageNode) -> Everywhere {
        let ([low, high], slope) = node.ranges.everywhere();
        let per_metre = self.tree.layers[node.layer].matrix[0][0].max(self.tree.layers[node.layer].matrix[1][D - 1]);
        Everywhere { low, high, slope: slope * per_metre, left_out: 0.0, peak: 1.0 }
            .scaled(node.scale)
            .shifted(node.low)
    }

    fn warp(&self, field: &Node<D>, by: [Option<Everywhere>; D]) -> Everywhere {
        let inner = walk(self, field);
        let by = by.into_iter().flatten();
        let (slope, left_out, peak) = by.fold((0.0, 0.0, inner.peak), |(slope, left_out, peak), by| {
            (slope + by.slope, left_out + by.left_out, peak.max(by.peak))
        });
        Everywhere {
            slope: product(inner.slope, 1.0 + slope),
            left_out: inner.left_out + product(inner.slope, left_out),
            peak,
            ..inner
        }
    }

    fn triplanar(&self, plane: usize, _: u32) -> Everywhere {
        let tree = &self.tree.planes[plane];
        // Weights are at least 0 and sum to 1, but near the origin they turn without limit.
        let flat = walk(&CutOff { tree, cutoff: self.cutoff }, &tree.root);
        Everywhere { slope: f64::INFINITY, ..flat }
    }
}

impl<const D: usize> Tree<D> {
    /// What holds everywhere; what is left out, of this cut-off.
    pub(super) fn everywhere(&self, cutoff: f64) -> Everywhere {
        walk(&CutOff { tree: self, cutoff }, &self.root)
    }
}

impl<const D: usize> Compiled<D> {
    /// The largest difference between the field and what is left of it at a cut-off, in metres. Not always reached; infinite
    /// where a warp that loses octaves displaces a field of unbounded slope.
    pub fn left_out(&self, cutoff: f64) -> f64 {
        self.tree().everywhere(cutoff).left_out
    }

    /// A Lipschitz constant: no gradient anywhere, at any cut-off, is longer.
    pub fn slope(&self) -> f64 {
        self.tree().everywhere(0.0).slope
    }
}
