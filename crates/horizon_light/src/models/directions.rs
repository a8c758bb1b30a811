//! Directions over the sphere, for what arrives at a point of the air from all round. WGSL twin: `directions.wgsl`.

use super::air::Air;
use super::scatter::SkyRay;
use crate::geometry::{distance_to_ground, distance_to_top, horizon_cosine};
use crate::profile::Light;

/// Nodes and weights of Gauss's rule on [0, 1], in the cosine, once above and once below the horizon, where light jumps.
pub const POLAR: [[f64; 2]; 6] = [
    [0.033_765_242_898_423_99, 0.085_662_246_189_585_17],
    [0.169_395_306_766_867_74, 0.180_380_786_524_069_3],
    [0.380_690_406_958_401_55, 0.233_956_967_286_345_52],
    [0.619_309_593_041_598_5, 0.233_956_967_286_345_52],
    [0.830_604_693_233_132_3, 0.180_380_786_524_069_3],
    [0.966_234_757_101_576, 0.085_662_246_189_585_17],
];

/// Cosines of azimuths from the sun, on one side, (i + ½)·45°: exact for products of cosines up to the seventh multiple.
pub const AZIMUTHS: [f64; 4] =
    [0.923_879_532_511_286_7, 0.382_683_432_365_089_8, -0.382_683_432_365_089_8, -0.923_879_532_511_286_7];

/// How many directions there are.
pub const DIRECTIONS: usize = 2 * POLAR.len() * AZIMUTHS.len();

/// One of them, for both sides of the plane of vertical and sun.
#[derive(Clone, Copy, Debug)]
pub struct Direction<T> {
    /// The ray.
    pub view: SkyRay<T>,
    /// Its component along the sun's azimuth.
    pub sunward: T,
    /// How far it goes through the air, in metres.
    pub distance: T,
    /// Whether it ends at the ground.
    pub ground: bool,
    /// Its share of the sphere, in steradians.
    pub weight: T,
}

/// The `index`th of [`DIRECTIONS`] at altitude `h` inside the air, under a sun at `mu_s`.
pub fn direction<T: Light>(air: &Air<T>, h: T, mu_s: T, index: usize) -> Direction<T> {
    let ground = index >= DIRECTIONS / 2;
    let [node, weight] = POLAR[index / AZIMUTHS.len() % POLAR.len()];
    let horizon = horizon_cosine(air.radius, h);
    let span = if ground { -T::ONE - horizon } else { T::ONE - horizon };
    let mu = horizon + span * T::of(node);
    let distance =
        if ground { distance_to_ground(air.radius, h, mu) } else { distance_to_top(air.radius, air.height, h, mu) };
    let sunward = sine(mu) * T::of(AZIMUTHS[index % AZIMUTHS.len()]);
    let nu = (mu * mu_s + sunward * sine(mu_s)).clamp(-T::ONE, T::ONE);
    let azimuth = 2.0 * core::f64::consts::PI / AZIMUTHS.len() as f64;
    let weight = span.abs() * T::of(weight * azimuth);
    Direction { view: SkyRay { h, mu, mu_s, nu }, sunward, distance, ground, weight }
}

/// The component along the sun's azimuth of a direction with cosine `mu` to the vertical, `nu` to the sun.
#[inline]
pub fn sunward<T: Light>(mu: T, mu_s: T, nu: T) -> T {
    let most = sine(mu);
    // Under a sun at the zenith no azimuth is the sun's, and nothing that asks depends on it.
    ((nu - mu * mu_s) / sine(mu_s).max(T::of(1e-6))).clamp(-most, most)
}

/// The sine of the angle, in [0, π], with this cosine.
#[inline]
pub(crate) fn sine<T: Light>(cosine: T) -> T {
    ((T::ONE - cosine) * (T::ONE + cosine)).max(T::ZERO).sqrt()
}
