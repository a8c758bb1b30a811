//! The tiles' lattices: their sizes, the waves that lie on them, and chance.

use core::f64::consts::TAU;

use super::{CASCADES, PERIOD, REACH, Wave};
use crate::hash::{hash2, pcg};

/// Gravity, in m/s².
pub(super) const GRAVITY: f64 = 9.81;

/// How often each tile fits into the largest one. No two periods have a small common multiple.
const RATIOS: [f64; CASCADES] = [1.0, 6.3, 41.0];

/// The tiles' sides where the largest is `side`.
pub(super) fn sides(side: f64) -> [f64; CASCADES] {
    RATIOS.map(|ratio| side / ratio)
}

/// The wave number of a tile's shortest waves.
pub(super) fn largest_wave_number(side: f64) -> f64 {
    TAU * REACH as f64 / side
}

/// Whether a tile holds waves of this n.
pub(super) fn is_held(n: [i32; 2]) -> bool {
    let [x, z] = n.map(|n| n.unsigned_abs() as usize);
    n != [0, 0] && x <= REACH && z <= REACH && x * x + z * z <= REACH * REACH
}

/// All n that a tile holds, in a fixed order.
pub(super) fn held() -> impl Iterator<Item = [i32; 2]> {
    let reach = REACH as i32;
    (-reach..=reach).flat_map(move |z| (-reach..=reach).map(move |x| [x, z])).filter(|n| is_held(*n))
}

/// The beats of a wave on deep water, ω² = g k. At least one.
pub(super) fn deep_beats(n: [i32; 2], side: f64) -> i32 {
    let wave = Wave { n, amplitude: 0.0, phase: 0.0, beats: 0 };
    let frequency = (GRAVITY * TAU / side * wave.length()).sqrt();
    (frequency * (PERIOD / TAU)).round().max(1.0) as i32
}

/// A number in (0, 1) by lot, for a point of a lattice.
pub(super) fn lot(at: [i32; 2], seed: u32) -> f64 {
    (f64::from(hash2(at.map(i64::from), seed)) + 0.5) / 4_294_967_296.0
}

/// The seed of one of many lots of a seed.
pub(super) fn sub_seed(seed: u32, which: u32) -> u32 {
    pcg(seed.wrapping_add(which.wrapping_mul(0x9e37_79b9)))
}
