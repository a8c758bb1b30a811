//! A flat surface: how much it reflects, where the rest goes, both ways.

use horizon_field::Real;

/// The square of eta times the cosine beyond the surface, eta² − 1 + c²; not above 0 where reflection is total.
#[inline]
pub(super) fn beyond_squared<T: Real>(cosine: T, eta: T) -> T {
    (eta - T::ONE) * (eta + T::ONE) + cosine * cosine
}

/// Reflectance for unpolarised light (Fresnel), 0 … 1; 1 where reflection is total. `cosine` is that between the ray and the
/// surface's normal, of either sign, on the side that light comes from.
#[inline]
pub fn fresnel<T: Real>(cosine: T, eta: T) -> T {
    let c = cosine.abs().min(T::ONE);
    let squared = beyond_squared(c, eta);
    if squared <= T::ZERO {
        return T::ONE;
    }
    let g = squared.sqrt();
    // A level ray without a surface, c = g = 0 at eta = 1, is let through.
    let least = T::of(1e-20);
    let across = (c - g) / (c + g).max(least);
    let within = (eta * eta * c - g) / (eta * eta * c + g).max(least);
    (T::of(0.5) * (across * across + within * within)).min(T::ONE)
}

/// What is left of radiance that crosses the surface: (1 − F)·eta², for a ray's cone narrows in the denser medium. 0 where
/// reflection is total. There and back it is (1 − F)², as no light is made.
#[inline]
pub fn crossing<T: Real>(cosine: T, eta: T) -> T {
    (T::ONE - fresnel(cosine, eta)) * eta * eta
}

/// Where a ray goes at a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refracted<T> {
    /// The direction beyond the surface, of length 1; the mirrored one where reflection is total.
    pub direction: [T; 3],
    /// Whether reflection is total, so that nothing gets through.
    pub total: bool,
}

/// Snell's law for a ray of unit `direction` that meets a surface with the unit `normal`, of either side.
#[inline]
pub fn refract<T: Real>(direction: [T; 3], normal: [T; 3], eta: T) -> Refracted<T> {
    let along = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2];
    let squared = beyond_squared(along.abs().min(T::ONE), eta);
    if squared <= T::ZERO {
        let twice = along + along;
        return Refracted { direction: core::array::from_fn(|k| direction[k] - twice * normal[k]), total: true };
    }
    // The part across the normal shrinks by eta; the one along it is what length 1 leaves.
    let forward = if along < T::ZERO { -squared.sqrt() } else { squared.sqrt() };
    Refracted {
        direction: core::array::from_fn(|k| (direction[k] + (forward - along) * normal[k]) / eta),
        total: false,
    }
}

/// The cosine from the normal, under water, below which reflection is total: Snell's window is what lies above. 48.6° at 1.333.
#[inline]
pub fn critical_cosine<T: Real>(index: T) -> T {
    ((index - T::ONE) * (index + T::ONE)).max(T::ZERO).sqrt() / index
}

/// Reflectance for light that comes from all of a uniform sky, 0.0664 at 1.333: a fit, to 2e-4 for indices of 1 to 1.6.
#[inline]
pub fn diffuse_reflectance<T: Real>(index: T) -> T {
    let u = index - T::ONE;
    u * (T::of(DIFFUSE[0]) + T::of(DIFFUSE[1]) * u) / (T::ONE + T::of(DIFFUSE[2]) * u)
}

/// The fit's coefficients.
pub(super) const DIFFUSE: [f64; 3] = [0.3156, 0.7267, 5.4];
