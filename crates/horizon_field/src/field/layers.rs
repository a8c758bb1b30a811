//! The lattices of a field's octaves and images.

use crate::hash::pcg;
use crate::lattice::Layer;
use crate::noise::Basis;

/// The seed of an octave: octaves of one fractal, and fractals of successive seeds, have nothing in common.
pub(super) fn octave_seed(seed: u32, octave: usize) -> u32 {
    pcg(seed.wrapping_add(pcg(octave as u32)))
}

/// Rotation by an angle: in the plane, or in space about (1, 1, 1), which tilts all axes alike.
fn rotation<const D: usize>(angle: f64) -> [[f64; D]; D] {
    let (sin, cos) = libm::sincos(angle);
    if D == 2 {
        let plane = [[cos, -sin], [sin, cos]];
        return core::array::from_fn(|row| core::array::from_fn(|column| plane[row][column]));
    }
    // Rodrigues' formula for the unit axis a = (1, 1, 1)/√3: cos·I + (1 − cos)·a aᵀ + sin·[a]×.
    let (same, ahead) = ((1.0 - cos) / 3.0, sin / 3.0_f64.sqrt());
    core::array::from_fn(|row| {
        core::array::from_fn(|column| match (column + D - row) % D {
            0 => same + cos,
            1 => same - ahead,
            _ => same + ahead,
        })
    })
}

/// The lattice of one octave of noise. Where it lies follows from the seed, so that no place is a lattice point of all
/// octaves: gradient noise is 0 at every one of them.
pub(super) fn noise_layer<const D: usize>(basis: Basis, wavelength: f64, angle: f64, seed: u32) -> Layer<D> {
    let (skew, rotation) = (basis.skew::<D>(), rotation::<D>(angle));
    let matrix = core::array::from_fn(|row| {
        core::array::from_fn(|column| (0..D).map(|k| skew[row][k] * rotation[k][column]).sum::<f64>() / wavelength)
    });
    let mut hash = seed;
    let offset = core::array::from_fn(|_| {
        hash = pcg(hash);
        f64::from(hash) / 4_294_967_296.0
    });
    Layer::new(matrix, offset, seed)
}

/// The lattice of an image of these many texels, laid about `centre`: a point's cell is the texel whose centre lies
/// next below, on both axes.
pub(super) fn image_layer<const D: usize>(texels: [f64; 2], centre: [f64; 2], size: [f64; 2]) -> Layer<D> {
    let mut matrix = [[0.0; D]; D];
    let mut offset = [0.0; D];
    for axis in 0..2 {
        let per_metre = texels[axis] / size[axis];
        matrix[axis][axis * (D - 1)] = per_metre;
        offset[axis] = 0.5 * texels[axis] - centre[axis] * per_metre - 0.5;
    }
    Layer::new(matrix, offset, 0)
}
