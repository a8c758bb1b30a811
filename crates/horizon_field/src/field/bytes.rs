//! The contents of the kernel's buffers, little-endian, in the layout of the structs in `lattice.wgsl`.

use super::compile::{Anchors, Compiled, IMAGE_BLOCK};
use crate::lattice::{LatticePoint, Layer};

fn floats(bytes: &mut Vec<u8>, values: &[f64]) {
    values.iter().for_each(|value| bytes.extend((*value as f32).to_le_bytes()));
}

fn words(bytes: &mut Vec<u8>, values: &[u32]) {
    values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
}

/// `Layer2` or `Layer3`, by `rows`. In space, a layer of a plane has a third row and column of zeros.
fn layer<const D: usize>(bytes: &mut Vec<u8>, layer: &Layer<D>, rows: usize) {
    let at = |row: usize, column: usize| if row < D && column < D { layer.matrix[row][column] } else { 0.0 };
    if rows == 2 {
        floats(bytes, &[at(0, 0), at(0, 1), at(1, 0), at(1, 1)]);
        words(bytes, &[layer.seed, 0, 0, 0]);
    } else {
        for (row, last) in [layer.seed, 0, 0].into_iter().enumerate() {
            floats(bytes, &[at(row, 0), at(row, 1), at(row, 2)]);
            words(bytes, &[last]);
        }
    }
}

/// `Anchor2` or `Anchor3`, by `rows`.
fn anchor<const D: usize>(bytes: &mut Vec<u8>, point: &LatticePoint<f64, D>, rows: usize) {
    let cell = |axis: usize| if axis < D { point.cell[axis] } else { 0 };
    let vectors = |bytes: &mut Vec<u8>, shift: u32| {
        (0..rows).for_each(|axis| words(bytes, &[(cell(axis) >> shift) as u32]));
        words(bytes, &[0][..rows - 2]);
    };
    for axis in 0..rows {
        floats(bytes, &[if axis < D { point.fraction[axis] } else { 0.0 }]);
    }
    words(bytes, &[0][..rows - 2]);
    vectors(bytes, 0);
    vectors(bytes, 32);
}

/// No buffer is empty: a storage binding holds at least one element.
fn padded(mut bytes: Vec<u8>, element: usize) -> Vec<u8> {
    if bytes.is_empty() {
        bytes.resize(element, 0);
    }
    bytes
}

/// What the buffers of a [`module`](super::kernel::module) hold. `field_numbers` begins with four numbers for each field:
/// where its numbers, layers, image blocks and anchors begin.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Contents {
    /// Of `field_layers`.
    pub layers: Vec<u8>,
    /// Of `field_numbers`.
    pub numbers: Vec<u8>,
    /// Of `field_images`.
    pub images: Vec<u8>,
}

impl Contents {
    /// The contents for these fields, in the order in which the module names them.
    pub fn new<const D: usize>(fields: &[&Compiled<D>]) -> Self {
        let mut contents = Self::default();
        let mut values: Vec<f64> = vec![0.0; 4 * fields.len()];
        let mut rows = 0;
        for (i, field) in fields.iter().enumerate() {
            contents.images.resize(contents.images.len().next_multiple_of(4 * IMAGE_BLOCK), 0);
            let blocks = contents.images.len() / (4 * IMAGE_BLOCK);
            let bases = [values.len(), rows, blocks, rows];
            (0..4).for_each(|k| values[4 * i + k] = bases[k] as f64);
            values.extend(&field.parts().numbers);
            field.append_layer_bytes(&mut contents.layers);
            field.append_image_bytes(&mut contents.images);
            rows += field.layer_count();
        }
        floats(&mut contents.numbers, &values);
        contents.layers = padded(contents.layers, if D == 2 { 32 } else { 48 });
        contents.images = padded(contents.images, 4);
        contents
    }
}

impl<const D: usize> Compiled<D> {
    /// How many layers the kernel reads, and so how many anchors each place has.
    pub fn layer_count(&self) -> usize {
        self.tree().rows()
    }

    fn append_layer_bytes(&self, bytes: &mut Vec<u8>) {
        let tree = self.tree();
        tree.layers.iter().for_each(|row| layer(bytes, row, D));
        for plane in &tree.planes {
            layer(bytes, &Layer::new([[0.0; D]; D], [0.0; D], 0), D);
            for _ in 0..3 {
                plane.layers.iter().for_each(|row| layer(bytes, row, D));
            }
        }
    }

    fn append_image_bytes(&self, bytes: &mut Vec<u8>) {
        let start = bytes.len();
        for image in &self.parts().images {
            bytes.resize(start + (bytes.len() - start).next_multiple_of(4 * IMAGE_BLOCK), 0);
            image.words().for_each(|word| bytes.extend(word.to_le_bytes()));
        }
    }

    /// Appends the anchors of one place: [`Compiled::layer_count`] elements of `field_anchors`. In a module of several
    /// fields, a place has the anchors of all of them, in order.
    pub fn append_anchor_bytes(&self, at: &Anchors<D>, bytes: &mut Vec<u8>) {
        at.points.iter().for_each(|point| anchor(bytes, point, D));
        for planes in &at.planes {
            anchor(bytes, &LatticePoint { cell: [0; 3], fraction: at.position }, D);
            for plane in planes {
                plane.points.iter().for_each(|point| anchor(bytes, point, D));
            }
        }
    }

    /// The contents of `field_anchors` for a single place.
    pub fn anchor_bytes(&self, at: &Anchors<D>) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.append_anchor_bytes(at, &mut bytes);
        padded(bytes, if D == 2 { 24 } else { 48 })
    }

    /// The shortest wave in the field, in metres: of its octaves, and two texels of its images. Infinite where it has none.
    pub fn finest_wavelength(&self) -> f64 {
        let of = |matrix: &dyn Fn(usize, usize) -> f64, d: usize| {
            (0..d).map(|row| (0..d).map(|column| matrix(row, column).powi(2)).sum::<f64>().sqrt()).fold(0.0, f64::max)
        };
        let tree = self.tree();
        let own = tree.layers.iter().map(|layer| of(&|r, c| layer.matrix[r][c], D));
        let planes =
            tree.planes.iter().flat_map(|plane| plane.layers.iter().map(|layer| of(&|r, c| layer.matrix[r][c], 2)));
        1.0 / own.chain(planes).fold(0.0, f64::max)
    }
}
