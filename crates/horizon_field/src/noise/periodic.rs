//! Gradient noise that comes again: for tables that repeat.

use super::axes::Axes;
use super::gradient;
use crate::hash::{axis, axis_seed};

/// A cell of a lattice that repeats.
struct PeriodicCell {
    cell: [i64; 3],
    period: i64,
    seeds: [u32; 3],
}

impl Axes<3> for PeriodicCell {
    #[inline(always)]
    fn hash(&self, k: usize, i: i32) -> u32 {
        axis((self.cell[k] + i64::from(i)).rem_euclid(self.period), self.seeds[k])
    }
}

/// Gradient noise in space, from −1 to 1, at `u` in [0, 1)³, which is `period` lattice cells wide and comes again after that.
pub(crate) fn periodic(u: [f64; 3], period: u32, seed: u32) -> f64 {
    let x = u.map(|u| u * f64::from(period));
    let cell = PeriodicCell {
        cell: x.map(|x| x.floor() as i64),
        period: i64::from(period),
        seeds: [0, 1, 2].map(|k| axis_seed(seed, k)),
    };
    gradient::space(&cell, x.map(|x| x - x.floor())).v
}
