//! Value and gradient at a point, generic over f32 and f64, by the same operations in the same order as the kernel.

use super::compile::{Anchors, Compiled};
use super::curve::Curve;
use super::tree::{FractalNode, ImageNode, Node, Tree};
use super::walk::{Evaluator, Function, walk};
use crate::fractal::{Algebra, fade};
use crate::lattice::LatticePoint;
use crate::real::{Jet, Real};

/// The axes of the three planes of a triplanar projection: (y, z), (x, z), (x, y).
pub(super) const PLANES: [[usize; 2]; 3] = [[1, 2], [0, 2], [0, 1]];

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

/// A point of evaluation.
struct Point<'a, T, const D: usize> {
    tree: &'a Tree<D>,
    anchors: &'a Anchors<D>,
    q: [T; D],
    cutoff: T,
}

impl<T: Real, const D: usize> Evaluator<D> for Point<'_, T, D> {
    type Value = Jet<T, D>;

    fn fractal(&self, node: &FractalNode) -> Jet<T, D> {
        let offset = T::of(node.offset);
        let mut state = node.rule.start::<Jet<T, D>>(offset);
        for octave in &node.octaves {
            let fade = fade(T::of(octave.wavelength), self.cutoff) * T::of(octave.presence);
            if fade <= T::ZERO {
                // All that follow are shorter.
                break;
            }
            let layer = &self.tree.layers[octave.layer];
            let noise = node.basis.jet(&layer.at(&self.anchors.points[octave.layer], self.q), layer.seed);
            let noise = Jet { v: noise.v, g: layer.per_metre(noise.g) };
            state = node.rule.step(state, noise, T::of(octave.weight), offset, fade);
        }
        state.result.scaled(T::of(node.amplitude))
    }

    fn image(&self, node: &ImageNode) -> Jet<T, D> {
        let layer = &self.tree.layers[node.layer];
        let at = layer.at(&self.anchors.points[node.layer], self.q);
        let texel = LatticePoint { cell: [at.cell[0], at.cell[1]], fraction: [at.fraction[0], at.fraction[1]] };
        let jet = node.image.jet(&texel, node.edge);
        let mut g = [T::ZERO; D];
        g[..2].copy_from_slice(&jet.g);
        Jet { v: jet.v, g: layer.per_metre(g) }.scaled(T::of(node.scale)).shifted(T::of(node.low))
    }

    fn warp(&self, field: &Node<D>, by: [Option<Jet<T, D>>; D]) -> Jet<T, D> {
        let q = core::array::from_fn(|k| by[k].map_or(self.q[k], |by| self.q[k] + by.v));
        let inner = walk(&Point { q, ..*self }, field);
        // ∇f(q + w(q)) = (I + ∇w)ᵀ ∇f.
        let mut g = inner.g;
        for (slope, by) in inner.g.into_iter().zip(by) {
            let Some(by) = by else { continue };
            for (sum, along) in g.iter_mut().zip(by.g) {
                *sum += slope * along;
            }
        }
        Jet { v: inner.v, g }
    }

    fn triplanar(&self, plane: usize, sharpness: u32) -> Jet<T, D> {
        let tree = &self.tree.planes[plane];
        let weights = weights(self.anchors.position, self.q, sharpness);
        let mut sum = Jet::constant(T::ZERO);
        for ((axes, anchors), weight) in PLANES.iter().zip(&self.anchors.planes[plane]).zip(weights) {
            let point = Point { tree, anchors, q: axes.map(|axis| self.q[axis]), cutoff: self.cutoff };
            let flat = walk(&point, &tree.root);
            let mut jet = Jet::constant(flat.v);
            for (axis, g) in axes.iter().zip(flat.g) {
                jet.g[*axis] = g;
            }
            sum = sum.plus(jet.times(weight));
        }
        sum
    }
}

/// The planes' weights |pᵢ|ᵏ / Σ|pⱼ|ᵏ, where p is the position from the world's origin. They are the same for all
/// multiples of p, so p is divided by its largest component first: no power then overflows, and the sum is at least 1.
fn weights<T: Real, const D: usize>(origin: [f64; 3], q: [T; D], sharpness: u32) -> [Jet<T, D>; D] {
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
        let tree = self.tree();
        walk(&Point { tree, anchors: at, q, cutoff }, &tree.root)
    }

    /// The value alone.
    #[inline]
    pub fn value<T: Real>(&self, at: &Anchors<D>, q: [T; D], cutoff: T) -> T {
        self.jet(at, q, cutoff).v
    }

    /// [`Compiled::jet`] in double precision, compiled in this crate.
    pub fn jet_f64(&self, at: &Anchors<D>, q: [f64; D], cutoff: f64) -> Jet<f64, D> {
        self.jet(at, q, cutoff)
    }

    /// [`Compiled::jet`] in single precision, compiled in this crate.
    pub fn jet_f32(&self, at: &Anchors<D>, q: [f32; D], cutoff: f32) -> Jet<f32, D> {
        self.jet(at, q, cutoff)
    }

    /// [`Compiled::value`] in double precision, compiled in this crate.
    pub fn value_f64(&self, at: &Anchors<D>, q: [f64; D], cutoff: f64) -> f64 {
        self.value(at, q, cutoff)
    }

    /// [`Compiled::value`] in single precision, compiled in this crate.
    pub fn value_f32(&self, at: &Anchors<D>, q: [f32; D], cutoff: f32) -> f32 {
        self.value(at, q, cutoff)
    }
}
