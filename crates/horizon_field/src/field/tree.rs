//! The compiled tree: the nodes, with their numbers and lattices looked up.

use std::sync::Arc;

use super::Edge;
use super::compile::Anchors;
use super::curve::Curve;
use super::eval::PLANES;
use super::image::HeightImage;
use super::ranges::RangePyramid;
use crate::fractal::Rule;
use crate::lattice::Layer;
use crate::noise::Basis;
use crate::place::Place;

/// A compiled node. `number` is the index of its first number in the kernel's array.
#[derive(Debug)]
pub(super) enum Node<const D: usize> {
    Constant { height: f64, number: usize },
    Image(ImageNode),
    Fractal(FractalNode),
    Warp { field: Box<Self>, by: [Option<Box<Self>>; D] },
    Triplanar { plane: usize, sharpness: u32, number: usize },
    Add(Vec<Self>),
    Multiply(Vec<Self>),
    Min(Vec<Self>),
    Max(Vec<Self>),
    Linear { field: Box<Self>, scale: f64, shift: f64, number: usize },
    Curve { field: Box<Self>, curve: Curve, number: usize },
    SmoothMin { a: Box<Self>, b: Box<Self>, round: Curve, number: usize },
    Dual { local: Box<Self>, global: Box<Self>, ramp: Curve, number: usize },
    Mask { mask: Box<Self>, outside: Box<Self>, inside: Box<Self>, step: Curve, number: usize },
}

/// Octaves, of one noise or a fractal. Numbers: amplitude, offset, first layer, octaves, first number of the octaves;
/// and per octave: wavelength, weight, presence.
#[derive(Debug)]
pub(super) struct FractalNode {
    pub rule: Rule,
    pub basis: Basis,
    pub amplitude: f64,
    pub offset: f64,
    pub octaves: Vec<OctaveNode>,
    pub number: usize,
}

/// One octave.
#[derive(Clone, Copy, Debug)]
pub(super) struct OctaveNode {
    pub layer: usize,
    pub wavelength: f64,
    pub weight: f64,
    pub presence: f64,
}

/// An image. Numbers: layer, low, scale, first block of words, width, height, edge.
#[derive(Debug)]
pub(super) struct ImageNode {
    pub image: Arc<HeightImage>,
    pub ranges: Arc<RangePyramid>,
    pub edge: Edge,
    pub layer: usize,
    pub low: f64,
    pub scale: f64,
    pub number: usize,
}

/// A compiled tree and its lattices; `planes` are what triplanar nodes project.
#[derive(Debug)]
pub(super) struct Tree<const D: usize> {
    pub root: Node<D>,
    pub layers: Vec<Layer<D>>,
    pub planes: Vec<Tree<2>>,
}

impl<const D: usize> Tree<D> {
    /// Where the lattices lie at a place.
    pub(super) fn anchor(&self, place: &Place) -> Anchors<D> {
        let planes = self
            .planes
            .iter()
            .map(|plane| {
                PLANES.map(|[a, b]| {
                    plane.anchor(&Place {
                        cell: [place.cell[a], 0, place.cell[b]],
                        offset: [place.offset[a], 0.0, place.offset[b]],
                    })
                })
            })
            .collect();
        Anchors {
            points: self.layers.iter().map(|layer| layer.anchor(place)).collect(),
            position: place.minus(&Place::ORIGIN),
            planes,
        }
    }

    /// The rows of layers that the kernel reads: this tree's, then per plane one for the position and three times the
    /// plane's.
    pub(super) fn rows(&self) -> usize {
        self.layers.len() + self.planes.iter().map(|plane| 1 + 3 * plane.layers.len()).sum::<usize>()
    }
}
