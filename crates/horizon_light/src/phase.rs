//! Phase functions: into which directions a scattering event sends light, per steradian, so that the integral over the
//! sphere is 1. WGSL twin: `phase.wgsl`; sampling is the reference's alone.

use horizon_field::Real;

#[cfg(test)]
mod tests;

/// Rayleigh's phase function, 3/(16π)·(1 + ν²), per steradian; `nu` is the cosine of the angle of deflection. Forward
/// and backward are alike.
#[inline]
pub fn rayleigh_phase<T: Real>(nu: T) -> T {
    T::of(3.0 / (16.0 * core::f64::consts::PI)) * (T::ONE + nu * nu)
}

/// Cornette and Shanks' phase function for aerosols of asymmetry `g`, per steradian (Applied Optics 31, 1992):
/// 3/(8π) · (1 − g²)(1 + ν²) / ((2 + g²)(1 + g² − 2gν)^{3/2}). It is Rayleigh's at g = 0.
#[inline]
pub fn mie_phase<T: Real>(g: T, nu: T) -> T {
    let two = T::of(2.0);
    // 1 + g² − 2gν as a sum of squares: it neither cancels nor turns negative when g and ν approach 1.
    let gap = T::ONE - g;
    let base = gap * gap + two * g * (T::ONE - nu);
    let k = T::of(3.0 / (8.0 * core::f64::consts::PI)) * (T::ONE - g * g) / (two + g * g);
    k * (T::ONE + nu * nu) / (base * base.sqrt())
}

/// A cosine of deflection drawn from [`mie_phase`], or from [`rayleigh_phase`] at `g` = 0; `uniform` gives numbers in
/// [0, 1).
///
/// Both are (1 + ν²) times Henyey and Greenstein's function, up to a constant. So a cosine is drawn from the latter,
/// whose integral inverts in closed form, and kept with the probability (1 + ν²)/2.
pub fn sample_phase(g: f64, mut uniform: impl FnMut() -> f64) -> f64 {
    loop {
        let x = 2.0 * uniform() - 1.0;
        // (1 + g² − ((1 − g²)/(1 + gx))²)/(2g), multiplied out so that nothing is divided by g.
        let top = 2.0 * x + g * (x * x + 3.0) + 2.0 * g * g * x + g * g * g * (x * x - 1.0);
        let bottom = 1.0 + g * x;
        let nu = (top / (2.0 * bottom * bottom)).clamp(-1.0, 1.0);
        if 2.0 * uniform() < 1.0 + nu * nu {
            return nu;
        }
    }
}
