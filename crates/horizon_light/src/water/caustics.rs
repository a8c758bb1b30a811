//! Caustics: where waves gather light on the bed.
//!
//! A ray from straight above that meets the surface at x, where it has the height η(x), is turned by k·∇η, k = 1 − 1/n, for small
//! slopes; at the depth d it is at x + d·k·∇η. So the light of a patch is spread over det(I + d·k·H) times its area, H the Hessian of
//! η: crests gather, troughs spread. The factor is 1/|det|, of the patch of surface that a point of the bed is lit from; taken from
//! the surface straight above, it is right while d·k·H is small, and there its mean is 1, for the mean of H is 0. A slanting sun is
//! near enough by the surface where its refracted ray enters, and the ray's length for the depth.
//!
//! At a focus the factor is infinite, but the sun's disc, 0.5° wide, blurs it over 0.007·d: hence a bound, with the factor of a flat
//! surface left at 1. Brighter than the bound nothing gets.

use horizon_field::Real;

/// The bound that suits a bed some waves' heights below: ten times a flat surface's light.
pub const BRIGHTEST: f64 = 10.0;

/// How much brighter the bed at a `depth` ≥ 0 in metres is than under a flat surface. `hessian` is ∂²η/∂x², ∂²η/∂x∂z and ∂²η/∂z² of
/// the surface's height, per metre; the result lies above 0 and at most a little above `bound` ≥ 1.
#[inline]
pub fn focus<T: Real>(hessian: [T; 3], depth: T, index: T, bound: T) -> T {
    let turned = depth.max(T::ZERO) * (T::ONE - T::ONE / index);
    let limit = T::of(1e15);
    let [xx, xz, zz] = hessian.map(|h| (turned * h).clamp(-limit, limit));
    let area = (T::ONE + xx) * (T::ONE + zz) - xz * xz;
    let least = T::ONE / (bound * bound);
    ((T::ONE + least) / (area * area + least)).sqrt()
}
