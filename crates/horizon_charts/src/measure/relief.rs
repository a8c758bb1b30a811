//! A grid of heights, its slopes and its hypsometry.

use super::samples::{ascending, mean, quantile};

/// Heights on a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    /// Points along x and along z; at least 3 each.
    pub size: [usize; 2],
    /// The distance of neighbours along x and along z, in metres.
    pub spacing: [f64; 2],
    /// The heights in metres, row by row, each along x.
    pub heights: Vec<f64>,
}

impl Relief {
    /// The heights that a function has on a grid, by indices along x and z.
    pub fn new(size: [usize; 2], spacing: [f64; 2], mut height: impl FnMut(usize, usize) -> f64) -> Self {
        assert!(size[0] >= 3 && size[1] >= 3, "slopes take three points");
        let heights = (0..size[1]).flat_map(|z| (0..size[0]).map(move |x| (x, z))).map(|(x, z)| height(x, z)).collect();
        Self { size, spacing, heights }
    }

    /// The height at a point of the grid.
    pub fn at(&self, x: usize, z: usize) -> f64 {
        self.heights[z * self.size[0] + x]
    }

    /// The lowest and the highest height.
    pub fn range(&self) -> [f64; 2] {
        let low = self.heights.iter().copied().fold(f64::INFINITY, f64::min);
        [low, self.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The relief, stretched and moved so that it has this range. What is level stays level, at the lower end.
    pub fn normalised(mut self, [low, high]: [f64; 2]) -> Self {
        let [from, to] = self.range();
        let scale = if to > from { (high - low) / (to - from) } else { 0.0 };
        self.heights.iter_mut().for_each(|h| *h = low + (*h - from) * scale);
        self
    }

    /// The steepness of all inner points, by central differences, in degrees and in ascending order.
    pub fn slopes(&self) -> Vec<f64> {
        let inner = (1..self.size[1] - 1).flat_map(|z| (1..self.size[0] - 1).map(move |x| (x, z)));
        ascending(inner.map(|(x, z)| {
            let along_x = (self.at(x + 1, z) - self.at(x - 1, z)) / (2.0 * self.spacing[0]);
            let along_z = (self.at(x, z + 1) - self.at(x, z - 1)) / (2.0 * self.spacing[1]);
            along_x.hypot(along_z).atan().to_degrees()
        }))
    }

    /// The hypsometric integral: the mean height as a share of the range. Old, worn ground has little.
    pub fn hypsometric_integral(&self) -> f64 {
        let [low, high] = self.range();
        (mean(&self.heights) - low) / (high - low)
    }

    /// The hypsometric curve: points (share of the area, height as a share of the range that so much of the area lies
    /// above), in `steps` even steps of the area.
    pub fn hypsometric_curve(&self, steps: usize) -> Vec<(f64, f64)> {
        let [low, high] = self.range();
        let heights = ascending(self.heights.iter().copied());
        let share = |step: usize| step as f64 / steps as f64;
        (0..=steps).map(|s| (share(s), (quantile(&heights, 1.0 - share(s)) - low) / (high - low))).collect()
    }
}

/// How often values fall into even bins: points (the bin's middle, share of the values per unit). What lies beyond the last
/// bin is left out.
pub fn histogram(values: &[f64], bins: usize, [low, high]: [f64; 2]) -> Vec<(f64, f64)> {
    let width = (high - low) / bins as f64;
    let mut counts = vec![0usize; bins];
    for value in values {
        if let Some(count) = counts.get_mut(((value - low) / width).floor().max(0.0) as usize) {
            *count += 1;
        }
    }
    let middle = |bin: usize| low + (bin as f64 + 0.5) * width;
    let share = |count: usize| count as f64 / (values.len() as f64 * width);
    counts.into_iter().enumerate().map(|(bin, count)| (middle(bin), share(count))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::samples::skewness;

    #[test]
    fn a_ramp_is_a_ramp() {
        let ramp = Relief::new([101, 7], [10.0, 5.0], |x, _| 3.0 * x as f64 + 40.0);
        assert!((ramp.hypsometric_integral() - 0.5).abs() < 1e-12 && skewness(&ramp.heights).abs() < 1e-12);
        for (area, height) in ramp.hypsometric_curve(20) {
            assert!((height - (1.0 - area)).abs() < 0.01, "{area} {height}");
        }
        let expected = 0.3_f64.atan().to_degrees();
        let slopes = ramp.slopes();
        assert_eq!(slopes.len(), 99 * 5);
        assert!(slopes.iter().all(|slope| (slope - expected).abs() < 1e-9));
        let along_z = Relief::new([5, 9], [1.0, 5.0], |_, z| -5.0 * z as f64);
        assert!(along_z.slopes().iter().all(|slope| (slope - 45.0).abs() < 1e-9));
        assert_eq!(ramp.normalised([-1.0, 1.0]).range(), [-1.0, 1.0]);
    }

    #[test]
    fn hypsometry_tells_plateaus_from_plains() {
        let squared = Relief::new([1001, 3], [1.0, 1.0], |x, _| (x as f64).powi(2));
        assert!((squared.hypsometric_integral() - 1.0 / 3.0).abs() < 1e-3);
        assert!(skewness(&squared.heights) > 0.5);
        assert!((squared.hypsometric_curve(2)[1].1 - 0.25).abs() < 1e-3);
    }

    #[test]
    fn histograms_hold_shares_per_unit() {
        assert_eq!(histogram(&[0.1, 0.4, 1.9, 3.0], 4, [0.0, 2.0])[..2], [(0.25, 1.0), (0.75, 0.0)]);
        assert_eq!(histogram(&[0.1, 0.4, 1.9, 3.0], 4, [0.0, 2.0])[3], (1.75, 0.5));
    }
}
