//! Rays through a round drop. A ray is told by the sine `b` of its angle of incidence, and by how often it is reflected inside, `k`:
//! once for the primary bow, twice for the secondary. Angles are in radians.

use super::index::reflectances;
use core::f64::consts::PI;

/// How far a ray is turned, unfolded: 2(i − r) + k(π − 2r).
pub fn turned(n: f64, k: u32, b: f64) -> f64 {
    let (i, r) = (libm::asin(b.min(1.0)), libm::asin((b / n).min(1.0)));
    2.0 * (i - r) + f64::from(k) * (PI - 2.0 * r)
}

/// The ray that is turned least, of those reflected `k` ≥ 1 times: cos² i = (n² − 1)/(k(k + 2)). For n in 1 … k + 1.
pub fn caustic(n: f64, k: u32) -> f64 {
    let square = (n - 1.0) * (n + 1.0) / f64::from(k * (k + 2));
    (1.0 - square).max(0.0).sqrt()
}

/// Where the bow's edge lies, from the point opposite the sun: 42° for the primary, 51° for the secondary.
pub fn bow_angle(n: f64, k: u32) -> f64 {
    from_antisolar(turned(n, k, caustic(n, k)))
}

/// The angle from the point opposite the sun, 0 to π, of a ray that is turned so far.
pub fn from_antisolar(turned: f64) -> f64 {
    let whole = 2.0 * PI;
    let folded = (turned - whole * (turned / whole).floor() - PI).abs();
    folded.min(PI)
}

/// How high above the horizon a bow's top stands, where the sun stands `elevation` above it; none, if below: no bow is seen.
pub fn top(bow: f64, elevation: f64) -> Option<f64> {
    let height = bow - elevation;
    (height > 0.0).then_some(height)
}

/// Which part of unpolarised light leaves after `k` reflections.
fn left(n: f64, k: u32, b: f64) -> f64 {
    let part = |r: f64| (1.0 - r) * (1.0 - r) * libm::pow(r, f64::from(k));
    let [across, within] = reflectances(((1.0 - b) * (1.0 + b)).max(0.0).sqrt(), n);
    0.5 * (part(across) + part(within))
}

/// Light of one ray, per steradian and of all that the drop scatters: b F/(2π sin θ |dθ/db|). Half of it is diffraction, whence the 2.
fn bright(n: f64, k: u32, b: f64, angle: f64) -> f64 {
    let (cos_i, cos_r) = (((1.0 - b) * (1.0 + b)).sqrt(), (1.0 - b * b / (n * n)).sqrt());
    let slope = (2.0 / cos_i - 2.0 * f64::from(k + 1) / (n * cos_r)).abs();
    left(n, k, b) * b / (2.0 * PI * libm::sin(angle).max(1e-3) * slope.max(1e-9))
}

/// The ray between `low` and `high`, where turning is monotone, that is turned by `target`.
fn ray(n: f64, k: u32, [mut low, mut high]: [f64; 2], target: f64) -> Option<f64> {
    let above = |b: f64| turned(n, k, b) > target;
    let (first, last) = (above(low), above(high));
    if first == last {
        return None;
    }
    for _ in 0..36 {
        let middle = 0.5 * (low + high);
        if above(middle) == first { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// By how far a place at `angle` from the antisolar point lies on the lit side of the bow of the `k`th order, 1 or 2.
pub fn lit(n: f64, k: u32, angle: f64) -> f64 {
    let off = bow_angle(n, k) - angle;
    if k == 1 { off } else { -off }
}

/// Light of rays reflected `k` = 1 or 2 times, per steradian, and how many rays there are: 0, 1 or 2. Without bound at the bow.
pub fn reflected(n: f64, k: u32, angle: f64) -> (f64, u32) {
    let least = caustic(n, k);
    let target = turned(n, k, least) + lit(n, k, angle);
    let both = [[0.0, least], [least, 1.0]].map(|ends| ray(n, k, ends, target));
    let rays = both.iter().flatten();
    (rays.clone().map(|b| bright(n, k, *b, angle)).sum(), rays.count() as u32)
}

/// Light that the drop's face reflects and that goes through without a reflection, per steradian.
pub fn plain(n: f64, angle: f64) -> f64 {
    // The face turns by π − 2i.
    let b = libm::cos(0.5 * (PI - angle)).clamp(0.0, 1.0);
    let [across, within] = reflectances(((1.0 - b) * (1.0 + b)).max(0.0).sqrt(), n);
    let face = 0.5 * (across + within) / (8.0 * PI);
    let through = ray(n, 0, [0.0, 1.0], PI - angle).map_or(0.0, |b| bright(n, 0, b.max(1e-6), angle));
    face + through
}
