//! The water's body: what a path through it takes away, and what it adds.
//!
//! A beam is attenuated by c = a + b, the sum of absorption and scattering; it draws images. The light field is not: most of b goes
//! forward, and stays in it. Irradiance falls with depth as e^{−Kz}; with μ the light's cosine under water (the refracted sun's own,
//! and the mean of 0.84 for a uniform sky), and b' = Σ b (1 − g) what scatters as much as if it went to all sides,
//! K² = (a² + (5.6 μ − 2.5) a b')/μ²: Kirk's (1984) fit to his Monte Carlo, and for μ = 1 nearly the diffusion of light in milk.
//!
//! Of it R = E_u/E_d comes back up, alike to all sides. Where little scatters, R = (0.975 − 0.629 μ) b_b/a by the same fit, b_b what
//! goes backward: a third of b_b/a under a high sun (as Gordon, Brown and Jacobs 1975 and Morel and Prieur 1977 have it). In milk it is
//! Kubelka and Munk's, R = y/(1 + y + √(1 + 2y)), y = ⅜ b'/a. Between them y goes over from the one to the other.
//!
//! Three lights are scattered into a view ray: the sun's beam; the sky's, taken for a Henyey–Greenstein lobe of mean cosine 0.84
//! about straight down (two such lobes, folded, are one whose mean cosine is their product), with its peak cut at [`SKY_PEAK`]; and E_u. The third makes up for what
//! the ray loses by forward scattering, so that deep water has its radiance whatever share of b goes forward. Each is an
//! exponential along the ray, and is integrated as such. Against every order of scattering in a half space, what deep water
//! sends up is at most a fifth off, for b/a of 0.5 to 270 (`tests::body`).
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
/// The most that sky light is scattered into a direction, per steradian: it comes from all of Snell's window, of 2.13 sr, while a lobe
/// about one direction would have a peak as sharp as the particles' own.
pub const SKY_PEAK: f64 = 0.47;

/// Kirk's coefficients: K's and R's.
pub(super) const KIRK: [f64; 4] = [5.6, 2.5, 0.975, 0.629];

/// By how much more than E_u has of it light comes up into a ray that loses some, where little comes up in all: fitted to every
/// order of scattering.
pub(super) const GATHERED: f64 = 0.2;

/// b'/a where water is half on its way to milk.
pub(super) const MILKY: f64 = 5.0;

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

    /// What would scatter as much if it went to all sides, b', per metre.
    #[inline]
    fn diffuse(&self) -> Rgb<T> {
        let particles = T::ONE - self.anisotropy;
        core::array::from_fn(|k| particles * self.scattering[k] + self.molecules[k])
    }

    /// How light with the mean `cosine` falls with depth, at each wavelength.
    #[inline]
    fn field(&self, cosine: T) -> [Field<T>; 3] {
        let (backward, diffuse) = (self.backscattering(), self.diffuse());
        core::array::from_fn(|k| Field::new(self.absorption[k], backward[k], diffuse[k], cosine))
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

    /// What arrives over `distance` metres besides the image, blurred: light scattered a little, e^{−Kd} − e^{−cd}. It belongs to
    /// the mean radiance of a bed round where the ray meets it, less the water's own [`upwelling`](Self::upwelling) there,
    /// which [`in_scatter`](Self::in_scatter) has in its place. A shallow white bed under milky water is dim without it.
    #[inline]
    pub fn blurred(&self, distance: T) -> Rgb<T>
    where
        T: Light,
    {
        let distance = distance.clamp(T::ZERO, T::of(FARTHEST));
        let (beam, field) = (self.attenuation(), self.field(T::ONE));
        core::array::from_fn(|k| {
            let kept = field[k].decay.min(beam[k]);
            let forward = (beam[k] - kept) * distance;
            (-kept * distance).exp() * forward * faded(forward)
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
        let (sun, sky) = (self.field(light.sun[1]), self.field(T::of(SKY_COSINE)));
        core::array::from_fn(|k| {
            light.sun_irradiance[k] * (-sun[k].decay * depth).exp()
                + light.sky_irradiance[k] * (-sky[k].decay * depth).exp()
        })
    }

    /// Radiance that deep water sends up at a depth in metres, the same to all sides: E_u/π.
    pub fn upwelling(&self, light: &WaterLight<T>, depth: T) -> Rgb<T>
    where
        T: Light,
    {
        let depth = depth.clamp(T::ZERO, T::of(FARTHEST));
        let (sun, sky) = (self.field(light.sun[1]), self.field(T::of(SKY_COSINE)));
        core::array::from_fn(|k| {
            light.sun_irradiance[k] * sun[k].up * (-sun[k].decay * depth).exp()
                + light.sky_irradiance[k] * sky[k].up * (-sky[k].decay * depth).exp()
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
        let sky_lobe = lobe(self.anisotropy * sky_cosine, -down).min(T::of(SKY_PEAK));
        let sun_molecules = T::of(1.0 / (4.0 * core::f64::consts::PI * (1.0 + MOLECULES / 3.0)))
            * (T::ONE + T::of(MOLECULES) * toward * toward);
        let sky_molecules = T::of(0.25 / core::f64::consts::PI);
        let (gathered, pi) = (T::of(GATHERED), T::of(core::f64::consts::PI));
        let upward = T::of(0.5) * (T::ONE + down);
        let (beam, backward) = (self.attenuation(), self.backscattering());
        let (sun, sky) = (self.field(light.sun[1]), self.field(sky_cosine));
        core::array::from_fn(|k| {
            let (particles, molecules) = (self.scattering[k], self.molecules[k]);
            // Of light that comes up, into the ray: the forward part where the ray looks down, the backward one where up.
            let turned = backward[k] + (particles + molecules - T::of(2.0) * backward[k]) * upward;
            let part = |field: Field<T>, irradiance: T, cosine: T, scattered: T| {
                let Field { decay, up } = field;
                let near = decay * depth;
                let far = decay * end + beam[k] * distance;
                // From the brighter end: neither exponential can overflow.
                let length = distance * faded((beam[k] + decay * down).abs() * distance);
                let source = scattered / cosine + turned * up * (T::ONE + gathered * (T::ONE - pi * up));
                irradiance * source * (-near.min(far)).exp() * length
            };
            let from_sun = particles * sun_lobe + molecules * sun_molecules;
            let from_sky = particles * sky_lobe + molecules * sky_molecules;
            part(sun[k], light.sun_irradiance[k], light.sun[1], from_sun)
                + part(sky[k], light.sky_irradiance[k], sky_cosine, from_sky)
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
    /// Of light with the mean `cosine` in water that absorbs, scatters backward, and scatters as if to all sides so much.
    #[inline]
    fn new(absorption: T, backward: T, diffuse: T, cosine: T) -> Self {
        let turns = (T::of(KIRK[0]) * cosine - T::of(KIRK[1])).max(T::ZERO);
        let decay = (absorption * (absorption + turns * diffuse)).sqrt() / cosine;
        // y a, and so all of R's terms times a: water may absorb nothing.
        let once = T::of(2.0) * backward * (T::of(KIRK[2]) - T::of(KIRK[3]) * cosine);
        let milky = diffuse / (diffuse + T::of(MILKY) * absorption).max(T::of(1e-30));
        let y = once + (T::of(0.375) * diffuse - once).max(T::ZERO) * milky;
        let root = (absorption * (absorption + y + y)).sqrt();
        let ratio = y / (absorption + y + root).max(T::of(1e-30));
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
