//! A tile's waves.

use core::f64::consts::TAU;

use super::{GRID, REACH};

/// A travelling wave of a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// How many times it fits into the tile along x and z.
    pub n: [i32; 2],
    /// The amplitude, in metres.
    pub amplitude: f64,
    /// The phase at the tile's corner and the time 0, in radians.
    pub phase: f64,
    /// How often it swings in a [`PERIOD`](super::PERIOD).
    pub beats: i32,
}

impl Wave {
    /// |n|.
    pub(crate) fn length(&self) -> f64 {
        let [x, z] = self.n.map(f64::from);
        (x * x + z * z).sqrt()
    }
}

/// A periodic tile of waves. No two have the same n, none has n = 0, and |n| is at most [`REACH`].
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// The tile's side, in metres.
    pub side: f64,
    /// How far water moves along, as a multiple of how far it moves up.
    pub choppiness: f64,
    /// The waves.
    pub waves: Vec<Wave>,
    /// No height is further from 0, in metres: the sum of all amplitudes, or five standard deviations where that is less.
    pub bound: f32,
}

impl Cascade {
    /// A tile with these waves.
    pub(super) fn new(side: f64, choppiness: f64, waves: Vec<Wave>) -> Self {
        let sum: f64 = waves.iter().map(|wave| wave.amplitude.abs()).sum();
        let deviation = waves.iter().map(|wave| 0.5 * wave.amplitude * wave.amplitude).sum::<f64>().sqrt();
        Self { side, choppiness, waves, bound: sum.min(5.0 * deviation) as f32 }
    }

    /// The distance of texels, in metres.
    pub fn texel(&self) -> f64 {
        self.side / GRID as f64
    }

    /// The height's variance in the frame of the water, in m²: Σ a²/2.
    pub fn height_variance(&self) -> f64 {
        self.waves.iter().map(|wave| 0.5 * wave.amplitude * wave.amplitude).sum()
    }

    /// The slope's variance in the frame of the water, along x and z together: Σ k²a²/2.
    pub fn slope_variance(&self) -> f64 {
        let slope = |wave: &Wave| TAU / self.side * wave.length() * wave.amplitude;
        self.waves.iter().map(|wave| 0.5 * slope(wave) * slope(wave)).sum()
    }

    /// What the device keeps of the waves: (2 [`REACH`] + 1)² texels from n = (−REACH, −REACH) on, x first. Each is the complex
    /// amplitude at the centre of the tile's first texel at the time 0, the beats, and 0.
    pub fn modes(&self) -> Vec<[f32; 4]> {
        let reach = REACH as i32;
        let width = 2 * REACH + 1;
        let mut modes = vec![[0.0; 4]; width * width];
        for wave in &self.waves {
            let [x, z] = wave.n.map(|n| (n + reach) as usize);
            let [re, im] = wave.at_first_texel();
            modes[z * width + x] = [re as f32, im as f32, wave.beats as f32, 0.0];
        }
        modes
    }
}

impl Wave {
    /// The complex amplitude at the time 0, at the centre of the tile's first texel: half a texel from the corner along both axes.
    pub(super) fn at_first_texel(&self) -> [f64; 2] {
        let phase = self.phase + TAU * f64::from(self.n[0] + self.n[1]) * (0.5 / GRID as f64);
        [self.amplitude * libm::cos(phase), self.amplitude * libm::sin(phase)]
    }
}
