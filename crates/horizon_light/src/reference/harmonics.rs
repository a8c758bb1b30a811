//! Real spherical harmonics of fields that are mirrored about the plane of the vertical and the sun, so that only the
//! cosines of the azimuth remain: Y_lm = P_lm(μ)·cos(mφ), normalised to ∫ Y² = 1 over the sphere.

use core::f64::consts::{PI, TAU};

use crate::reference::quadrature::gauss_legendre;

/// How many harmonics there are up to `degree`.
pub fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// The place of `l`, `m` among them: by m, then by l, as [`legendre`] fills them.
pub fn index(degree: usize, l: usize, m: usize) -> usize {
    m * (degree + 1) - m * m.saturating_sub(1) / 2 + (l - m)
}

/// The factors P_lm(μ) of all harmonics, with their normalisation.
pub fn legendre(degree: usize, mu: f64, into: &mut [f64]) {
    let sine = ((1.0 - mu) * (1.0 + mu)).max(0.0).sqrt();
    let mut diagonal = (1.0 / (4.0 * PI)).sqrt();
    for m in 0..=degree {
        let start = index(degree, m, m);
        // Cosines of the azimuth have a mean square of one half.
        into[start] = diagonal * if m > 0 { core::f64::consts::SQRT_2 } else { 1.0 };
        for l in m + 1..=degree {
            let (lf, mf) = (l as f64, m as f64);
            let a = ((4.0 * lf * lf - 1.0) / (lf * lf - mf * mf)).sqrt();
            let before = lf - 1.0;
            let b = ((before * before - mf * mf) / (4.0 * before * before - 1.0)).sqrt();
            let older = if l > m + 1 { b * into[start + l - m - 2] } else { 0.0 };
            into[start + l - m] = a * (mu * into[start + l - m - 1] - older);
        }
        diagonal *= sine * ((2.0 * m as f64 + 3.0) / (2.0 * m as f64 + 2.0)).sqrt();
    }
}

/// By what a phase function scales the harmonics of each degree: its Legendre moments, 2π ∫ p P_l dν.
pub fn moments(degree: usize, phase: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut moments = vec![0.0; degree + 1];
    // Nodes gather at the forward peak, ν = 1 − 2t².
    for (x, weight) in gauss_legendre(256) {
        let t = 0.5 * (x + 1.0);
        let nu = 1.0 - 2.0 * t * t;
        let share = TAU * phase(nu) * 2.0 * t * weight;
        let (mut before, mut value) = (0.0, 1.0);
        for (l, moment) in moments.iter_mut().enumerate() {
            *moment += share * value;
            let l = l as f64;
            (before, value) = (value, ((2.0 * l + 1.0) * nu * value - l * before) / (l + 1.0));
        }
    }
    moments
}
