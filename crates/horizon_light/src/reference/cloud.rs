//! Light in clouds, by paths in double precision. Where light meets a droplet is found by null collisions (Woodcock et al. 1965): as
//! if the cloud were as dense everywhere as it is at most, with the chance of each event being a real one. No step is taken that could
//! be too long, so that the estimate has noise but no bias.

pub mod scenes;
#[cfg(test)]
mod tests;

use super::monte_carlo::Estimate;
use super::quadrature::gauss_legendre;
use super::random::Random;
use crate::clouds::phase::Phase;

/// What scatters light: all that it meets, in a convex space.
pub trait Matter {
    /// Extinction at a point, per metre.
    fn extinction(&self, at: [f64; 3]) -> f64;
    /// More than that is nowhere.
    fn most(&self) -> f64;
    /// From where to where a ray is in the space; nothing, if the end is not beyond the start.
    fn span(&self, from: [f64; 3], toward: [f64; 3]) -> [f64; 2];
}

/// Light under a sun of irradiance 1 and nothing else.
#[derive(Clone, Copy, Debug)]
pub struct Lit<'a, M> {
    /// What is lit.
    pub matter: &'a M,
    /// Where it scatters light to.
    pub phase: Phase<f64>,
    /// Towards the sun, of length 1.
    pub sun: [f64; 3],
}

/// Batches that a standard error is found from.
const BATCHES: u64 = 32;

/// Paths that judge how many are needed. Paths that come near the sun's direction are rare and bright: few say little of them.
const PILOT: u64 = 8_192;

/// Below this a transmittance is carried on by lot.
const FAINT: f64 = 0.1;

fn along(from: [f64; 3], toward: [f64; 3], distance: f64) -> [f64; 3] {
    core::array::from_fn(|k| from[k] + distance * toward[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A direction that a cosine and an azimuth turn `toward` to.
pub(crate) fn turned(toward: [f64; 3], nu: f64, azimuth: f64) -> [f64; 3] {
    // A frame without a branch (Duff et al. 2017).
    let [x, y, z] = toward;
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let (u, v) = ([1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]);
    let sine = ((1.0 - nu) * (1.0 + nu)).max(0.0).sqrt();
    let (c, s) = (sine * libm::cos(azimuth), sine * libm::sin(azimuth));
    let new: [f64; 3] = core::array::from_fn(|k| c * u[k] + s * v[k] + nu * toward[k]);
    let length = dot(new, new).sqrt();
    new.map(|x| x / length)
}

impl<M: Matter> Lit<'_, M> {
    /// Where a ray meets something, if it does.
    fn met(&self, random: &mut Random, from: [f64; 3], toward: [f64; 3]) -> Option<[f64; 3]> {
        let [mut t, end] = self.matter.span(from, toward);
        let most = self.matter.most();
        loop {
            t += random.exponential() / most;
            if t >= end {
                return None;
            }
            let at = along(from, toward, t);
            if random.uniform() * most < self.matter.extinction(at) {
                return Some(at);
            }
        }
    }

    /// An estimate of the sun's transmittance from a point: ratio tracking (Novák, Selle and Jarosz 2014).
    fn sunlit(&self, random: &mut Random, from: [f64; 3]) -> f64 {
        let [mut t, end] = self.matter.span(from, self.sun);
        let most = self.matter.most();
        let mut left = 1.0;
        loop {
            t += random.exponential() / most;
            if t >= end {
                return left;
            }
            left *= 1.0 - self.matter.extinction(along(from, self.sun, t)) / most;
            if left < FAINT {
                if random.uniform() * FAINT >= left {
                    return 0.0;
                }
                left = FAINT;
            }
        }
    }

    /// Light of all orders along a ray, of `paths` paths: the same for the same seed.
    pub fn radiance(&self, from: [f64; 3], toward: [f64; 3], paths: u64, seed: u64) -> Estimate {
        let each = paths.div_ceil(BATCHES).max(1);
        let (mut sum, mut squares) = (0.0, 0.0);
        for batch in 0..BATCHES {
            let mut random = Random::new(seed, batch);
            let mean = (0..each).map(|_| self.path(&mut random, from, toward)).sum::<f64>() / each as f64;
            sum += mean;
            squares += mean * mean;
        }
        let n = BATCHES as f64;
        let mean = sum / n;
        Estimate { mean, standard_error: ((squares / n - mean * mean).max(0.0) / (n - 1.0)).sqrt() }
    }

    /// [`Self::radiance`] with as many paths as bring the standard error below `relative` of the mean, up to `most`. How many is judged
    /// by other paths than those that count.
    pub fn radiance_within(&self, from: [f64; 3], toward: [f64; 3], relative: f64, most: u64, seed: u64) -> Estimate {
        let pilot = self.radiance(from, toward, PILOT, seed ^ 0x5eed);
        let excess = pilot.standard_error / (relative * pilot.mean).max(f64::MIN_POSITIVE);
        let paths = ((PILOT as f64 * 1.3 * excess * excess) as u64).clamp(PILOT, most.max(PILOT));
        self.radiance(from, toward, paths, seed)
    }

    fn path(&self, random: &mut Random, from: [f64; 3], toward: [f64; 3]) -> f64 {
        let (mut from, mut toward, mut light) = (from, toward, 0.0);
        while let Some(at) = self.met(random, from, toward) {
            light += self.phase.at(dot(toward, self.sun)) * self.sunlit(random, at);
            let (nu, azimuth) = (self.phase.draw(|| random.uniform()), random.angle());
            toward = turned(toward, nu, azimuth);
            from = at;
        }
        light
    }

    /// Light scattered once, by quadrature: `cells` along the ray, as many towards the sun from each of their nodes.
    pub fn once(&self, from: [f64; 3], toward: [f64; 3], cells: usize) -> f64 {
        let [near, far] = self.matter.span(from, toward);
        if far <= near {
            return 0.0;
        }
        let nodes = gauss_legendre(2);
        let length = (far - near) / cells as f64;
        let (mut light, mut depth) = (0.0, 0.0);
        for cell in 0..cells {
            let start = near + length * cell as f64;
            // Both nodes of Gauss's rule weigh half: between them depth grows by a straight line.
            let found: Vec<[f64; 2]> = nodes
                .iter()
                .map(|(x, _)| {
                    let at = along(from, toward, start + length * 0.5 * (1.0 + x));
                    let extinction = self.matter.extinction(at);
                    [extinction, if extinction > 0.0 { self.sun_transmittance(at, cells) } else { 0.0 }]
                })
                .collect();
            let mean = 0.5 * (found[0][0] + found[1][0]);
            for ([extinction, sun], (x, weight)) in found.iter().zip(&nodes) {
                let before = depth + mean * length * 0.5 * (1.0 + x);
                light += 0.5 * weight * length * extinction * sun * libm::exp(-before);
            }
            depth += mean * length;
            if depth > 40.0 {
                break;
            }
        }
        light * self.phase.at(dot(toward, self.sun))
    }

    fn sun_transmittance(&self, at: [f64; 3], cells: usize) -> f64 {
        let [near, far] = self.matter.span(at, self.sun);
        let length = (far - near) / cells as f64;
        let mut depth = 0.0;
        for cell in 0..cells {
            depth += length * self.matter.extinction(along(at, self.sun, near + length * (cell as f64 + 0.5)));
            if depth > 40.0 {
                return 0.0;
            }
        }
        libm::exp(-depth)
    }
}
