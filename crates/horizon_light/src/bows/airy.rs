//! Airy's function Ai, to some 1e-11: its series near 0, its asymptotic expansions beyond.

/// Beyond, on both sides, the expansions hold.
const NEAR: f64 = 6.0;

/// Ai(x).
pub fn airy(x: f64) -> f64 {
    if x.abs() <= NEAR { series(x) } else { far(x) }
}

/// Ai(0) f − (−Ai'(0)) g, by the recurrence of their terms (Abramowitz and Stegun, 10.4.2).
fn series(x: f64) -> f64 {
    let cube = x * x * x;
    let (mut f, mut g, mut a, mut b) = (0.0, 0.0, 1.0, x);
    for k in 0..60 {
        f += a;
        g += b;
        let n = 3.0 * f64::from(k);
        a *= cube / ((n + 2.0) * (n + 3.0));
        b *= cube / ((n + 3.0) * (n + 4.0));
    }
    0.355_028_053_887_817_2 * f - 0.258_819_403_792_806_8 * g
}

/// Abramowitz and Stegun, 10.4.59 and 10.4.60.
fn far(x: f64) -> f64 {
    let z = x.abs();
    let zeta = 2.0 / 3.0 * z * z.sqrt();
    let fourth = z.sqrt().sqrt();
    // u_k/ζᵏ: summed by parity for the oscillating side, in turn for the other.
    let (mut even, mut odd, mut all, mut term) = (0.0, 0.0, 0.0, 1.0);
    for k in 0..12_i32 {
        let turn = if k / 2 % 2 == 0 { 1.0 } else { -1.0 };
        if k % 2 == 0 {
            even += turn * term
        } else {
            odd += turn * term
        }
        all += if k % 2 == 0 { term } else { -term };
        let n = f64::from(k + 1);
        term *= (6.0 * n - 5.0) * (6.0 * n - 3.0) * (6.0 * n - 1.0) / (216.0 * n * (2.0 * n - 1.0)) / zeta;
    }
    let root = core::f64::consts::PI.sqrt();
    if x > 0.0 {
        return libm::exp(-zeta) / (2.0 * root * fourth) * all;
    }
    let angle = zeta + core::f64::consts::FRAC_PI_4;
    (libm::sin(angle) * even - libm::cos(angle) * odd) / (root * fourth)
}
