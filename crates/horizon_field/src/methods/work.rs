//! What marching costs.

use serde::{Deserialize, Serialize};

/// What casts cost, summed over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Heights evaluated, of however many octaves.
    pub evaluations: u64,
    /// Octaves of noise evaluated, in heights and in bounds.
    pub noise: u64,
    /// Boxes bounded.
    pub bounds: u64,
    /// Steps along rays: turns of the march's loop, without the refinement of a crossing.
    pub steps: u64,
}

impl core::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.noise += other.noise;
        self.bounds += other.bounds;
        self.steps += other.steps;
    }
}
