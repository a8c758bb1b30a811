//! Many points at once, in double precision: points share vector instructions, lane by lane, octave after octave.

use core::marker::PhantomData;

use multiversion::multiversion;

use super::compile::{Anchors, Compiled};
use super::curve::Curve;
use super::eval::{PLANES, weights};
use super::sample::Sample;
use super::tree::{FractalNode, ImageNode, Node, Tree};
use super::walk::{Evaluator, Function, walk};
use crate::fractal::{Algebra, Rule, State};
use crate::noise::{Lanes, high_hashes};
use crate::real::Jet;

/// How many points go through the tree together: enough to share the octaves' set-up, few enough for the nearest cache.
const LANES: usize = 32;

/// A function's values at as many points.
#[derive(Clone, Copy)]
struct Many<S>([S; LANES]);

impl<S: Copy> Many<S> {
    #[inline(always)]
    fn each(self, f: impl Fn(S) -> S) -> Self {
        let mut all = self.0;
        for x in &mut all {
            *x = f(*x);
        }
        Self(all)
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(S, S) -> S) -> Self {
        let mut all = self.0;
        for (x, y) in all.iter_mut().zip(&other.0) {
            *x = f(*x, *y);
        }
        Self(all)
    }
}

impl<S: Algebra> Algebra for Many<S> {
    type Scalar = S::Scalar;
    #[inline(always)]
    fn constant(v: S::Scalar) -> Self {
        Self([S::constant(v); LANES])
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.with(other, S::plus)
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self.with(other, S::times)
    }
    #[inline(always)]
    fn scaled(self, by: S::Scalar) -> Self {
        self.each(|x| x.scaled(by))
    }
    #[inline(always)]
    fn shifted(self, by: S::Scalar) -> Self {
        self.each(|x| x.shifted(by))
    }
    #[inline(always)]
    fn squared(self) -> Self {
        self.each(S::squared)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.each(S::abs)
    }
    #[inline(always)]
    fn at_most(self, limit: S::Scalar) -> Self {
        self.each(|x| x.at_most(limit))
    }
    #[inline(always)]
    fn at_least(self, limit: S::Scalar) -> Self {
        self.each(|x| x.at_least(limit))
    }
}

impl<S: Function> Function for Many<S> {
    fn smaller(self, other: Self) -> Self {
        self.with(other, S::smaller)
    }
    fn larger(self, other: Self) -> Self {
        self.with(other, S::larger)
    }
    fn curve(self, curve: &Curve) -> Self {
        self.each(|x| x.curve(curve))
    }
}

/// Points of evaluation, axis by axis, at which an `S` is taken.
struct Points<'a, S, const D: usize> {
    tree: &'a Tree<D>,
    anchors: &'a Anchors<D>,
    q: [[f64; LANES]; D],
    cutoff: f64,
    taken: PhantomData<S>,
}

impl<S, const D: usize> Points<'_, S, D> {
    fn point(&self, i: usize) -> [f64; D] {
        core::array::from_fn(|k| self.q[k][i])
    }
}

impl<S: Sample<f64, D>, const D: usize> Evaluator<D> for Points<'_, S, D> {
    type Value = Many<S>;

    fn fractal(&self, node: &FractalNode) -> Many<S> {
        let mut out = Many::constant(0.0);
        octaves(node, self, &mut out);
        out
    }

    fn image(&self, node: &ImageNode) -> Many<S> {
        Many(core::array::from_fn(|i| S::of(self.tree.image(node, self.anchors, self.point(i)))))
    }

    fn warp(&self, field: &Node<D>, by: [Option<Many<S>>; D]) -> Many<S> {
        let mut q = self.q;
        for (q, by) in q.iter_mut().zip(&by) {
            if let Some(by) = by {
                for (q, by) in q.iter_mut().zip(by.0) {
                    *q += by.value();
                }
            }
        }
        let Many(inner) = walk(&Points { q, ..*self }, field);
        Many(core::array::from_fn(|i| inner[i].displaced(by.map(|by| by.map(|by| by.0[i])))))
    }

    fn triplanar(&self, plane: usize, sharpness: u32) -> Many<S> {
        let tree = &self.tree.planes[plane];
        let weights: [_; LANES] =
            core::array::from_fn(|i| weights(self.anchors.position, self.point(i), sharpness).map(S::of));
        let mut sum = Many::constant(0.0);
        for (side, (axes, anchors)) in PLANES.iter().zip(&self.anchors.planes[plane]).enumerate() {
            let q = axes.map(|axis| self.q[axis]);
            let Many(flat) =
                walk(&Points { tree, anchors, q, cutoff: self.cutoff, taken: PhantomData::<S::Flat> }, &tree.root);
            let share = |i: usize| S::lifted(flat[i], *axes).times(weights[i][side]);
            sum = sum.plus(Many(core::array::from_fn(share)));
        }
        sum
    }
}

/// A sum of octaves; see [`super::query`] on the targets.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"))]
fn octaves<S: Sample<f64, D>, const D: usize>(node: &FractalNode, at: &Points<'_, S, D>, out: &mut Many<S>) {
    let State { result, weight } = node.rule.start::<S>(node.offset);
    let mut result = [result; LANES];
    let mut weight = [weight; LANES];
    let mut lanes = Lanes::<D, LANES>::new();
    let mut noise = [S::constant(0.0); LANES];
    for (octave, fade) in node.present(at.cutoff) {
        let (layer, anchor) = (&at.tree.layers[octave.layer], &at.anchors.points[octave.layer]);
        if lanes.points(layer, anchor, &at.q) {
            let high = high_hashes(layer, anchor);
            let each = |i: usize, jet: Jet<f64, D>| noise[i] = S::of(Jet { v: jet.v, g: layer.per_metre(jet.g) });
            lanes.noise(node.basis, |_| high, each);
        } else {
            for (i, noise) in noise.iter_mut().enumerate() {
                *noise = S::of(at.tree.octave(node.basis, octave, at.anchors, at.point(i)));
            }
        }
        let mut step = |rule: Rule| {
            for i in 0..LANES {
                let state = State { result: result[i], weight: weight[i] };
                let state = rule.step(state, noise[i], octave.weight, node.offset, fade);
                result[i] = state.result;
                weight[i] = state.weight;
            }
        };
        // The match is outside of the loop over the lanes.
        match node.rule {
            Rule::Fbm => step(Rule::Fbm),
            Rule::Heterogeneous => step(Rule::Heterogeneous),
            Rule::Hybrid => step(Rule::Hybrid),
            Rule::Ridged => step(Rule::Ridged),
        }
    }
    for (out, result) in out.0.iter_mut().zip(result) {
        *out = result.scaled(node.amplitude);
    }
}

fn all<S: Sample<f64, D>, const D: usize>(
    tree: &Tree<D>,
    anchors: &Anchors<D>,
    q: &[[f64; D]],
    cutoff: f64,
    out: &mut [S],
) {
    assert_eq!(q.len(), out.len(), "as many answers as points");
    for (q, out) in q.chunks(LANES).zip(out.chunks_mut(LANES)) {
        let q = core::array::from_fn(|k| core::array::from_fn(|i| q[i.min(q.len() - 1)][k]));
        let Many(taken) = walk(&Points { tree, anchors, q, cutoff, taken: PhantomData::<S> }, &tree.root);
        out.copy_from_slice(&taken[..out.len()]);
    }
}

impl<const D: usize> Compiled<D> {
    /// [`Compiled::value`] at many points, in double precision: the same bits, several times as fast. `out` takes one value
    /// for each point, in order. Panics where there are not as many of both.
    pub fn values_f64(&self, at: &Anchors<D>, q: &[[f64; D]], cutoff: f64, out: &mut [f64]) {
        all(self.tree(), at, q, cutoff, out);
    }

    /// [`Compiled::jet`] at many points, as [`Compiled::values_f64`].
    pub fn jets_f64(&self, at: &Anchors<D>, q: &[[f64; D]], cutoff: f64, out: &mut [Jet<f64, D>]) {
        all(self.tree(), at, q, cutoff, out);
    }
}
