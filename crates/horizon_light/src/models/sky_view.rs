//! The sky all round a camera inside the air as a table, for one altitude and one sun. WGSL twin: `sky_view.wgsl`.
//!
//! Rows crowd quadratically at the horizon, where the sky changes fastest, and part there, for it jumps. Both coordinates are sines of half
//! angles: smooth at the zenith and towards the sun, where a cosine's own table would lose its resolution, and without an arc function.

use horizon_field::Real;

use super::air::Air;
use super::directions::{sine, sunward};
use super::scatter::{Multiple, Scattered, Scene, SkyRay};
use super::table::{Table, coordinate};
use crate::geometry::{distance_to_ground, distance_to_top, hits_ground, horizon_cosine};
use crate::profile::Light;

/// Azimuths from the sun, on one side.
pub const AZIMUTHS: usize = 48;
/// Rows from the horizon up.
pub const ABOVE: usize = 48;
/// Rows from the horizon down.
pub const BELOW: usize = 24;

/// [`Scattered::soft`] and [`Scattered::mie`], above the horizon and below it.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyView<T> {
    /// The camera's altitude, in metres.
    pub h: T,
    /// Cosine between the vertical and the sun.
    pub mu_s: T,
    /// Rays that leave the air.
    pub above: Table<T, 2>,
    /// Rays that end at the ground.
    pub below: Table<T, 2>,
}

impl<T: Light> SkyView<T> {
    /// The table from altitude `h` inside the air, `steps` samples to a ray.
    pub fn new(scene: &Scene<T, impl Multiple<T>>, h: T, mu_s: T, steps: usize) -> Self {
        Self::sized(scene, h, mu_s, steps, [AZIMUTHS, ABOVE, BELOW])
    }

    /// A table of `[azimuths, rows above, rows below]`.
    pub fn sized(scene: &Scene<T, impl Multiple<T>>, h: T, mu_s: T, steps: usize, size: [usize; 3]) -> Self {
        let [azimuths, above, below] = size;
        let half = |ground: bool, rows: usize| {
            Table::of(azimuths, rows, |x, y| {
                let view = texel_view(scene.air, h, mu_s, ground, coordinate(x, azimuths), coordinate(y, rows));
                let distance = if ground {
                    distance_to_ground(scene.air.radius, h, view.mu)
                } else {
                    distance_to_top(scene.air.radius, scene.air.height, h, view.mu)
                };
                let Scattered { soft, mie, .. } = scene.gather_all(&view, distance, ground, steps);
                [soft, mie]
            })
        };
        Self { h, mu_s, above: half(false, above), below: half(true, below) }
    }

    /// Radiance of the sky, or of the bare ground, at cosines `mu` to the vertical and `nu` to the sun. Transmittance is not kept.
    pub fn radiance(&self, air: &Air<T>, mu: T, nu: T) -> [T; 3] {
        let ground = hits_ground(air.radius, self.h, mu);
        let [u, v] = coordinates(air, &SkyRay { h: self.h, mu, mu_s: self.mu_s, nu }, ground);
        let [soft, mie] = if ground { &self.below } else { &self.above }.at(u, v);
        Scattered { soft, mie, transmittance: [T::ZERO; 3] }.radiance(air, nu)
    }
}

/// The ray of a table's coordinates.
fn texel_view<T: Light>(air: &Air<T>, h: T, mu_s: T, ground: bool, u: T, v: T) -> SkyRay<T> {
    let horizon = horizon_cosine(air.radius, h);
    // v² is what the half angle's sine lacks to its largest, w: 1 − w = v², and w² is in proportion to 1 ∓ mu.
    let gap = v * v;
    let rise = gap * (T::of(2.0) - gap);
    let mu = if ground { horizon - (T::ONE + horizon) * rise } else { horizon + (T::ONE - horizon) * rise };
    let azimuth = T::ONE - T::of(2.0) * u * u;
    let nu = (mu * mu_s + sine(mu) * sine(mu_s) * azimuth).clamp(-T::ONE, T::ONE);
    SkyRay { h, mu, mu_s, nu }
}

/// The table's coordinates of a ray.
fn coordinates<T: Light>(air: &Air<T>, view: &SkyRay<T>, ground: bool) -> [T; 2] {
    let horizon = horizon_cosine(air.radius, view.h);
    let sign = if ground { -T::ONE } else { T::ONE };
    let span = T::ONE - sign * horizon;
    // 1 − w from the difference of cosines, which does not cancel at the horizon as w itself does.
    let w = ((T::ONE - sign * view.mu) / span).max(T::ZERO).sqrt();
    let gap = sign * (view.mu - horizon) / (span * (T::ONE + w));
    let run = sine(view.mu);
    let azimuth = if run > T::ZERO { sunward(view.mu, view.mu_s, view.nu) / run } else { T::ONE };
    [half_sine(azimuth), gap.max(T::ZERO).sqrt()]
}

/// sin(φ/2) from cos φ.
fn half_sine<T: Real>(cosine: T) -> T {
    (T::of(0.5) * (T::ONE - cosine)).max(T::ZERO).sqrt()
}
