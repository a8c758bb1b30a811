//! The truth that models answer to, in double precision on the CPU: nothing here is fast, everything says how exact it
//! is.

use crate::geometry::{advance, advance_sun, air_interval};
use crate::medium::Medium;

pub mod cloud;
pub mod first_leg;
pub mod harmonics;
pub mod monte_carlo;
pub mod orders;
pub mod picture;
pub mod quadrature;
pub mod random;
pub mod single;
pub mod stencil;
pub mod transmittance;

/// A view ray under a sun: where it starts, and the three cosines that the sky depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Altitude of the start, in metres, at least 0; above the air too.
    pub h: f64,
    /// Cosine between the local vertical and the ray.
    pub mu: f64,
    /// Cosine between the local vertical and the sun.
    pub mu_s: f64,
    /// Cosine between the ray and the sun.
    pub nu: f64,
}

impl Ray {
    /// From angles in radians: the view's zenith angle, the sun's, and the azimuth between them.
    pub fn of_angles(h: f64, zenith: f64, sun_zenith: f64, azimuth: f64) -> Self {
        let nu = zenith.cos() * sun_zenith.cos() + zenith.sin() * sun_zenith.sin() * azimuth.cos();
        Self { h, mu: zenith.cos(), mu_s: sun_zenith.cos(), nu: nu.clamp(-1.0, 1.0) }
    }

    /// The same ray, seen from `distance` metres along it.
    pub fn advanced(&self, medium: &Medium, distance: f64) -> Self {
        let (h, mu) = advance(medium.radius, self.h, self.mu, distance);
        let mu_s = advance_sun(medium.radius, self.h, self.mu_s, self.nu, distance, h);
        Self { h, mu, mu_s, nu: self.nu }
    }

    /// The same ray from where it enters the air: itself if it starts there, nothing if it never does.
    pub fn into_air(&self, medium: &Medium) -> Option<Self> {
        if self.h <= medium.height {
            return Some(*self);
        }
        let [near, far] = air_interval(medium.radius, medium.height, self.h, self.mu);
        (far > near).then(|| {
            let entered = self.advanced(medium, near);
            Self { h: medium.height.min(entered.h), ..entered }
        })
    }

    /// Directions of ray and sun in axes whose third is the local vertical.
    pub(crate) fn directions(&self) -> [[f64; 3]; 2] {
        let sine = ((1.0 - self.mu) * (1.0 + self.mu)).sqrt();
        let sun_sine = ((1.0 - self.mu_s) * (1.0 + self.mu_s)).sqrt();
        let x = if sine > 0.0 { (self.nu - self.mu * self.mu_s) / sine } else { sun_sine };
        let x = x.clamp(-sun_sine, sun_sine);
        [[sine, 0.0, self.mu], [x, ((sun_sine - x) * (sun_sine + x)).sqrt(), self.mu_s]]
    }
}

/// Adds to each of several numbers its own.
pub(crate) fn accumulate<const N: usize>(into: &mut [f64; N], from: impl Fn(usize) -> f64) {
    for (k, into) in into.iter_mut().enumerate() {
        *into += from(k);
    }
}
