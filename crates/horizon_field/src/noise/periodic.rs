//! Noise that comes again: for tables that repeat. `periodic.wgsl` is the twin.

use super::axes::Axes;
use super::{gradient, worley};
use crate::hash::{axis, axis_seed};

/// The WGSL twin: `gradient3_periodic(u: vec3<f32>, period: u32, seed: u32)` and `worley3_periodic`. The hash, `gradient.wgsl` and
/// `worley.wgsl` come before it.
pub const PERIODIC_WGSL: &str = include_str!("periodic.wgsl");

/// A cell of a lattice that repeats.
struct PeriodicCell {
    cell: [i64; 3],
    period: i64,
    seeds: [u32; 3],
}

impl PeriodicCell {
    /// The cell at `u` periods, and the fraction in it.
    fn at(u: [f64; 3], period: u32, seed: u32) -> (Self, [f64; 3]) {
        let x = u.map(|u| u * f64::from(period));
        let cell = Self {
            cell: x.map(|x| x.floor() as i64),
            period: i64::from(period),
            seeds: [0, 1, 2].map(|k| axis_seed(seed, k)),
        };
        (cell, x.map(|x| x - x.floor()))
    }
}

impl Axes<3> for PeriodicCell {
    #[inline(always)]
    fn hash(&self, k: usize, i: i32) -> u32 {
        axis((self.cell[k] + i64::from(i)).rem_euclid(self.period), self.seeds[k])
    }
}

/// Gradient noise in space, from −1 to 1, at `u` in [0, 1)³, which is `period` ≥ 1 lattice cells wide and comes again after that.
pub fn periodic(u: [f64; 3], period: u32, seed: u32) -> f64 {
    let (cell, fraction) = PeriodicCell::at(u, period, seed);
    gradient::space(&cell, fraction).v
}

/// Worley noise in space, from −1 at the feature points to 1, in the same way.
pub fn periodic_worley(u: [f64; 3], period: u32, seed: u32) -> f64 {
    let (cell, fraction) = PeriodicCell::at(u, period, seed);
    worley::space(&cell, fraction).v
}
