//! The cheapest sky: a gradient from horizon to zenith (seed 000 appendix D.1), which here also follows the sun.
//!
//! Seed 000 blends two colours up the screen and knows no sun. This blends up the sky, so that it holds still as the camera
//! turns, dims with the sun by published illuminances, and warms the horizon under a low sun. No table, no integral.

#[cfg(test)]
mod tests;

use crate::night::MOONLESS_NIGHT;
use horizon_field::Real;
use serde::{Deserialize, Serialize};

/// The same in WGSL.
pub const WGSL: &str = include_str!("gradient.wgsl");

/// Part of the brightest sky's light that is left with the sun on the horizon: clear skies give 0.8 + 15.5 √(sin elevation)
/// klx (IES 1984, Recommended practice for the calculation of daylight availability).
const SUNSET: f64 = 0.8 / 16.3;

/// How fast light fades as the sun sinks, per sine of its depth: from 0.8 klx down to 2 – 3.5 lx at 6° and 0.008 lx at 12°
/// (American Meteorological Society, glossary, "civil twilight", "nautical twilight").
const FADE: f64 = 54.0;

/// Sine of the elevation within which a sun warms the horizon.
const LOW: f64 = 0.15;

/// A sky's colours, in linear sRGB, cd/m²; laid out as the shader's `GradientSky`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GradientSky<T> {
    /// The zenith under the highest sun.
    pub zenith: [T; 3],
    /// How much haze takes of what lies behind it, per metre.
    pub haze: T,
    /// The horizon under the highest sun.
    pub horizon: [T; 3],
    /// The floor of a moonless night, a grey.
    pub night: T,
    /// The horizon towards a setting sun, before it is dimmed as the whole sky then is: to 1/20.
    pub sunset: [T; 3],
}

impl GradientSky<f64> {
    /// Earth's clear sky. Colours are those of single scattering by Bruneton's air (at the zenith, near the horizon across
    /// from the sun, and near a sun 2° high), brightness is such that the sky gives 16.3 klx, as the IES has it.
    pub const EARTH: Self = Self {
        zenith: [2_900.0, 4_700.0, 9_000.0],
        haze: 2e-5,
        horizon: [6_600.0, 8_300.0, 9_400.0],
        night: MOONLESS_NIGHT,
        sunset: [27_000.0, 14_000.0, 4_000.0],
    };

    /// The same numbers in another precision.
    pub fn cast<T: Real>(&self) -> GradientSky<T> {
        GradientSky {
            zenith: self.zenith.map(T::of),
            haze: T::of(self.haze),
            horizon: self.horizon.map(T::of),
            night: T::of(self.night),
            sunset: self.sunset.map(T::of),
        }
    }
}

fn exp<T: Real>(x: T) -> T {
    T::of(libm::exp(x.f64()))
}

impl<T: Real> GradientSky<T> {
    /// Luminance of the sky in linear sRGB, cd/m². `mu` and `mu_s` are the heights of the unit vectors to view and sun over
    /// the level, `nu` is the cosine between them. Below the level it is the horizon's.
    pub fn luminance(&self, mu: T, mu_s: T, nu: T) -> [T; 3] {
        let day = if mu_s > T::ZERO {
            T::of(SUNSET) + T::of(1.0 - SUNSET) * mu_s.sqrt()
        } else {
            T::of(SUNSET) * exp(T::of(FADE) * mu_s)
        };
        let low = mu_s * T::of(1.0 / LOW);
        let towards = (T::ONE + nu) * T::of(0.5);
        let warm = exp(-low * low) * towards * towards;
        let over = T::ONE - mu.clamp(T::ZERO, T::ONE);
        core::array::from_fn(|c| {
            let horizon = self.horizon[c] + (self.sunset[c] - self.horizon[c]) * warm;
            (self.zenith[c] + (horizon - self.zenith[c]) * over * over) * day + self.night
        })
    }

    /// How much of a thing's light comes through `distance` metres of haze (seed 000 eq. D.1); the rest of what is seen is
    /// the sky's luminance in that direction.
    pub fn transmittance(&self, distance: T) -> T {
        exp(-self.haze * distance)
    }
}
