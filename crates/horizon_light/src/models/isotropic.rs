//! The fast model's multiple scattering, after Hillaire (2020): light that was scattered before is taken as isotropic, and as falling from
//! order to order in the ratio that a surrounding all alike would give. WGSL twin: `isotropic.wgsl`.

use super::air::{Air, Rgb};
use super::directions::{DIRECTIONS, Direction, direction};
use super::scatter::{Multiple, SkyRay, faded};
use super::steps::Steps;
use super::table::{Table, coordinate};
use super::transmittance::Transmittance;
use crate::profile::Light;

/// Texels over the sun's cosine and over altitude, each evenly (Hillaire 2020).
pub const SIZE: usize = 32;
/// Samples along each ray (Hillaire 2020).
pub const STEPS: usize = 20;

/// Mean radiance of diffuse light over the sphere, in W m⁻² sr⁻¹ nm⁻¹: over the sun's cosine, then altitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Isotropic<T>(pub Table<T, 1>);

impl<T: Light> Isotropic<T> {
    /// The table for this air.
    pub fn new(air: &Air<T>, transmittance: &Transmittance<T>) -> Self {
        Self(Table::of(SIZE, SIZE, |x, y| {
            let mu_s = T::of(2.0) * coordinate::<T>(x, SIZE) - T::ONE;
            [mean(air, transmittance, coordinate::<T>(y, SIZE) * air.height, mu_s)]
        }))
    }

    /// Marching steps that a build takes; each looks up transmittance.
    pub const fn evaluations() -> usize {
        SIZE * SIZE * DIRECTIONS * STEPS
    }

    fn at(&self, air: &Air<T>, h: T, mu_s: T) -> Rgb<T> {
        self.0.at(T::of(0.5) * mu_s + T::of(0.5), h / air.height)[0]
    }
}

impl<T: Light> Multiple<T> for Isotropic<T> {
    fn source(&self, air: &Air<T>, densities: [T; 3], at: &SkyRay<T>) -> Rgb<T> {
        let light = self.at(air, at.h, at.mu_s);
        core::array::from_fn(|k| (air.rayleigh[k] * densities[0] + air.mie_scattering[k] * densities[1]) * light[k])
    }

    /// As if light came from everywhere alike: an irradiance of π times the radiance.
    fn ground_irradiance(&self, air: &Air<T>, mu_s: T) -> Rgb<T> {
        self.at(air, T::ZERO, mu_s).map(|light| light * T::of(core::f64::consts::PI))
    }
}

/// Mean light of the first order over the sphere, with the geometric series of all orders: 1/(1 − f), f being the light that a unit of
/// isotropic light all round sends back.
fn mean<T: Light>(air: &Air<T>, transmittance: &Transmittance<T>, h: T, mu_s: T) -> Rgb<T> {
    let sphere = T::of(1.0 / (4.0 * core::f64::consts::PI));
    let (mut once, mut back) = ([T::ZERO; 3], [T::ZERO; 3]);
    for index in 0..DIRECTIONS {
        let direction = direction(air, h, mu_s, index);
        let (first, again) = both(air, transmittance, &direction);
        for k in 0..3 {
            once[k] += first[k] * direction.weight * sphere;
            back[k] += again[k] * direction.weight * sphere;
        }
    }
    core::array::from_fn(|k| once[k] / (T::ONE - back[k].min(T::of(0.99))))
}

/// Sunlight scattered once, as if evenly, and light out of a unit of isotropic light.
fn both<T: Light>(air: &Air<T>, transmittance: &Transmittance<T>, direction: &Direction<T>) -> (Rgb<T>, Rgb<T>) {
    let Direction { view, distance, ground, .. } = *direction;
    let sphere = T::of(1.0 / (4.0 * core::f64::consts::PI));
    let steps = Steps::new(air.radius, view.h, view.mu, distance, STEPS);
    let (mut first, mut again, mut through) = ([T::ZERO; 3], [T::ZERO; 3], [T::ONE; 3]);
    for i in 0..STEPS {
        let (at, length) = steps.step(i);
        let here = view.advanced(air.radius, at);
        let densities = air.densities(here.h);
        let extinction = air.extinction(densities);
        let sun = transmittance.of_sun(air, here.h.min(air.height), here.mu_s);
        for k in 0..3 {
            let depth = extinction[k] * length;
            let scattering = air.rayleigh[k] * densities[0] + air.mie_scattering[k] * densities[1];
            let light = through[k] * length * faded(depth) * scattering;
            again[k] += light;
            first[k] += light * sphere * air.irradiance[k] * sun[k];
            through[k] *= (-depth).exp();
        }
    }
    if ground {
        let mu_s = view.advanced(air.radius, distance).mu_s;
        let sun = transmittance.of_sun(air, T::ZERO, mu_s);
        let lambert = mu_s.max(T::ZERO) * T::of(core::f64::consts::FRAC_1_PI);
        for k in 0..3 {
            first[k] += through[k] * air.albedo[k] * air.irradiance[k] * sun[k] * lambert;
        }
    }
    (first, again)
}
