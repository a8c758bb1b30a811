//! Rival ways to find the plant that a ray meets: what the walk through the dual cells is measured against.

use super::cast::{Cone, PlantWork};
use super::cells::cell_of;
use super::foliage::Foliage;
use super::grove::Grove;
use super::solid::{Solid, dot};
use crate::Place;
use crate::march::Ray;

/// Steps of a ray, at most.
pub const RIVAL_STEPS: u32 = 4000;

/// How near to a plant a ray meets it, in pixels.
const NEAR: f64 = 0.25;

/// What a rival takes for the distance from an ellipsoid, with k₀ = ‖p / r‖ and k₁ = ‖p / r²‖.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distance {
    /// Seed 000's eq. 3.7 as printed: the bar cancels, and k₀ − 1 is left, which counts in radii.
    Printed,
    /// What it was meant to be: k₀ (k₀ − 1) / k₁, an estimate.
    Estimate,
    /// min(r) (k₀ − 1), a bound.
    Bound,
}

/// Sphere tracing through repeated cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NineCells {
    /// The distance from an ellipsoid.
    pub distance: Distance,
    /// Whether all nine cells take the offset of the cell that the point is in, as eq. 3.10 has it.
    pub shared: bool,
    /// Whether steps are divided by the slope of the sum of distance and foliage, which eq. 3.8 leaves as it is.
    pub divided: bool,
    /// Whether steps end where cells begin that were not looked at.
    pub limited: bool,
    /// The share of the distance that a step takes: 1 is sphere tracing as it is known.
    pub pace: f64,
    /// How near to a plant a ray meets it, in pixels.
    pub near: f64,
    /// Whether the ground's height under the nine plants is computed at every step, as eq. 3.10 has it, and not remembered.
    /// What else there is to know of a plant is remembered in any case.
    pub forgetful: bool,
}

impl NineCells {
    /// Seed 000's search, as printed in eq. 3.7 to 3.10.
    pub const PRINTED: Self = Self {
        distance: Distance::Printed,
        shared: true,
        divided: false,
        limited: false,
        pace: 1.0,
        near: NEAR,
        forgetful: false,
    };
    /// Sphere tracing of the whole domain, with what it takes to be sure.
    pub const SURE: Self =
        Self { distance: Distance::Bound, shared: false, divided: true, limited: true, ..Self::PRINTED };

    /// The distance in metres at which a ray first meets a plant, as this search has it; arguments as of [`Grove::cast`].
    pub fn cast(
        &self,
        grove: &mut Grove<'_>,
        place: &Place,
        ray: &Ray,
        t_max: f64,
        cone: Cone,
        work: &mut PlantWork,
    ) -> Option<f64> {
        let [mut t, end] = grove.heights(ray, t_max)?;
        let spacing = grove.spacing();
        let (base, within) = cell_of(place, spacing);
        let direction = ray.direction();
        let flat = libm::hypot(direction[0], direction[2]);
        // The plants around a point, made once for all steps within its cell.
        let (mut cell, mut around) = ([f64::NAN; 2], Vec::new());
        let anchors = grove.ground().field.anchor(place);
        let (mut feet, mut heights) = (Vec::new(), Vec::new());
        for _ in 0..RIVAL_STEPS {
            if t > end {
                return None;
            }
            let [x, y, z] = ray.at(t);
            let p = [x + within[0], y, z + within[1]];
            let here = [p[0], p[2]].map(|x| (x / spacing).floor());
            if cell != here {
                (cell, around) = (here, self.around(grove, base, here));
                feet = around.iter().map(|solid| [solid.foot[0] - within[0], solid.foot[2] - within[1]]).collect();
                heights = vec![0.0; around.len()];
            }
            if self.forgetful {
                grove.ground().field.values_f64(&anchors, &feet, 0.0, &mut heights);
                around.iter_mut().zip(&heights).for_each(|(solid, height)| solid.foot[1] = *height);
            }
            let mut step = f64::INFINITY;
            work.cells += 1;
            for solid in &around {
                work.plants += 1;
                step = step.min(self.distance(solid, p, direction, cone.at(t), work));
            }
            if step < self.near * cone.at(t) {
                return Some(t);
            }
            if self.limited {
                // Trunks of cells not looked at are a cell away or farther, and reach half a cell.
                let border = |k: usize, x: f64| (x - (here[k] - 1.0) * spacing).min((here[k] + 2.0) * spacing - x);
                let free = border(0, p[0]).min(border(1, p[2])) - 0.5 * spacing;
                step = step.min(free / flat.max(1e-9)).max(1e-6);
            }
            // With nothing in nine cells there is no distance; a cell's edge is what is left.
            t += if step.is_finite() { self.pace * step } else { spacing };
        }
        None
    }

    /// The plants of the nine cells around a cell, as the search has them.
    fn around(&self, grove: &mut Grove<'_>, base: [i64; 2], here: [f64; 2]) -> Vec<Solid<f64>> {
        let spacing = grove.spacing();
        let of = |side: [i64; 2]| core::array::from_fn(|k| base[k].wrapping_add(here[k] as i64 + side[k]));
        let middle = grove.plant(of([0, 0]));
        let sides = (0..9).map(|neighbour| [neighbour % 3 - 1, neighbour / 3 - 1]);
        sides
            .filter_map(|side| {
                let plant = grove.plant(of(side))?;
                let offset = if self.shared { middle.unwrap_or(plant).offset } else { plant.offset };
                let at = |k: usize| (here[k] + side[k] as f64 + f64::from(offset[k]) / 65535.0) * spacing;
                Some(grove.solid(&plant, [at(0), plant.foot(), at(1)]))
            })
            .collect()
    }

    fn distance(
        &self,
        solid: &Solid<f64>,
        p: [f64; 3],
        direction: [f64; 3],
        footprint: f64,
        work: &mut PlantWork,
    ) -> f64 {
        work.steps += 1;
        let level = solid.level(footprint);
        let (q, d) = (solid.own(p), solid.own_direction(direction));
        let leaves = solid.foliage * Foliage::table().value(solid.periods(q), level);
        let pace = if self.divided { 1.0 / (solid.slope(level) * dot(d, d).sqrt()) } else { 1.0 };
        let crown = solid.crown.iter().map(|ellipsoid| {
            let scaled = ellipsoid.scaled(q);
            let k0 = dot(scaled, scaled).sqrt();
            let twice: [f64; 3] = core::array::from_fn(|k| scaled[k] / ellipsoid.radii[k]);
            let eaten = leaves * ellipsoid.narrow();
            pace * match self.distance {
                Distance::Printed => k0 - 1.0 + leaves,
                Distance::Estimate => k0 * (k0 - 1.0) / dot(twice, twice).sqrt() + eaten,
                Distance::Bound => ellipsoid.narrow() * (k0 - 1.0) + eaten,
            }
        });
        let trunk = solid.trunk.iter().map(|ellipsoid| {
            let scaled = ellipsoid.scaled(q);
            pace * ellipsoid.narrow() * (dot(scaled, scaled).sqrt() - 1.0)
        });
        crown.chain(trunk).fold(f64::INFINITY, f64::min)
    }
}
