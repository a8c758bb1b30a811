//! What is proven of a field over a box: a first-order Taylor model, an interval, and intervals of the slopes.

use super::compile::{Anchors, Compiled};
use super::eval::PLANES;
use super::model::Model;
use super::tree::{FractalNode, ImageNode, Node, Tree};
use super::walk::{Evaluator, walk};
use crate::fractal::Algebra;

/// A first-order Taylor model over the box `centre` ± `half`: `|f(centre + d) − v − g·d| ≤ rest` for all d in the box.
/// And intervals of the values and of the slopes along each axis, also over the box. Sound including rounding.
///
/// `v` and `g` need not be the field's value and gradient at the centre: of octaves that turn within the box they have
/// the middle of the range, and 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound<const D: usize> {
    /// The model's value at the centre, in metres.
    pub v: f64,
    /// The model's gradient.
    pub g: [f64; D],
    /// How far the field is from the model at most, in metres.
    pub rest: f64,
    /// No value is below.
    pub low: f64,
    /// No value is above.
    pub high: f64,
    /// The smallest and the largest slope along each axis.
    pub slope: [[f64; 2]; D],
}

impl<const D: usize> Compiled<D> {
    /// What is proven for all points that differ from `centre` by at most `half` on each axis; metres from the anchor.
    pub fn bound(&self, at: &Anchors<D>, centre: [f64; D], half: [f64; D]) -> Bound<D> {
        let tree = self.tree();
        walk(&Region { tree, anchors: at, centre, half }, &tree.root).bound
    }
}

/// A box.
struct Region<'a, const D: usize> {
    tree: &'a Tree<D>,
    anchors: &'a Anchors<D>,
    centre: [f64; D],
    half: [f64; D],
}

/// Of a value, for the evaluation's rounding: the lattice point, the noise, the sum.
const RELATIVE: f64 = 1e-12;

impl<const D: usize> Region<'_, D> {
    /// How far rounding may move a lattice coordinate, in metres: some units in the last place of the metres.
    fn misplaced(&self) -> f64 {
        4e-16 * self.centre.iter().zip(self.half).map(|(c, h)| c.abs() + h).sum::<f64>()
    }
}

impl<const D: usize> Evaluator<D> for Region<'_, D> {
    type Value = Model<D>;

    fn fractal(&self, node: &FractalNode) -> Model<D> {
        let basis = node.basis.bounds::<D>();
        let radius = self.half.iter().map(|h| h * h).sum::<f64>().sqrt();
        let (middle, reach) = (0.5 * (basis.low + basis.high), 0.5 * (basis.high - basis.low));
        let misplaced = self.misplaced();
        let mut state = node.rule.start::<Model<D>>(node.offset);
        for octave in &node.octaves {
            let slope = basis.slope / octave.wavelength;
            let curvature = basis.curvature / (octave.wavelength * octave.wavelength);
            let pad = RELATIVE + slope * misplaced;
            let mut bound = Bound {
                v: middle,
                g: [0.0; D],
                rest: reach + pad,
                low: basis.low - pad,
                high: basis.high + pad,
                slope: [[-slope, slope]; D],
            };
            // Where the octave turns within the box, no evaluation can beat its range.
            if slope * radius < reach || 0.5 * curvature * radius * radius < reach {
                let layer = &self.tree.layers[octave.layer];
                let jet = node.basis.jet(&layer.at(&self.anchors.points[octave.layer], self.centre), layer.seed);
                let g = layer.per_metre(jet.g);
                let straight = Bound { v: jet.v, rest: slope * radius + pad, ..bound };
                bound = if curvature.is_finite() {
                    // |∇f(c + d) − ∇f(c)| ≤ curvature · |d|, and the remainder is half of that times |d|.
                    let turn = curvature * radius;
                    let steepness = slope * (1.0 + RELATIVE);
                    let slope =
                        g.map(|g| [(g - turn - RELATIVE).max(-steepness), (g + turn + RELATIVE).min(steepness)]);
                    let slope = slope.map(|[low, high]| [low - RELATIVE * steepness, high + RELATIVE * steepness]);
                    let curved = Bound { v: jet.v, g, rest: 0.5 * turn * radius + pad, slope, ..bound };
                    if curved.rest <= straight.rest { curved } else { Bound { slope, ..straight } }
                } else {
                    straight
                };
            }
            let noise = Model::new(bound, self.half);
            state = node.rule.step(state, noise, octave.weight, node.offset, octave.presence);
        }
        state.result.scaled(node.amplitude)
    }

    fn image(&self, node: &ImageNode) -> Model<D> {
        let layer = &self.tree.layers[node.layer];
        let at = layer.at(&self.anchors.points[node.layer], self.centre);
        let scale: [f64; 2] = [layer.matrix[0][0], layer.matrix[1][D - 1]];
        let half = [self.half[0] * scale[0], self.half[D - 1] * scale[1]];
        let misplaced = self.misplaced() * scale[0].max(scale[1]);
        let cells = core::array::from_fn(|k| {
            let reach = half[k] + misplaced + RELATIVE;
            [at.fraction[k] - reach, at.fraction[k] + reach].map(|x| at.cell[k].saturating_add(x.floor() as i64))
        });
        let texels = node.ranges.bound(&node.image, node.edge, cells);
        let pad = RELATIVE + misplaced;
        let [low, high] = [texels.value[0] - pad, texels.value[1] + pad];
        let axes = [0, D - 1];
        let mut slope = [[0.0; 2]; D];
        let mut g = [0.0; D];
        for k in 0..2 {
            slope[axes[k]] = texels.slope[k].map(|s| s * scale[k]);
            slope[axes[k]] = [slope[axes[k]][0] - RELATIVE * scale[k], slope[axes[k]][1] + RELATIVE * scale[k]];
        }
        let [xx, xz, zz] = texels.curvature;
        let mut bound = Bound { v: 0.5 * (low + high), g, rest: 0.5 * (high - low), low, high, slope };
        if xx.is_finite() {
            let texel =
                crate::LatticePoint { cell: [at.cell[0], at.cell[1]], fraction: [at.fraction[0], at.fraction[1]] };
            let jet = node.image.jet(&texel, node.edge);
            for k in 0..2 {
                g[axes[k]] = jet.g[k] * scale[k];
            }
            let rest = 0.5 * (xx * half[0] * half[0] + 2.0 * xz * half[0] * half[1] + zz * half[1] * half[1]);
            bound = Bound { v: jet.v, g, rest: rest + pad, ..bound };
        }
        Model::new(bound, self.half).scaled(node.scale).shifted(node.low)
    }

    fn warp(&self, field: &Node<D>, by: [Option<Model<D>>; D]) -> Model<D> {
        // The inner box is about the displaced centre, and larger by what the displacement varies.
        let mut inner = Region { centre: self.centre, half: self.half, ..*self };
        for k in 0..D {
            let Some(by) = by[k] else { continue };
            inner.centre[k] += by.bound.v;
            inner.half[k] += by.deviation() + RELATIVE * (inner.centre[k].abs() + inner.half[k]);
        }
        let outer = walk(&inner, field).bound;
        // With w(c + d) = v_w + g_w·d + rest_w: f = v + g·(d + g_w·d + rest_w) + rest.
        let mut bound = outer;
        for k in 0..D {
            let Some(by) = by[k].map(|by| by.bound) else { continue };
            bound.rest += outer.g[k].abs() * by.rest;
            for j in 0..D {
                bound.g[j] += outer.g[k] * by.g[j];
                let along = interval_product(outer.slope[k], by.slope[j]);
                bound.slope[j] = [bound.slope[j][0] + along[0], bound.slope[j][1] + along[1]];
            }
        }
        Model::new(bound, self.half)
    }

    fn triplanar(&self, plane: usize, sharpness: u32) -> Model<D> {
        let tree = &self.tree.planes[plane];
        let weights = self.weights(sharpness);
        let mut sum = Model::constant(0.0);
        let mut hull = [f64::INFINITY, f64::NEG_INFINITY];
        for ((axes, anchors), weight) in PLANES.iter().zip(&self.anchors.planes[plane]).zip(weights) {
            let (centre, half) = (axes.map(|k| self.centre[k]), axes.map(|k| self.half[k]));
            let flat = walk(&Region { tree, anchors, centre, half }, &tree.root).bound;
            let (mut g, mut slope) = ([0.0; D], [[0.0; 2]; D]);
            for (k, axis) in axes.iter().enumerate() {
                g[*axis] = flat.g[k];
                slope[*axis] = flat.slope[k];
            }
            let Bound { v, rest, low, high, .. } = flat;
            hull = [hull[0].min(low), hull[1].max(high)];
            sum = sum.plus(Model::new(Bound { v, g, rest, low, high, slope }, self.half).times(weight));
        }
        // The weights are at least 0 and sum to 1.
        let pad = RELATIVE * hull[0].abs().max(hull[1].abs());
        sum.within(hull[0] - pad, hull[1] + pad)
    }
}

impl<const D: usize> Region<'_, D> {
    /// The weights of the planes, |pᵢ|ᵏ / Σ|pⱼ|ᵏ, as intervals: each grows with |pᵢ| and falls with the others. With m
    /// the largest |pᵢ|, the slopes of a weight are at most k/m.
    fn weights(&self, sharpness: u32) -> [Model<D>; D] {
        let power = |x: f64| (0..sharpness).fold(1.0, |power, _| power * x);
        let p: [[f64; 2]; D] = core::array::from_fn(|k| {
            let middle = self.anchors.position[k] + self.centre[k];
            let reach =
                self.half[k] + RELATIVE * (self.anchors.position[k].abs() + self.centre[k].abs() + self.half[k]);
            [(middle.abs() - reach).max(0.0), middle.abs() + reach]
        });
        let nearest = p.iter().fold(0.0_f64, |nearest, p| nearest.max(p[0]));
        let steepest = f64::from(sharpness) / nearest;
        core::array::from_fn(|k| {
            let share = |own: f64, others: usize| {
                let sum: f64 = (0..D).filter(|j| *j != k).map(|j| power(p[j][others] / own)).sum();
                if own > 0.0 { 1.0 / (1.0 + sum) } else { 0.0 }
            };
            let (low, high) = (share(p[k][0], 1), share(p[k][1], 0));
            let (low, high) = ((low - RELATIVE).max(-RELATIVE), (high + RELATIVE).min(1.0 + RELATIVE));
            let slope = [[-steepest, steepest]; D];
            let bound = Bound { v: 0.5 * (low + high), g: [0.0; D], rest: 0.5 * (high - low), low, high, slope };
            Model::new(bound, self.half)
        })
    }
}

/// The products of two intervals; 0 · ∞ = 0.
pub(super) fn interval_product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for x in a {
        for y in b {
            let z = if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
            range = [range[0].min(z), range[1].max(z)];
        }
    }
    range
}
