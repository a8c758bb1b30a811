//! How the air thins with height, and what its layers take from light together. WGSL twin: `profile.wgsl`.

use horizon_field::Real;

#[cfg(test)]
mod tests;

/// A scalar with the exponential, which light needs throughout; by `libm`, so that values are the same on every
/// platform.
pub trait Light: Real {
    /// e to the power of the value.
    fn exp(self) -> Self;
}

impl Light for f32 {
    #[inline(always)]
    fn exp(self) -> Self {
        libm::expf(self)
    }
}

impl Light for f64 {
    #[inline(always)]
    fn exp(self) -> Self {
        libm::exp(self)
    }
}

/// Density at altitude `h` relative to the ground's, of a layer that thins by e over `scale_height`; both in metres.
#[inline]
pub fn exponential_density<T: Light>(h: T, scale_height: T) -> T {
    (-h / scale_height).exp()
}

/// Density at altitude `h` relative to the peak's, of a layer that falls to 0 linearly over `width` above and below
/// `peak`; all in metres.
#[inline]
pub fn tent_density<T: Real>(h: T, peak: T, width: T) -> T {
    (T::ONE - (h - peak).abs() / width).max(T::ZERO)
}

/// What the layers take together, at each wavelength. `layers` are their densities, or their columns in metres;
/// `rayleigh`, `mie` and `absorption` the extinction at density 1, per metre.
#[inline]
pub fn extinction<T: Real>(layers: [T; 3], rayleigh: [T; 3], mie: [T; 3], absorption: [T; 3]) -> [T; 3] {
    core::array::from_fn(|k| layers[0] * rayleigh[k] + layers[1] * mie[k] + layers[2] * absorption[k])
}
