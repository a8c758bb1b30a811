//! A few sines, straight or trochoidal, on the tiles' lattices.

use core::f64::consts::TAU;

use super::lattice::{deep_beats, is_held, lot, sides, sub_seed};
use super::{CASCADES, Cascade, Gerstner, Sines, Wave, towards};

/// How long a wave is, as a share of the one before it.
const SHORTER: f64 = 0.8;
/// How often the longest wave fits into the largest tile: often enough that rounding to the lattice turns it little.
const FIT: f64 = 8.0;

/// The tiles of sines.
pub(super) fn sines(model: &Sines) -> Vec<Cascade> {
    let sides = sides(FIT * model.wavelength);
    let waves = waves(model, sides);
    sides.into_iter().zip(waves).map(|(side, waves)| Cascade::new(side, 0.0, waves)).collect()
}

/// The tiles of Gerstner's waves. The displacement's slope nowhere exceeds c Σ k a, so that with this sum at most 1, over all
/// tiles, crests have cusps at the worst.
pub(super) fn gerstner(model: &Gerstner) -> Vec<Cascade> {
    let Gerstner { count, wavelength, amplitude, steepness, heading, spread, seed } = *model;
    let sides = sides(FIT * wavelength);
    let waves = waves(&Sines { count, wavelength, amplitude, heading, spread, seed }, sides);
    let of_tile = |(side, waves): (&f64, &Vec<Wave>)| {
        waves.iter().map(|wave| TAU / side * wave.length() * wave.amplitude).sum::<f64>()
    };
    let sum: f64 = sides.iter().zip(&waves).map(of_tile).sum();
    let choppiness = if sum > 0.0 { steepness / sum } else { 0.0 };
    sides.into_iter().zip(waves).map(|(side, waves)| Cascade::new(side, choppiness, waves)).collect()
}

/// Each wave goes to the largest tile that holds it, at the nearest point of its lattice.
fn waves(model: &Sines, sides: [f64; CASCADES]) -> [Vec<Wave>; CASCADES] {
    let mut tiles: [Vec<Wave>; CASCADES] = Default::default();
    let lengths: Vec<f64> =
        core::iter::successors(Some(1.0), |length| Some(length * SHORTER)).take(model.count as usize).collect();
    let share = model.amplitude / lengths.iter().sum::<f64>();
    for (i, length) in lengths.into_iter().enumerate() {
        let at = |which| lot([i as i32, which], sub_seed(model.seed, which as u32));
        let heading = towards(model.heading + model.spread * (2.0 * at(0) - 1.0));
        let phase = TAU * at(1);
        for (side, waves) in sides.into_iter().zip(&mut tiles) {
            let n = heading.map(|along| (along * side / (model.wavelength * length)).round() as i32);
            if is_held(n) {
                put(waves, Wave { n, amplitude: share * length, phase, beats: deep_beats(n, side) });
                break;
            }
        }
    }
    tiles
}

/// Two waves at the same point of the lattice are one wave.
fn put(waves: &mut Vec<Wave>, wave: Wave) {
    let Some(same) = waves.iter_mut().find(|same| same.n == wave.n) else { return waves.push(wave) };
    let [a, b] = [&*same, &wave].map(|w| [w.amplitude * libm::cos(w.phase), w.amplitude * libm::sin(w.phase)]);
    let [re, im] = [a[0] + b[0], a[1] + b[1]];
    (same.amplitude, same.phase) = ((re * re + im * im).sqrt(), libm::atan2(im, re));
}
