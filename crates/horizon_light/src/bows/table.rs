//! Tables over an angle: from spectrum to colour, blurred by the sun's disc.

use crate::spectrum::{Star, color_matching, srgb};

/// First and last wavelength of the sums, and their step, in nanometres.
const BAND: [u32; 3] = [390, 710, 10];

/// Values over an angle, in steps.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleTable {
    /// The first value's angle, in radians.
    pub start: f64,
    /// From one value to the next, in radians.
    pub step: f64,
    /// Linear sRGB against the star's own.
    pub values: Vec<[f32; 3]>,
}

impl AngleTable {
    /// The value at an angle, between its neighbours; 0 beyond the ends.
    pub fn at(&self, angle: f64) -> [f32; 3] {
        let x = (angle - self.start) / self.step;
        let last = self.values.len().saturating_sub(1);
        if !(0.0..=last as f64).contains(&x) {
            return [0.0; 3];
        }
        let i = (x as usize).min(last.saturating_sub(1));
        let (a, b, t) = (self.values[i], self.values[(i + 1).min(last)], (x - i as f64) as f32);
        core::array::from_fn(|k| a[k] + t * (b[k] - a[k]))
    }
}

/// The wavelengths that tables are summed over, in nanometres.
pub fn wavelengths() -> impl Iterator<Item = f64> {
    (BAND[0]..=BAND[1]).step_by(BAND[2] as usize).map(f64::from)
}

/// Colours of `count` values, of each of which `spectrum` gives the whole row at a wavelength.
pub fn coloured(star: &Star, count: usize, mut spectrum: impl FnMut(f64) -> Vec<f64>) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; count];
    let mut white = [0.0; 3];
    for nm in wavelengths() {
        let (bar, power) = (color_matching(nm), star.at(nm));
        for (sum, value) in sums.iter_mut().zip(spectrum(nm)) {
            (0..3).for_each(|k| sum[k] += bar[k] * power * value);
        }
        (0..3).for_each(|k| white[k] += bar[k] * power);
    }
    let white = srgb(white);
    sums.into_iter()
        .map(|xyz| {
            let rgb = srgb(xyz);
            core::array::from_fn(|k| if white[k] > 0.0 { rgb[k] / white[k] } else { 0.0 })
        })
        .collect()
}

/// Values in steps of `step`, blurred across by an even disc of this angular radius: weights √(1 − t²), integrated over each step.
pub fn blurred(values: &[[f64; 3]], step: f64, radius: f64) -> Vec<[f64; 3]> {
    let reach = (radius / step + 0.5).floor() as isize;
    let up_to = |x: f64| {
        let t = (x * step / radius.max(1e-12)).clamp(-1.0, 1.0);
        0.5 + (t * (1.0 - t * t).max(0.0).sqrt() + libm::asin(t)) / core::f64::consts::PI
    };
    let weights: Vec<f64> = (-reach..=reach).map(|i| up_to(i as f64 + 0.5) - up_to(i as f64 - 0.5)).collect();
    let last = values.len() as isize - 1;
    (0..=last)
        .map(|i| {
            let mut sum = [0.0; 3];
            for (j, weight) in (-reach..=reach).zip(&weights) {
                let from = values[(i + j).clamp(0, last) as usize];
                (0..3).for_each(|k| sum[k] += weight * from[k]);
            }
            sum
        })
        .collect()
}

/// A table of blurred colours.
pub fn table(
    star: &Star,
    radius: f64,
    start: f64,
    step: f64,
    count: usize,
    spectrum: impl FnMut(f64) -> Vec<f64>,
) -> AngleTable {
    let values = blurred(&coloured(star, count, spectrum), step, radius);
    AngleTable { start, step, values: values.into_iter().map(|rgb| rgb.map(|x| x as f32)).collect() }
}
