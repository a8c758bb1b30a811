//! The radiance of an order of scattering, per irradiance of the sun, on the grid.

use super::grid::Grid;
use crate::reference::{accumulate, harmonics};

/// Harmonics of radiance over altitudes and suns; what comes down to the ground and what leaves the top, over suns.
pub(super) struct Field {
    suns: usize,
    count: usize,
    /// By altitude, harmonic, sun.
    harmonics: Vec<[f64; 3]>,
    down: Vec<[f64; 3]>,
    up: Vec<[f64; 3]>,
}

impl Field {
    pub fn dark(grid: &Grid) -> Self {
        let suns = grid.resolution.suns;
        let count = harmonics::count(grid.resolution.degree);
        Self {
            suns,
            count,
            harmonics: vec![[0.0; 3]; grid.resolution.altitudes * count * suns],
            down: vec![[0.0; 3]; suns],
            up: vec![[0.0; 3]; suns],
        }
    }

    pub fn add(&mut self, other: &Self) {
        let both = [(&mut self.harmonics, &other.harmonics), (&mut self.down, &other.down), (&mut self.up, &other.up)];
        for (into, from) in both {
            for (into, from) in into.iter_mut().zip(from) {
                accumulate(into, |k| from[k]);
            }
        }
    }

    /// Adds the radiance `light`, by sun and azimuth, that comes to altitude `i` from the direction `mu`.
    pub fn gather(&mut self, grid: &Grid, i: usize, mu: f64, weight: f64, light: &[[f64; 3]]) {
        let (degree, azimuths) = (grid.resolution.degree, grid.resolution.azimuths);
        let mut legendre = vec![0.0; self.count];
        harmonics::legendre(degree, mu, &mut legendre);
        let ground = i == 0 && mu > 0.0;
        let top = i + 1 == grid.resolution.altitudes && mu < 0.0;
        for (j, light) in light.chunks_exact(azimuths).enumerate() {
            for m in 0..=degree {
                let mut round = [0.0; 3];
                for (azimuth, light) in light.iter().enumerate() {
                    let turn = (m as f64 * grid.azimuth(azimuth)).cos();
                    accumulate(&mut round, |k| turn * light[k] * grid.azimuth_weight() * weight);
                }
                for l in m..=degree {
                    let n = harmonics::index(degree, l, m);
                    accumulate(&mut self.harmonics[(i * self.count + n) * self.suns + j], |k| legendre[n] * round[k]);
                }
                if m == 0 {
                    accumulate(&mut self.down[j], |k| if ground { mu * round[k] } else { 0.0 });
                    accumulate(&mut self.up[j], |k| if top { -mu * round[k] } else { 0.0 });
                }
            }
        }
    }

    /// Harmonic `n` at altitude `i`, over suns.
    pub fn line(&self, i: usize, n: usize) -> &[[f64; 3]] {
        &self.harmonics[(i * self.count + n) * self.suns..][..self.suns]
    }

    /// Harmonic `n` between altitudes and suns.
    pub fn at(&self, n: usize, rows: (usize, [f64; 4]), columns: (usize, [f64; 4])) -> [f64; 3] {
        let mut value = [0.0; 3];
        for (row, weight) in rows.1.into_iter().enumerate() {
            let found = blend(self.line(rows.0 + row, n), columns);
            accumulate(&mut value, |k| weight * found[k]);
        }
        value
    }

    /// Irradiance of level ground, per irradiance of the sun.
    pub fn irradiance_at(&self, grid: &Grid, mu_s: f64) -> [f64; 3] {
        blend(&self.down, grid.sun_stencil(mu_s))
    }

    /// What leaves the top upwards, per area and irradiance of the sun.
    pub fn leaving_at(&self, grid: &Grid, mu_s: f64) -> [f64; 3] {
        blend(&self.up, grid.sun_stencil(mu_s))
    }
}

fn blend(line: &[[f64; 3]], (first, weights): (usize, [f64; 4])) -> [f64; 3] {
    let mut value = [0.0; 3];
    for (found, weight) in line[first..first + 4].iter().zip(weights) {
        accumulate(&mut value, |k| weight * found[k]);
    }
    value
}
