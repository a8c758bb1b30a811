//! Sums over samples.

/// The root of the mean square.
pub fn rms(samples: impl IntoIterator<Item = f64>) -> f64 {
    let (count, sum) = samples.into_iter().fold((0, 0.0), |(count, sum), x| (count + 1, sum + x * x));
    (sum / f64::from(count)).sqrt()
}

/// The largest absolute value.
pub fn largest(samples: impl IntoIterator<Item = f64>) -> f64 {
    samples.into_iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

/// The mean and the variance.
pub fn moments(samples: &[f64]) -> [f64; 2] {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    [mean, samples.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / samples.len() as f64]
}

/// Pearson's correlation: 1 for the same, 0 for what has nothing in common.
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let ([mean_a, square_a], [mean_b, square_b]) = (moments(a), moments(b));
    let product: f64 = a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).sum();
    product / a.len() as f64 / (square_a * square_b).sqrt()
}
