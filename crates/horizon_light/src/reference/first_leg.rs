//! Where light that comes along a view ray was scattered last: the first leg of its backward path.

use crate::geometry::{advance, distance_to_end, hits_ground};
use crate::medium::Medium;
use crate::reference::Ray;
use crate::reference::quadrature::gauss_legendre;

/// Parts that the ray is cut into.
const PARTS: usize = 192;

/// A density over the ray's length, constant on each part, near to that of true events; weights make up for the
/// difference, so that nothing depends on it but noise.
pub struct FirstLeg<'a> {
    medium: &'a Medium,
    wavelength: usize,
    ray: Ray,
    length: f64,
    /// Gauss's rule for the depth within a part.
    rule: Vec<(f64, f64)>,
    /// Distances at the parts' ends.
    ends: Vec<f64>,
    /// Optical depth up to each.
    depths: Vec<f64>,
    /// Probability of an event up to each; the rest is the ground's.
    chances: Vec<f64>,
}

impl<'a> FirstLeg<'a> {
    /// For a ray that starts inside the air.
    pub fn new(medium: &'a Medium, ray: &Ray, wavelength: usize) -> Self {
        let length = distance_to_end(medium.radius, medium.height, ray.h, ray.mu);
        let mut leg = Self {
            medium,
            wavelength,
            ray: *ray,
            length,
            rule: gauss_legendre(4),
            ends: vec![0.0],
            depths: vec![0.0],
            chances: vec![0.0],
        };
        for k in 1..=PARTS {
            // Parts widen with distance, where air gets thin or light is lost before it arrives.
            let x = k as f64 / PARTS as f64;
            let end = length * x * (0.15 + 0.85 * x * x);
            let depth = leg.depths[k - 1] + leg.depth_between(leg.ends[k - 1], end);
            leg.ends.push(end);
            leg.depths.push(depth);
            leg.chances.push(-(-depth).exp_m1());
        }
        let ground = if hits_ground(medium.radius, ray.h, ray.mu) { (-leg.depths[PARTS]).exp() } else { 0.0 };
        let whole = leg.chances[PARTS] + ground;
        if whole > 0.0 {
            leg.chances.iter_mut().for_each(|chance| *chance /= whole);
        }
        leg
    }

    fn depth_between(&self, start: f64, end: f64) -> f64 {
        let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
        self.rule.iter().map(|(x, weight)| half * weight * self.extinction(centre + half * x)).sum()
    }

    fn extinction(&self, d: f64) -> f64 {
        let h = advance(self.medium.radius, self.ray.h, self.ray.mu, d).0;
        self.medium.extinction(self.medium.densities(h))[self.wavelength]
    }

    /// Whether `u` in [0, 1) stands for an event on the ground.
    pub fn is_ground(&self, u: f64) -> bool {
        u >= self.chances[PARTS]
    }

    /// The distance of the event that `u` in [0, 1) stands for, and its weight.
    pub fn draw(&self, u: f64) -> (f64, f64) {
        let last = self.chances[PARTS];
        if u >= last {
            // Nothing at all lies on a ray through a vacuum into space: its weight is 0.
            let left = (-self.depths[PARTS]).exp();
            return (self.length, if last < 1.0 && self.reaches_ground() { left / (1.0 - last) } else { 0.0 });
        }
        let part = self.chances.partition_point(|chance| *chance <= u).clamp(1, PARTS) - 1;
        let chance = self.chances[part + 1] - self.chances[part];
        let width = self.ends[part + 1] - self.ends[part];
        let d = self.ends[part] + width * (u - self.chances[part]) / chance;
        let depth = self.depths[part] + self.depth_between(self.ends[part], d);
        (d, (-depth).exp() * self.extinction(d) * width / chance)
    }

    fn reaches_ground(&self) -> bool {
        hits_ground(self.medium.radius, self.ray.h, self.ray.mu)
    }
}
