//! Fractal sums of octaves after Musgrave (Ebert et al., *Texturing & Modeling*, 3rd ed., ch. 16), one octave at a
//! time. The recurrences are written once, over an [`Algebra`]: plain jets, bounds, or any model of a function that
//! can be added and multiplied. `fractal.wgsl` is the twin.
//!
//! Notation: octave i has the noise n_i, the weight w_i = gainⁱ, the frequency lacunarityⁱ, Musgrave's offset o, and
//! a fade f_i in [0, 1], which multiplies its contribution: with f_i = 0 the state is as if there were no octave i.

use serde::{Deserialize, Serialize};

use crate::noise::BasisBounds;
use crate::real::{Jet, Real};

/// The WGSL twin: `FractalState2`, `fbm_start2`, `fbm_step2`, ... and the same in space. It stands alone.
pub const WGSL: &str = include_str!("fractal.wgsl");

/// How steeply a ridge gates the next octave; Musgrave's `gain` of his ridged multifractal.
pub const RIDGE_GAIN: f64 = 2.0;

/// What a recurrence needs of the functions that it combines: arithmetic that carries derivatives, or bounds, along.
pub trait Algebra: Copy {
    /// The type of factors that don't vary with the place.
    type Scalar: Real;
    /// A constant function.
    fn constant(v: Self::Scalar) -> Self;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The product.
    fn times(self, other: Self) -> Self;
    /// The product with a constant.
    fn scaled(self, by: Self::Scalar) -> Self;
    /// The sum with a constant.
    fn shifted(self, by: Self::Scalar) -> Self;
    /// The square.
    fn squared(self) -> Self;
    /// The absolute value.
    fn abs(self) -> Self;
    /// The smaller one of the function and a constant.
    fn at_most(self, limit: Self::Scalar) -> Self;
    /// The larger one of the function and a constant.
    fn at_least(self, limit: Self::Scalar) -> Self;
}

/// How octaves combine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
pub enum Rule {
    /// Fractional Brownian motion: Σ f_i w_i n_i. Equally rough everywhere.
    #[default]
    Fbm,
    /// Heterogeneous terrain: low ground is smooth, high ground rough. Musgrave's v_0 = o + n_0,
    /// v_i = v_{i−1} (1 + w_i (o + n_i)), divided by its mean Π_{i≥1} (1 + w_i o):
    ///
    /// v_i = v_{i−1} (1 + f_i n_i w_i / (1 + w_i o)), so that the mean is o, whichever octaves fade. Wants o ≥ 0.
    Heterogeneous,
    /// The hybrid multifractal: valleys are smooth at every height. From m_{−1} = 1, r = 0:
    /// s_i = w_i (o + n_i) min(m_{i−1}, 1), r += f_i s_i, m_i = s_i.
    Hybrid,
    /// The ridged multifractal: crests where the noise crosses zero. From m_{−1} = 1, r = 0:
    /// s_i = (o − |n_i|)² m_{i−1}, r += f_i w_i s_i, m_i = min([`RIDGE_GAIN`] s_i, 1).
    /// Its gradient jumps at the crests.
    Ridged,
}

/// The running state of a sum of octaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<A> {
    /// The sum so far; after the last octave, the result.
    pub result: A,
    /// What weights the next octave: m_i of the recurrences.
    pub weight: A,
}

impl Rule {
    /// The rule's name in WGSL; `_start2`, `_step2`, `_start3` and `_step3` follow it.
    pub const fn function(self) -> &'static str {
        match self {
            Self::Fbm => "fbm",
            Self::Heterogeneous => "heterogeneous",
            Self::Hybrid => "hybrid",
            Self::Ridged => "ridged",
        }
    }

    /// The state before the first octave.
    #[inline(always)]
    pub fn start<A: Algebra>(self, offset: A::Scalar) -> State<A> {
        let (zero, one) = (A::Scalar::ZERO, A::Scalar::ONE);
        match self {
            // The weight 1 + o makes the first step, which divides by it, add n_0 itself.
            Self::Heterogeneous => State { result: A::constant(offset), weight: A::constant(one + offset) },
            _ => State { result: A::constant(zero), weight: A::constant(one) },
        }
    }

    /// The state after one more octave: `n` is its noise, `w` its weight gainⁱ, `fade` its fade.
    #[inline(always)]
    pub fn step<A: Algebra>(self, state: State<A>, n: A, w: A::Scalar, offset: A::Scalar, fade: A::Scalar) -> State<A> {
        let one = A::Scalar::ONE;
        let (contribution, weight) = match self {
            Self::Fbm => return State { result: state.result.plus(n.scaled(w * fade)), weight: state.weight },
            Self::Heterogeneous => {
                let contribution = n.times(state.weight).scaled(w / (one + w * offset));
                (contribution, state.result.plus(contribution))
            }
            Self::Hybrid => {
                let signal = n.shifted(offset).scaled(w).times(state.weight.at_most(one));
                (signal, signal)
            }
            Self::Ridged => {
                let signal = n.abs().scaled(-one).shifted(offset).squared().times(state.weight);
                (signal.scaled(w), signal.scaled(A::Scalar::of(RIDGE_GAIN)).at_most(one))
            }
        };
        State {
            result: state.result.plus(contribution.scaled(fade)),
            weight: state.weight.scaled(one - fade).plus(weight.scaled(fade)),
        }
    }

    /// Proven bounds of the whole sum, whatever octaves fade, per unit of the first octave's lattice; `basis` bounds
    /// one octave. The curvature is infinite where the gradient jumps: at the crests of [`Rule::Ridged`], and where
    /// the weight of [`Rule::Hybrid`] passes 1.
    pub fn bounds(self, basis: BasisBounds, octaves: &Octaves) -> BasisBounds {
        let mut state = self.start::<BasisBounds>(octaves.offset);
        for octave in octaves.iter() {
            let n = BasisBounds {
                slope: basis.slope * octave.frequency,
                curvature: basis.curvature * octave.frequency * octave.frequency,
                ..basis
            };
            // A fade is constant in space, so a faded state lies between the states without and with the octave.
            let full = self.step(state, n, octave.weight, octaves.offset, octave.presence);
            state = State { result: state.result.hull(full.result), weight: state.weight.hull(full.weight) };
        }
        state.result
    }
}

/// The numbers of a sum of octaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves {
    /// How many octaves; of a fractional count, the last octave has the fraction's share.
    pub count: f64,
    /// The ratio of successive frequencies, above 1.
    pub lacunarity: f64,
    /// The ratio of successive weights, in (0, 1).
    pub gain: f64,
    /// Musgrave's offset, at least 0.
    pub offset: f64,
}

/// One octave's share in a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octave {
    /// Cycles per cycle of the first octave: lacunarityⁱ.
    pub frequency: f64,
    /// The weight w_i = gainⁱ.
    pub weight: f64,
    /// 1, or the fraction of the last octave of a fractional count; multiplies the fade.
    pub presence: f64,
}

impl Octaves {
    /// How many octaves there are, the fractional one included.
    pub fn len(&self) -> usize {
        self.count.ceil() as usize
    }

    /// Whether there is no octave.
    pub fn is_empty(&self) -> bool {
        self.count <= 0.0
    }

    /// The octaves, from the longest on. Powers are repeated products, which are the same on every platform.
    pub fn iter(&self) -> impl Iterator<Item = Octave> + '_ {
        let first = Octave { frequency: 1.0, weight: 1.0, presence: 1.0 };
        core::iter::successors(Some(first), |o| {
            Some(Octave { frequency: o.frequency * self.lacunarity, weight: o.weight * self.gain, ..*o })
        })
        .take(self.len())
        .enumerate()
        .map(|(i, octave)| Octave { presence: (self.count - i as f64).clamp(0.0, 1.0), ..octave })
    }
}

/// How much of a wavelength shows on a grid of spacing `cutoff`: none below the spacing, all from twice the spacing
/// on (Nyquist); all of it where the cut-off is 0. Same unit for both.
#[inline(always)]
pub fn fade<T: Real>(wavelength: T, cutoff: T) -> T {
    (wavelength / cutoff.max(T::of(1e-20)) - T::ONE).clamp(T::ZERO, T::ONE)
}

/// A value alone: what [`Jet`] does to its value, bit for bit.
impl<T: Real> Algebra for T {
    type Scalar = T;
    #[inline(always)]
    fn constant(v: T) -> Self {
        v
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn scaled(self, by: T) -> Self {
        self * by
    }
    #[inline(always)]
    fn shifted(self, by: T) -> Self {
        self + by
    }
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self < T::ZERO { self * -T::ONE } else { self }
    }
    #[inline(always)]
    fn at_most(self, limit: T) -> Self {
        if self < limit { self } else { limit }
    }
    #[inline(always)]
    fn at_least(self, limit: T) -> Self {
        if self > limit { self } else { limit }
    }
}

impl<T: Real, const D: usize> Algebra for Jet<T, D> {
    type Scalar = T;
    #[inline(always)]
    fn constant(v: T) -> Self {
        Self::constant(v)
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { v: self.v + other.v, g: core::array::from_fn(|k| self.g[k] + other.g[k]) }
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self { v: self.v * other.v, g: core::array::from_fn(|k| self.v * other.g[k] + other.v * self.g[k]) }
    }
    #[inline(always)]
    fn scaled(self, by: T) -> Self {
        Self { v: self.v * by, g: self.g.map(|g| g * by) }
    }
    #[inline(always)]
    fn shifted(self, by: T) -> Self {
        Self { v: self.v + by, g: self.g }
    }
    #[inline(always)]
    fn squared(self) -> Self {
        self.times(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self.v < T::ZERO { self.scaled(-T::ONE) } else { self }
    }
    #[inline(always)]
    fn at_most(self, limit: T) -> Self {
        if self.v < limit { self } else { Self::constant(limit) }
    }
    #[inline(always)]
    fn at_least(self, limit: T) -> Self {
        if self.v > limit { self } else { Self::constant(limit) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Layer;
    use crate::noise::Basis;
    use crate::place::Place;

    const RULES: [Rule; 4] = [Rule::Fbm, Rule::Heterogeneous, Rule::Hybrid, Rule::Ridged];
    const OCTAVES: Octaves = Octaves { count: 5.4, lacunarity: 1.93, gain: 0.55, offset: 0.8 };

    /// The noise of every octave at `x`, per unit of the first octave.
    fn noises(basis: Basis, x: [f64; 2]) -> Vec<Jet<f64, 2>> {
        let octave = |(seed, o): (usize, Octave)| {
            let matrix = basis.skew::<2>().map(|row| row.map(|m| m * o.frequency));
            let layer = Layer::<2>::new(matrix, [0.3, 0.7], seed as u32);
            let n = basis.jet(&layer.at(&layer.anchor(&Place::ORIGIN), x), layer.seed);
            Jet { v: n.v, g: layer.per_metre(n.g) }
        };
        OCTAVES.iter().enumerate().map(octave).collect()
    }

    fn sum(rule: Rule, basis: Basis, x: [f64; 2], fade: f64) -> Jet<f64, 2> {
        let mut state = rule.start(OCTAVES.offset);
        for (n, o) in noises(basis, x).into_iter().zip(OCTAVES.iter()) {
            state = rule.step(state, n, o.weight, OCTAVES.offset, o.presence * fade);
        }
        state.result
    }

    /// Musgrave's own loops, over whole octaves.
    #[test]
    fn rules_are_musgraves() {
        let (n, o): (Vec<f64>, f64) = (noises(Basis::Gradient, [0.4, -7.7]).iter().map(|n| n.v).collect(), 0.8);
        let w: Vec<f64> = OCTAVES.iter().map(|o| o.weight).collect();
        let octaves = 1..n.len();
        let fbm: f64 = n.iter().zip(&w).map(|(n, w)| n * w).sum();
        let (mut terrain, mut mean) = (n[0] + o, 1.0);
        let (mut hybrid, mut weight) = (n[0] + o, n[0] + o);
        let mut signal = (o - n[0].abs()).powi(2);
        let mut ridged = signal;
        for i in octaves {
            terrain += (n[i] + o) * w[i] * terrain;
            mean *= 1.0 + w[i] * o;
            weight = weight.min(1.0);
            hybrid += weight * (n[i] + o) * w[i];
            weight *= (n[i] + o) * w[i];
            signal = (o - n[i].abs()).powi(2) * (signal * 2.0).clamp(0.0, 1.0);
            ridged += signal * w[i];
        }
        for (rule, expected) in RULES.into_iter().zip([fbm, terrain / mean, hybrid, ridged]) {
            let mut state = rule.start::<Jet<f64, 2>>(o);
            for (n, w) in n.iter().zip(&w) {
                state = rule.step(state, Jet::constant(*n), *w, o, 1.0);
            }
            assert!((state.result.v - expected).abs() < 1e-12, "{rule:?} {} {expected}", state.result.v);
        }
    }

    #[test]
    fn gradients_are_derivatives_and_bounds_hold() {
        for (rule, basis) in RULES.into_iter().flat_map(|rule| [(rule, Basis::Gradient), (rule, Basis::Simplex)]) {
            let bounds = rule.bounds(basis.bounds::<2>(), &OCTAVES);
            assert_eq!(bounds.curvature.is_infinite(), matches!(rule, Rule::Hybrid | Rule::Ridged));
            let (h, mut skipped) = (1e-6, 0);
            for i in 0..2000 {
                let (x, fade) = ([f64::from(i) * 0.377 - 300.0, f64::from(i) * 0.619], f64::from(i % 4) / 3.0);
                let at = |dx: f64, dz: f64| sum(rule, basis, [x[0] + dx, x[1] + dz], fade).v;
                let n = sum(rule, basis, x, fade);
                let (before, after) = ([at(-h, 0.0), at(0.0, -h)], [at(h, 0.0), at(0.0, h)]);
                for k in 0..2 {
                    if (before[k] + after[k] - 2.0 * n.v).abs() > 1e-8 {
                        skipped += 1;
                    } else {
                        let difference = (after[k] - before[k]) / (2.0 * h);
                        assert!((difference - n.g[k]).abs() < 1e-6 * bounds.slope, "{rule:?} {difference} {n:?}");
                    }
                }
                assert!(bounds.low <= n.v && n.v <= bounds.high, "{rule:?} {n:?} {bounds:?}");
                assert!(n.g[0].hypot(n.g[1]) <= bounds.slope, "{rule:?} {n:?} {bounds:?}");
            }
            assert!(skipped < 20, "{rule:?}: {skipped} creases");
        }
    }

    #[test]
    fn a_faded_octave_leaves_no_trace() {
        let n = Jet { v: 0.3, g: [1.0, -2.0] };
        for rule in RULES {
            let state = rule.step(rule.start(0.8), n, 1.0, 0.8, 1.0);
            assert_eq!(rule.step(state, n, 0.5, 0.8, 0.0), state);
            let near = rule.step(state, n, 0.5, 0.8, 1e-9);
            let moved: f64 = near.result.v - state.result.v;
            assert!(moved.abs() < 1e-8);
        }
        assert_eq!([fade(10.0, 0.0), fade(10.0, 5.0), fade(10.0, 8.0), fade(10.0, 10.0)], [1.0, 1.0, 0.25, 0.0]);
    }
}
