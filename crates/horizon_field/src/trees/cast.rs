//! A ray against plants: one, and all that it may meet on its way through the dual cells; the twin of `solids.wgsl`.

use super::plant::Plant;
use super::solid::{Part, Solid, dot};
use crate::real::Real;

/// Steps within one crown, at most; the longest ray has come out before.
pub const PLANT_STEPS: u32 = 160;

/// The shortest step in a crown, in pixels.
pub const PLANT_STEP: f64 = 0.25;

/// After how many steps the shortest one begins to grow, so that a ray along a crown's skin gets on.
pub const PLANT_PATIENCE: u32 = 24;

/// How much it grows with each step.
pub const PLANT_HURRY: f64 = 1.1;

/// A pixel's width along a ray, in metres: `start` at the ray's origin, and `growth` more for each metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// At the origin.
    pub start: f64,
    /// For each metre.
    pub growth: f64,
}

impl Cone {
    /// A tenth of a millimetre, everywhere: for questions.
    pub const FINE: Self = Self { start: 1e-4, growth: 0.0 };

    /// At this distance, in metres; never 0.
    pub fn at(&self, t: f64) -> f64 {
        (self.start + self.growth * t.max(0.0)).max(1e-6)
    }
}

/// What the work of a cast was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlantWork {
    /// Dual cells looked at.
    pub cells: u64,
    /// Plants tested.
    pub plants: u64,
    /// The crown's function evaluated.
    pub steps: u64,
}

impl<T: Real> Solid<T> {
    /// Where, within `range`, a ray first meets the plant, and what of it. `direction` is of unit length, and `footprint` a
    /// pixel's width there, in metres, above 0. Steps are as long as the bound of the crown's function allows, but no shorter
    /// than [`PLANT_STEP`], and more after [`PLANT_PATIENCE`] of them: what is passed over is thinner than a step.
    pub fn cast(
        &self,
        origin: [T; 3],
        direction: [T; 3],
        range: [T; 2],
        footprint: T,
        work: &mut PlantWork,
    ) -> Option<(T, Part)> {
        let (o, d) = (self.own(origin), self.own_direction(direction));
        let [start, mut end] = range;
        let mut hit = None;
        if let Some(chord) = self.trunk.and_then(|trunk| trunk.chord(o, d)) {
            let t = chord[0].max(start);
            if t <= chord[1].min(end) {
                hit = Some((t, Part::Trunk));
                end = t;
            }
        }
        let Some(chord) = self.crown_chord(o, d) else { return hit };
        let (mut t, leave) = (chord[0].max(start), chord[1].min(end));
        let cut = leave < chord[1];
        if t > leave {
            return hit;
        }
        let level = self.level(footprint);
        let length = dot(d, d).sqrt();
        let pace = T::ONE / (self.slope(level) * length);
        let mut least = T::of(PLANT_STEP) * footprint / length;
        // The step that led here, and the function before it.
        let (mut step, mut before) = (T::ZERO, T::ONE);
        for i in 0..PLANT_STEPS {
            work.steps += 1;
            let f = self.crown(core::array::from_fn(|k| o[k] + t * d[k]), level);
            if f < T::ZERO {
                return Some((t + step * f / (before - f), Part::Crown));
            }
            if i >= PLANT_PATIENCE {
                least *= T::of(PLANT_HURRY);
            }
            (step, before) = (least.max(f * pace), f);
            t += step;
            if t > leave {
                // What ends a ray within a crown may stand just behind its skin.
                let last = leave - (t - step);
                if cut && last > T::ZERO {
                    work.steps += 1;
                    let f = self.crown(core::array::from_fn(|k| o[k] + leave * d[k]), level);
                    if f < T::ZERO {
                        return Some((leave + last * f / (before - f), Part::Crown));
                    }
                }
                return hit;
            }
        }
        hit
    }
}

/// A plant that a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantHit {
    /// Metres along the ray.
    pub t: f64,
    /// The plant.
    pub plant: Plant,
    /// What of it.
    pub part: Part,
    /// The outward normal there, of unit length.
    pub normal: [f64; 3],
}

/// The dual cells that a ray goes through, in order, with where it enters and leaves each. Dual cell (0, 0) is the square of
/// one cell's size around the corner that cells (0, 0) and (1, 1) share.
#[derive(Clone, Debug)]
pub struct DualCells {
    cell: [i64; 2],
    step: [i64; 2],
    /// Where the ray leaves the dual cell, along x and z.
    next: [f64; 2],
    /// How far it is from one border to the next.
    across: [f64; 2],
    t: f64,
    end: f64,
}

impl DualCells {
    /// Along a ray whose origin lies `origin` metres, in x and z, from the corner of cell (0, 0), from `range[0]` to `range[1]`;
    /// none where these are not finite.
    pub fn new(origin: [f64; 2], direction: [f64; 2], spacing: f64, range: [f64; 2]) -> Self {
        let at = [0, 1].map(|k| (origin[k] + range[0] * direction[k]) / spacing - 0.5);
        let cell = at.map(|at| at.floor());
        let across = direction.map(|d| if d == 0.0 { f64::INFINITY } else { spacing / d.abs() });
        let next = core::array::from_fn(|k| {
            let border = cell[k] + if direction[k] > 0.0 { 1.0 } else { 0.0 };
            if direction[k] == 0.0 { f64::INFINITY } else { ((border + 0.5) * spacing - origin[k]) / direction[k] }
        });
        let step = direction.map(|d| if d > 0.0 { 1 } else { -1 });
        let finite = range.iter().chain(&at).all(|x| x.is_finite());
        let end = if finite { range[1] } else { f64::NEG_INFINITY };
        Self { cell: cell.map(|cell| cell as i64), step, next, across, t: range[0], end }
    }
}

impl Iterator for DualCells {
    type Item = ([i64; 2], [f64; 2]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.t > self.end {
            return None;
        }
        let axis = usize::from(self.next[1] < self.next[0]);
        let leave = self.next[axis].max(self.t);
        let item = (self.cell, [self.t, leave.min(self.end)]);
        if leave < self.end {
            self.t = leave;
        } else {
            self.end = f64::NEG_INFINITY;
        }
        self.cell[axis] += self.step[axis];
        self.next[axis] += self.across[axis];
        Some(item)
    }
}
