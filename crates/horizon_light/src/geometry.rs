//! Rays through a shell of air round a sphere. WGSL twin: `geometry.wgsl`.
//!
//! A ray is given where it stands by the altitude `h` ≥ 0 and the cosine `mu` of the angle between the local vertical
//! and its direction; `radius` is the ground's, lengths are in metres. A difference of squared radii would lose all of
//! a small altitude in single precision: on Earth r² has a step of 4e6 m², which at 2 m is a sixth of r² − R². So
//! differences are factored, with r² − a² = (h − a_h)(2R + h + a_h) between the altitudes h and a_h.

use horizon_field::Real;

#[cfg(test)]
mod tests;

/// A quarter of the discriminant of a ray's distances to the sphere at altitude `level`: (rμ)² − (r² − a²), in m². Both
/// of its terms are large against it when the ray starts far out, so that a² − r²(1 − μ²) then takes its place.
#[inline]
pub(crate) fn shell_discriminant<T: Real>(radius: T, level: T, h: T, mu: T) -> T {
    let (r, a) = (radius + h, radius + level);
    let c = shell_excess(radius, level, h);
    if c < a * a { r * mu * (r * mu) - c } else { a * a - r * r * ((T::ONE - mu) * (T::ONE + mu)) }
}

/// r² − a² between the altitudes `h` and `level`, in m².
#[inline]
pub(crate) fn shell_excess<T: Real>(radius: T, level: T, h: T) -> T {
    (h - level) * (radius + radius + h + level)
}

/// Whether a ray meets the ground. At the ground itself level rays pass, those that point below do not.
#[inline]
pub fn hits_ground<T: Real>(radius: T, h: T, mu: T) -> bool {
    mu < T::ZERO && shell_discriminant(radius, T::ZERO, h, mu) >= T::ZERO
}

/// The distance to the ground, for a ray that [`hits_ground`]; for one that passes, to its closest approach ahead.
#[inline]
pub fn distance_to_ground<T: Real>(radius: T, h: T, mu: T) -> T {
    let ahead = (-(radius + h) * mu).max(T::ZERO);
    let root = shell_discriminant(radius, T::ZERO, h, mu).max(T::ZERO).sqrt();
    // The nearer root of d² − 2·ahead·d + excess, in the form that does not cancel.
    if ahead > T::ZERO && root > T::ZERO { shell_excess(radius, T::ZERO, h) / (ahead + root) } else { ahead }
}

/// The distance from inside the air (0 ≤ `h` ≤ `height`) to its top at altitude `height`, the ground let through.
#[inline]
pub fn distance_to_top<T: Real>(radius: T, height: T, h: T, mu: T) -> T {
    let along = (radius + h) * mu;
    let below = (-shell_excess(radius, height, h)).max(T::ZERO);
    let root = (along * along + below).sqrt();
    // The larger root of d² + 2·along·d − below; for upward rays in the form that does not cancel.
    if along > T::ZERO { below / (along + root) } else { root - along }
}

/// Between which distances a ray is in the air, from inside or outside, the ground let through; `[0, 0]` for one that
/// misses.
#[inline]
pub fn air_interval<T: Real>(radius: T, height: T, h: T, mu: T) -> [T; 2] {
    if h <= height {
        return [T::ZERO, distance_to_top(radius, height, h, mu)];
    }
    let square = shell_discriminant(radius, height, h, mu);
    if mu >= T::ZERO || square <= T::ZERO {
        return [T::ZERO; 2];
    }
    let far = square.sqrt() - (radius + h) * mu;
    [shell_excess(radius, height, h) / far, far]
}

/// How far a ray goes through the air from inside: to the ground, or to the top.
#[inline]
pub fn distance_to_end<T: Real>(radius: T, height: T, h: T, mu: T) -> T {
    if hits_ground(radius, h, mu) { distance_to_ground(radius, h, mu) } else { distance_to_top(radius, height, h, mu) }
}

/// Altitude and local cosine of the ray after `distance`.
#[inline]
pub fn advance<T: Real>(radius: T, h: T, mu: T, distance: T) -> (T, T) {
    let along = (radius + h) * mu;
    let grown = (h * (radius + radius + h) + distance * (distance + along + along)).max(T::ZERO);
    // From h'(2R + h') = grown.
    let above = grown / (radius + (radius * radius + grown).sqrt());
    (above, ((along + distance) / (radius + above)).clamp(-T::ONE, T::ONE))
}

/// The sun's local cosine after `distance`, at the altitude `above` that [`advance`] gave, from `mu_s` where the ray
/// started and the cosine `nu` between ray and sun.
#[inline]
pub fn advance_sun<T: Real>(radius: T, h: T, mu_s: T, nu: T, distance: T, above: T) -> T {
    (((radius + h) * mu_s + distance * nu) / (radius + above)).clamp(-T::ONE, T::ONE)
}

/// The cosine of the horizon's direction from altitude `h`, −√(h(2R + h))/(R + h).
#[inline]
pub fn horizon_cosine<T: Real>(radius: T, h: T) -> T {
    -horizon_distance(radius, h) / (radius + h)
}

/// The distance to the horizon from altitude `h`, √(h(2R + h)).
#[inline]
pub fn horizon_distance<T: Real>(radius: T, h: T) -> T {
    shell_excess(radius, T::ZERO, h).sqrt()
}

/// The lowest altitude that a ray comes to, if it neither starts below the ground nor is stopped by it.
#[inline]
pub fn lowest_altitude<T: Real>(radius: T, h: T, mu: T) -> T {
    if mu >= T::ZERO { h } else { advance(radius, h, mu, -(radius + h) * mu).0 }
}
