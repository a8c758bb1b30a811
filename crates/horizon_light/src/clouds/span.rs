//! Where a ray is in a layer. WGSL twin in `march.wgsl`.
//!
//! A ray is given by its altitude `h` and the cosine `mu` between the local vertical and its direction, as in
//! [`geometry`](crate::geometry); a `radius` of 0 stands for a plane. Differences of altitudes are taken before anything is divided or
//! squared, so that a camera near a face, or on it, keeps its digits.

use crate::geometry::{shell_discriminant, shell_excess};
use horizon_field::Real;

/// As far as a ray goes in a plane layer that it never leaves, in metres.
pub const FARTHEST: f64 = 1e6;

/// From where to where, in metres along the ray; nothing, if the end is not beyond the start.
pub type Span<T> = [T; 2];

/// Where a ray is between the altitudes `base` < `top`, nearest first. Round a planet a ray can leave the layer downward and meet
/// it once more; the ground is let through. In a plane the second span is empty.
pub fn spans<T: Real>(radius: T, base: T, top: T, h: T, mu: T) -> [Span<T>; 2] {
    let none = [T::ZERO; 2];
    if radius <= T::ZERO {
        return [plane(base - h, top - h, mu), none];
    }
    let [start, end] = ahead(radius, top, h, mu);
    if end <= start {
        return [none; 2];
    }
    let [leaves, enters] = ahead(radius, base, h, mu);
    if enters <= leaves {
        return [[start, end], none];
    }
    let first = [start, leaves.max(start)];
    if first[1] <= first[0] { [[enters, end], none] } else { [first, [enters, end]] }
}

/// In a plane, from the ways up to both faces.
fn plane<T: Real>(base: T, top: T, mu: T) -> Span<T> {
    if mu == T::ZERO {
        return if base <= T::ZERO && top >= T::ZERO { [T::ZERO, T::of(FARTHEST)] } else { [T::ZERO; 2] };
    }
    let (a, b) = (base / mu, top / mu);
    let far = a.max(b).min(T::of(FARTHEST));
    let near = a.min(b).max(T::ZERO);
    if far > near { [near, far] } else { [T::ZERO; 2] }
}

/// Where a ray is below the altitude `level`, from its start on.
fn ahead<T: Real>(radius: T, level: T, h: T, mu: T) -> Span<T> {
    let along = (radius + h) * mu;
    let excess = shell_excess(radius, level, h);
    if excess <= T::ZERO {
        // From inside: the far root, in the form that does not cancel.
        let root = (along * along - excess).max(T::ZERO).sqrt();
        let far = if along > T::ZERO { -excess / (along + root) } else { root - along };
        return [T::ZERO, far];
    }
    let square = shell_discriminant(radius, level, h, mu);
    if along >= T::ZERO || square <= T::ZERO {
        return [T::ZERO; 2];
    }
    let far = square.sqrt() - along;
    [excess / far, far]
}
