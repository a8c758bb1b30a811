//! The sun's disc: its luminance with limb darkening, softened over a pixel, and how much of it stands above the horizon.
//!
//! Seen from afar a sphere's disc has, at the angle θ from its centre, the emission cosine μ = √(1 − u) with
//! u = sin²θ / sin²α, where α is the disc's radius (the law of sines: exact, also for a near star). In u the irradiance on a
//! plane that faces the star is plain, dE = π sin²α · L du, so what is done to L(u) without changing ∫ L du changes no light.

mod limb;
#[cfg(test)]
mod tests;

pub use limb::{FLAT, LimbLaw, limb_darkening};

use crate::medium::Medium;
use core::f64::consts::PI;
use horizon_field::Real;

/// The same in WGSL.
pub const WGSL: &str = include_str!("sun.wgsl");

/// ∫ μᵏ du over the disc: 2 / (k + 2).
const MEAN: [f64; 6] = [1.0, 2.0 / 3.0, 1.0 / 2.0, 2.0 / 5.0, 1.0 / 3.0, 2.0 / 7.0];

/// ∫ (1 − y²)^(k/2) dy over −1 … 1: what a chord of the disc gathers.
const CHORD: [f64; 6] = [2.0, PI / 2.0, 4.0 / 3.0, 3.0 * PI / 8.0, 16.0 / 15.0, 5.0 * PI / 16.0];

/// The least softening, in u: with less, f32 would show its rounding. It moves the edge by 0.2 % of the radius.
const SOFTEST: f64 = 1.0 / 256.0;

/// A star's disc, ready to draw; laid out as the shader's `SunDisc`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisc<T> {
    /// Luminance at the centre, above the air: cd/m² for an illuminance in lux, W m⁻² sr⁻¹ nm⁻¹ for W m⁻² nm⁻¹.
    pub center: [T; 3],
    /// Sine of the disc's angular radius.
    pub sine: T,
    /// Coefficients aₖ of each channel's limb law.
    pub limb: [[T; 3]; 6],
}

impl SunDisc<f64> {
    /// The disc that gives this irradiance (or illuminance) on a plane facing it. `radius` in radians, 1e-6 – 1.5.
    pub fn new(irradiance: [f64; 3], radius: f64, laws: [LimbLaw; 3]) -> Self {
        let sine = libm::sin(radius.clamp(1e-6, 1.5));
        let mean = laws.map(|law| (0..6).map(|k| law[k] * MEAN[k]).sum::<f64>());
        Self {
            center: core::array::from_fn(|c| irradiance[c] / (PI * sine * sine * mean[c])),
            sine,
            limb: core::array::from_fn(|k| laws.map(|law| law[k])),
        }
    }

    /// The star that a medium is lit by, with our sun's limb law.
    pub fn of(medium: &Medium) -> Self {
        Self::new(medium.irradiance, medium.sun_radius, medium.wavelengths.map(limb_darkening))
    }

    /// The same numbers in another precision.
    pub fn cast<T: Real>(&self) -> SunDisc<T> {
        SunDisc {
            center: self.center.map(T::of),
            sine: T::of(self.sine),
            limb: self.limb.map(|channels| channels.map(T::of)),
        }
    }
}

impl<T: Real> SunDisc<T> {
    /// Luminance in the unit view direction `view`, of a star at the unit direction `sun`, as a pixel `pixel` radians wide
    /// sees it: a mean over u, reflected at the centre, so that the whole disc gives its irradiance exactly at any pixel
    /// size. Black outside. The air's transmittance is not in it.
    pub fn luminance(&self, view: [T; 3], sun: [T; 3], pixel: T) -> [T; 3] {
        // By the chord: 1 − ν loses every digit at the centre, where the cosine ν is 1.
        let mut chord = T::ZERO;
        for k in 0..3 {
            let d = view[k] - sun[k];
            chord += d * d;
        }
        let t = pixel.max(T::ZERO) / (T::of(2.0) * self.sine);
        let width = (t * (T::of(2.0) + t)).max(T::of(SOFTEST));
        let u = chord * (T::ONE - T::of(0.25) * chord) / (self.sine * self.sine);
        if chord > T::of(2.0) || u >= T::ONE + width {
            return [T::ZERO; 3];
        }
        let (outer, inner) = (self.gathered(u + width), self.gathered(u - width));
        core::array::from_fn(|c| self.center[c] * ((outer[c] - inner[c]) / (T::of(2.0) * width)).max(T::ZERO))
    }

    /// ∫ L du from the centre to u, over the centre's luminance; odd in u.
    fn gathered(&self, u: T) -> [T; 3] {
        let rest = (T::ONE - u.abs()).max(T::ZERO);
        let mu = rest.sqrt();
        core::array::from_fn(|c| {
            let (mut total, mut outside) = (T::ZERO, T::ZERO);
            for k in (0..6).rev() {
                let a = self.limb[k][c] * T::of(MEAN[k]);
                total += a;
                outside = outside * mu + a;
            }
            let inside = total - outside * rest;
            if u < T::ZERO { -inside } else { inside }
        })
    }

    /// Which part of the star's light comes over a straight horizon, per channel, 0 … 1: the circle's segment, weighed by
    /// the limb law. `elevation` is the sine of the centre's angle above the horizon ([`above_horizon`]).
    pub fn visible(&self, elevation: T) -> [T; 3] {
        let x = (elevation / self.sine).clamp(-T::ONE, T::ONE);
        let s2 = (T::ONE - x) * (T::ONE + x);
        // Σₙ = ∫ (1 − t²)^(n/2) dt from −1 to x, by Σₙ = (x (1 − x²)^(n/2) + n Σₙ₋₂) / (n + 1).
        let mut power = [s2.sqrt(), s2];
        let mut sums = [T::of(libm::acos(-x.f64())), T::ONE + x];
        let mut strips = [T::ZERO; 6];
        for (k, strip) in strips.iter_mut().enumerate() {
            let (odd, n) = (k % 2, T::of_u32(k as u32 + 1));
            sums[odd] = (x * power[odd] + n * sums[odd]) / (n + T::ONE);
            power[odd] *= s2;
            *strip = T::of(CHORD[k]) * sums[odd];
        }
        core::array::from_fn(|c| {
            let (mut seen, mut total) = (T::ZERO, T::ZERO);
            for k in 0..6 {
                seen += self.limb[k][c] * strips[k];
                total += self.limb[k][c] * T::of(PI * MEAN[k]);
            }
            (seen / total).clamp(T::ZERO, T::ONE)
        })
    }
}

/// Sine of the sun's angle above the horizon of a sphere of radius `radius`, at altitude `h ≥ 0` in metres, where it stands
/// `mu_s` from the vertical; at least the horizon's dip for a sun above the level, even where the sum exceeds 90°.
pub fn above_horizon<T: Real>(mu_s: T, h: T, radius: T) -> T {
    let r = radius + h;
    let dip = (h * (radius + r)).max(T::ZERO).sqrt() / r;
    let sin_s = ((T::ONE - mu_s) * (T::ONE + mu_s)).max(T::ZERO).sqrt();
    let sum = mu_s * (radius / r) + sin_s * dip;
    if mu_s > T::ZERO { sum.max(mu_s).max(dip) } else { sum }
}
