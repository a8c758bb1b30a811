//! The water's body: what a path through it takes away, and what it adds.
//!
//! A beam is attenuated by c = a + b, the sum of absorption and scattering; it draws images. The light field is not: particles
//! scatter so much forward that it loses only κ = a + b_b, with b_b what is scattered backward (Gordon 1973's quasi-single
//! scattering). With μ the mean cosine of the light (the refracted sun's own, 0.84 for a uniform sky) and ½ that of what comes back
//! up, two streams, dE_d/dz = −κ/μ E_d + 2 b_b E_u and dE_u/dz = 2 κ E_u − b_b/μ E_d, fall as e^{−Kz} at a constant ratio R = E_u/E_d:
//! where little scatters back, K = κ/μ and R = b_b/κ · ½/(μ + ½), 0.33 b_b/κ under a high sun, as measured and computed (Gordon, Brown
//! and Jacobs 1975; Morel and Prieur 1977; Kirk 1984).
//!
//! Three lights are scattered into a view ray: the sun's beam; the sky's, taken for a Henyey–Greenstein lobe of mean cosine 0.84
//! about straight down (two such lobes, folded, are one whose mean cosine is their product); and E_u, alike to all sides. The third
//! makes up for what the ray loses by forward scattering, so that deep water has its radiance whatever share of b goes forward. Each
//! is an exponential along the ray, and is integrated as such.
//!
//! What the surface sends back down from below (of E_u nearly a half) is left out: it adds 0.48 E_u/E_d to the light, mostly below
//! 3 %.

use horizon_field::Real;

use super::WaterOptics;
use super::surface::{diffuse_reflectance, fresnel};
use crate::models::scatter::faded;
use crate::profile::Light;

/// Mean cosine of a uniform sky's light under a surface with the index 1.333: irradiance over scalar irradiance.
pub const SKY_COSINE: f64 = 0.84;

/// That of the light that comes up.
pub(super) const UP_COSINE: f64 = 0.5;

/// Paths and depths beyond are taken for as long as this, in metres: no light is left, and single precision has room.
pub const FARTHEST: f64 = 1e7;

/// The least cosine of a sun under water: only an index of 1 has any below 0.1.
pub(super) const LOWEST_SUN: f64 = 0.01;

/// How much more molecules scatter along the light than across it (Morel 1974): 1 + 0.835 ν².
pub(super) const MOLECULES: f64 = 0.835;

/// A value at each of the three wavelengths.
type Rgb<T> = [T; 3];

/// [`WaterOptics`] as `f32` or `f64`; laid out as the shader's `Water`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water<T> {
    /// Absorption, per metre.
    pub absorption: Rgb<T>,
    /// Refractive index.
    pub index: T,
    /// Scattering by particles, per metre.
    pub scattering: Rgb<T>,
    /// Mean cosine of that.
    pub anisotropy: T,
    /// Scattering by molecules, per metre.
    pub molecules: Rgb<T>,
    /// Albedo of dense foam.
    pub foam: T,
}

/// What lights the water just below its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterLight<T> {
    /// Towards the sun as it is seen from under water: of length 1, at least 0.01 upward.
    pub sun: [T; 3],
    /// Its irradiance on a level plane.
    pub sun_irradiance: Rgb<T>,
    /// The sky's irradiance on a level plane.
    pub sky_irradiance: Rgb<T>,
}

impl<T: Real> Water<T> {
    /// From optics that pass [`WaterOptics::check`].
    pub fn new(optics: &WaterOptics) -> Self {
        let of = |x: f32| T::of(f64::from(x));
        Self {
            absorption: optics.absorption.map(of),
            index: of(optics.index),
            scattering: optics.scattering.map(of),
            anisotropy: of(optics.anisotropy),
            molecules: optics.molecules.map(of),
            foam: of(optics.foam),
        }
    }

    /// What a beam loses, c = a + b, per metre.
    #[inline]
    pub fn attenuation(&self) -> Rgb<T> {
        core::array::from_fn(|k| self.absorption[k] + self.scattering[k] + self.molecules[k])
    }

    /// What is scattered backward, b_b, per metre: half of what molecules scatter, and the backward half of the particles' lobe.
    #[inline]
    pub fn backscattering(&self) -> Rgb<T> {
        let share = backward_share(self.anisotropy);
        core::array::from_fn(|k| share * self.scattering[k] + T::of(0.5) * self.molecules[k])
    }

    /// Beer and Lambert's law: what is left of a beam after `distance` ≥ 0 metres.
    #[inline]
    pub fn transmittance(&self, distance: T) -> Rgb<T>
    where
        T: Light,
    {
        let distance = distance.clamp(T::ZERO, T::of(FARTHEST));
        self.attenuation().map(|c| (-c * distance).exp())
    }

    /// What arrives over `distance` metres besides the image, blurred: light scattered a little, e^{−κd} − e^{−cd}. It belongs to
    /// the mean radiance of a bed round where the ray meets it, less the water's own [`upwelling`](Self::upwelling) there,
    /// which [`in_scatter`](Self::in_scatter) has in its place. A shallow white bed under milky water is dim without it.
    #[inline]
    pub fn blurred(&self, distance: T) -> Rgb<T>
    where
        T: Light,
    {
        let distance = distance.clamp(T::ZERO, T::of(FARTHEST));
        let (beam, backward) = (self.attenuation(), self.backscattering());
        core::array::from_fn(|k| {
            let field = self.absorption[k] + backward[k];
            let forward = (beam[k] - field) * distance;
            (-field * distance).exp() * forward * faded(forward)
        })
    }

    /// What lights the water: a sun in the unit direction `sun`, y up, with an irradiance on a plane that faces it, and a sky with one
    /// on a level plane. A sun below the horizon lights nothing. Waves are left out: they change the mean by little.
    pub fn lit(&self, sun: [T; 3], sun_irradiance: Rgb<T>, sky_irradiance: Rgb<T>) -> WaterLight<T> {
        let (x, z) = (sun[0] / self.index, sun[2] / self.index);
        let up = (T::ONE - x * x - z * z).max(T::ZERO).sqrt().max(T::of(LOWEST_SUN));
        let above = sun[1].max(T::ZERO);
        let enters = above * (T::ONE - fresnel(above, self.index));
        let sky = T::ONE - diffuse_reflectance(self.index);
        WaterLight {
            sun: [x, up, z],
            sun_irradiance: sun_irradiance.map(|e| e * enters),
            sky_irradiance: sky_irradiance.map(|e| e * sky),
        }
    }

    /// Irradiance on a level plane at a depth ≥ 0 in metres, from above.
    pub fn irradiance(&self, light: &WaterLight<T>, depth: T) -> Rgb<T>
    where
        T: Light,
    {
        let depth = depth.clamp(T::ZERO, T::of(FARTHEST));
        let backward = self.backscattering();
        core::array::from_fn(|k| {
            let part = |irradiance: T, cosine: T| {
                irradiance * (-Field::new(self.absorption[k], backward[k], cosine).decay * depth).exp()
            };
            part(light.sun_irradiance[k], light.sun[1]) + part(light.sky_irradiance[k], T::of(SKY_COSINE))
        })
    }

    /// Radiance that deep water sends up at a depth in metres, the same to all sides: E_u/π.
    pub fn upwelling(&self, light: &WaterLight<T>, depth: T) -> Rgb<T>
    where
        T: Light,
    {
        let depth = depth.clamp(T::ZERO, T::of(FARTHEST));
        let backward = self.backscattering();
        core::array::from_fn(|k| {
            let part = |irradiance: T, cosine: T| {
                let field = Field::new(self.absorption[k], backward[k], cosine);
                irradiance * field.up * (-field.decay * depth).exp()
            };
            part(light.sun_irradiance[k], light.sun[1]) + part(light.sky_irradiance[k], T::of(SKY_COSINE))
        })
    }

    /// Light scattered into `distance` ≥ 0 metres (also infinitely many) of a view ray from a depth ≥ 0 in metres, in the unit
    /// `direction`, y up: radiance where the ray starts. Rays that look up end at the surface at the latest.
    pub fn in_scatter(&self, light: &WaterLight<T>, depth: T, direction: [T; 3], distance: T) -> Rgb<T>
    where
        T: Light,
    {
        let down = (-direction[1]).clamp(-T::ONE, T::ONE);
        let depth = depth.clamp(T::ZERO, T::of(FARTHEST));
        let mut distance = distance.clamp(T::ZERO, T::of(FARTHEST));
        if -down * distance > depth {
            distance = depth / -down;
        }
        let end = (depth + down * distance).max(T::ZERO);
        let toward = light.sun[0] * direction[0] + light.sun[1] * direction[1] + light.sun[2] * direction[2];
        let toward = toward.clamp(-T::ONE, T::ONE);
        let sky_cosine = T::of(SKY_COSINE);
        let sun_lobe = lobe(self.anisotropy, toward);
        let sky_lobe = lobe(self.anisotropy * sky_cosine, -down);
        let sun_molecules = T::of(1.0 / (4.0 * core::f64::consts::PI * (1.0 + MOLECULES / 3.0)))
            * (T::ONE + T::of(MOLECULES) * toward * toward);
        let sky_molecules = T::of(0.25 / core::f64::consts::PI);
        let upward = T::of(0.5) * (T::ONE + down);
        let (beam, backward) = (self.attenuation(), self.backscattering());
        core::array::from_fn(|k| {
            let (particles, molecules) = (self.scattering[k], self.molecules[k]);
            // Of light that comes up, into the ray: the forward part where the ray looks down, the backward one where up.
            let turned = backward[k] + (particles + molecules - T::of(2.0) * backward[k]) * upward;
            let part = |irradiance: T, cosine: T, scattered: T| {
                let Field { decay, up } = Field::new(self.absorption[k], backward[k], cosine);
                let near = decay * depth;
                let far = decay * end + beam[k] * distance;
                // From the brighter end: neither exponential can overflow.
                let length = distance * faded((beam[k] + decay * down).abs() * distance);
                let source = scattered / cosine + turned * up;
                irradiance * source * (-near.min(far)).exp() * length
            };
            part(light.sun_irradiance[k], light.sun[1], particles * sun_lobe + molecules * sun_molecules)
                + part(light.sky_irradiance[k], sky_cosine, particles * sky_lobe + molecules * sky_molecules)
        })
    }
}

/// How the light of one source falls with depth.
#[derive(Clone, Copy, Debug)]
struct Field<T> {
    /// K, per metre.
    decay: T,
    /// Upwelling radiance over downwelling irradiance, R/π.
    up: T,
}

impl<T: Real> Field<T> {
    /// Of light with this mean cosine, at one wavelength.
    #[inline]
    fn new(absorption: T, backward: T, cosine: T) -> Self {
        let lost = absorption + backward;
        let (two, down) = (T::of(1.0 / UP_COSINE), T::ONE / cosine);
        // The smaller root of 2 b_b R² − κ(1/μ + 2) R + b_b/μ = 0.
        let sum = lost * (down + two);
        let root = (sum * sum - T::of(4.0) * two * down * backward * backward).max(T::ZERO).sqrt();
        let ratio = (T::of(2.0) * down * backward / (sum + root).max(T::of(1e-30))).min(T::ONE);
        let decay = (lost * down - two * backward * ratio).max(T::ZERO);
        Self { decay, up: ratio * T::of(core::f64::consts::FRAC_1_PI) }
    }
}

/// Which share of a Henyey–Greenstein lobe lies behind: (1 − g)/(2g)·((1 + g)/√(1 + g²) − 1), multiplied out so that nothing cancels.
#[inline]
pub fn backward_share<T: Real>(g: T) -> T {
    let root = (T::ONE + g * g).sqrt();
    (T::ONE - g) / (root * (T::ONE + g + root))
}

/// Henyey and Greenstein's phase function, per steradian; `nu` is the cosine of the angle of deflection.
#[inline]
pub fn lobe<T: Real>(g: T, nu: T) -> T {
    // 1 + g² − 2gν as a sum of squares, as in `mie_phase`; for a lobe that points back, about the other end.
    let gap = T::ONE - g.abs();
    let turn = if g < T::ZERO { T::ONE + nu } else { T::ONE - nu };
    let base = gap * gap + T::of(2.0) * g.abs() * turn;
    T::of(0.25 / core::f64::consts::PI) * (T::ONE - g * g) / (base * base.sqrt())
}
