//! Halos of prisms that point anywhere. Sides of a hexagonal crystal that are next but one make prisms of 60°, a side and an end
//! prisms of 90°: the halos of 22° and of 46°.
//!
//! A ray that leans by an angle e out of the prism's principal plane is refracted in that plane as by an index n' = √(n² − sin² e)/cos e
//! (Bravais), and is turned by Δ in all, where sin(Δ/2) = cos e sin(δ/2).

use super::index::{ice, through};
use super::table::{AngleTable, table};
use crate::spectrum::Star;
use core::f64::consts::{FRAC_PI_2, PI};

/// A prism of ice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prism {
    /// Two sides, 60° apart.
    Sides,
    /// A side and an end, 90° apart.
    End,
}

impl Prism {
    /// The angle between its faces.
    pub fn angle(self) -> f64 {
        match self {
            Self::Sides => PI / 3.0,
            Self::End => FRAC_PI_2,
        }
    }

    /// Which part of what enters one face reaches the other by itself, for a ray inside that stands at `inside` to the first face's
    /// normal, towards the second. Between two sides of a hexagon lies a third; an end is taken as wide.
    pub fn reached(self, inside: f64) -> f64 {
        if self == Self::End {
            return 1.0;
        }
        // The first side from (−½, 0) to (½, 0), light going up; the second from (1, √3/2) to (½, √3).
        let slope = libm::tan(inside);
        let project = |x: f64, y: f64| x - slope * y;
        let [a, b] = [project(1.0, 0.75_f64.sqrt()), project(0.5, 3.0_f64.sqrt())];
        (a.max(b).min(0.5) - a.min(b).max(-0.5)).max(0.0)
    }
}

/// Bravais' index for rays that lean by an angle of this sine.
pub fn leaning(n: f64, sine: f64) -> f64 {
    ((n - sine) * (n + sine) / ((1.0 - sine) * (1.0 + sine)).max(1e-12)).sqrt()
}

/// Least turning in the principal plane, δ = 2 asin(n sin(A/2)) − A; none, if no ray gets through.
pub fn least(n: f64, prism: Prism) -> Option<f64> {
    let half = 0.5 * prism.angle();
    let sine = n * libm::sin(half);
    (sine < 1.0).then(|| 2.0 * (libm::asin(sine) - half))
}

/// A ray through a prism, in its principal plane: turning, and the light that is left of what meets the first face.
pub fn pass(n: f64, prism: Prism, incidence: f64) -> Option<[f64; 2]> {
    let angle = prism.angle();
    let inside = libm::asin((libm::sin(incidence) / n).clamp(-1.0, 1.0));
    let second = angle - inside;
    let sine = n * libm::sin(second);
    if sine.abs() >= 1.0 || second >= FRAC_PI_2 {
        return None;
    }
    let out = libm::asin(sine);
    let lost = through(libm::cos(incidence), n) * through(libm::cos(second), 1.0 / n);
    Some([incidence + out - angle, lost * prism.reached(inside)])
}

/// Steps over the lean, and over incidence.
const STEPS: [usize; 2] = [160, 400];

/// Light of a halo per steradian over the angle from the sun, in `count` bins of `step`, from 0 on; all that goes through such prisms is 1.
pub fn ring(n: f64, prism: Prism, step: f64, count: usize) -> Vec<f64> {
    let mut bins = vec![0.0; count];
    for i in 0..STEPS[0] {
        // Even steps in sin e are even in solid angle.
        let sine = (i as f64 + 0.5) / STEPS[0] as f64;
        let cosine = (1.0 - sine * sine).sqrt();
        let index = leaning(n, sine);
        let mut last: Option<[f64; 2]> = None;
        for j in 0..=STEPS[1] {
            let incidence = FRAC_PI_2 * (2.0 * j as f64 / STEPS[1] as f64 - 1.0) * (1.0 - 1e-9);
            let now = pass(index, prism, incidence).map(|[turning, light]| {
                let whole = 2.0 * libm::asin((cosine * libm::sin(0.5 * turning)).clamp(-1.0, 1.0));
                [whole, light * cosine * libm::cos(incidence)]
            });
            if let (Some(a), Some(b)) = (last, now) {
                spread(&mut bins, step, [a[0], b[0]], 0.5 * (a[1] + b[1]));
            }
            last = now;
        }
    }
    let total: f64 = bins.iter().sum();
    bins.iter().enumerate().map(|(i, bin)| bin / total / solid(i, step)).collect()
}

/// The solid angle of a ring of bin `i`.
fn solid(i: usize, step: f64) -> f64 {
    let (a, b) = (step * i as f64, step * (i + 1) as f64);
    // cos a − cos b, without cancelling.
    4.0 * PI * libm::sin(0.5 * (a + b)) * libm::sin(0.5 * (b - a))
}

/// Adds light evenly between two angles.
pub(super) fn spread(bins: &mut [f64], step: f64, [a, b]: [f64; 2], light: f64) {
    let (low, high) = (a.min(b).max(0.0) / step, a.max(b).max(0.0) / step);
    if light.is_nan() || light <= 0.0 {
        return;
    }
    let width = (high - low).max(1e-9);
    for (i, bin) in bins.iter_mut().enumerate().skip(low as usize).take(high as usize - low as usize + 1) {
        let part = (high.min((i + 1) as f64) - low.max(i as f64)).max(0.0);
        *bin += if high - low < 1e-9 { light } else { light * part / width };
    }
}

/// A halo in colour over the angle from the sun, from 0 to `end` in `count` ≥ 2 values: the phase function of what goes through
/// such prisms. How much of a cloud's light that is, its crystals' shapes say.
pub fn halo(star: &Star, prism: Prism, sun_radius: f64, end: f64, count: usize) -> AngleTable {
    let count = count.max(2);
    let step = end / count as f64;
    // Bins' middles are where values stand; all light is counted, also what is beyond the end.
    let all = (PI / step).ceil() as usize;
    table(star, sun_radius, 0.5 * step, step, count, |nm| {
        let mut bins = ring(ice(nm), prism, step, all);
        bins.truncate(count);
        bins
    })
}
