//! Rays, and the clearance of a ray above a surface.

use super::surface::Surface;
use crate::real::Jet;

/// Why a ray can't be cast.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RayError {
    /// The origin has an infinite or NaN coordinate.
    #[error("the ray's origin {0:?} is not finite")]
    Origin([f64; 3]),
    /// The direction has an infinite or NaN coordinate, or is zero.
    #[error("the ray's direction {0:?} is not finite, or zero")]
    Direction([f64; 3]),
}

/// A ray, in metres: x and z in the plane as the surface counts them, y is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    origin: [f64; 3],
    direction: [f64; 3],
}

impl Ray {
    /// The ray from `origin` along `direction`, which need not be of unit length.
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Result<Self, RayError> {
        if origin.iter().any(|x| !x.is_finite()) {
            return Err(RayError::Origin(origin));
        }
        // Scaled by the largest coordinate first, so that no square overflows or vanishes.
        let largest = direction.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        if direction.iter().any(|x| !x.is_finite()) || largest == 0.0 {
            return Err(RayError::Direction(direction));
        }
        let scaled = direction.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        Ok(Self { origin, direction: scaled.map(|x| x / length) })
    }

    /// Where the ray starts.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// Where the ray goes, of unit length.
    pub fn direction(&self) -> [f64; 3] {
        self.direction
    }

    /// The point at distance `t`, in metres.
    pub fn at(&self, t: f64) -> [f64; 3] {
        core::array::from_fn(|axis| self.origin[axis] + t * self.direction[axis])
    }

    /// The ray upside down.
    pub(super) fn mirrored(&self) -> Self {
        let upside_down = |[x, y, z]: [f64; 3]| [x, -y, z];
        Self { origin: upside_down(self.origin), direction: upside_down(self.direction) }
    }

    /// The interval of t in `[0, t_max]` on which the ray is not above `high`; `None` if there is none.
    pub(super) fn below(&self, high: f64, t_max: f64) -> Option<[f64; 2]> {
        // A hair more than the range, so that the rounding of the two quotients cuts nothing off.
        let room = high - self.origin[1] + 1e-12 * (high.abs() + self.origin[1].abs());
        let fall = self.direction[1];
        let crossing = if fall == 0.0 { f64::INFINITY } else { room / fall };
        match (room < 0.0, fall < 0.0) {
            (true, true) => (crossing <= t_max).then_some([crossing, t_max]),
            (true, false) => None,
            (false, true) => Some([0.0, t_max]),
            (false, false) => Some([0.0, crossing.min(t_max)]),
        }
    }

    /// The interval of f', given those of the ground's slope along x and z.
    pub(super) fn slope(&self, ground: [[f64; 2]; 2]) -> [f64; 2] {
        let [dx, dy, dz] = self.direction;
        // The upper bound of the ground's slope gives the lower one of f', where d > 0.
        let along = |d: f64, [low, high]: [f64; 2]| if d > 0.0 { [d * low, d * high] } else { [d * high, d * low] };
        let (x, z) = (along(dx, ground[0]), along(dz, ground[1]));
        [dy - x[1] - z[1], dy - x[0] - z[0]]
    }

    /// How far the ray is above the ground at `t`, f(t) = y(t) − h(x(t), z(t)), with f'(t) and the ground's jet.
    pub(super) fn clearance(&self, surface: &impl Surface, t: f64) -> Clearance {
        let [x, y, z] = self.at(t);
        let ground = surface.jet([x, z]);
        let [dx, dy, dz] = self.direction;
        Clearance { f: y - ground.v, slope: dy - ground.g[0] * dx - ground.g[1] * dz, ground }
    }
}

/// The height of a ray above the ground at one t.
#[derive(Clone, Copy)]
pub(super) struct Clearance {
    /// f, in metres.
    pub f: f64,
    /// df/dt.
    pub slope: f64,
    /// The ground below.
    pub ground: Jet<f64, 2>,
}
