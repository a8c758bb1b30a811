//! The sky by backward paths: all orders of scattering, exact but for noise, which it states.
//!
//! Legs end by null collisions (Woodcock's delta tracking, with a majorant that follows the leg's altitude). The sun is
//! a point: its disc is not in the picture. Against noise, light that was scattered once is integrated apart, by
//! quadrature; the first leg's length is drawn from strata; and on each later leg the sun's light is gathered at a
//! point drawn for that alone, wherever the path goes on: most legs through thin air leave it, and at dusk most events
//! lie in the shadow. [`Sky::pure`] does without all three, as their check.

use crate::geometry::{advance, distance_to_end, hits_ground, lowest_altitude};
use crate::medium::Medium;
use crate::phase::{mie_phase, rayleigh_phase, sample_phase};
use crate::reference::Ray;
use crate::reference::first_leg::FirstLeg;
use crate::reference::random::{Random, mix};
use crate::reference::single;
use crate::reference::transmittance::DepthTable;

#[cfg(test)]
mod tests;

/// Groups of paths: their means' spread is the standard error, itself known to 1/√(2·64) = 9 %.
const BATCHES: u64 = 64;

/// Paths that judge how many are needed.
const PILOT: u64 = 8192;

/// Below this part of its light a path is ended at random, without bias.
const FAINT: f64 = 0.05;

/// A radiance, in W m⁻² sr⁻¹ nm⁻¹, and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub mean: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// A medium made ready for paths; making it takes about a second.
pub struct Sky<'a> {
    medium: &'a Medium,
    depths: [DepthTable; 3],
}

/// Where a path stands: from the point of the ground under the camera, the third axis up. Altitudes then come from h(2R
/// + h) and keep their digits.
#[derive(Clone, Copy)]
struct Place {
    at: [f64; 3],
    h: f64,
    up: [f64; 3],
}

/// What ends a leg.
enum Event {
    Space,
    Ground(Place),
    Air(Place),
}

/// The medium at one wavelength.
struct Air<'a> {
    medium: &'a Medium,
    depths: &'a DepthTable,
    rayleigh: f64,
    mie_scattering: f64,
    mie: f64,
    absorption: f64,
    albedo: f64,
}

impl<'a> Sky<'a> {
    /// Tables the sun's light in `medium`.
    pub fn new(medium: &'a Medium) -> Self {
        Self { medium, depths: DepthTable::all(medium) }
    }

    /// The radiance that comes along `view` at `medium.wavelengths[wavelength]`, from `paths` paths: the same for the same
    /// `seed`, while views and wavelengths do not share their noise.
    pub fn radiance(&self, view: &Ray, wavelength: usize, paths: u64, seed: u64) -> Estimate {
        let Some(start) = view.into_air(self.medium) else { return Estimate { mean: 0.0, standard_error: 0.0 } };
        let air = self.air(wavelength);
        let once = single::radiance(self.medium, &start)[wavelength];
        let irradiance = self.medium.irradiance[wavelength];
        let leg = FirstLeg::new(self.medium, &start, wavelength);
        let more = batches(paths, seed_of(seed, view, wavelength), |random, stratum, strata| {
            let u = (stratum as f64 + random.uniform()) / strata as f64;
            air.continued(random, &start, &leg, u) * irradiance
        });
        Estimate { mean: once + more.mean, standard_error: more.standard_error }
    }

    /// [`Self::radiance`] with as many paths as bring the standard error below `relative` of the mean, up to `most`.
    ///
    /// How many is judged by other paths than those that count: to stop at the first small error would prefer runs that
    /// missed rare bright paths, and with them would miss light.
    pub fn radiance_within(&self, view: &Ray, wavelength: usize, relative: f64, most: u64, seed: u64) -> Estimate {
        let mut paths = PILOT.min(most);
        let mut found = self.radiance(view, wavelength, paths, seed);
        for stage in 1.. {
            // A half more than the pilot asks for, whose error is itself uncertain.
            let excess = found.standard_error / (relative * found.mean.abs()).max(f64::MIN_POSITIVE);
            paths = ((paths as f64 * 1.5 * excess * excess) as u64).clamp(PILOT.min(most), most);
            found = self.radiance(view, wavelength, paths, seed.wrapping_add(stage));
            if found.standard_error <= relative * found.mean.abs() || paths == most {
                break;
            }
        }
        found
    }

    /// The same radiance by nothing but paths: every order at random, no strata, no quadrature.
    pub fn pure(&self, view: &Ray, wavelength: usize, paths: u64, seed: u64) -> Estimate {
        let Some(start) = view.into_air(self.medium) else { return Estimate { mean: 0.0, standard_error: 0.0 } };
        let air = self.air(wavelength);
        let irradiance = self.medium.irradiance[wavelength];
        let [toward, sun] = start.directions();
        batches(paths, seed_of(seed, view, wavelength), |random, _, _| {
            air.path(random, air.place([0.0, 0.0, start.h]), toward, sun, 1.0, false) * irradiance
        })
    }

    fn air(&self, wavelength: usize) -> Air<'_> {
        let medium = self.medium;
        Air {
            medium,
            depths: &self.depths[wavelength],
            rayleigh: medium.rayleigh[wavelength],
            mie_scattering: medium.mie_scattering[wavelength],
            mie: medium.mie_extinction()[wavelength],
            absorption: medium.absorption[wavelength],
            albedo: medium.albedo[wavelength],
        }
    }
}

fn seed_of(seed: u64, view: &Ray, wavelength: usize) -> u64 {
    let bits = [view.h, view.mu, view.mu_s, view.nu].map(f64::to_bits);
    bits.into_iter().chain([wavelength as u64]).fold(seed, |all, next| mix(all ^ next))
}

/// The mean over `paths` values and its standard error. Each value is told its stratum among those of its batch.
fn batches(paths: u64, seed: u64, mut value: impl FnMut(&mut Random, u64, u64) -> f64) -> Estimate {
    let strata = paths.div_ceil(BATCHES).max(1);
    let (mut sum, mut squares) = (0.0, 0.0);
    for batch in 0..BATCHES {
        let mut random = Random::new(seed, batch);
        let mean = (0..strata).map(|stratum| value(&mut random, stratum, strata)).sum::<f64>() / strata as f64;
        sum += mean;
        squares += mean * mean;
    }
    let n = BATCHES as f64;
    let mean = sum / n;
    Estimate { mean, standard_error: ((squares / n - mean * mean).max(0.0) / (n - 1.0)).sqrt() }
}

impl Air<'_> {
    fn place(&self, at: [f64; 3]) -> Place {
        let radius = self.medium.radius;
        let [x, y, z] = at;
        let grown = x * x + y * y + z * (z + 2.0 * radius);
        let h = (grown / (radius + (radius * radius + grown).max(0.0).sqrt())).max(0.0);
        Place { at, h, up: [x / (radius + h), y / (radius + h), (z + radius) / (radius + h)] }
    }

    fn ahead(&self, place: &Place, toward: [f64; 3], distance: f64) -> Place {
        self.place(core::array::from_fn(|k| place.at[k] + distance * toward[k]))
    }

    /// Light of order two and more along the first leg, its event drawn by `u`; per irradiance.
    fn continued(&self, random: &mut Random, start: &Ray, leg: &FirstLeg, u: f64) -> f64 {
        let [toward, sun] = start.directions();
        let from = self.place([0.0, 0.0, start.h]);
        let (distance, weight) = leg.draw(u);
        let place = self.ahead(&from, toward, distance);
        let (toward, left) =
            if leg.is_ground(u) { self.reflected(random, &place) } else { self.scattered(random, &place, toward) };
        self.path(random, place, toward, sun, weight * left, true)
    }

    /// Light of all orders that comes to `place` against `toward`, times `weight`, per irradiance: the sun's share of
    /// each leg from where the leg ends, or `gathered` apart.
    fn path(
        &self,
        random: &mut Random,
        place: Place,
        toward: [f64; 3],
        sun: [f64; 3],
        weight: f64,
        gathered: bool,
    ) -> f64 {
        let (mut place, mut toward, mut weight, faint) = (place, toward, weight, FAINT * weight);
        let mut light = 0.0;
        while weight > 0.0 {
            if gathered {
                light += weight * self.gathered(random, &place, toward, sun);
            }
            let left;
            match self.fly(random, &place, toward) {
                Event::Space => break,
                Event::Ground(hit) => {
                    if !gathered {
                        light += weight * self.ground(&hit, sun);
                    }
                    place = hit;
                    (toward, left) = self.reflected(random, &hit);
                }
                Event::Air(hit) => {
                    if !gathered {
                        light += weight * self.lit(&hit, toward, sun) / self.shares(hit.h)[2];
                    }
                    place = hit;
                    (toward, left) = self.scattered(random, &hit, toward);
                }
            }
            weight *= left;
            if weight < faint {
                weight = if random.uniform() * faint < weight { faint } else { 0.0 };
            }
        }
        light
    }

    /// The sun's light that air and ground scatter once into the leg from `place`. The point is drawn with a density
    /// that falls with the root of its distance: near enough for opaque air, far enough for light above a shadow.
    fn gathered(&self, random: &mut Random, place: &Place, toward: [f64; 3], sun: [f64; 3]) -> f64 {
        let (radius, mu) = (self.medium.radius, dot(place.up, toward));
        let length = distance_to_end(radius, self.medium.height, place.h, mu);
        let u = random.uniform();
        let point = self.ahead(place, toward, length * u * u);
        let mut light = 2.0 * length * u * self.between(place, &point, toward) * self.lit(&point, toward, sun);
        if hits_ground(radius, place.h, mu) {
            let hit = self.ahead(place, toward, length);
            light += self.between(place, &hit, toward) * self.ground(&hit, sun);
        }
        light
    }

    /// Transmittance between two points of a leg.
    fn between(&self, from: &Place, to: &Place, toward: [f64; 3]) -> f64 {
        let [start, end] = [from, to].map(|place| [place.h, dot(place.up, toward)]);
        (-self.depths.between(start, end)).exp()
    }

    /// What air at `place` scatters of the sun's light against `toward`, per metre and irradiance.
    fn lit(&self, place: &Place, toward: [f64; 3], sun: [f64; 3]) -> f64 {
        let [molecules, aerosols, _] = self.shares(place.h);
        let nu = dot(toward, sun);
        let phase = molecules * rayleigh_phase(nu) + aerosols * mie_phase(self.medium.mie_asymmetry, nu);
        phase * self.depths.transmittance(place.h, dot(place.up, sun))
    }

    /// What the ground at `place` reflects of the sun's light, per irradiance.
    fn ground(&self, place: &Place, sun: [f64; 3]) -> f64 {
        let mu_s = dot(place.up, sun).max(0.0);
        self.albedo * core::f64::consts::FRAC_1_PI * mu_s * self.depths.transmittance(0.0, mu_s)
    }

    /// Where a path goes on from the ground, and what it keeps. Lambert's law is the density of directions.
    fn reflected(&self, random: &mut Random, place: &Place) -> ([f64; 3], f64) {
        let up = random.uniform().sqrt();
        (turned(place.up, up, random.angle()), self.albedo)
    }

    /// Where a path that came along `toward` goes on from an event in the air, and what it keeps.
    fn scattered(&self, random: &mut Random, place: &Place, toward: [f64; 3]) -> ([f64; 3], f64) {
        let [molecules, aerosols, extinction] = self.shares(place.h);
        let scattering = molecules + aerosols;
        let g = if random.uniform() * scattering < molecules { 0.0 } else { self.medium.mie_asymmetry };
        let nu = sample_phase(g, || random.uniform());
        (turned(toward, nu, random.angle()), scattering / extinction)
    }

    /// Scattering by molecules and by aerosols, and extinction, per metre.
    fn shares(&self, h: f64) -> [f64; 3] {
        let [molecules, aerosols, absorbers] = self.medium.densities(h);
        let extinction = molecules * self.rayleigh + aerosols * self.mie + absorbers * self.absorption;
        [molecules * self.rayleigh, aerosols * self.mie_scattering, extinction]
    }

    /// Draws where a leg ends. Lengths are drawn for a medium nowhere thinner than what lies ahead, and an event counts
    /// with the probability of the true density.
    fn fly(&self, random: &mut Random, place: &Place, toward: [f64; 3]) -> Event {
        let medium = self.medium;
        let (radius, mu) = (medium.radius, dot(place.up, toward));
        let length = distance_to_end(radius, medium.height, place.h, mu);
        let ground = hits_ground(radius, place.h, mu);
        let mut bound = self.bound(if ground { 0.0 } else { lowest_altitude(radius, place.h, mu) });
        let mut d = 0.0;
        loop {
            d += random.exponential() / bound;
            // A bound of 0 makes d infinite, or NaN where a vacuum is left out of both: both leave the air.
            if d >= length || d.is_nan() {
                let end = if ground { Event::Ground } else { |_| Event::Space };
                return end(self.ahead(place, toward, length));
            }
            let (h, rise) = advance(radius, place.h, mu, d);
            if random.uniform() * bound < self.shares(h)[2] {
                return Event::Air(self.ahead(place, toward, d));
            }
            if rise > 0.0 {
                bound = self.bound(h);
            }
        }
    }

    /// A bound of extinction at and above altitude `h`, per metre.
    fn bound(&self, h: f64) -> f64 {
        let [molecules, aerosols, absorbers] = self.medium.densities(h);
        let absorbers = if h < self.medium.absorption_peak { 1.0 } else { absorbers };
        molecules * self.rayleigh + aerosols * self.mie + absorbers * self.absorption
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).clamp(-1.0, 1.0)
}

/// The direction at the angle of cosine `cosine` to the unit vector `from`, at `angle` about it.
///
/// The axes across are those of Duff et al. 2017 (Building an Orthonormal Basis, Revisited), which have no singular
/// direction.
fn turned(from: [f64; 3], cosine: f64, angle: f64) -> [f64; 3] {
    let [x, y, z] = from;
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let first = [1.0 + sign * x * x * a, sign * b, -sign * x];
    let second = [b, sign + y * y * a, -y];
    let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
    let (s, c) = (sine * angle.sin(), sine * angle.cos());
    let to: [f64; 3] = core::array::from_fn(|k| cosine * from[k] + c * first[k] + s * second[k]);
    // A path turns hundreds of times in thick air: lengths must not drift.
    let length = (to[0] * to[0] + to[1] * to[1] + to[2] * to[2]).sqrt();
    to.map(|k| k / length)
}
