//! Cubic interpolation between evenly spaced values.

/// The first of four neighbouring places of `n` in [0, 1], and Lagrange's weights for the cubic through them.
#[inline]
pub fn stencil(x: f64, n: usize) -> (usize, [f64; 4]) {
    let at = x.clamp(0.0, 1.0) * (n - 1) as f64;
    let first = (at.floor() as usize).saturating_sub(1).min(n - 4);
    let t = at - first as f64;
    let (a, b, c, d) = (t, t - 1.0, t - 2.0, t - 3.0);
    (first, [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0])
}
