//! The bows of drops. Rays alone are without bound at a bow's edge and end there; waves are not. Airy's theory puts his function in the
//! place of both rays' interference: Ai² of −ζ, ζ = (x²/h)^{1/3} δ, for a drop of the size x = 2πa/λ, δ beyond the edge on the lit side;
//! h is half the second derivative of the turning by the sine of incidence. Farther in, where ζ is large, Ai² averages to 1/(2π√ζ),
//! which is the rays' light: so that light is multiplied by 2π√ζ Ai²(−ζ).
//!
//! On the dark side, Alexander's band, what is left are Ai's decay and what the drops' faces reflect.

use super::airy::airy;
use super::drop::{bow_angle, caustic, lit, plain, reflected};
use super::index::water;
use super::table::{AngleTable, table};
use crate::spectrum::Star;
use core::f64::consts::PI;

/// Radii of drops that the theory is good for, in metres: from a mist's, which make a white bow, to a cloudburst's. Larger ones are not
/// round.
pub const RADII: [f64; 2] = [1e-5, 1e-3];

/// Half the second derivative of the turning at the caustic: (p² − 1)²/p² · √(p² − n²)/(n² − 1)^{3/2}, p = k + 1 (van de Hulst 1957,
/// section 13.23).
pub fn curvature(n: f64, k: u32) -> f64 {
    let p = f64::from(k + 1);
    let square = (n - 1.0) * (n + 1.0);
    let last = p * p - 1.0;
    last * last / (p * p) * ((p - n) * (p + n)).max(0.0).sqrt() / (square * square.sqrt())
}

/// Light of one order per steradian, at an angle from the antisolar point, of drops of a radius in metres at a wavelength in nanometres.
pub fn order(k: u32, radius: f64, nm: f64, angle: f64) -> f64 {
    let n = water(nm);
    let size = 2.0 * PI * radius.clamp(RADII[0], RADII[1]) / (nm * 1e-9);
    let h = curvature(n, k);
    let scale = libm::cbrt(size * size / h);
    // Within this of the edge rays are as they are at it: nothing is to be divided by 0.
    let least = 0.02 / scale;
    let off = lit(n, k, angle);
    let inside = off.max(least);
    let edge = bow_angle(n, k);
    let at = if k == 1 { edge - inside } else { edge + inside };
    let (rays, count) = reflected(n, k, if off > least { angle } else { at });
    let zeta = scale * inside;
    if off <= least {
        let wave = airy(-scale * off);
        return rays * 2.0 * PI * zeta.sqrt() * wave * wave;
    }
    if count < 2 {
        return rays;
    }
    let wave = airy(-zeta);
    rays * 2.0 * PI * zeta.sqrt() * wave * wave
}

/// How much light drops scatter, per steradian and of all that they scatter, at an angle from the antisolar point: both bows, what their
/// faces reflect and what goes straight through. Diffraction, which is half of all and goes ahead, is not in it, nor are orders beyond
/// the second.
pub fn phase(radius: f64, nm: f64, angle: f64) -> f64 {
    order(1, radius, nm, angle) + order(2, radius, nm, angle) + plain(water(nm), angle)
}

/// The phase function of rain in colour, over the angle from the antisolar point: from 0 to `end` in `count` ≥ 2 values, for drops of a
/// radius in metres under a sun of an angular radius.
pub fn rainbow(star: &Star, radius: f64, sun_radius: f64, end: f64, count: usize) -> AngleTable {
    let count = count.max(2);
    let step = end / (count - 1) as f64;
    table(star, sun_radius, 0.0, step, count, |nm| (0..count).map(|i| phase(radius, nm, step * i as f64)).collect())
}

/// Where one order's bow lies by rays, from the antisolar point, at a wavelength in nanometres.
pub fn ray_angle(k: u32, nm: f64) -> f64 {
    bow_angle(water(nm), k)
}

/// The sine of incidence of the ray that makes the bow.
pub fn ray_sine(k: u32, nm: f64) -> f64 {
    caustic(water(nm), k)
}
