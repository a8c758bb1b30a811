//! Foam: whitecaps and what they reflect.
//!
//! Dense fresh foam scatters some 55 % of visible light back, to all sides; as it ages it thins, so that over the whole area that a
//! whitecap covers in its life the mean is 22 % (Koepke 1984). Who draws single whitecaps fades their coverage instead.

use horizon_field::Real;

/// The share of the area that whitecaps cover under a wind at 10 m height, in m/s: 3.84e-6 U^3.41 (Monahan and O'Muircheartaigh
/// 1980), at most 1.
pub fn whitecaps(wind: f64) -> f64 {
    (3.84e-6 * libm::pow(wind.max(0.0), 3.41)).min(1.0)
}

/// Radiance of a surface that foam of this albedo covers by a share 0 … 1: the foam's of the `irradiance` on a level plane, and the bare
/// water's for the rest.
#[inline]
pub fn covered<T: Real>(water: [T; 3], irradiance: [T; 3], albedo: T, coverage: T) -> [T; 3] {
    let coverage = coverage.clamp(T::ZERO, T::ONE);
    let white = albedo * T::of(core::f64::consts::FRAC_1_PI);
    core::array::from_fn(|k| water[k] * (T::ONE - coverage) + irradiance[k] * white * coverage)
}
