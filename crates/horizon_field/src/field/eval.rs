//! Value and gradient at a point, generic over f32 and f64, by the same operations in the same order as the kernel.

use core::marker::PhantomData;

use super::compile::{Anchors, Compiled};
use super::sample::Sample;
use super::tree::{FractalNode, ImageNode, Node, OctaveNode, Tree};
use super::walk::{Evaluator, walk};
use crate::fractal::{Algebra, fade};
use crate::lattice::LatticePoint;
use crate::noise::Basis;
use crate::real::{Jet, Real};

/// The axes of the three planes of a triplanar projection: (y, z), (x, z), (x, y).
pub(super) const PLANES: [[usize; 2]; 3] = [[1, 2], [0, 2], [0, 1]];

/// A point of evaluation, at which an `S` is taken.
struct Point<'a, T, S, const D: usize> {
    tree: &'a Tree<D>,
    anchors: &'a Anchors<D>,
    q: [T; D],
    cutoff: T,
    taken: PhantomData<S>,
}

/// Takes an `S` at a point.
fn taken<T: Real, S: Sample<T, D>, const D: usize>(
    tree: &Tree<D>,
    anchors: &Anchors<D>,
    q: [T; D],
    cutoff: T,
    node: &Node<D>,
) -> S {
    walk(&Point { tree, anchors, q, cutoff, taken: PhantomData::<S> }, node)
}

impl<T: Real, S: Sample<T, D>, const D: usize> Evaluator<D> for Point<'_, T, S, D> {
    type Value = S;

    fn fractal(&self, node: &FractalNode) -> S {
        let offset = T::of(node.offset);
        let mut state = node.rule.start::<S>(offset);
        for (octave, fade) in node.present(self.cutoff) {
            let noise = S::of(self.tree.octave(node.basis, octave, self.anchors, self.q));
            state = node.rule.step(state, noise, T::of(octave.weight), offset, fade);
        }
        state.result.scaled(T::of(node.amplitude))
    }

    fn image(&self, node: &ImageNode) -> S {
        S::of(self.tree.image(node, self.anchors, self.q))
    }

    fn warp(&self, field: &Node<D>, by: [Option<S>; D]) -> S {
        let q = core::array::from_fn(|k| by[k].map_or(self.q[k], |by| self.q[k] + by.value()));
        taken::<T, S, D>(self.tree, self.anchors, q, self.cutoff, field).displaced(by)
    }

    fn triplanar(&self, plane: usize, sharpness: u32) -> S {
        let tree = &self.tree.planes[plane];
        let weights = weights(self.anchors.position, self.q, sharpness);
        let mut sum = S::constant(T::ZERO);
        for ((axes, anchors), weight) in PLANES.iter().zip(&self.anchors.planes[plane]).zip(weights) {
            let q = axes.map(|axis| self.q[axis]);
            let flat = taken(tree, anchors, q, self.cutoff, &tree.root);
            sum = sum.plus(S::lifted(flat, *axes).times(S::of(weight)));
        }
        sum
    }
}

impl FractalNode {
    /// The octaves that a cut-off leaves, with their fades. All that follow the first that is gone are shorter.
    #[inline(always)]
    pub(super) fn present<T: Real>(&self, cutoff: T) -> impl Iterator<Item = (&OctaveNode, T)> {
        self.octaves
            .iter()
            .map(move |octave| (octave, fade(T::of(octave.wavelength), cutoff) * T::of(octave.presence)))
            .take_while(|(_, fade)| *fade > T::ZERO)
    }
}

impl<const D: usize> Tree<D> {
    /// One octave's noise, at `q` metres from the anchors; its gradient per metre.
    #[inline(always)]
    pub(super) fn octave<T: Real>(
        &self,
        basis: Basis,
        octave: &OctaveNode,
        anchors: &Anchors<D>,
        q: [T; D],
    ) -> Jet<T, D> {
        let layer = &self.layers[octave.layer];
        let noise = basis.of_seeds(&layer.at(&anchors.points[octave.layer], q), layer.axis_seeds);
        Jet { v: noise.v, g: layer.per_metre(noise.g) }
    }

    /// An image's height, at `q` metres from the anchors; its gradient per metre.
    #[inline(always)]
    pub(super) fn image<T: Real>(&self, node: &ImageNode, anchors: &Anchors<D>, q: [T; D]) -> Jet<T, D> {
        let layer = &self.layers[node.layer];
        let at = layer.at(&anchors.points[node.layer], q);
        let texel = LatticePoint { cell: [at.cell[0], at.cell[1]], fraction: [at.fraction[0], at.fraction[1]] };
        let jet = node.image.jet(&texel, node.edge);
        let mut g = [T::ZERO; D];
        g[..2].copy_from_slice(&jet.g);
        Jet { v: jet.v, g: layer.per_metre(g) }.scaled(T::of(node.scale)).shifted(T::of(node.low))
    }
}

/// The planes' weights |pᵢ|ᵏ / Σ|pⱼ|ᵏ, where p is the position from the world's origin. They are the same for all
/// multiples of p, so p is divided by its largest component first: no power then overflows, and the sum is at least 1.
#[inline(always)]
pub(super) fn weights<T: Real, const D: usize>(origin: [f64; 3], q: [T; D], sharpness: u32) -> [Jet<T, D>; D] {
    let p: [T; D] = core::array::from_fn(|k| T::of(origin[k]) + q[k]);
    let largest = p.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()));
    if largest <= T::ZERO {
        return [Jet::constant(T::of(1.0 / 3.0)); D];
    }
    let inverse = T::ONE / largest;
    let mut powers = [T::ZERO; D];
    let mut slopes = [T::ZERO; D];
    let mut sum = T::ZERO;
    for k in 0..D {
        let a = p[k].abs() * inverse;
        let mut power = T::ONE;
        for _ in 1..sharpness {
            power *= a;
        }
        let sign = if p[k] < T::ZERO { -inverse } else { inverse };
        slopes[k] = T::of_u32(sharpness) * power * sign;
        powers[k] = power * a;
        sum += powers[k];
    }
    let share = T::ONE / sum;
    core::array::from_fn(|k| {
        let v = powers[k] * share;
        let g = core::array::from_fn(|j| ((if j == k { T::ONE } else { T::ZERO }) - v) * slopes[j] * share);
        Jet { v, g }
    })
}

impl<const D: usize> Compiled<D> {
    /// The value and the gradient per metre at `q` metres from an anchor; octaves that a grid of spacing `cutoff`
    /// metres can't show are faded out.
    #[inline]
    pub fn jet<T: Real>(&self, at: &Anchors<D>, q: [T; D], cutoff: T) -> Jet<T, D> {
        taken(self.tree(), at, q, cutoff, &self.tree().root)
    }

    /// The value alone: that of [`Compiled::jet`], bit for bit.
    #[inline]
    pub fn value<T: Real>(&self, at: &Anchors<D>, q: [T; D], cutoff: T) -> T {
        taken(self.tree(), at, q, cutoff, &self.tree().root)
    }

    /// [`Compiled::jet`] in double precision, compiled in this crate.
    pub fn jet_f64(&self, at: &Anchors<D>, q: [f64; D], cutoff: f64) -> Jet<f64, D> {
        self.jet(at, q, cutoff)
    }

    /// [`Compiled::jet`] in single precision, compiled in this crate.
    pub fn jet_f32(&self, at: &Anchors<D>, q: [f32; D], cutoff: f32) -> Jet<f32, D> {
        self.jet(at, q, cutoff)
    }

    /// [`Compiled::value`] in single precision, compiled in this crate.
    pub fn value_f32(&self, at: &Anchors<D>, q: [f32; D], cutoff: f32) -> f32 {
        self.value(at, q, cutoff)
    }
}
