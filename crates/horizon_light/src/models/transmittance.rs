//! The transmittance table: which part of light comes from outside to an altitude, out of a direction. WGSL twin:
//! `transmittance.wgsl`.
//!
//! Coordinates after Bruneton (2017): for the altitude h the distance to the horizon √(h(2R + h)) over its largest, for the direction the
//! distance to the top between its least, straight up, and its largest, at the horizon. So the texels crowd where transmittance
//! changes, and none looks below the horizon.

use super::air::{Air, Rgb};
use super::steps::Steps;
use super::table::{Table, coordinate};
use crate::geometry::{advance, distance_to_top, hits_ground, horizon_distance};
use crate::profile::Light;

/// Directions of the table (Bruneton 2017).
pub const DIRECTIONS: usize = 256;
/// Altitudes of the table (Bruneton 2017).
pub const ALTITUDES: usize = 64;
/// Samples of each texel.
pub const SAMPLES: usize = 40;

/// Transmittance from each altitude and direction to the top of the air.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmittance<T>(pub Table<T, 1>);

impl<T: Light> Transmittance<T> {
    /// The table of the default size.
    pub fn new(air: &Air<T>) -> Self {
        Self::sized(air, DIRECTIONS, ALTITUDES)
    }

    /// A table of `directions` × `altitudes` texels.
    pub fn sized(air: &Air<T>, directions: usize, altitudes: usize) -> Self {
        Self(Table::of(directions, altitudes, |x, y| {
            let [h, mu, distance] = texel_ray(air, coordinate(x, directions), coordinate(y, altitudes));
            [optical_depth(air, h, mu, distance, SAMPLES).map(|depth| (-depth).exp())]
        }))
    }

    /// From altitude `h` ≤ the air's height out of direction `mu`, which must not meet the ground.
    #[inline]
    pub fn to_top(&self, air: &Air<T>, h: T, mu: T) -> Rgb<T> {
        let (horizon, farthest) = (horizon_distance(air.radius, h), horizon_distance(air.radius, air.height));
        let (least, most) = (air.height - h, horizon + farthest);
        let distance = distance_to_top(air.radius, air.height, h, mu);
        self.0.at((distance - least) / (most - least), horizon / farthest)[0]
    }

    /// Of the sun's centre, 0 behind the ground.
    #[inline]
    pub fn of_sun(&self, air: &Air<T>, h: T, mu_s: T) -> Rgb<T> {
        if hits_ground(air.radius, h, mu_s) { [T::ZERO; 3] } else { self.to_top(air, h, mu_s) }
    }
}

/// Altitude, cosine and distance to the top that the table's coordinates in [0, 1] stand for.
pub fn texel_ray<T: Light>(air: &Air<T>, u: T, v: T) -> [T; 3] {
    let farthest = horizon_distance(air.radius, air.height);
    let horizon = farthest * v;
    let square = horizon * horizon;
    let h = (square / (air.radius + (air.radius * air.radius + square).sqrt())).min(air.height);
    let least = air.height - h;
    let distance = least + (horizon + farthest - least) * u;
    // From R_top² = r² + d² + 2rdμ, with R_top² − r² in factors.
    let rise = least * (air.radius + air.radius + air.height + h);
    let run = (air.radius + h) * distance;
    let mu = if run > T::ZERO { (rise - distance * distance) / (run + run) } else { T::ONE };
    [h, mu.clamp(-T::ONE, T::ONE), distance]
}

/// Optical depth of the first `distance` metres of a ray inside the air, by `samples`.
pub fn optical_depth<T: Light>(air: &Air<T>, h: T, mu: T, distance: T, samples: usize) -> Rgb<T> {
    let steps = Steps::new(air.radius, h, mu, distance, samples);
    let mut depth = [T::ZERO; 3];
    for i in 0..samples {
        let (at, length) = steps.step(i);
        let extinction = air.extinction(air.densities(advance(air.radius, h, mu, at).0));
        for k in 0..3 {
            depth[k] += extinction[k] * length;
        }
    }
    depth
}
