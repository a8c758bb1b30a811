//! What the loops share: a ray in the scalar of the march, the part of it where ground can be, and the crossing.

use crate::march::Ray;
use crate::real::Real;

/// Steps after which a plain march gives up. With seed 000's b = 0.004 some 2 000 lead over 30 km.
pub const MARCH_STEPS: u32 = 4096;

/// The most bisections of a crossing: more than an f64 has bits.
pub(super) const BISECTIONS: u32 = 64;

/// A ray, in metres, and how far it is followed.
pub(super) struct Path<T> {
    pub origin: [T; 3],
    pub direction: [T; 3],
    /// Up to here the ray is known to be clear.
    pub start: T,
    pub far: T,
    /// No ground is higher.
    pub high: T,
}

/// What became of a march.
pub(super) struct Traced<T> {
    /// Where the ray meets the ground, in metres along it.
    pub t: Option<T>,
    pub evaluations: u32,
    pub steps: u32,
}

impl<T: Real> Path<T> {
    pub(super) fn new(ray: &Ray, far: f64, high: f64) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|v| v.map(T::of));
        Self { origin, direction, start: T::ZERO, far: T::of(far), high: T::of(high) }
    }

    /// The interval of t on which the ray is not above the highest ground.
    pub(super) fn span(&self) -> Option<[T; 2]> {
        let room = self.high - self.origin[1];
        let fall = self.direction[1];
        let (mut start, mut end) = (self.start, self.far);
        if room < T::ZERO {
            if fall >= T::ZERO {
                return None;
            }
            start = start.max(room / fall);
        } else if fall > T::ZERO {
            end = end.min(room / fall);
        }
        (start < end).then_some([start, end])
    }

    /// The height of the ray above the ground at `t`, y(t) − h(x(t), z(t)).
    #[inline]
    pub(super) fn clearance(&self, height: &impl Fn([T; 2]) -> T, t: T) -> T {
        let [x, y, z] = core::array::from_fn(|k| self.origin[k] + t * self.direction[k]);
        y - height([x, z])
    }
}

/// Where the line through (low, above) and (high, below) crosses zero; `below` ≤ 0 < `above`.
///
/// That is seed 000's eq. 2.7 with its signs put right: t − λ f(t) / (f(t) − f(t − λ)), where f = y − H.
#[inline]
pub(super) fn crossing<T: Real>([low, high]: [T; 2], [above, below]: [T; 2]) -> T {
    high - (high - low) * below / (below - above)
}
