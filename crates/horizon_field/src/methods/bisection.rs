//! Interval bisection.

use super::ground::Ground;
use super::path::crossing;
use super::stretch::{Bounded, MOST_BOUNDS, shortest};

/// Halves what the interval of heights can't prove clear, the near half first. A stretch as short as `pixel` per metre of
/// distance is decided by the height at its end.
pub(super) fn march<G: Ground>(mut ray: Bounded<'_, G>, pixel: f64) -> Option<f64> {
    let [start, end] = ray.span()?;
    if ray.clearance(start) <= 0.0 {
        return Some(start);
    }
    let most = ray.work.bounds + MOST_BOUNDS;
    let mut open = vec![[start, end]];
    while let Some([from, to]) = open.pop() {
        if ray.work.bounds >= most {
            return Some(from);
        }
        ray.work.steps += 1;
        let stretch = ray.stretch([from, to]);
        if stretch.ends[0][1].min(stretch.ends[1][1]) > stretch.bound.high {
            continue;
        }
        if to - from > shortest(pixel, from) {
            let middle = 0.5 * (from + to);
            open.extend([[middle, to], [from, middle]]);
            continue;
        }
        let below = ray.clearance(to);
        if below <= 0.0 {
            // A ray that grazed the ground before may be under it already.
            let above = ray.clearance(from);
            return Some(if above > 0.0 { crossing([from, to], [above, below]) } else { from });
        }
    }
    None
}
