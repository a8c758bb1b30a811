//! How many octaves of noise a value and a bound evaluate, for those who count work.

use crate::field::compile::Compiled;
use crate::field::tree::{FractalNode, Node, OctaveNode};

impl Compiled<2> {
    /// The octaves of noise that one value of the full field evaluates. Every branch of the tree counts: none is skipped.
    pub fn value_octaves(&self) -> u64 {
        count(&self.tree().root, &|_, _| true)
    }

    /// The octaves that [`Compiled::bound`] evaluates over a box of these half extents: those that do not turn within it,
    /// as the others are bounded by their range. Under a warp a few too many, as its boxes are larger than the one outside.
    pub fn bound_octaves(&self, half: [f64; 2]) -> u64 {
        let radius = (half[0] * half[0] + half[1] * half[1]).sqrt();
        count(&self.tree().root, &|node, octave| {
            let basis = node.basis.bounds::<2>();
            let reach = 0.5 * (basis.high - basis.low);
            let slope = basis.slope / octave.wavelength;
            let curvature = basis.curvature / (octave.wavelength * octave.wavelength);
            slope * radius < reach || 0.5 * curvature * radius * radius < reach
        })
    }
}

/// How many of a tree's octaves are as wanted, each as often as a value evaluates it.
fn count(node: &Node<2>, wanted: &impl Fn(&FractalNode, &OctaveNode) -> bool) -> u64 {
    let of = |node: &Node<2>| count(node, wanted);
    match node {
        // A projection of planes is the plane's own field, in the plane.
        Node::Constant { .. } | Node::Image(_) | Node::Triplanar { .. } => 0,
        Node::Fractal(fractal) => fractal.octaves.iter().map(|octave| u64::from(wanted(fractal, octave))).sum(),
        Node::Warp { field, by } => of(field) + by.iter().flatten().map(|by| of(by)).sum::<u64>(),
        Node::Add(nodes) | Node::Multiply(nodes) | Node::Min(nodes) | Node::Max(nodes) => nodes.iter().map(of).sum(),
        Node::Linear { field, .. } | Node::Curve { field, .. } => of(field),
        Node::SmoothMin { a, b, .. } => of(a) + of(b),
        Node::Dual { local, global, .. } => of(global) + of(local),
        Node::Mask { mask, outside, inside, .. } => of(mask) + of(outside) + of(inside),
    }
}
