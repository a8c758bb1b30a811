//! Single scattering over flat ground: the cheapest rung with air in it, no table and no sphere (seed 000 §3.5). WGSL twin:
//! `planar.wgsl`.
//!
//! Columns over flat ground are those straight up, divided by the cosine. So every sun under the horizon leaves the air dark, and level rays
//! never leave it: they are marched to [`FARTHEST`].

use super::air::{Air, Rgb};
use super::scatter::{Scattered, SkyRay, faded};
use crate::phase::rayleigh_phase;
use crate::profile::Light;

/// Where level rays end, in scale heights of the molecules: far beyond any air mass that a sphere's shell has.
pub const FARTHEST: f64 = 200.0;

/// Columns of the three layers from altitude `h` straight up to the top of the air, in metres.
fn columns_above<T: Light>(air: &Air<T>, h: T) -> [T; 3] {
    let exponential = |scale: T| scale * ((-h / scale).exp() - (-air.height / scale).exp()).max(T::ZERO);
    // The tent's integral from x on, in half widths from its peak.
    let tent = |x: T| {
        let x = x.clamp(-T::ONE, T::ONE);
        let half = T::of(0.5);
        if x < T::ZERO { T::ONE - half * (T::ONE + x) * (T::ONE + x) } else { half * (T::ONE - x) * (T::ONE - x) }
    };
    let place = |h: T| (h - air.absorption_peak) / air.absorption_width;
    let absorbers = air.absorption_width * (tent(place(h)) - tent(place(air.height))).max(T::ZERO);
    [exponential(air.rayleigh_height), exponential(air.mie_height), absorbers]
}

/// The sun's transmittance at altitude `h`, 0 under the horizon.
fn sun<T: Light>(air: &Air<T>, h: T, mu_s: T) -> Rgb<T> {
    if mu_s <= T::ZERO {
        return [T::ZERO; 3];
    }
    air.extinction(columns_above(air, h)).map(|depth| (-depth / mu_s).exp())
}

/// Light scattered once into the first `distance` metres of a ray over flat ground, by `count` samples; it ends at the ground or at the
/// top of the air.
pub fn planar<T: Light>(air: &Air<T>, view: &SkyRay<T>, distance: T, count: usize) -> Scattered<T> {
    // Above the air: from where it begins.
    let near = if view.h <= air.height {
        T::ZERO
    } else if view.mu < T::ZERO {
        (air.height - view.h) / view.mu
    } else {
        return Scattered::nothing();
    };
    let h = view.h.min(air.height);
    let room = if view.mu < T::ZERO { h } else { air.height - h };
    let farthest = air.rayleigh_height * T::of(FARTHEST);
    let whole = if view.mu.abs() * farthest > room { room / view.mu.abs() } else { farthest };
    let distance = (distance - near).min(whole);
    if distance <= T::ZERO {
        return Scattered::nothing();
    }
    let phase = rayleigh_phase(view.nu);
    let mut sum = Scattered::nothing();
    for i in 0..count {
        // Cells grow evenly, as air thins upward; the ground's end of a ray that falls is where they are short.
        let part = |i: usize| T::of((i * i) as f64 / (count * count) as f64);
        let (from, to) = if view.mu < T::ZERO {
            (T::ONE - part(count - i), T::ONE - part(count - i - 1))
        } else {
            (part(i), part(i + 1))
        };
        let length = (to - from) * distance;
        let here = (h + view.mu * distance * T::of(0.5) * (from + to)).clamp(T::ZERO, air.height);
        let densities = air.densities(here);
        let extinction = air.extinction(densities);
        let sun = sun(air, here, view.mu_s);
        for k in 0..3 {
            let depth = extinction[k] * length;
            let direct = sum.transmittance[k] * length * faded(depth) * air.irradiance[k] * sun[k];
            sum.soft[k] += direct * air.rayleigh[k] * densities[0] * phase;
            sum.mie[k] += direct * air.mie_scattering[k] * densities[1];
            sum.transmittance[k] *= (-depth).exp();
        }
    }
    sum
}
