//! What one bound proves about a stretch of a ray, or of a beam of rays.

use super::surface::Surface;

/// A stretch of `N` lines, and what a bound over the box of its ends proves.
pub(super) struct Stretch {
    /// The share of the stretch, from its start, that is proven clear of the ground; 1 for all of it.
    pub clear: f64,
    /// By how much the stretch should be shortened to be proven clear at its start, at a guess.
    pub shrink: f64,
    /// The intervals of the ground's slope along x and z.
    pub slope: [[f64; 2]; 2],
}

impl Stretch {
    /// Bounds the lines from `from[i]` to `to[i]`, all parametrised alike. What is proven of them is proven of all lines
    /// between them too: the lower bound of f is linear over their hull.
    pub fn bound<const N: usize>(surface: &impl Surface, from: &[[f64; 3]; N], to: &[[f64; 3]; N]) -> Self {
        let extent = |axis: usize| {
            let ends = from.iter().chain(to).map(|p| p[axis]);
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let ends = [extent(0), extent(2)];
        let middle = ends.map(|[low, high]| 0.5 * (low + high));
        // The box holds the ends however they and the middle were rounded.
        let half = ends.map(|[low, high]| 0.5 * (high - low) + 2.0 * f64::EPSILON * (low.abs() + high.abs()));
        let bound = surface.bound(middle, half);

        // f's least lower bound at both ends, by the Taylor model and by the interval; the better one decides.
        let pad = |y: f64| 8.0 * f64::EPSILON * (y.abs() + bound.v.abs());
        let rise = [from, to].map(|points| {
            let above = points
                .map(|[x, y, z]| y - bound.v - bound.g[0] * (x - middle[0]) - bound.g[1] * (z - middle[1]) - pad(y));
            above.into_iter().fold(f64::INFINITY, f64::min)
        });
        let height = [from, to].map(|points| {
            let above = points.map(|[_, y, _]| y - bound.high - pad(y));
            above.into_iter().fold(f64::INFINITY, f64::min)
        });
        let clear = clear_share(rise.map(|x| x - bound.rest)).max(clear_share(height));
        // The rest falls with the square of the length where curvature rules it.
        let shrink = (rise[0] / bound.rest).clamp(0.0, 0.25).sqrt().max(0.125);
        Self { clear, shrink, slope: bound.slope }
    }
}

/// The share, from the start, on which a linear function with these values at the ends is positive.
fn clear_share([start, end]: [f64; 2]) -> f64 {
    if start > 0.0 && end > 0.0 {
        1.0
    } else if start > 0.0 {
        start / (start - end)
    } else {
        0.0
    }
}
