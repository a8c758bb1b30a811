//! Compilation: from the field's parameters to lattices, numbers and images. What a node computes stands in the tree;
//! the same numbers, in the order in which they were met, stand in the arrays that the kernel reads.

use std::sync::Arc;

use super::check::MAX_HEIGHT;
use super::curve::Curve;
use super::image::{HeightImage, ImageSource};
use super::layers::{image_layer, noise_layer, octave_seed};
use super::ranges::RangePyramid;
use super::tree::{FractalNode, ImageNode, Node, OctaveNode, Tree};
use super::{Edge, Field, FieldError, Fractal, ImageField};
use crate::fractal::{Octaves, Rule};
use crate::lattice::{LatticePoint, Layer};
use crate::place::Place;

/// Images start at multiples of this many words, so that the block's index is exact as an f32.
pub(super) const IMAGE_BLOCK: usize = 64;

/// What is shared by all clones of a compiled field.
#[derive(Debug)]
pub(super) struct Parts<const D: usize> {
    pub tree: Tree<D>,
    pub numbers: Vec<f64>,
    pub images: Vec<Arc<HeightImage>>,
    pub range: (f64, f64),
}

/// A field, ready to be evaluated in the plane (`D` = 2: x and z) or in space (`D` = 3). Cheap to clone.
#[derive(Clone, Debug)]
pub struct Compiled<const D: usize> {
    parts: Arc<Parts<D>>,
}

/// Where a field's lattices lie at a place of the world: one lattice point for each layer, in full precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Anchors<const D: usize> {
    pub(super) points: Vec<LatticePoint<f64, D>>,
    /// Metres from the world's origin, for triplanar weights only.
    pub(super) position: [f64; 3],
    pub(super) planes: Vec<[Anchors<2>; 3]>,
}

impl Field {
    /// Compiles for the plane (`D` = 2) or space (`D` = 3). Refuses what [`Field::check`] refuses, images that can't be
    /// had, and fields that may rise beyond single precision.
    pub fn compile<const D: usize>(&self, images: &dyn ImageSource) -> Result<Compiled<D>, FieldError> {
        const { assert!(D == 2 || D == 3) }
        self.check()?;
        let mut builder = Builder {
            root: self,
            source: images,
            images: Vec::new(),
            words: 0,
            numbers: Vec::new(),
            octaves: Vec::new(),
            octave_slots: Vec::new(),
            plane_slots: Vec::new(),
        };
        let tree = builder.tree::<D>(self)?;
        let numbers = builder.numbers(&tree);
        let images = builder.images.into_iter().map(|loaded| loaded.image).collect();
        let mut parts = Parts { tree, numbers, images, range: (0.0, 0.0) };
        let everywhere = parts.tree.everywhere(0.0);
        if everywhere.peak.is_nan() || everywhere.peak > MAX_HEIGHT {
            return Err(FieldError::TooHigh { height: everywhere.peak });
        }
        // Evaluation rounds relative to the largest value on the way.
        let pad = 1e-12 * everywhere.peak;
        parts.range = (everywhere.low - pad, everywhere.high + pad);
        Ok(Compiled { parts: Arc::new(parts) })
    }
}

impl<const D: usize> Compiled<D> {
    pub(super) fn parts(&self) -> &Parts<D> {
        &self.parts
    }

    pub(super) fn tree(&self) -> &Tree<D> {
        &self.parts.tree
    }

    /// Where the lattices lie at a place.
    pub fn anchor(&self, place: &Place) -> Anchors<D> {
        self.tree().anchor(place)
    }

    /// The smallest and the largest value anywhere, at any cut-off; not always reached.
    pub fn range(&self) -> (f64, f64) {
        self.parts.range
    }
}

struct Loaded {
    path: String,
    image: Arc<HeightImage>,
    ranges: Arc<RangePyramid>,
    block: usize,
}

/// Compilation in progress.
struct Builder<'a> {
    root: &'a Field,
    source: &'a dyn ImageSource,
    images: Vec<Loaded>,
    words: usize,
    numbers: Vec<f64>,
    /// The octaves' numbers, which come after all others: how many there are is itself a number.
    octaves: Vec<f64>,
    /// Numbers that are indices into `octaves`.
    octave_slots: Vec<usize>,
    /// Numbers that say where a plane's rows begin, with the plane's index.
    plane_slots: Vec<(usize, usize)>,
}

/// The lattices of a tree in progress.
struct Lattices<const D: usize> {
    layers: Vec<Layer<D>>,
    planes: Vec<Tree<2>>,
}

impl Builder<'_> {
    fn push(&mut self, numbers: &[f64]) -> usize {
        self.numbers.extend_from_slice(numbers);
        self.numbers.len() - numbers.len()
    }

    fn tree<const D: usize>(&mut self, field: &Field) -> Result<Tree<D>, FieldError> {
        let mut lattices = Lattices { layers: Vec::new(), planes: Vec::new() };
        let root = self.node(field, &mut lattices)?;
        Ok(Tree { root, layers: lattices.layers, planes: lattices.planes })
    }

    /// All numbers, with what could not be known before.
    fn numbers<const D: usize>(&mut self, tree: &Tree<D>) -> Vec<f64> {
        let mut numbers = core::mem::take(&mut self.numbers);
        for slot in &self.octave_slots {
            numbers[*slot] += numbers.len() as f64;
        }
        let mut rows = vec![tree.layers.len()];
        for plane in &tree.planes {
            rows.push(rows[rows.len() - 1] + 1 + 3 * plane.layers.len());
        }
        for (slot, plane) in &self.plane_slots {
            numbers[*slot] = rows[*plane] as f64;
        }
        numbers.append(&mut self.octaves);
        numbers
    }

    fn nodes<const D: usize>(
        &mut self,
        fields: &[Field],
        lattices: &mut Lattices<D>,
    ) -> Result<Vec<Node<D>>, FieldError> {
        fields.iter().map(|field| self.node(field, lattices)).collect()
    }

    fn boxed<const D: usize>(&mut self, field: &Field, lattices: &mut Lattices<D>) -> Result<Box<Node<D>>, FieldError> {
        self.node(field, lattices).map(Box::new)
    }

    fn node<const D: usize>(&mut self, field: &Field, lattices: &mut Lattices<D>) -> Result<Node<D>, FieldError> {
        Ok(match field {
            Field::Constant(height) => Node::Constant { height: *height, number: self.push(&[*height]) },
            Field::Image(image) => Node::Image(self.image(image, lattices)?),
            Field::Noise(noise) => {
                let single = Fractal {
                    rule: Rule::Fbm,
                    basis: noise.basis,
                    wavelength: noise.wavelength,
                    amplitude: noise.amplitude,
                    octaves: 1.0,
                    offset: 0.0,
                    rotation: 0.0,
                    seed: noise.seed,
                    ..Fractal::default()
                };
                Node::Fractal(self.fractal(&single, noise.rotation, lattices))
            }
            Field::Fractal(fractal) => Node::Fractal(self.fractal(fractal, 0.0, lattices)),
            Field::Warp(warp) => {
                let x = self.boxed(&warp.x, lattices)?;
                let z = self.boxed(&warp.z, lattices)?;
                let y = if D == 3 { warp.y.as_ref().map(|y| self.boxed(y, lattices)).transpose()? } else { None };
                let mut by = [const { None }; D];
                by[0] = Some(x);
                by[D - 1] = Some(z);
                if D == 3 {
                    by[1] = y;
                }
                Node::Warp { by, field: self.boxed(&warp.field, lattices)? }
            }
            Field::Triplanar(triplanar) if D == 3 => {
                let number = self.push(&[f64::from(triplanar.sharpness), 0.0, 0.0]);
                let plane = lattices.planes.len();
                self.plane_slots.push((number + 1, plane));
                let tree = self.tree::<2>(&triplanar.field)?;
                self.numbers[number + 2] = tree.layers.len() as f64;
                lattices.planes.push(tree);
                Node::Triplanar { plane, sharpness: triplanar.sharpness, number }
            }
            Field::Triplanar(triplanar) => self.node(&triplanar.field, lattices)?,
            Field::Add(fields) => Node::Add(self.nodes(fields, lattices)?),
            Field::Multiply(fields) => Node::Multiply(self.nodes(fields, lattices)?),
            Field::Min(fields) => Node::Min(self.nodes(fields, lattices)?),
            Field::Max(fields) => Node::Max(self.nodes(fields, lattices)?),
            Field::SmoothMin(min) => {
                let round = Curve::round(min.radius);
                let number = self.push(&round.numbers());
                Node::SmoothMin { a: self.boxed(&min.a, lattices)?, b: self.boxed(&min.b, lattices)?, round, number }
            }
            Field::Clamp(clamp) => {
                self.curve(Curve::Clamp { low: clamp.low, high: clamp.high }, &clamp.field, lattices)?
            }
            Field::Terrace(terrace) => {
                self.curve(Curve::terrace(terrace.step, terrace.sharpness), &terrace.field, lattices)?
            }
            Field::Remap(remap) => {
                let scale = (remap.to[1] - remap.to[0]) / (remap.from[1] - remap.from[0]);
                let shift = remap.to[0] - remap.from[0] * scale;
                let number = self.push(&[scale, shift]);
                Node::Linear { field: self.boxed(&remap.field, lattices)?, scale, shift, number }
            }
            Field::Dual(dual) => {
                let ramp = Curve::ramp(dual.low, dual.high);
                let number = self.push(&ramp.numbers());
                Node::Dual {
                    local: self.boxed(&dual.local, lattices)?,
                    global: self.boxed(&dual.global, lattices)?,
                    ramp,
                    number,
                }
            }
            Field::Mask(mask) => {
                let step = Curve::step(mask.low, mask.high);
                let number = self.push(&step.numbers());
                Node::Mask {
                    mask: self.boxed(&mask.mask, lattices)?,
                    outside: self.boxed(&mask.outside, lattices)?,
                    inside: self.boxed(&mask.inside, lattices)?,
                    step,
                    number,
                }
            }
        })
    }

    fn curve<const D: usize>(
        &mut self,
        curve: Curve,
        field: &Field,
        lattices: &mut Lattices<D>,
    ) -> Result<Node<D>, FieldError> {
        let number = self.push(&curve.numbers());
        Ok(Node::Curve { field: self.boxed(field, lattices)?, curve, number })
    }

    fn fractal<const D: usize>(&mut self, node: &Fractal, turned: f64, lattices: &mut Lattices<D>) -> FractalNode {
        let sum = Octaves { count: node.octaves, lacunarity: node.lacunarity, gain: node.gain, offset: node.offset };
        let first = lattices.layers.len();
        let table = self.octaves.len();
        let mut octaves = Vec::with_capacity(sum.len());
        for (index, octave) in sum.iter().enumerate() {
            let wavelength = node.wavelength / octave.frequency;
            let angle = turned + index as f64 * node.rotation;
            let seed = octave_seed(node.seed, index);
            lattices.layers.push(noise_layer(node.basis, wavelength, angle, seed));
            self.octaves.extend([wavelength, octave.weight, octave.presence]);
            octaves.push(OctaveNode {
                layer: first + index,
                wavelength,
                weight: octave.weight,
                presence: octave.presence,
            });
        }
        let numbers = [node.amplitude, node.offset, first as f64, octaves.len() as f64, table as f64];
        let number = self.push(&numbers);
        self.octave_slots.push(number + 4);
        FractalNode {
            rule: node.rule,
            basis: node.basis,
            amplitude: node.amplitude,
            offset: node.offset,
            octaves,
            number,
        }
    }

    fn image<const D: usize>(
        &mut self,
        node: &ImageField,
        lattices: &mut Lattices<D>,
    ) -> Result<ImageNode, FieldError> {
        let at = self.load(&node.path)?;
        let loaded = &self.images[at];
        let (image, ranges, block) = (loaded.image.clone(), loaded.ranges.clone(), loaded.block);
        let texels = [f64::from(image.width), f64::from(image.height)];
        let layer = lattices.layers.len();
        lattices.layers.push(image_layer(texels, node.centre, node.size));
        let scale = node.high - node.low;
        let edge = match node.edge {
            Edge::Clamp => 0.0,
            Edge::Mirror => 1.0,
            Edge::Repeat => 2.0,
        };
        let number = self.push(&[layer as f64, node.low, scale, block as f64, texels[0], texels[1], edge]);
        Ok(ImageNode { image, ranges, edge: node.edge, layer, low: node.low, scale, number })
    }

    /// The index of an image, which is loaded once.
    fn load(&mut self, path: &str) -> Result<usize, FieldError> {
        if let Some(at) = self.images.iter().position(|loaded| loaded.path == path) {
            return Ok(at);
        }
        let named = || (self.root.path_of_image(path), path.to_owned());
        let image = self.source.load(path).map_err(|reason| {
            let (path, image) = named();
            FieldError::Image { path, image, reason }
        })?;
        if !image.is_valid() {
            let (path, name) = named();
            return Err(FieldError::ImageSize { path, image: name, width: image.width, height: image.height });
        }
        let block = self.words.div_ceil(IMAGE_BLOCK);
        self.words = block * IMAGE_BLOCK + image.texels.len().div_ceil(2);
        let ranges = Arc::new(RangePyramid::new(&image));
        self.images.push(Loaded { path: path.to_owned(), image: Arc::new(image), ranges, block });
        Ok(self.images.len() - 1)
    }
}
