//! A part of a stamp: a rounded box in plan, with a plane of heights; its value and gradient at a point. `stamp.wgsl` is
//! the twin.

use crate::real::{Jet, Real};

/// A part, in metres from some place. In its own axes the box spans `centre ± extent`, and all that is nearer than
/// `radius`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part<T> {
    pub centre: [T; 2],
    /// The box' first axis: cosine and sine of its angle.
    pub axis: [T; 2],
    pub extent: [T; 2],
    pub radius: T,
    pub per_falloff: T,
    /// At the centre: the height that the ground is levelled to, or by how much it is raised.
    pub height: T,
    /// How much of the part shows on a grid, from 0 to 1.
    pub presence: T,
    /// The height's gradient.
    pub slope: [T; 2],
    /// 1 where the part levels, 0 where it raises.
    pub levels: T,
    /// Whether it is its stamp's last part.
    pub last: bool,
}

/// 6u⁵ − 15u⁴ + 10u³.
pub(super) fn smooth<T: Real>(u: T) -> T {
    u * u * u * (T::of(10.0) + u * (T::of(6.0) * u - T::of(15.0)))
}

impl<T: Real> Part<T> {
    /// A point's offset from the centre in the box' axes, and how far it is outside of the box' core along each.
    pub(super) fn beyond(&self, q: [T; 2]) -> ([T; 2], [T; 2]) {
        let (x, z) = (q[0] - self.centre[0], q[1] - self.centre[1]);
        let along = [x * self.axis[0] + z * self.axis[1], z * self.axis[0] - x * self.axis[1]];
        (along, [along[0].abs() - self.extent[0], along[1].abs() - self.extent[1]])
    }

    /// Whether a point lies within the part, where it is whole.
    pub(super) fn holds(&self, q: [T; 2]) -> bool {
        let over = self.beyond(q).1.map(|x| x.max(T::ZERO));
        over[0] * over[0] + over[1] * over[1] <= self.radius * self.radius
    }

    /// How whole the part is at a point, with the gradient.
    pub(super) fn weight(&self, q: [T; 2]) -> Jet<T, 2> {
        let (along, beyond) = self.beyond(q);
        let over = [beyond[0].max(T::ZERO), beyond[1].max(T::ZERO)];
        let length = (over[0] * over[0] + over[1] * over[1]).sqrt();
        let out = (length - self.radius).max(T::ZERO);
        let u = T::ONE - out * self.per_falloff;
        if u <= T::ZERO {
            return Jet::constant(T::ZERO);
        }
        let left = u * (T::ONE - u);
        let slope = -T::of(30.0) * left * left * self.per_falloff * self.presence / length.max(T::of(1e-30));
        let g = [0, 1].map(|k| if along[k] < T::ZERO { -(slope * over[k]) } else { slope * over[k] });
        Jet {
            v: self.presence * smooth(u),
            g: [g[0] * self.axis[0] - g[1] * self.axis[1], g[0] * self.axis[1] + g[1] * self.axis[0]],
        }
    }

    /// The height at a point.
    pub(super) fn plane(&self, q: [T; 2]) -> Jet<T, 2> {
        let (x, z) = (q[0] - self.centre[0], q[1] - self.centre[1]);
        Jet { v: self.height + (self.slope[0] * x + self.slope[1] * z), g: self.slope }
    }
}

/// The ground with parts on it, in their order.
pub(super) fn stamped<T: Real>(parts: impl Iterator<Item = Part<T>>, q: [T; 2], mut ground: Jet<T, 2>) -> Jet<T, 2> {
    let nothing = Jet::constant(T::ZERO);
    // Of the parts of one stamp: the largest weight, the sum of weights, and of weights times how far the ground is moved.
    let (mut whole, mut weights, mut moves) = (nothing, nothing, nothing);
    for part in parts {
        let w = part.weight(q);
        if w.v > T::ZERO {
            let plane = part.plane(q);
            let by =
                Jet { v: plane.v - part.levels * ground.v, g: [0, 1].map(|k| plane.g[k] - part.levels * ground.g[k]) };
            if w.v > whole.v {
                whole = w;
            }
            weights = Jet { v: weights.v + w.v, g: [0, 1].map(|k| weights.g[k] + w.g[k]) };
            moves = Jet { v: moves.v + w.v * by.v, g: [0, 1].map(|k| moves.g[k] + (w.g[k] * by.v + w.v * by.g[k])) };
        }
        if part.last && weights.v > T::ZERO {
            let mean = moves.v / weights.v;
            let share = whole.v / weights.v;
            ground = Jet {
                v: ground.v + whole.v * mean,
                g: [0, 1].map(|k| ground.g[k] + (whole.g[k] * mean + share * (moves.g[k] - mean * weights.g[k]))),
            };
            (whole, weights, moves) = (nothing, nothing, nothing);
        }
    }
    ground
}
