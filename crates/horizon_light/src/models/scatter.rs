//! The march that every model shares: light scattered into a ray, once from the sun itself and, by the model's [`Multiple`], from all
//! the light that is already under way. WGSL twin: `scatter.wgsl`.

use super::air::{Air, Rgb};
use super::steps::Steps;
use super::transmittance::Transmittance;
use crate::geometry::{advance, advance_sun, air_interval, distance_to_ground, distance_to_top, hits_ground};
use crate::phase::{mie_phase, rayleigh_phase};
use crate::profile::Light;

/// Samples along a view ray through the whole air: errors of single scattering stay below half a percent on Earth.
pub const VIEW_STEPS: usize = 16;

/// A ray under a sun: altitude in metres, and the cosines vertical–ray, vertical–sun and ray–sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyRay<T> {
    /// Altitude, at least 0, in metres.
    pub h: T,
    /// Cosine between the vertical and the ray.
    pub mu: T,
    /// Cosine between the vertical and the sun.
    pub mu_s: T,
    /// Cosine between the ray and the sun.
    pub nu: T,
}

impl<T: Light> SkyRay<T> {
    /// The same ray, seen from `distance` metres along it.
    #[inline]
    pub fn advanced(&self, radius: T, distance: T) -> Self {
        let (h, mu) = advance(radius, self.h, self.mu, distance);
        Self { h, mu, mu_s: advance_sun(radius, self.h, self.mu_s, self.nu, distance, h), nu: self.nu }
    }
}

/// What a model knows of light that was scattered before.
pub trait Multiple<T: Light> {
    /// The light that the air at `at` scatters into the ray out of all diffuse light there, per metre: W m⁻³ sr⁻¹ nm⁻¹.
    fn source(&self, air: &Air<T>, densities: [T; 3], at: &SkyRay<T>) -> Rgb<T>;
    /// Diffuse irradiance of the level ground under a sun at `mu_s`, in W m⁻² nm⁻¹.
    fn ground_irradiance(&self, air: &Air<T>, mu_s: T) -> Rgb<T>;
}

/// No light but the sun's own: single scattering.
#[derive(Clone, Copy, Debug)]
pub struct Once;

impl<T: Light> Multiple<T> for Once {
    fn source(&self, _: &Air<T>, _: [T; 3], _: &SkyRay<T>) -> Rgb<T> {
        [T::ZERO; 3]
    }

    fn ground_irradiance(&self, _: &Air<T>, _: T) -> Rgb<T> {
        [T::ZERO; 3]
    }
}

/// Light that a stretch of air sends along a ray, and what it lets through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered<T> {
    /// Radiance but for `mie`, in W m⁻² sr⁻¹ nm⁻¹.
    pub soft: Rgb<T>,
    /// Radiance of sunlight that aerosols scattered once, divided by their phase function: it peaks sharply round the sun, and so is
    /// applied after any table, per pixel.
    pub mie: Rgb<T>,
    /// The part of light that comes through from behind.
    pub transmittance: Rgb<T>,
}

impl<T: Light> Scattered<T> {
    /// No air at all.
    pub const fn nothing() -> Self {
        Self { soft: [T::ZERO; 3], mie: [T::ZERO; 3], transmittance: [T::ONE; 3] }
    }

    /// Radiance in W m⁻² sr⁻¹ nm⁻¹.
    #[inline]
    pub fn radiance(&self, air: &Air<T>, nu: T) -> Rgb<T> {
        let phase = mie_phase(air.mie_asymmetry, nu);
        core::array::from_fn(|k| self.soft[k] + self.mie[k] * phase)
    }
}

/// A planet's light as one model sees it.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, T, M> {
    /// The air.
    pub air: &'a Air<T>,
    /// Its transmittance.
    pub transmittance: &'a Transmittance<T>,
    /// Light that was scattered before.
    pub multiple: &'a M,
    /// Whether the sun's own light counts; without it, `multiple` alone is the light.
    pub sunlit: bool,
}

impl<T: Light, M: Multiple<T>> Scene<'_, T, M> {
    /// Light scattered into the first `distance` metres of a ray that stays inside the air, by `count` samples. Each cell's light fades
    /// within the cell too, ∫ e^{−σx} dx = (1 − e^{−σs})/σ, so that dense air needs no shorter cells.
    pub fn gather(&self, view: &SkyRay<T>, distance: T, count: usize) -> Scattered<T> {
        let air = self.air;
        let steps = Steps::new(air.radius, view.h, view.mu, distance, count);
        let phase = rayleigh_phase(view.nu);
        let mut sum = Scattered::nothing();
        for i in 0..count {
            let (at, length) = steps.step(i);
            let here = view.advanced(air.radius, at);
            let here = SkyRay { h: here.h.min(air.height), ..here };
            let densities = air.densities(here.h);
            let extinction = air.extinction(densities);
            let source = self.multiple.source(air, densities, &here);
            let sun = if self.sunlit { self.transmittance.of_sun(air, here.h, here.mu_s) } else { [T::ZERO; 3] };
            for k in 0..3 {
                let depth = extinction[k] * length;
                let weight = sum.transmittance[k] * length * faded(depth);
                let direct = weight * air.irradiance[k] * sun[k];
                sum.soft[k] += weight * source[k] + direct * air.rayleigh[k] * densities[0] * phase;
                sum.mie[k] += direct * air.mie_scattering[k] * densities[1];
                sum.transmittance[k] *= (-depth).exp();
            }
        }
        sum
    }

    /// Aerial perspective: light scattered into the first `distance` metres of any ray, from inside or outside the air, by `count`
    /// samples. It ends at the ground.
    pub fn in_scatter(&self, view: &SkyRay<T>, distance: T, count: usize) -> Scattered<T> {
        match self.enter(view) {
            Some((view, near)) if distance > near => {
                self.gather(&view, (distance - near).min(self.end(&view).0), count)
            }
            _ => Scattered::nothing(),
        }
    }

    /// The sky, or the bare ground where it is met, out of any direction: its light is in `soft`.
    pub fn sky(&self, view: &SkyRay<T>, count: usize) -> Scattered<T> {
        let Some((view, _)) = self.enter(view) else { return Scattered::nothing() };
        let (distance, ground) = self.end(&view);
        self.gather_all(&view, distance, ground, count)
    }

    /// The march to the end of a ray inside the air, with the ground's light if it ends there.
    pub(crate) fn gather_all(&self, view: &SkyRay<T>, distance: T, ground: bool, count: usize) -> Scattered<T> {
        let mut sum = self.gather(view, distance, count);
        if ground {
            let light = self.ground(view.advanced(self.air.radius, distance).mu_s);
            for (k, light) in light.into_iter().enumerate() {
                sum.soft[k] += sum.transmittance[k] * light;
            }
        }
        sum
    }

    /// Radiance of the ground under a sun at `mu_s`, in W m⁻² sr⁻¹ nm⁻¹: Lambert's law.
    pub fn ground(&self, mu_s: T) -> Rgb<T> {
        let air = self.air;
        let diffuse = self.multiple.ground_irradiance(air, mu_s);
        let sun = if self.sunlit { self.transmittance.of_sun(air, T::ZERO, mu_s) } else { [T::ZERO; 3] };
        let lambert = T::of(core::f64::consts::FRAC_1_PI);
        core::array::from_fn(|k| {
            air.albedo[k] * lambert * (air.irradiance[k] * sun[k] * mu_s.max(T::ZERO) + diffuse[k])
        })
    }

    /// How far a ray goes inside the air, and whether it ends at the ground.
    fn end(&self, view: &SkyRay<T>) -> (T, bool) {
        let air = self.air;
        if hits_ground(air.radius, view.h, view.mu) {
            (distance_to_ground(air.radius, view.h, view.mu), true)
        } else {
            (distance_to_top(air.radius, air.height, view.h, view.mu), false)
        }
    }

    /// The ray from where it is in the air first, and how far that is; nothing if it never is.
    fn enter(&self, view: &SkyRay<T>) -> Option<(SkyRay<T>, T)> {
        let air = self.air;
        if view.h <= air.height {
            return Some((*view, T::ZERO));
        }
        let [near, far] = air_interval(air.radius, air.height, view.h, view.mu);
        (far > near).then(|| (SkyRay { h: air.height, ..view.advanced(air.radius, near) }, near))
    }
}

/// (1 − e^{−x})/x, by its series where that cancels.
#[inline]
pub(crate) fn faded<T: Light>(x: T) -> T {
    if x < T::of(1e-2) { T::ONE - x * (T::of(0.5) - x * T::of(1.0 / 6.0)) } else { (T::ONE - (-x).exp()) / x }
}
