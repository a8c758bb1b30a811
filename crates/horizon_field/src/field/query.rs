//! The value at one point, in double precision: the octaves of a fractal share vector instructions, lane by lane.

use multiversion::multiversion;

use super::compile::{Anchors, Compiled};
use super::eval::{PLANES, weights};
use super::tree::{FractalNode, ImageNode, Node, OctaveNode, Tree};
use super::walk::{Evaluator, walk};
use crate::fractal::{Algebra, State, fade};
use crate::noise::{HighWords, Lanes};

/// A point of evaluation.
struct Query<'a, const D: usize> {
    tree: &'a Tree<D>,
    anchors: &'a Anchors<D>,
    q: [f64; D],
    cutoff: f64,
}

impl<const D: usize> Evaluator<D> for Query<'_, D> {
    type Value = f64;

    fn fractal(&self, node: &FractalNode) -> f64 {
        octaves(node, self)
    }

    fn image(&self, node: &ImageNode) -> f64 {
        self.tree.image(node, self.anchors, self.q).v
    }

    fn warp(&self, field: &Node<D>, by: [Option<f64>; D]) -> f64 {
        let q = core::array::from_fn(|k| by[k].map_or(self.q[k], |by| self.q[k] + by));
        walk(&Query { q, ..*self }, field)
    }

    fn triplanar(&self, plane: usize, sharpness: u32) -> f64 {
        let tree = &self.tree.planes[plane];
        let weights = weights(self.anchors.position, self.q, sharpness);
        let mut sum = 0.0;
        for ((axes, anchors), weight) in PLANES.iter().zip(&self.anchors.planes[plane]).zip(weights) {
            let q = axes.map(|axis| self.q[axis]);
            sum += walk(&Query { tree, anchors, q, cutoff: self.cutoff }, &tree.root) * weight.v;
        }
        sum
    }
}

/// A sum of octaves. Where the processor has wider vectors than the build asks for, it uses them: there too, each
/// operation is rounded on its own.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw", "x86_64+avx2"))]
fn octaves<const D: usize>(node: &FractalNode, at: &Query<'_, D>) -> f64 {
    let mut state = node.rule.start::<f64>(node.offset);
    let mut rest = &node.octaves[..];
    // As many lanes as there are octaves, more or less.
    while rest.len() > 4 {
        let (some, others) = rest.split_at(rest.len().min(8));
        if !group::<8, D>(node, some, at, &mut state) {
            rest = &[];
            break;
        }
        rest = others;
    }
    if !rest.is_empty() {
        group::<4, D>(node, rest, at, &mut state);
    }
    state.result.scaled(node.amplitude)
}

/// Adds some octaves, at most `N`; returns whether shorter ones may follow.
#[inline(always)]
fn group<const N: usize, const D: usize>(
    node: &FractalNode,
    octaves: &[OctaveNode],
    at: &Query<'_, D>,
    state: &mut State<f64>,
) -> bool {
    if fade(octaves[0].wavelength, at.cutoff) <= 0.0 {
        return false;
    }
    // The layers of a fractal are successive.
    let range = octaves[0].layer..octaves[0].layer + octaves.len();
    let (layers, anchors) = (&at.tree.layers[range.clone()], &at.anchors.points[range]);
    let mut lanes = Lanes::<D, N>::new();
    let mut noise = [0.0; N];
    let mut high = HighWords::<D, N>::new();
    if lanes.layers(layers, anchors, at.q, &mut high) {
        lanes.noise(node.basis, |i| high.hashes(i), |i, jet| noise[i] = jet.v);
    } else {
        for (noise, octave) in noise.iter_mut().zip(octaves) {
            *noise = at.tree.octave(node.basis, octave, at.anchors, at.q).v;
        }
    }
    for (noise, octave) in noise.into_iter().zip(octaves) {
        let fade = fade(octave.wavelength, at.cutoff) * octave.presence;
        if fade <= 0.0 {
            // All that follow are shorter.
            return false;
        }
        *state = node.rule.step(*state, noise, octave.weight, node.offset, fade);
    }
    true
}

impl<const D: usize> Compiled<D> {
    /// [`Compiled::value`] in double precision, compiled in this crate.
    pub fn value_f64(&self, at: &Anchors<D>, q: [f64; D], cutoff: f64) -> f64 {
        let tree = self.tree();
        walk(&Query { tree, anchors: at, q, cutoff }, &tree.root)
    }
}
