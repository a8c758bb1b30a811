//! Power spectra of relief: detrended, under a Hann window (which keeps the edges from looking like cliffs), by a discrete
//! Fourier transform.

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use super::relief::Relief;
use super::samples::fitted_slope;

/// The radially averaged power spectral density of a relief: points (wavenumber in cycles per metre, power in m⁴), in
/// `bins` bins, even in the logarithm, from the grid's longest wave to its shortest (Nyquist). Bins without waves are left
/// out. Of a power law kᵝ in the plane, a profile has k^(β + 1).
pub fn radial(relief: &Relief, bins: usize) -> Vec<(f64, f64)> {
    let ([width, height], [dx, dz]) = (relief.size, relief.spacing);
    let window_x = hann(width);
    let trend = plane(relief);
    let mut energy = 0.0;
    let mut data: Vec<Complex<f64>> = Vec::with_capacity(width * height);
    for (z, window_z) in hann(height).into_iter().enumerate() {
        for (x, window_x) in window_x.iter().enumerate() {
            let window = window_x * window_z;
            energy += window * window;
            data.push(Complex::new(window * (relief.at(x, z) - trend(x, z)), 0.0));
        }
    }
    let mut planner = FftPlanner::new();
    let (along_x, along_z) = (planner.plan_fft_forward(width), planner.plan_fft_forward(height));
    along_x.process(&mut data);
    for x in 0..width {
        column(&mut data, x, width, along_z.as_ref());
    }
    // Periodogram: |F|² · cell area / Σw².
    let scale = dx * dz / energy;
    let low = (1.0 / (width as f64 * dx)).max(1.0 / (height as f64 * dz));
    let high = (0.5 / dx).min(0.5 / dz);
    let mut sums = vec![(0.0, 0.0, 0usize); bins];
    for z in 0..height {
        for x in 0..width {
            let (kx, kz) = (frequency(x, width) / dx, frequency(z, height) / dz);
            let k = kx.hypot(kz);
            let at = (k / low).ln() / (high / low).ln() * bins as f64;
            if !(0.0..bins as f64).contains(&at) {
                continue;
            }
            let sum = &mut sums[at as usize];
            *sum = (sum.0 + k.ln(), sum.1 + data[z * width + x].norm_sqr() * scale, sum.2 + 1);
        }
    }
    let filled = sums.into_iter().filter(|sum| sum.2 > 0);
    filled.map(|(ln_k, power, count)| ((ln_k / count as f64).exp(), power / count as f64)).collect()
}

/// The mean power spectral density of the rows, which run along x: points (wavenumber in cycles per metre, power in m³).
pub fn rows(relief: &Relief) -> Vec<(f64, f64)> {
    let ([width, height], dx) = (relief.size, relief.spacing[0]);
    let window = hann(width);
    let scale = dx / window.iter().map(|w| w * w).sum::<f64>();
    let fft = FftPlanner::new().plan_fft_forward(width);
    let mut power = vec![0.0; width / 2];
    for z in 0..height {
        let row: Vec<_> = (0..width).map(|x| (x as f64, relief.at(x, z))).collect();
        let slope = fitted_slope(&row);
        let middle = row.iter().map(|(x, h)| h - slope * x).sum::<f64>() / width as f64;
        let windowed = row.iter().zip(&window).map(|((x, h), w)| Complex::new(w * (h - slope * x - middle), 0.0));
        let mut data: Vec<_> = windowed.collect();
        fft.process(&mut data);
        power.iter_mut().zip(&data).for_each(|(sum, value)| *sum += value.norm_sqr() * scale / height as f64);
    }
    power.into_iter().enumerate().skip(1).map(|(i, power)| (i as f64 / (width as f64 * dx), power)).collect()
}

/// The exponent β of the power law that fits a spectrum best between two wavelengths in metres.
pub fn exponent(spectrum: &[(f64, f64)], [shortest, longest]: [f64; 2]) -> f64 {
    let within = spectrum.iter().filter(|(k, power)| (1.0 / longest..=1.0 / shortest).contains(k) && *power > 0.0);
    fitted_slope(&within.map(|(k, power)| (k.ln(), power.ln())).collect::<Vec<_>>())
}

/// The window of Hann, which is 0 one step before the first and after the last point.
fn hann(count: usize) -> Vec<f64> {
    let angle = |i: usize| core::f64::consts::TAU * (i + 1) as f64 / (count + 1) as f64;
    (0..count).map(|i| 0.5 - 0.5 * angle(i).cos()).collect()
}

/// The frequency of a transform's entry, in cycles per point.
fn frequency(index: usize, count: usize) -> f64 {
    let index = index as f64;
    let count = count as f64;
    if 2.0 * index > count { (index - count) / count } else { index / count }
}

/// The plane that fits a relief best. On a grid the two directions are independent of one another.
fn plane(relief: &Relief) -> impl Fn(usize, usize) -> f64 {
    let [width, height] = relief.size;
    let points = (0..height).flat_map(|z| (0..width).map(move |x| (x, z)));
    let along = |which: fn((usize, usize)) -> usize| {
        fitted_slope(&points.clone().map(|p| (which(p) as f64, relief.at(p.0, p.1))).collect::<Vec<_>>())
    };
    let (slope_x, slope_z) = (along(|p| p.0), along(|p| p.1));
    let mean = relief.heights.iter().sum::<f64>() / relief.heights.len() as f64;
    let (x0, z0) = ((width - 1) as f64 / 2.0, (height - 1) as f64 / 2.0);
    move |x, z| mean + slope_x * (x as f64 - x0) + slope_z * (z as f64 - z0)
}

fn column(data: &mut [Complex<f64>], x: usize, width: usize, fft: &dyn Fft<f64>) {
    let mut values: Vec<_> = data.iter().skip(x).step_by(width).copied().collect();
    fft.process(&mut values);
    data.iter_mut().skip(x).step_by(width).zip(values).for_each(|(place, value)| *place = value);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relief of a known power law: waves of random phase, by the inverse transform.
    fn power_law(size: [usize; 2], spacing: [f64; 2], beta: f64) -> Relief {
        let [width, height] = size;
        let mut state = 12345_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut data: Vec<Complex<f64>> = (0..width * height)
            .map(|i| {
                let (kx, kz) = (frequency(i % width, width) / spacing[0], frequency(i / width, height) / spacing[1]);
                let k = kx.hypot(kz);
                let amplitude = if k > 0.0 { k.powf(beta / 2.0) } else { 0.0 };
                Complex::from_polar(amplitude, core::f64::consts::TAU * random())
            })
            .collect();
        let mut planner = FftPlanner::new();
        planner.plan_fft_inverse(width).process(&mut data);
        let along_z = planner.plan_fft_inverse(height);
        (0..width).for_each(|x| column(&mut data, x, width, along_z.as_ref()));
        Relief { size, spacing, heights: data.into_iter().map(|value| value.re).collect() }
    }

    #[test]
    fn a_power_law_has_its_exponent() {
        for beta in [-3.0, -4.2] {
            let relief = power_law([240, 200], [70.0, 90.0], beta);
            let found = exponent(&radial(&relief, 32), [300.0, 5000.0]);
            assert!((found - beta).abs() < 0.1, "{found} for {beta}");
            let of_rows = exponent(&rows(&relief), [300.0, 5000.0]);
            assert!((of_rows - (beta + 1.0)).abs() < 0.15, "rows: {of_rows} for {beta}");
        }
    }

    #[test]
    fn power_is_where_the_wave_is_and_a_slope_has_none() {
        let tau = core::f64::consts::TAU;
        let wave = |x: usize, z: usize| 2.0 * (tau * (3.0 * x as f64 * 10.0 + 4.0 * z as f64 * 10.0) / 2000.0).sin();
        let ramp = |x: usize, z: usize| 5.0 * x as f64 - 3.0 * z as f64;
        let relief = Relief::new([160, 160], [10.0; 2], |x, z| wave(x, z) + ramp(x, z));
        let spectrum = radial(&relief, 40);
        let peak = spectrum.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        // A bin is 12 % wide.
        assert!((1.0 / peak.0 - 400.0).abs() < 50.0, "wavelength {}", 1.0 / peak.0);
        let longest = spectrum[0];
        assert!(longest.1 < 1e-3 * peak.1, "{longest:?} {peak:?}");
    }

    #[test]
    fn power_adds_up_to_the_variance() {
        // Parseval: white noise has the density variance · cell area everywhere.
        let flat = power_law([128, 128], [10.0; 2], 0.0);
        let variance = flat.heights.iter().map(|h| h * h).sum::<f64>() / flat.heights.len() as f64;
        let density = variance * 100.0;
        for (k, power) in radial(&flat, 12).into_iter().skip(6) {
            assert!((power / density - 1.0).abs() < 0.2, "{k} {power} {density}");
        }
        for (k, power) in rows(&flat).into_iter().skip(10) {
            assert!((power / (variance * 10.0) - 1.0).abs() < 0.6, "{k} {power}");
        }
    }
}
