//! Light scattered once, by adaptive quadrature.

use crate::geometry::{distance_to_end, hits_ground};
use crate::medium::Medium;
use crate::phase::{mie_phase, rayleigh_phase};
use crate::reference::Ray;
use crate::reference::quadrature::integrate;
use crate::reference::transmittance::{kinks, transmittance, transmittance_to_top};

#[cfg(test)]
mod tests;

/// The error that scattered light is integrated to, relative to the whole.
const RELATIVE: f64 = 1e-6;

/// What one scattering brings along a ray, divided by the sun's irradiance, at each wavelength.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scattered {
    /// By molecules, without the phase function.
    pub rayleigh: [f64; 3],
    /// By aerosols, without the phase function.
    pub mie: [f64; 3],
    /// By the ground at the ray's end, per steradian.
    pub ground: [f64; 3],
}

impl Scattered {
    /// With phase functions and the sun: radiance in W m⁻² sr⁻¹ nm⁻¹.
    pub fn radiance(&self, medium: &Medium, nu: f64) -> [f64; 3] {
        let (by_molecules, by_aerosols) = (rayleigh_phase(nu), mie_phase(medium.mie_asymmetry, nu));
        core::array::from_fn(|k| {
            let scattered = self.rayleigh[k] * by_molecules + self.mie[k] * by_aerosols + self.ground[k];
            medium.irradiance[k] * scattered
        })
    }
}

/// Radiance of light that was scattered once, by air or ground, in W m⁻² sr⁻¹ nm⁻¹; the sun's disc is not in it.
pub fn radiance(medium: &Medium, ray: &Ray) -> [f64; 3] {
    scattered(medium, ray).radiance(medium, ray.nu)
}

/// What one scattering brings along the whole ray: to the ground with its light, or out into space.
pub fn scattered(medium: &Medium, ray: &Ray) -> Scattered {
    let Some(start) = ray.into_air(medium) else { return Scattered::default() };
    let length = distance_to_end(medium.radius, medium.height, start.h, start.mu);
    let mut found = scattered_within(medium, &start, length);
    if hits_ground(medium.radius, start.h, start.mu) {
        let mu_s = start.advanced(medium, length).mu_s;
        let left = transmittance(medium, start.h, start.mu, length);
        let sun = transmittance_to_top(medium, 0.0, mu_s);
        found.ground = core::array::from_fn(|k| {
            left[k] * medium.albedo[k] * core::f64::consts::FRAC_1_PI * sun[k] * mu_s.max(0.0)
        });
    }
    found
}

/// What one scattering brings along the first `distance` metres of a ray inside the air.
pub fn scattered_within(medium: &Medium, ray: &Ray, distance: f64) -> Scattered {
    let mut ends = kinks(medium, ray.h, ray.mu, distance);
    ends.extend(shadow(medium, ray).into_iter().filter(|d| (0.0..distance).contains(d)));
    ends.sort_by(f64::total_cmp);
    let both = integrate(|d| integrand(medium, ray, d), &ends, RELATIVE);
    let mut found = Scattered::default();
    for k in 0..3 {
        found.rayleigh[k] = both[k] * medium.rayleigh[k];
        found.mie[k] = both[k + 3] * medium.mie_scattering[k];
    }
    found
}

/// Density times the transmittance of the whole path by way of the point `d` metres along the ray: of molecules at each
/// wavelength, then of aerosols.
pub(crate) fn integrand(medium: &Medium, ray: &Ray, d: f64) -> [f64; 6] {
    let point = ray.advanced(medium, d);
    let sun = transmittance_to_top(medium, point.h, point.mu_s);
    if sun == [0.0; 3] {
        return [0.0; 6];
    }
    let left = transmittance(medium, ray.h, ray.mu, d);
    let [molecules, aerosols, _] = medium.densities(point.h);
    core::array::from_fn(|k| left[k % 3] * sun[k % 3] * if k < 3 { molecules } else { aerosols })
}

/// Where a ray's line crosses the cylinder of the ground's shadow: there its light begins or ends at once.
///
/// With p·s the place's component along the sun, the cylinder is |p|² − (p·s)² = R², a quadratic in the distance.
fn shadow(medium: &Medium, ray: &Ray) -> Vec<f64> {
    let r = medium.radius + ray.h;
    let a = (1.0 - ray.nu) * (1.0 + ray.nu);
    let b = r * (ray.mu - ray.mu_s * ray.nu);
    let c = ray.h * (2.0 * medium.radius + ray.h) - (r * ray.mu_s).powi(2);
    let square = b * b - a * c;
    if square <= 0.0 {
        return Vec::new();
    }
    // Both roots from the sum that does not cancel.
    let q = -(b + square.sqrt().copysign(b));
    [q / a, c / q].into_iter().filter(|d| d.is_finite()).collect()
}
