//! From a tile's waves to a grid of them: one fast Fourier transform gives height and displacement together.
//!
//! With the complex amplitudes H(n) at a time, h = Re Σ H e^(ik·x), and D = Re Σ i c (n/|n|) H e^(ik·x). Let
//! G(n) = (H(n) + H*(−n)) / 2: its transform is real, and is h. So (1 − c n_x/|n|) G transforms to h + i D_x, and i c n_z/|n| G to D_z.
//!
//! Stockham's form of radix 2, in the order of `transform.wgsl` of the renderer.

use core::f64::consts::TAU;

use super::{Cascade, GRID, REACH};

/// Rows of wave vectors.
const ROWS: usize = 2 * REACH + 1;

/// Two complex numbers.
pub(super) type Pair = [f64; 4];

/// The roots of unity, e^(2πi m / GRID), of the upper half of the circle.
pub fn roots() -> [[f64; 2]; GRID / 2] {
    core::array::from_fn(|m| {
        let turn = TAU * m as f64 / GRID as f64;
        [libm::cos(turn), libm::sin(turn)]
    })
}

/// Both complex numbers of a line: Σ_m x_m e^(2πi m j / GRID).
pub(super) fn transform(line: &mut [Pair; GRID], roots: &[[f64; 2]; GRID / 2]) {
    let mut other = [[0.0; 4]; GRID];
    let mut width = 1;
    while width < GRID {
        for (j, k) in (0..GRID / 2).map(|j| (j, j & (width - 1))) {
            let [c, s] = roots[k * (GRID / 2 / width)];
            let (a, b) = (line[j], line[j + GRID / 2]);
            let b = [b[0] * c - b[1] * s, b[0] * s + b[1] * c, b[2] * c - b[3] * s, b[2] * s + b[3] * c];
            let to = 2 * j - k;
            other[to] = [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]];
            other[to + width] = [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]];
        }
        core::mem::swap(line, &mut other);
        width *= 2;
    }
}

/// Height, D_x and D_z at the time of this tick, in metres, at the centres of texels, x first.
pub(super) fn grid(cascade: &Cascade, tick: u32) -> Vec<[f64; 3]> {
    let roots = roots();
    let modes = amplitudes(cascade, tick);
    let at = |x: usize, z: usize| modes[z * ROWS + x];
    // Row by row of wave vectors; then what belongs to one x lies together.
    let mut columns = vec![[[0.0; 4]; GRID]; GRID];
    for row in 0..ROWS {
        let mut line = [[0.0; 4]; GRID];
        for column in 0..ROWS {
            let (a, b) = (at(column, row), at(ROWS - 1 - column, ROWS - 1 - row));
            let g = [0.5 * (a[0] + b[0]), 0.5 * (a[1] - b[1])];
            let [x, z] = [column, row].map(|n| n as f64 - REACH as f64);
            let turn = cascade.choppiness / (x * x + z * z).sqrt().max(1.0);
            let [along, across] = [1.0 - turn * x, turn * z];
            line[bin(column)] = [along * g[0], along * g[1], -across * g[1], across * g[0]];
        }
        transform(&mut line, &roots);
        for (column, pair) in columns.iter_mut().zip(line) {
            column[bin(row)] = pair;
        }
    }
    let mut grid = vec![[0.0; 3]; GRID * GRID];
    for (x, column) in columns.iter_mut().enumerate() {
        transform(column, &roots);
        for (z, pair) in column.iter().enumerate() {
            grid[z * GRID + x] = [pair[0], pair[1], pair[2]];
        }
    }
    grid
}

/// Where the transform has the wave vector at an index from −REACH on.
fn bin(index: usize) -> usize {
    (index + GRID - REACH) % GRID
}

/// H(n) of all rows.
fn amplitudes(cascade: &Cascade, tick: u32) -> Vec<[f64; 2]> {
    let mut modes = vec![[0.0; 2]; ROWS * ROWS];
    for wave in &cascade.waves {
        let [x, z] = wave.n.map(|n| (n + REACH as i32) as usize);
        let [re, im] = wave.at_first_texel();
        // The turn in whole 2⁻³² of the circle: exact.
        let turn = (wave.beats as u32).wrapping_mul(tick).cast_signed();
        let turn = f64::from(turn) * (TAU / 4_294_967_296.0);
        let [c, s] = [libm::cos(turn), libm::sin(turn)];
        modes[z * ROWS + x] = [re * c + im * s, im * c - re * s];
    }
    modes
}
