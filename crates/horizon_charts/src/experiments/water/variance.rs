//! The variance of the slope that squares of water hide, along x and z together: from the moments that tiles keep, and by brute
//! force, from the sum of all waves at many points.

use horizon_field::hash::{hash2, pcg};
use horizon_field::waves::{Sea, Tiles};

/// The time of the waves, in seconds.
const TIME: f64 = 8.0;
/// How far from the middle of the sea squares lie, in metres.
const FAR: f64 = 1000.0;

/// A number in (0, 1) by lot.
fn lot(at: [i64; 2], seed: u32) -> f64 {
    (f64::from(hash2(at, seed)) + 0.5) / 4_294_967_296.0
}

/// The middles of squares, by lot.
pub fn middles(count: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| [0, 1].map(|axis| FAR * (2.0 * lot([i as i64, axis], 1) - 1.0));
    (0..count).map(at).collect()
}

/// The sides of the squares, in metres: from some texels of the smallest tile to most of the largest.
pub fn footprints(sea: &Sea) -> Vec<f64> {
    let least = sea.cascades.iter().map(|cascade| cascade.texel()).fold(f64::INFINITY, f64::min);
    let most = sea.cascades.iter().map(|cascade| cascade.side).fold(0.0, f64::max);
    core::iter::successors(Some(4.0 * least), |side| Some(4.0 * side)).take_while(|side| *side <= most).collect()
}

/// By brute force: from so many points along each side, each somewhere in its part of the square.
pub fn direct(sea: &Sea, middle: [f64; 2], footprint: f64, side: u32, seed: u32) -> f64 {
    let (mut sum, mut squares) = ([0.0; 2], 0.0);
    for i in 0..side * side {
        let part = [i % side, i / side];
        let within = [0, 1].map(|k| lot([i64::from(i), k as i64], pcg(seed)));
        let at = [0, 1].map(|k| middle[k] + ((f64::from(part[k]) + within[k]) / f64::from(side) - 0.5) * footprint);
        let [x, z] = sea.exact(at, TIME).slope;
        sum = [sum[0] + x, sum[1] + z];
        squares += x * x + z * z;
    }
    let count = f64::from(side * side);
    let [x, z] = sum.map(|sum| sum / count);
    squares / count - x * x - z * z
}

/// The tiles, at all sizes.
pub fn tiles(sea: &Sea) -> Tiles {
    let tiles = sea.tiles(TIME);
    for tile in &tiles.tiles {
        tile.chains();
    }
    tiles
}

/// From the tiles.
pub fn filtered(tiles: &Tiles, middle: [f64; 2], footprint: f64) -> f64 {
    let [x, z, _] = tiles.moments(middle, footprint).variance;
    x + z
}
