//! The one recursion over a compiled tree. What is computed on the way (a value with its gradient, a bound over a box,
//! what holds everywhere) is an [`Evaluator`] at the leaves and a [`Function`] between them.

use super::curve::Curve;
use super::tree::{FractalNode, ImageNode, Node};
use crate::fractal::Algebra;
use crate::real::Real;

/// A model of a function that the nodes can combine.
pub(super) trait Function: Algebra {
    /// The smaller of two.
    fn smaller(self, other: Self) -> Self;

    /// The larger of two.
    fn larger(self, other: Self) -> Self {
        self.negated().smaller(other.negated()).negated()
    }

    /// The curve of the function.
    fn curve(self, curve: &Curve) -> Self;

    /// −f.
    fn negated(self) -> Self {
        self.scaled(-Self::Scalar::ONE)
    }

    /// `from` where the function is 0, `to` where it is 1. It is within [0, 1].
    fn blend(self, from: Self, to: Self) -> Self {
        from.plus(to.plus(from.negated()).times(self))
    }

    /// min(a, b) = b + min(a − b, 0), with a curve that rounds the latter.
    fn smooth_min(self, other: Self, round: &Curve) -> Self {
        other.plus(self.plus(other.negated()).curve(round))
    }
}

/// Computes leaves, and what moves the point at which they are computed.
pub(super) trait Evaluator<const D: usize> {
    /// What comes out.
    type Value: Function;

    /// A sum of octaves.
    fn fractal(&self, node: &FractalNode) -> Self::Value;
    /// A height image.
    fn image(&self, node: &ImageNode) -> Self::Value;
    /// A field at the point that is displaced by `by`.
    fn warp(&self, field: &Node<D>, by: [Option<Self::Value>; D]) -> Self::Value;
    /// The tree's plane of this index, projected along the axes of space.
    fn triplanar(&self, plane: usize, sharpness: u32) -> Self::Value;
}

/// A number as a scalar of the evaluator.
fn scalar<E: Evaluator<D>, const D: usize>(x: f64) -> <E::Value as Algebra>::Scalar {
    <E::Value as Algebra>::Scalar::of(x)
}

/// Evaluates a node.
pub(super) fn walk<E: Evaluator<D>, const D: usize>(evaluator: &E, node: &Node<D>) -> E::Value {
    let one = |node: &Node<D>| walk(evaluator, node);
    let all = |nodes: &[Node<D>], combine: fn(E::Value, E::Value) -> E::Value| {
        let first = one(&nodes[0]);
        nodes[1..].iter().fold(first, |sum, node| combine(sum, one(node)))
    };
    match node {
        Node::Constant { height, .. } => E::Value::constant(scalar::<E, D>(*height)),
        Node::Image(node) => evaluator.image(node),
        Node::Fractal(node) => evaluator.fractal(node),
        Node::Warp { field, by } => evaluator.warp(field, core::array::from_fn(|k| by[k].as_deref().map(one))),
        Node::Triplanar { plane, sharpness, .. } => evaluator.triplanar(*plane, *sharpness),
        Node::Add(nodes) => all(nodes, E::Value::plus),
        Node::Multiply(nodes) => all(nodes, E::Value::times),
        Node::Min(nodes) => all(nodes, E::Value::smaller),
        Node::Max(nodes) => all(nodes, E::Value::larger),
        Node::Linear { field, scale, shift, .. } => {
            one(field).scaled(scalar::<E, D>(*scale)).shifted(scalar::<E, D>(*shift))
        }
        Node::Curve { field, curve, .. } => one(field).curve(curve),
        Node::SmoothMin { a, b, round, .. } => one(a).smooth_min(one(b), round),
        Node::Dual { local, global, ramp, .. } => {
            let global = one(global);
            global.plus(one(local).times(global.curve(ramp)))
        }
        Node::Mask { mask, outside, inside, step, .. } => one(mask).curve(step).blend(one(outside), one(inside)),
    }
}
