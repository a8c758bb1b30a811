//! A stretch of a ray, for the methods that bound the ground under it.

use super::ground::{Ground, Setting};
use super::path::Path;
use super::work::Work;
use crate::field::Bound;
use crate::march::Ray;

/// Boxes per ray after which it counts as touching: only a ray that runs along the ground, nearer than bounds can tell,
/// needs so many.
pub(super) const MOST_BOUNDS: u64 = 1 << 18;

/// A ray over a setting's ground, and what it costs.
pub(super) struct Bounded<'a, G> {
    pub setting: &'a Setting<'a, G>,
    pub ray: &'a Ray,
    pub work: &'a mut Work,
}

/// The ground's bound under a stretch of a ray.
pub(super) struct Stretch {
    /// The ends.
    pub ends: [[f64; 3]; 2],
    /// The middle of the box that the bound is about.
    pub middle: [f64; 2],
    pub bound: Bound<2>,
}

impl<G: Ground> Bounded<'_, G> {
    /// The part of the ray where ground can be.
    pub(super) fn span(&self) -> Option<[f64; 2]> {
        Path::new(self.ray, self.setting.far, self.setting.high).span()
    }

    /// The height of the ray above the full ground.
    pub(super) fn clearance(&mut self, t: f64) -> f64 {
        self.work.evaluations += 1;
        self.work.noise += self.setting.octaves;
        let [x, y, z] = self.ray.at(t);
        y - self.setting.surface.height([x, z])
    }

    /// The bound under the stretch of these ends.
    pub(super) fn stretch(&mut self, [from, to]: [f64; 2]) -> Stretch {
        let ends = [self.ray.at(from), self.ray.at(to)];
        let sides = [0, 2].map(|axis| ends.map(|end| end[axis]));
        let middle = sides.map(|[a, b]| 0.5 * (a + b));
        // The box holds the ends however they and the middle were rounded.
        let half = sides.map(|[a, b]| 0.5 * (b - a).abs() + 2.0 * f64::EPSILON * (a.abs() + b.abs()));
        self.work.bounds += 1;
        self.work.noise += self.setting.surface.bound_octaves(half);
        Stretch { ends, middle, bound: self.setting.surface.bound(middle, half) }
    }
}

/// How short a stretch at `t` may get before the height at its end decides it, in metres.
pub(super) fn shortest(pixel: f64, t: f64) -> f64 {
    pixel.max(1e-7) * t + 1e-6
}
