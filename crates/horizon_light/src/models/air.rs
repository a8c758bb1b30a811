//! The air as the models compute with it: a [`Medium`] in the scalar at hand, with what follows from it alone. WGSL twin:
//! `air.wgsl`, whose `Medium` is [`Air::uniform`].

use crate::medium::Medium;
use crate::profile::{Light, exponential_density, extinction, tent_density};

/// A value at each of the three wavelengths.
pub type Rgb<T> = [T; 3];

/// A [`Medium`] as `f32` or `f64`, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air<T> {
    /// Rayleigh scattering at the ground, per metre.
    pub rayleigh: Rgb<T>,
    /// Over which height molecules thin by e, in metres.
    pub rayleigh_height: T,
    /// Mie scattering at the ground, per metre.
    pub mie_scattering: Rgb<T>,
    /// Over which height aerosols thin by e, in metres.
    pub mie_height: T,
    /// Mie extinction at the ground (scattering and absorption), per metre.
    pub mie_extinction: Rgb<T>,
    /// Asymmetry g of the Cornette–Shanks phase function.
    pub mie_asymmetry: T,
    /// Absorption at the layer's peak, per metre.
    pub absorption: Rgb<T>,
    /// Altitude of the absorbing layer's peak, in metres.
    pub absorption_peak: T,
    /// The ground's albedo.
    pub albedo: Rgb<T>,
    /// Half the absorbing layer's thickness, in metres.
    pub absorption_width: T,
    /// Solar irradiance at the top of the air, in W m⁻² nm⁻¹.
    pub irradiance: Rgb<T>,
    /// The ground's radius, in metres.
    pub radius: T,
    /// Thickness of the shell of air, in metres.
    pub height: T,
    /// Cosine of the sun's zenith angle, negative, beyond which tables over the sun's height end: there is night.
    pub night: T,
    /// First and second Legendre moments of the Mie phase function.
    pub mie_moments: [T; 2],
}

impl<T: Light> Air<T> {
    /// From a medium that passes [`Medium::check`].
    pub fn new(medium: &Medium) -> Self {
        let rgb = |values: [f64; 3]| values.map(T::of);
        Self {
            rayleigh: rgb(medium.rayleigh),
            rayleigh_height: T::of(medium.rayleigh_height),
            mie_scattering: rgb(medium.mie_scattering),
            mie_height: T::of(medium.mie_height),
            mie_extinction: rgb(medium.mie_extinction()),
            mie_asymmetry: T::of(medium.mie_asymmetry),
            absorption: rgb(medium.absorption),
            absorption_peak: T::of(medium.absorption_peak),
            albedo: rgb(medium.albedo),
            absorption_width: T::of(medium.absorption_width),
            irradiance: rgb(medium.irradiance),
            radius: T::of(medium.radius),
            height: T::of(medium.height),
            night: T::of(night_cosine(medium)),
            mie_moments: mie_moments(medium.mie_asymmetry).map(T::of),
        }
    }

    /// Densities at altitude `h`, in metres, of molecules, aerosols and the absorbing layer.
    #[inline]
    pub fn densities(&self, h: T) -> [T; 3] {
        [
            exponential_density(h, self.rayleigh_height),
            exponential_density(h, self.mie_height),
            tent_density(h, self.absorption_peak, self.absorption_width),
        ]
    }

    /// Extinction at these densities, per metre.
    #[inline]
    pub fn extinction(&self, densities: [T; 3]) -> Rgb<T> {
        extinction(densities, self.rayleigh, self.mie_extinction, self.absorption)
    }

    /// The shader's uniform `Medium`: seven rows of four, each a colour and a number.
    pub fn uniform(&self) -> [[T; 4]; 7] {
        let row = |c: Rgb<T>, w: T| [c[0], c[1], c[2], w];
        [
            row(self.rayleigh, self.rayleigh_height),
            row(self.mie_scattering, self.mie_height),
            row(self.mie_extinction, self.mie_asymmetry),
            row(self.absorption, self.absorption_peak),
            row(self.albedo, self.absorption_width),
            row(self.irradiance, self.radius),
            row([self.height, self.night, self.mie_moments[0]], self.mie_moments[1]),
        ]
    }
}

/// −sin of twice the horizon's dip at the top of the air. A level ray at the ground leaves the air one dip away, where the sun
/// itself sets one more dip later: beyond, no light reaches a low point that was scattered once.
fn night_cosine(medium: &Medium) -> f64 {
    let cosine = medium.radius / (medium.radius + medium.height);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let twice = if cosine > sine { 2.0 * sine * cosine } else { 1.0 };
    -twice.max(0.05)
}

/// First and second Legendre moments of Cornette and Shanks' phase function: Henyey and Greenstein's are gˡ, and the factor
/// 3/2 · (1 + ν²)/(2 + g²) mixes them by ν P₁ = (2P₂ + 1)/3 and so on.
fn mie_moments(g: f64) -> [f64; 2] {
    let square = g * g;
    let first = 0.6 * g * (4.0 + square) / (2.0 + square);
    let second = 1.5 / (2.0 + square) * (2.0 / 15.0 + square * (32.0 / 21.0 + square * 12.0 / 35.0));
    [first, second]
}
