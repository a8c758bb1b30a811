//! Segment tracing, with a bound that leaves octaves out.

use super::ground::Ground;
use super::path::crossing;
use super::stretch::{Bounded, MOST_BOUNDS, Stretch, shortest};

/// How much longer the next stretch is tried after one that was clear.
const GROWTH: f64 = 2.0;

/// The least share of a stretch that is worth stepping over, when not all of it is clear.
const PROGRESS: f64 = 0.25;

/// Steps over what bounds prove clear. An octave that turns within a stretch counts by its amplitude alone and isn't
/// evaluated, so that long stretches high above the ground cost few octaves. What can't be proven is shortened; a stretch
/// as short as `pixel` per metre of distance is decided by the height at its end.
pub(super) fn march<G: Ground>(mut ray: Bounded<'_, G>, pixel: f64) -> Option<f64> {
    let [mut t, end] = ray.span()?;
    if ray.clearance(t) <= 0.0 {
        return Some(t);
    }
    let most = ray.work.bounds + MOST_BOUNDS;
    let mut step = end - t;
    while t < end {
        if ray.work.bounds >= most {
            return Some(t);
        }
        ray.work.steps += 1;
        let shortest = shortest(pixel, t);
        step = step.max(shortest).min(end - t);
        let (clear, shrink) = proven(&ray.stretch([t, t + step]));
        if clear >= 1.0 {
            t += step;
            step *= GROWTH;
        } else if step <= shortest {
            let below = ray.clearance(t + step);
            if below <= 0.0 {
                // A ray that grazed the ground before may be under it already.
                let above = ray.clearance(t);
                return Some(if above > 0.0 { crossing([t, t + step], [above, below]) } else { t });
            }
            t += step;
            step *= GROWTH;
        } else if clear >= PROGRESS {
            t += 0.999 * clear * step;
            step *= 0.5;
        } else {
            step *= shrink;
        }
    }
    None
}

/// The share of a stretch, from its start, that is clear of the ground, and by how much to shorten it if it is little.
fn proven(Stretch { ends, middle, bound }: &Stretch) -> (f64, f64) {
    let pad = |y: f64| 8.0 * f64::EPSILON * (y.abs() + bound.v.abs());
    // Above the linear model of the ground, whose rest is still to be taken off.
    let rise = ends.map(|[x, y, z]| y - bound.v - bound.g[0] * (x - middle[0]) - bound.g[1] * (z - middle[1]) - pad(y));
    let model = positive(rise.map(|rise| rise - bound.rest));
    let interval = positive(ends.map(|[_, y, _]| y - bound.high - pad(y)));
    // The rest falls with the square of the length where curvature rules it.
    let shrink = (rise[0] / bound.rest).clamp(0.0, 0.25).sqrt().max(0.125);
    (model.max(interval), shrink)
}

/// The share, from the start, on which a linear function with these values at the ends is positive.
fn positive([start, end]: [f64; 2]) -> f64 {
    if start > 0.0 && end > 0.0 {
        1.0
    } else if start > 0.0 {
        start / (start - end)
    } else {
        0.0
    }
}
