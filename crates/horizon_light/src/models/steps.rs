//! Where a march along a ray takes its samples. WGSL twin: `steps.wgsl`.

use horizon_field::Real;

/// Cells of a ray that are short where it is lowest, for there the air is densest: their ends are at c ± t² for evenly spaced t,
/// round the distance c of the lowest point. In t, the density's fall by e over some scale height is a Gaussian or milder, for rays
/// straight up, level ones and those that only graze, so that a midpoint rule converges fast.
#[derive(Clone, Copy, Debug)]
pub struct Steps<T> {
    lowest: T,
    first: T,
    width: T,
}

impl<T: Real> Steps<T> {
    /// `count` cells of the first `distance` metres of a ray from altitude `h`, cosine `mu`.
    #[inline]
    pub fn new(radius: T, h: T, mu: T, distance: T, count: usize) -> Self {
        let lowest = (-(radius + h) * mu).clamp(T::ZERO, distance);
        let (first, last) = (-lowest.sqrt(), (distance - lowest).sqrt());
        Self { lowest, first, width: (last - first) / T::of(count as f64) }
    }

    /// The `i`th cell's sample and length, in metres.
    #[inline]
    pub fn step(&self, i: usize) -> (T, T) {
        let t = self.first + self.width * T::of(i as f64);
        let square = |t: T| t * t.abs();
        // Not below 0 by rounding: the sample belongs to the ray.
        let at = (self.lowest + square(t + self.width * T::of(0.5))).max(T::ZERO);
        (at, square(t + self.width) - square(t))
    }
}
