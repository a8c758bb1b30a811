//! Where successive orders are sampled: altitudes, suns, directions, and points along rays.

use core::f64::consts::PI;

use crate::geometry::{distance_to_end, hits_ground, horizon_cosine};
use crate::medium::Medium;
use crate::reference::quadrature::gauss_legendre;
use crate::reference::stencil::stencil;

/// How finely. The time goes with the product of all but the degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Altitudes, denser towards the ground.
    pub altitudes: usize,
    /// Cosines of the sun, denser where it sets.
    pub suns: usize,
    /// Cosines of directions above the horizon, and as many below; denser at the horizon.
    pub cosines: usize,
    /// Azimuths on a half circle.
    pub azimuths: usize,
    /// Points on each smooth stretch of a ray.
    pub steps: usize,
    /// Degree of spherical harmonics that what scatters is held in; the harmonic of degree l of twice scattered light
    /// falls as g²ˡ.
    pub degree: usize,
}

impl Resolution {
    /// For truths.
    pub const FINE: Self = Self { altitudes: 28, suns: 44, cosines: 20, azimuths: 16, steps: 28, degree: 14 };
    /// For tests: an eighth of the work.
    pub const COARSE: Self = Self { altitudes: 18, suns: 28, cosines: 12, azimuths: 12, steps: 16, degree: 10 };
}

/// A resolution laid over a medium.
pub(super) struct Grid {
    pub resolution: Resolution,
    height: f64,
    radius: f64,
    /// The sun's cosine is `centre` + `spread`·sinh(y), y from `first` in steps of `step`.
    centre: f64,
    spread: f64,
    first: f64,
    step: f64,
    /// Gauss's rules on [0, 1].
    cosines: Vec<(f64, f64)>,
    steps: Vec<(f64, f64)>,
}

impl Grid {
    pub fn new(medium: &Medium, resolution: Resolution) -> Self {
        // From the top the sun sets at this cosine; a little below it the air is dark.
        let last_light = horizon_cosine(medium.radius, medium.height);
        let least = (last_light - 0.15).max(-1.0);
        let (centre, spread) = (0.4 * last_light, 0.1);
        let first = f64::asinh((least - centre) / spread);
        let last = f64::asinh((1.0 - centre) / spread);
        let on_unit = |n| gauss_legendre(n).into_iter().map(|(x, w)| (0.5 * (x + 1.0), 0.5 * w)).collect();
        Self {
            resolution,
            height: medium.height,
            radius: medium.radius,
            centre,
            spread,
            first,
            step: (last - first) / (resolution.suns - 1) as f64,
            cosines: on_unit(resolution.cosines),
            steps: on_unit(resolution.steps),
        }
    }

    pub fn altitude(&self, i: usize) -> f64 {
        let x = i as f64 / (self.resolution.altitudes - 1) as f64;
        self.height * x * x
    }

    pub fn sun(&self, j: usize) -> f64 {
        (self.centre + self.spread * (self.first + self.step * j as f64).sinh()).clamp(-1.0, 1.0)
    }

    pub fn azimuth(&self, k: usize) -> f64 {
        PI * (k as f64 + 0.5) / self.resolution.azimuths as f64
    }

    /// What each azimuth stands for, in radians, with its mirror image.
    pub fn azimuth_weight(&self) -> f64 {
        2.0 * PI / self.resolution.azimuths as f64
    }

    pub fn altitude_stencil(&self, h: f64) -> (usize, [f64; 4]) {
        stencil((h / self.height).sqrt(), self.resolution.altitudes)
    }

    pub fn sun_stencil(&self, mu_s: f64) -> (usize, [f64; 4]) {
        let y = f64::asinh((mu_s - self.centre) / self.spread);
        stencil((y - self.first) / (self.step * (self.resolution.suns - 1) as f64), self.resolution.suns)
    }

    /// Cosines of directions from altitude `h` and their weights, split at the horizon: radiance jumps there, and
    /// changes fast above it.
    pub fn directions(&self, h: f64) -> Vec<(f64, f64)> {
        let horizon = horizon_cosine(self.radius, h);
        let side =
            |reach: f64| self.cosines.iter().map(move |(t, w)| (horizon + reach * t * t, reach.abs() * 2.0 * t * w));
        side(1.0 - horizon).chain(side(-1.0 - horizon)).collect()
    }

    /// Distances along a ray from inside the air and their weights, dense towards its lowest point, where the air is.
    pub fn steps(&self, h: f64, mu: f64) -> Vec<(f64, f64)> {
        let length = distance_to_end(self.radius, self.height, h, mu);
        let stretch = |from: f64, reach: f64| {
            self.steps.iter().map(move |(t, w)| (from + reach * t * t, reach.abs() * 2.0 * t * w))
        };
        if hits_ground(self.radius, h, mu) {
            stretch(length, -length).collect()
        } else if mu < 0.0 {
            let lowest = (-(self.radius + h) * mu).min(length);
            stretch(lowest, -lowest).chain(stretch(lowest, length - lowest)).collect()
        } else {
            stretch(0.0, length).collect()
        }
    }
}
