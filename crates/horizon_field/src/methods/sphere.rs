//! Sphere tracing of a height field, enhanced.

use super::path::{MARCH_STEPS, Path, Traced};
use crate::real::Real;

/// Steps of `omega` times the radius of the largest sphere that is surely empty: the height above the ground over √(1 + L²),
/// with the slope bound L. `pixel` is the radius, per metre of distance, at which the ray meets the ground.
pub(super) fn march<T: Real>(height: &impl Fn([T; 2]) -> T, path: &Path<T>, slope: T, pixel: T, omega: T) -> Traced<T> {
    let mut traced = Traced { t: None, evaluations: 0, steps: 0 };
    let Some([start, end]) = path.span() else { return traced };
    let shrink = T::ONE / (T::ONE + slope * slope).sqrt();
    let (mut t, mut last, mut last_radius) = (start, start, T::ZERO);
    let mut relax = omega;
    // The place that looks nearest on the screen, which is the answer where the steps run out.
    let (mut best, mut best_radius) = (start, T::ZERO);
    while traced.steps < MARCH_STEPS {
        traced.steps += 1;
        let radius = shrink * path.clearance(height, t);
        traced.evaluations += 1;
        if relax > T::ONE && radius.abs() + last_radius < t - last {
            // The spheres do not overlap, so that there may be ground between them. Back to the plain step, and no more
            // such risks on this ray.
            relax = T::ONE;
            t = last + last_radius;
            continue;
        }
        if radius <= pixel * t {
            traced.t = Some(t);
            return traced;
        }
        // radius / t < best_radius / best, without dividing by a distance of 0.
        if best_radius == T::ZERO || radius * best < best_radius * t {
            best = t;
            best_radius = radius;
        }
        if t + radius >= end {
            return traced;
        }
        last = t;
        last_radius = radius;
        t = (t + relax * radius).min(end);
    }
    traced.t = Some(best);
    traced
}
