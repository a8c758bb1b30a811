//! Octaves of gradient noise on the tiles' lattices.
//!
//! An octave must come again at the tile's edge, and yet be turned against the others. Its lattice has the coordinates
//! u = P x / L, with P = p + i q a whole complex number: it is turned by the argument of P and fits |P| times into the tile. A tile
//! on moves u by P, or by i P: cells that differ by multiples of P are the same cell.

use super::lattice::{held, sides, sub_seed};
use super::transform::{roots, transform};
use super::{CASCADES, Cascade, FbmWaves, GRID, PERIOD, Wave, towards};
use crate::hash::hash2;

/// How often the first octave fits into the largest tile.
const FIT: f64 = 5.0;
/// The most that an octave may fit into a tile: its waves reach from about half of that to half as much again.
const MOST: f64 = 12.0;
/// How much each octave is turned against the one before it, in radians.
const TURN: f64 = 0.6;
/// How far the tiles' drifts are apart, in radians: their sum does not move as a whole.
const APART: [f64; CASCADES] = [0.0, 0.4, -0.4];

/// No tile goes on more often in a period, which would be a thousand times a second: beats stay whole in single precision.
const FASTEST: f64 = 262_144.0;

/// A tile's octave: P, the amplitude, the seed.
struct Octave {
    p: [i64; 2],
    amplitude: f64,
    seed: u32,
}

/// The tiles of drifting noise.
pub(super) fn fbm(model: &FbmWaves) -> Vec<Cascade> {
    let sides = sides(FIT * model.wavelength);
    let mut tiles: [Vec<Octave>; CASCADES] = Default::default();
    let (mut fit, mut amplitude) = (FIT, model.amplitude);
    for i in 0..model.octaves {
        for (side, octaves) in sides.into_iter().zip(&mut tiles) {
            let fits = fit * side / sides[0];
            if fits <= MOST {
                let turn = TURN * f64::from(i);
                let p = [fits * libm::cos(turn), fits * libm::sin(turn)].map(|x| x.round() as i64);
                octaves.push(Octave { p, amplitude, seed: sub_seed(model.seed, i) });
                break;
            }
        }
        (fit, amplitude) = (fit * model.lacunarity, amplitude * model.gain);
    }
    let of_tile = |((side, octaves), apart): ((f64, Vec<Octave>), f64)| {
        let drift = towards(model.heading + apart)
            .map(|along| (along * model.speed * PERIOD / side).round().clamp(-FASTEST, FASTEST) as i32);
        Cascade::new(side, 0.0, waves(&octaves, drift))
    };
    sides.into_iter().zip(tiles).zip(APART).map(of_tile).collect()
}

/// The waves of octaves, by a discrete Fourier transform of their sum, all of which goes `drift` tiles a period.
fn waves(octaves: &[Octave], drift: [i32; 2]) -> Vec<Wave> {
    if octaves.is_empty() {
        return Vec::new();
    }
    let texel = |i: usize| i as f64 / GRID as f64;
    let roots = roots();
    let mut columns = vec![[[0.0; 4]; GRID]; GRID];
    for z in 0..GRID {
        let mut line = [[0.0; 4]; GRID];
        for (x, pair) in line.iter_mut().enumerate() {
            pair[0] = octaves.iter().map(|octave| octave.amplitude * noise(octave, [texel(x), texel(z)])).sum();
        }
        transform(&mut line, &roots);
        for (column, pair) in columns.iter_mut().zip(line) {
            column[z] = pair;
        }
    }
    columns.iter_mut().for_each(|column| transform(column, &roots));
    // The noise is real: n and −n are one wave. The transform's sign makes the amplitudes at n those of −n.
    held()
        .filter(|n| n[1] > 0 || (n[1] == 0 && n[0] > 0))
        .filter_map(|n| {
            let [x, z] = n.map(|n| n.rem_euclid(GRID as i32) as usize);
            let [re, im, ..] = columns[x][z].map(|part| 2.0 * part / (GRID * GRID) as f64);
            let amplitude = (re * re + im * im).sqrt();
            let beats = n[0] * drift[0] + n[1] * drift[1];
            (amplitude > 0.0).then(|| Wave { n, amplitude, phase: -libm::atan2(im, re), beats })
        })
        .collect()
}

/// Gradient noise in [−1, 1], at a place in tiles.
fn noise(octave: &Octave, at: [f64; 2]) -> f64 {
    let [p, q] = octave.p.map(|p| p as f64);
    let u = [p * at[0] - q * at[1], q * at[0] + p * at[1]];
    let cell = u.map(|u| u.floor() as i64);
    let [x, z] = [0, 1].map(|k| u[k] - cell[k] as f64);
    let corner = |i: i64, j: i64| {
        let hash = hash2(wrapped([cell[0] + i, cell[1] + j], octave.p), octave.seed);
        let [gx, gz] = [hash & 0xffff, hash >> 16].map(|half| (f64::from(half) - 32_767.5) / 32_768.0);
        gx * (x - i as f64) + gz * (z - j as f64)
    };
    let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let mix = |a: f64, b: f64, t: f64| a + t * (b - a);
    mix(mix(corner(0, 0), corner(1, 0), fade(x)), mix(corner(0, 1), corner(1, 1), fade(x)), fade(z))
}

/// The one cell of all that differ by multiples of P: the remainder of the division of complex numbers, with P* / |P|² for 1 / P.
fn wrapped([x, z]: [i64; 2], [p, q]: [i64; 2]) -> [i64; 2] {
    let norm = p * p + q * q;
    let times = [(x * p + z * q).div_euclid(norm), (z * p - x * q).div_euclid(norm)];
    [x - (times[0] * p - times[1] * q), z - (times[0] * q + times[1] * p)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octaves_come_again_at_the_tile_s_edge_and_nowhere_before() {
        for p in [[5, 0], [3, 4], [-2, 7], [1, 2]] {
            let octave = Octave { p, amplitude: 1.0, seed: 7 };
            let mut cells: Vec<_> = (0..400).map(|i| wrapped([i % 20 - 10, i / 20 - 10], p)).collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len() as i64, p[0] * p[0] + p[1] * p[1]);
            for at in [[0.11, 0.72], [0.5, 0.03], [0.93, 0.999]] {
                let here = noise(&octave, at);
                assert!((here - noise(&octave, [at[0] + 1.0, at[1] - 2.0])).abs() < 1e-12);
                assert!((here - noise(&octave, [at[0] + 0.5, at[1]])).abs() > 1e-6);
            }
        }
    }
}
