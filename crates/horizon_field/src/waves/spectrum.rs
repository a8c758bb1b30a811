//! The JONSWAP spectrum, and a sea by it.
//!
//! Notation: U the wind's speed, F the fetch, χ = g F / U², ω the frequency, k = ω² / g. Hasselmann et al., *Measurements of
//! wind-wave growth and swell decay during the Joint North Sea Wave Project* (1973), has the variance of the height as ∫ S dω with
//!
//! S(ω) = α g² ω⁻⁵ exp(−5/4 (ωp/ω)⁴) γʳ, r = exp(−(ω − ωp)² / (2 σ² ωp²)), α = 0.076 χ^−0.22, ωp = 22 χ^−1/3 g / U,
//! γ = 3.3, σ = 0.07 up to ωp and 0.09 from there on.

use core::f64::consts::TAU;

use super::lattice::{GRAVITY, deep_beats, held, largest_wave_number, lot, sides, sub_seed};
use super::{Cascade, Spectrum, Wave, towards};

/// Where the sea is fully developed, ωp is Pierson's and Moskowitz's 0.855 g / U (1964), and χ this.
const DEVELOPED: f64 = 17_036.5;
/// Wind below this speed, in m/s, raises no waves.
const CALM: f64 = 0.1;
/// How often the longest waves of note fit into the largest tile.
const FIT: f64 = 6.0;
/// The smallest of the largest tiles, in metres: shorter waves than it leaves have no weight.
const SMALLEST: f64 = 4.0;
/// The largest wave number of gravity waves: shorter ones than 17 mm are ruled by surface tension.
const CAPILLARY: f64 = 370.0;
/// Intervals of an integral over the spectrum.
const INTERVALS: usize = 1024;

/// JONSWAP's spectrum of a wind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jonswap {
    alpha: f64,
    /// ωp.
    pub peak: f64,
}

impl Jonswap {
    /// Of a wind and a fetch; none in a calm.
    pub fn new(wind: f64, fetch: f64) -> Option<Self> {
        if wind < CALM {
            return None;
        }
        let fetch = (GRAVITY * fetch / (wind * wind)).min(DEVELOPED);
        Some(Self { alpha: 0.076 * libm::pow(fetch, -0.22), peak: 22.0 / libm::cbrt(fetch) * GRAVITY / wind })
    }

    /// S(ω), in m² s.
    pub fn density(&self, frequency: f64) -> f64 {
        // Far below the peak powers would overflow before the exponential is 0, which it is.
        if frequency < 0.1 * self.peak {
            return 0.0;
        }
        let ratio = self.peak / frequency;
        let width = if frequency <= self.peak { 0.07 } else { 0.09 };
        let off = (frequency - self.peak) / (width * self.peak);
        let enhanced = libm::pow(3.3, libm::exp(-0.5 * off * off));
        let fall = GRAVITY * GRAVITY / (frequency * frequency * frequency * frequency * frequency);
        self.alpha * fall * libm::exp(-1.25 * ratio * ratio * ratio * ratio) * enhanced
    }

    /// ∫ S(ω) weight(ω) dω between two wave numbers, by the trapezoidal rule in log ω.
    pub fn integral(&self, from: f64, to: f64, weight: impl Fn(f64) -> f64) -> f64 {
        let [from, to] = [from, to].map(|k| (GRAVITY * k).sqrt().max(0.1 * self.peak));
        if from >= to {
            return 0.0;
        }
        let step = libm::log(to / from) / INTERVALS as f64;
        let term = |i: usize| {
            let frequency = from * libm::exp(step * i as f64);
            let end = if i == 0 || i == INTERVALS { 0.5 } else { 1.0 };
            end * step * frequency * self.density(frequency) * weight(frequency)
        };
        (0..=INTERVALS).map(term).sum()
    }
}

/// The tiles of a wind sea, and the slope's variance of waves that are too short for them.
pub(super) fn spectrum(model: &Spectrum) -> (Vec<Cascade>, f64) {
    let Some(jonswap) = Jonswap::new(model.wind, model.fetch) else { return (Vec::new(), 0.0) };
    let longest = TAU * GRAVITY / (jonswap.peak * jonswap.peak);
    let mut below = 0.0;
    let mut cascades = Vec::new();
    for (i, side) in sides((FIT * longest).max(SMALLEST)).into_iter().enumerate() {
        let above = largest_wave_number(side);
        cascades.push(Cascade::new(side, model.choppiness, band(model, &jonswap, i as u32, side, [below, above])));
        below = above;
    }
    let slope = |frequency: f64| (frequency * frequency / GRAVITY) * (frequency * frequency / GRAVITY);
    (cascades, jonswap.integral(below, CAPILLARY, slope))
}

/// The waves of a tile, between two wave numbers. Chance decides each amplitude (two normal numbers, as Tessendorf has it), and
/// all are scaled together so that the band's variance is the spectrum's.
fn band(model: &Spectrum, jonswap: &Jonswap, tile: u32, side: f64, [below, above]: [f64; 2]) -> Vec<Wave> {
    let wind = towards(model.heading);
    let [amplitudes, phases] = [2 * tile, 2 * tile + 1].map(|which| sub_seed(model.seed, which));
    let mut waves: Vec<Wave> = held()
        .filter_map(|n| {
            let wave = Wave { n, amplitude: 0.0, phase: TAU * lot(n, phases), beats: deep_beats(n, side) };
            let k = TAU / side * wave.length();
            if k <= below || k > above {
                return None;
            }
            let frequency = (GRAVITY * k).sqrt();
            let along = (wind[0] * f64::from(n[0]) + wind[1] * f64::from(n[1])) / wave.length();
            let spreading = libm::pow((0.5 + 0.5 * along).clamp(0.0, 1.0), model.focus);
            // The density over the plane of wave vectors is S dω/dk D(θ) / k; constant factors fall out below.
            let variance = jonswap.density(frequency) / (frequency * k) * spreading;
            let amplitude = (variance * -libm::log(lot(n, amplitudes))).sqrt();
            (amplitude > 0.0).then_some(Wave { amplitude, ..wave })
        })
        .collect();
    let sum: f64 = waves.iter().map(|wave| 0.5 * wave.amplitude * wave.amplitude).sum();
    let scale = (jonswap.integral(below, above, |_| 1.0) / sum).sqrt();
    if !scale.is_finite() {
        return Vec::new();
    }
    waves.iter_mut().for_each(|wave| wave.amplitude *= scale);
    waves
}
