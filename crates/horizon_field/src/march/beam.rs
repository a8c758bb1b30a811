//! Beams: how far all rays of a pyramid are clear of the ground, which spares each the same bounds, as beam tracing
//! and cone marching do.

use super::stretch::Stretch;
use super::surface::Surface;
use super::{Counts, GROWTH, PROGRESS};

/// A line o + s·d, not of unit speed: its parameter s is one that a beam's lines share, such as the depth.
pub(crate) type Line = ([f64; 3], [f64; 3]);

/// Bounds per beam. One that is not through by then is near the ground, where its rays part.
const MOST_BOUNDS: u32 = 64;

/// An s in `[0, far]` up to which all lines between the four corner lines are proven clear of the ground.
pub(crate) fn clear_beam(surface: &impl Surface, corners: &[Line; 4], far: f64, counts: &mut Counts) -> f64 {
    let at = |s: f64| corners.map(|(o, d)| [0, 1, 2].map(|axis| o[axis] + s * d[axis]));
    let (mut s, mut step) = (0.0, far);
    for _ in 0..MOST_BOUNDS {
        step = step.min(far - s);
        let (from, to) = (at(s), at(s + step));
        counts.bounds += 1;
        let stretch = Stretch::bound(surface, &from, &to);
        if stretch.clear >= 1.0 {
            s += step;
            step *= GROWTH;
        } else if stretch.clear >= PROGRESS {
            s += 0.999 * stretch.clear * step;
            step *= 0.5;
        } else {
            // A stretch that is shorter than wide gains nothing from being shortened.
            let width = [0, 1, 2].map(|axis| (from[3][axis] - from[0][axis]).abs()).into_iter().fold(0.0, f64::max);
            if step <= width {
                break;
            }
            step *= stretch.shrink;
        }
        if s >= far {
            break;
        }
    }
    s
}
