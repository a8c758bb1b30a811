//! Marches that sample the ray at steps of some rule: seed 000's and seed 002's. They differ in the rule.

use super::path::{BISECTIONS, MARCH_STEPS, Path, Traced, crossing};
use crate::real::Real;

/// Seed 000's march: steps of a + b·t + c·h, with the height h above the ground, then `k` bisections.
pub(super) fn fixed<T: Real>(height: &impl Fn([T; 2]) -> T, path: &Path<T>, [a, b, c]: [T; 3], k: u32) -> Traced<T> {
    march(height, path, |t, above| a + b * t + c * above, k)
}

/// Seed 002's march: steps of `delta` times the distance, within the first metre as at its end.
pub(super) fn linear<T: Real>(height: &impl Fn([T; 2]) -> T, path: &Path<T>, delta: T) -> Traced<T> {
    march(height, path, |t, _| delta * t.max(T::ONE), 0)
}

/// Steps of `step(t, above)`, until a sample is not above the ground; then `k` bisections, and linear interpolation in
/// what they leave.
///
/// The first sample is where the ray starts. Seed 002 instead interpolates its first step with heights of 0, and a camera
/// under the ground gets a distance that means nothing. The last sample is at the far end.
fn march<T: Real>(height: &impl Fn([T; 2]) -> T, path: &Path<T>, step: impl Fn(T, T) -> T, k: u32) -> Traced<T> {
    let mut traced = Traced { t: None, evaluations: 0, steps: 0 };
    let Some([mut t, end]) = path.span() else { return traced };
    let mut above = path.clearance(height, t);
    traced.evaluations += 1;
    if above <= T::ZERO {
        traced.t = Some(t);
        return traced;
    }
    while traced.steps < MARCH_STEPS && t < end {
        traced.steps += 1;
        let next = (t + step(t, above)).min(end);
        let below = path.clearance(height, next);
        traced.evaluations += 1;
        if below <= T::ZERO {
            let (mut ends, mut sides) = ([t, next], [above, below]);
            for _ in 0..k.min(BISECTIONS) {
                let middle = T::of(0.5) * (ends[0] + ends[1]);
                let side = path.clearance(height, middle);
                traced.evaluations += 1;
                let end = usize::from(side <= T::ZERO);
                ends[end] = middle;
                sides[end] = side;
            }
            traced.t = Some(crossing(ends, sides));
            return traced;
        }
        t = next;
        above = below;
    }
    traced
}
