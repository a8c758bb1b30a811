//! Measures of lists of numbers.

/// The value below which this share of ascending values lies, linearly interpolated; NaN where there is none.
pub fn quantile(ascending: &[f64], share: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else { return f64::NAN };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (below, above) = (ascending[at.floor() as usize], ascending[at.ceil() as usize]);
    below + (above - below) * at.fract()
}

/// The median; NaN of none.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(&ascending(values), 0.5)
}

/// The mean; NaN of none.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The third standardised moment: positive where a few values lie far above the mean.
pub fn skewness(values: &[f64]) -> f64 {
    let mean = mean(values);
    let moment = |k: i32| values.iter().map(|v| (v - mean).powi(k)).sum::<f64>() / values.len() as f64;
    moment(3) / moment(2).powf(1.5)
}

/// The values in ascending order.
pub fn ascending(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The first Wasserstein distance of two samples of equal size, both ascending: how far, in the mean, one has to be moved
/// to become the other.
///
/// # Panics
/// If the sizes differ.
pub fn wasserstein(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "samples of equal size");
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
}

/// The slope of the straight line that fits best, by least squares; NaN through fewer than two places.
pub fn fitted_slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let (mut above, mut below) = (0.0, 0.0);
    for point in points {
        above += (point.0 - x) * (point.1 - y);
        below += (point.0 - x) * (point.0 - x);
    }
    above / below
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_of_known_lists() {
        let values = [1.0, 2.0, 3.0, 4.0, 10.0];
        assert_eq!((median(values), mean(&values)), (3.0, 4.0));
        assert_eq!([0.0, 0.125, 1.0].map(|share| quantile(&values, share)), [1.0, 1.5, 10.0]);
        assert!(median([]).is_nan());
        assert!(skewness(&[1.0, 2.0, 3.0]).abs() < 1e-12);
        // Two of three at 0, one at 1: mean 1/3, variance 2/9, third moment 2/27.
        assert!((skewness(&[0.0, 0.0, 1.0]) - 0.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(wasserstein(&[0.0, 1.0, 5.0], &[1.0, 1.0, 3.0]), 1.0);
        assert!((fitted_slope(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]) - 2.0).abs() < 1e-12);
    }
}
