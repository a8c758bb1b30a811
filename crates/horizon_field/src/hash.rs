//! The hash of lattice cells: permuted congruential (PCG), over 64-bit cells taken as two 32-bit words each, so that
//! no coordinate wraps early. `hash.wgsl` is its twin, equal bit for bit. The high word's hash shifts the low word: one
//! octave's lattice beyond 2³² cells is itself at another offset, a different one in each octave and along each axis, so
//! that sums of octaves, which is what worlds are, do not come again.
//!
//! One axis is hashed by both words of its coordinate, then the axes are mixed: corners of one cell share their axes'
//! hashes, which is what makes the hash cheap.

/// The WGSL twin.
pub const WGSL: &str = include_str!("hash.wgsl");

/// PCG-RXS-M-XS-32, after O'Neill 2014 and Jarzynski & Olano 2020: a permutation of the 32-bit words.
#[inline(always)]
pub const fn pcg(v: u32) -> u32 {
    let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// The hash of one coordinate of a cell, under a seed. Axes differ by the seed: see [`axis_seed`].
#[inline(always)]
pub const fn axis(coordinate: i64, seed: u32) -> u32 {
    axis_low(coordinate as u32, axis_high((coordinate >> 32) as u32, seed))
}

/// The first half of [`axis`]: what neighbours share, unless the low word wraps between them.
#[inline(always)]
pub const fn axis_high(high: u32, seed: u32) -> u32 {
    pcg(high.wrapping_add(seed))
}

/// The second half of [`axis`]: the hash of a coordinate's low word, after its high word's [`axis_high`].
#[inline(always)]
pub const fn axis_low(low: u32, high: u32) -> u32 {
    pcg(low.wrapping_add(high))
}

/// The seed of axis 0, 1 or 2: different odd multiples, so that (a, b) and (b, a) differ.
#[inline(always)]
pub const fn axis_seed(seed: u32, axis: u32) -> u32 {
    pcg(seed.wrapping_add(axis.wrapping_mul(0x9e37_79b9)))
}

/// Mixes the axes' hashes into the hash of a cell of the plane.
#[inline(always)]
pub const fn mix2(x: u32, y: u32) -> u32 {
    pcg(x.wrapping_add(y.rotate_left(16)))
}

/// Mixes the axes' hashes into the hash of a cell of space.
#[inline(always)]
pub const fn mix3(x: u32, y: u32, z: u32) -> u32 {
    pcg(x.wrapping_add(y.rotate_left(11)).wrapping_add(z.rotate_left(22)))
}

/// The hash of a cell of the plane.
#[inline(always)]
pub const fn hash2(cell: [i64; 2], seed: u32) -> u32 {
    mix2(axis(cell[0], axis_seed(seed, 0)), axis(cell[1], axis_seed(seed, 1)))
}

/// The hash of a cell of space.
#[inline(always)]
pub const fn hash3(cell: [i64; 3], seed: u32) -> u32 {
    mix3(axis(cell[0], axis_seed(seed, 0)), axis(cell[1], axis_seed(seed, 1)), axis(cell[2], axis_seed(seed, 2)))
}
