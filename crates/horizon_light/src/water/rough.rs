//! A surface whose waves are finer than what is seen of it: Gaussian slopes about a mean plane.
//!
//! In a level frame, y up, the slopes (∂η/∂x, ∂η/∂z) are normal with the mean that the resolved waves' normal has, and with
//! variances (σx², σz²). What a viewer sees of the facets is each one's area times its cosine, where that is positive. Per unit of
//! level area that is, with m = v·n/n_y and w² = σx² v_x² + σz² v_z², the mean of max(m + w N, 0), N standard normal:
//! A(v) = m Φ(m/w) + w φ(m/w), which Smith's masking follows from, and which never vanishes where there are slopes.

use core::f64::consts::{FRAC_1_SQRT_2, PI};

use horizon_field::Real;

use super::surface::fresnel;
use crate::profile::Light;

/// The fit's coefficients: [`reflectance`].
pub(super) const FIT: [f64; 2] = [1.43, 0.105];

/// Largest error of [`reflectance`], for an index of 1.333 and variances up to [`ROUGHEST`].
pub const FIT_ERROR: f64 = 0.006;

/// The largest variance of slopes that [`reflectance`] is fitted to: the open sea has less in any storm (Cox and Munk 1954: both
/// axes together 0.003 + 0.00512 U, 0.16 at 30 m/s).
pub const ROUGHEST: f64 = 0.2;

/// The least angular radius of a sun, in radians: single precision needs some.
pub(super) const NARROWEST: f64 = 1e-6;

/// The distribution function Φ of the standard normal for x ≥ 0, and its density φ; Φ to 1e-7 (Abramowitz and Stegun 7.1.26).
#[inline]
fn normal<T: Light>(x: T) -> (T, T) {
    let x = x.min(T::of(10.0));
    let e = (-T::of(0.5) * x * x).exp();
    let t = T::ONE / (T::ONE + T::of(0.327_591_1 * FRAC_1_SQRT_2) * x);
    let tail = t
        * (T::of(0.127_414_796)
            + t * (T::of(-0.142_248_368)
                + t * (T::of(0.710_706_870_5) + t * (T::of(-0.726_576_013) + t * T::of(0.530_702_714_5)))));
    (T::ONE - tail * e, e * T::of(1.0 / libm::sqrt(2.0 * PI)))
}

/// Facets seen, per unit of the area of the plane whose heights they are: A above, from m ≥ 0 and w ≥ 0.
#[inline]
fn seen<T: Light>(m: T, w: T) -> T {
    let (below, density) = normal(m / w.max(T::of(1e-15)));
    m * below + w * density
}

/// Mean reflectance of a rough surface, 0 … 1: Fresnel's over the facets that are seen. `cosine` is that between view and mean
/// normal, 0 … 1; `variance` that of the slopes, along the view (of both axes, where they are alike).
///
/// Fresnel's own formula at an effective cosine: the mean of m² over that of m, of facets seen, lowered for the formula's bow. The fit is off
/// the integral by at most [`FIT_ERROR`], where Bruneton, Neyret and Holzschuch's (2010) is by 0.10, for it builds on Schlick's.
#[inline]
pub fn reflectance<T: Light>(cosine: T, variance: T, index: T) -> T {
    let c = cosine.clamp(T::ZERO, T::ONE);
    let variance = variance.clamp(T::of(1e-12), T::of(ROUGHEST));
    let sigma = variance.sqrt();
    let w = sigma * ((T::ONE - c) * (T::ONE + c)).sqrt();
    let (below, density) = normal(c / w.max(T::of(1e-15)));
    let facing = c + w * w * below / (c * below + w * density);
    let bow = T::of(FIT[0]) * sigma * variance / (variance + T::of(FIT[1]) * c * c);
    fresnel((facing / (T::ONE + bow)).min(T::ONE), index)
}

/// The variance of slopes that blurs a mirrored point as much as a disc of this angular radius, in radians, is wide: α²/8. A
/// surface with less than this looks flat. [`glitter`] adds the disc itself; this is for who filters by variance alone.
#[inline]
pub fn sun_variance<T: Real>(radius: T) -> T {
    T::of(0.125) * radius * radius
}

/// The sun's reflection: radiance towards the unit direction `view`, per irradiance on a plane that faces the sun, per steradian.
/// `normal` is the mean plane's, of length 1; `variance` holds σx² and σz² ≥ 0, `radius` is the sun's angular one, above 0.
///
/// F·P·G/(4 h_y⁴ A): facets that mirror sun to view, with the height-correlated masking and shadowing of Smith (Ross, Dion and
/// Potvin 2005). The sun's disc is a Gaussian as bright in its middle as a uniform disc, of the same irradiance: it blurs the slopes
/// by its image in them, so that flat water mirrors the disc, and nothing is ever brighter.
pub fn glitter<T: Light>(view: [T; 3], sun: [T; 3], normal: [T; 3], variance: [T; 2], radius: T, index: T) -> T {
    let dot = |a: [T; 3], b: [T; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let radius = radius.max(T::of(NARROWEST));
    let half: [T; 3] = core::array::from_fn(|k| view[k] + sun[k]);
    let least = T::of(1e-4);
    let level = normal[1].max(least);
    let lit = dot(sun, normal) / level;
    if half[1] < least || lit <= T::ZERO {
        return T::ZERO;
    }
    let seen_plane = (dot(view, normal) / level).max(T::ZERO);
    // Slopes of the facet that mirrors, and of the mean plane.
    let (p, q) = (-half[0] / half[1], -half[2] / half[1]);
    let (dp, dq) = (p + normal[0] / level, q + normal[2] / level);
    // How the facet's slopes follow the sun, a = (1, p, 0)/H_y and b = (0, q, 1)/H_y, less their parts along it.
    let tau = T::of(0.5) * radius * radius / (half[1] * half[1]);
    let a = [p * sun[2], -sun[2], sun[1] - p * sun[0]];
    let b = [q * sun[2] - sun[1], sun[0], -q * sun[0]];
    let (x, z) = (variance[0].max(T::ZERO), variance[1].max(T::ZERO));
    // Determinant and inverse of diag(σx², σz²) + τ a bᵀ …, as sums of what is not negative.
    let facing = sun[1] - p * sun[0] - q * sun[2];
    let determinant = x * z + tau * (x * dot(b, b) + z * dot(a, a)) + tau * tau * facing * facing;
    let across: [T; 3] = core::array::from_fn(|k| dp * b[k] - dq * a[k]);
    let exponent = (z * dp * dp + x * dq * dq + tau * dot(across, across)) / determinant;
    let steep = T::ONE + p * p + q * q;
    let density = (-T::of(0.5) * exponent).exp() * steep * steep / (T::of(2.0 * PI) * determinant.sqrt());
    let spread = |v: [T; 3]| (x * v[0] * v[0] + z * v[2] * v[2]).sqrt();
    let (seen_all, lit_all) = (seen(seen_plane, spread(view)), seen(lit, spread(sun)));
    // 1/(v·n (1 + Λ(v) + Λ(s))) with A = v·n (1 + Λ).
    let masked = lit / (seen_all * lit + seen_plane * (lit_all - lit).max(T::ZERO)).max(T::of(1e-12));
    let cosine = dot(view, half) / dot(half, half).sqrt();
    // No facet shows more than the disc's middle.
    fresnel(cosine, index) * (density * masked * T::of(0.25)).min(T::ONE / (T::of(PI) * radius * radius))
}
