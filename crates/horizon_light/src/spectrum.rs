//! From spectrum to colour: what an eye makes of spectral radiance, in linear sRGB with luminance in cd/m².
//!
//! The models compute radiance at three wavelengths. Three such numbers are not a colour: the eye weighs all wavelengths.
//! Bruneton 2017 (arXiv 1612.04336, section 14.3) assumes that light has the star's spectrum times a power of the
//! wavelength, −3 for a sky and 0 for the star itself, so that one factor for each channel converts. [`Star::matrix`] drops
//! the assumption: it draws a curve through all three radiances, whatever their slope, and integrates that; one matrix
//! serves sky, star and ground. Against full spectra the luminance of a hazy sky with ozone is then off by 0.3 % with the sun
//! at a zenith angle of 30° and by at most 1.4 % at 80°, where Bruneton's factors are off by 0.7 % and 10 %
//! (`tests::the_matrix_beats_the_factors`). What both miss there is ozone's band round 600 nm, between the published wavelengths:
//! [`earth`] says which ones do not.
//!
//! Radiance becomes luminance here, and irradiance illuminance: the factors are the same.

pub mod earth;
pub mod tables;
#[cfg(test)]
mod tests;

use crate::medium::{Medium, WAVELENGTHS};
use tables::{CIE_1931, CIE_STEP, FIRST, LAST, SOLAR, SOLAR_STEP, XYZ_TO_SRGB};

/// Lumens per watt where the eye is most sensitive (the SI's definition of the candela).
pub const MAX_LUMINOUS_EFFICACY: f64 = 683.0;

/// The power of the wavelength that a clear sky's colour follows, against its star's (Bruneton 2017).
pub const SKY_POWER: f64 = -3.0;

/// Linear interpolation in a table that starts at [`FIRST`], held constant beyond its ends.
fn interpolate<const N: usize>(len: usize, row: impl Fn(usize) -> [f64; N], step: f64, nm: f64) -> [f64; N] {
    let x = ((nm - FIRST) / step).clamp(0.0, (len - 1) as f64);
    let i = (x as usize).min(len - 2);
    let (a, b, t) = (row(i), row(i + 1), x - i as f64);
    core::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

/// Colour matching functions x̄, ȳ, z̄ of the CIE 1931 2° observer at a wavelength in nanometres; 0 outside 360 – 830 nm.
pub fn color_matching(nm: f64) -> [f64; 3] {
    if nm <= FIRST || nm >= LAST {
        return [0.0; 3];
    }
    interpolate(CIE_1931.len(), |i| CIE_1931[i], CIE_STEP, nm)
}

/// The sun's spectral irradiance above the air, at 1 AU, in W m⁻² nm⁻¹ at a wavelength in nanometres (ASTM G-173; constant
/// beyond 360 – 830 nm).
pub fn solar_irradiance(nm: f64) -> f64 {
    interpolate(SOLAR.len(), |i| [SOLAR[i]], SOLAR_STEP, nm)[0]
}

/// CIE XYZ of a spectrum (per nanometre, by wavelength in nanometres); Y is luminance, in cd/m² for W m⁻² sr⁻¹ nm⁻¹.
pub fn xyz(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    // In steps of 1 nm, as Bruneton sums: the published factors hold to the last digit only so.
    for nm in FIRST as u32 + 1..LAST as u32 {
        let nm = f64::from(nm);
        let (bar, power) = (color_matching(nm), spectrum(nm));
        for k in 0..3 {
            sum[k] += MAX_LUMINOUS_EFFICACY * bar[k] * power;
        }
    }
    sum
}

/// Linear sRGB of CIE XYZ, in the same unit. A colour outside sRGB's gamut has a negative channel.
pub fn srgb(xyz: [f64; 3]) -> [f64; 3] {
    XYZ_TO_SRGB.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2])
}

/// Luminance of linear sRGB, in the same unit (IEC 61966-2-1).
pub fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

/// A star's light, known at three wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// The wavelengths, in nanometres: different, in any order, within 360 – 830.
    pub wavelengths: [f64; 3],
    /// Spectral irradiance there, in W m⁻² nm⁻¹, not negative.
    pub irradiance: [f64; 3],
}

impl Star {
    /// The star that a medium is lit by.
    pub const fn of(medium: &Medium) -> Self {
        Self { wavelengths: medium.wavelengths, irradiance: medium.irradiance }
    }

    /// A star of this irradiance at the published [`WAVELENGTHS`].
    const fn published(irradiance: [f64; 3]) -> Self {
        Self { wavelengths: WAVELENGTHS, irradiance }
    }

    /// Irradiance at any wavelength in nanometres: the sun's spectrum, bent through the three that are known, so that the
    /// sun itself keeps its lines, and a dimmer or redder star has them too.
    pub fn at(&self, nm: f64) -> f64 {
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| self.wavelengths[a].total_cmp(&self.wavelengths[b]));
        let known = order.map(|i| self.wavelengths[i]);
        let ratio = order.map(|i| self.irradiance[i] / solar_irradiance(self.wavelengths[i]));
        let k = usize::from(nm > known[1]);
        let t = ((nm - known[k]) / (known[k + 1] - known[k])).clamp(0.0, 1.0);
        solar_irradiance(nm) * (ratio[k] + (ratio[k + 1] - ratio[k]) * t)
    }

    /// Luminance of each linear sRGB channel, in cd/m², for a radiance of 1 W m⁻² sr⁻¹ nm⁻¹ at its wavelength, where light
    /// follows the star's spectrum times λ to `power`. The wavelengths stand for red, green and blue in this order.
    /// 0 where the star has no light.
    pub fn factors(&self, power: f64) -> [f64; 3] {
        core::array::from_fn(|k| {
            let (at, own) = (self.wavelengths[k], self.irradiance[k]);
            if own > 0.0 { srgb(xyz(|nm| self.at(nm) / own * libm::pow(nm / at, power)))[k] } else { 0.0 }
        })
    }

    /// From radiance at the three wavelengths, in W m⁻² sr⁻¹ nm⁻¹, to linear sRGB in cd/m²: rows are red, green, blue.
    ///
    /// Radiance over the star's irradiance is taken as a quadratic in the wave number 1/λ: exact for what reflects without
    /// colour, and close for λ⁻⁴ as for what shines through a long way of air. Of eleven families of powers tried it had
    /// the least error in colour over skies and low suns together. Deep reds lie outside sRGB: clamp what is negative.
    pub fn matrix(&self) -> [[f64; 3]; 3] {
        let x = self.wavelengths.map(f64::recip);
        let columns: [[f64; 3]; 3] = core::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            if self.irradiance[i] <= 0.0 {
                return [0.0; 3];
            }
            let lagrange = |x0: f64| (x0 - x[j]) * (x0 - x[k]) / ((x[i] - x[j]) * (x[i] - x[k]));
            srgb(xyz(|nm| lagrange(1.0 / nm) * self.at(nm) / self.irradiance[i]))
        });
        core::array::from_fn(|channel| columns.map(|column| column[channel]))
    }
}

/// Bruneton's factors for a sky under a star of this irradiance at [`WAVELENGTHS`]: linear sRGB in cd/m² for
/// W m⁻² sr⁻¹ nm⁻¹, channel by channel.
pub fn sky_luminance_factors(irradiance: [f64; 3]) -> [f64; 3] {
    Star::published(irradiance).factors(SKY_POWER)
}

/// Bruneton's factors for the star itself, and for what it lights without a change of colour.
pub fn sun_luminance_factors(irradiance: [f64; 3]) -> [f64; 3] {
    Star::published(irradiance).factors(0.0)
}
