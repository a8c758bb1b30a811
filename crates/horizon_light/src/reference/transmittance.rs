//! What is left of light along a ray, by adaptive quadrature, and a dense table of it for paths by the million.

use crate::geometry::{
    advance, distance_to_top, hits_ground, horizon_cosine, horizon_distance, shell_discriminant, shell_excess,
};
use crate::medium::Medium;
use crate::reference::quadrature::integrate;
use crate::reference::stencil::stencil;

#[cfg(test)]
mod tests;

/// The error that columns are integrated to, relative to the column.
const RELATIVE: f64 = 1e-9;

/// The columns of molecules, aerosols and absorbers along `distance` metres of a ray that stays inside the air: the
/// lengths, in metres, that would hold as much at density 1.
pub fn columns(medium: &Medium, h: f64, mu: f64, distance: f64) -> [f64; 3] {
    let densities = |d: f64| medium.densities(advance(medium.radius, h, mu, d).0);
    integrate(densities, &kinks(medium, h, mu, distance), RELATIVE)
}

/// The optical depth along `distance` metres of a ray inside the air, at each wavelength.
pub fn optical_depth(medium: &Medium, h: f64, mu: f64, distance: f64) -> [f64; 3] {
    medium.extinction(columns(medium, h, mu, distance))
}

/// The part of light that passes `distance` metres of a ray inside the air, at each wavelength.
pub fn transmittance(medium: &Medium, h: f64, mu: f64, distance: f64) -> [f64; 3] {
    optical_depth(medium, h, mu, distance).map(|depth| (-depth).exp())
}

/// The part of light that comes from outside to altitude `h` out of the direction `mu`: 0 where the ground is in the
/// way.
pub fn transmittance_to_top(medium: &Medium, h: f64, mu: f64) -> [f64; 3] {
    if hits_ground(medium.radius, h, mu) {
        return [0.0; 3];
    }
    transmittance(medium, h, mu, distance_to_top(medium.radius, medium.height, h, mu))
}

/// Where a ray's integrals are to be split, from 0 to `distance`: where the absorbing layer's tent has its edges, and
/// at the lowest point, on both sides of which the densities rise and fall as exponentials do.
pub(crate) fn kinks(medium: &Medium, h: f64, mu: f64, distance: f64) -> Vec<f64> {
    let along = (medium.radius + h) * mu;
    let mut ends = vec![0.0, distance, -along];
    for level in [-1.0, 0.0, 1.0].map(|side| medium.absorption_peak + side * medium.absorption_width) {
        let square = shell_discriminant(medium.radius, level, h, mu);
        if square > 0.0 {
            ends.extend([-along - square.sqrt(), -along + square.sqrt()]);
        }
    }
    ends.retain(|d| (0.0..=distance).contains(d));
    ends.sort_by(f64::total_cmp);
    ends
}

/// Optical depths from inside the air to its top, for every altitude and every direction that passes the ground, at one
/// wavelength.
///
/// Coordinates are those of Bruneton and Neyret 2008: over altitudes the distance to the horizon, over directions the
/// distance to the top, both uniform between their extremes. In them the depth is smooth, so that cubic interpolation
/// in f64 serves.
pub struct DepthTable {
    radius: f64,
    height: f64,
    /// The longest distance to the horizon, from the top.
    reach: f64,
    depths: Vec<f64>,
}

impl DepthTable {
    /// Altitudes.
    const ROWS: usize = 512;
    /// Directions.
    const COLUMNS: usize = 512;

    /// The tables of all three wavelengths.
    pub fn all(medium: &Medium) -> [Self; 3] {
        let reach = horizon_distance(medium.radius, medium.height);
        let mut depths = [const { Vec::new() }; 3];
        for row in 0..Self::ROWS {
            let away = reach * row as f64 / (Self::ROWS - 1) as f64;
            // From h(2R + h) = away².
            let h = (away * away / (medium.radius + medium.radius.hypot(away))).min(medium.height);
            let [least, most] = Self::range(medium.height, reach, h, away);
            for column in 0..Self::COLUMNS {
                let d = least + (most - least) * column as f64 / (Self::COLUMNS - 1) as f64;
                let mu = if column + 1 == Self::COLUMNS {
                    horizon_cosine(medium.radius, h)
                } else if d > 0.0 {
                    // From (R + h_t)² = r² + d² + 2rμd.
                    let gain = -shell_excess(medium.radius, medium.height, h);
                    ((gain - d * d) / (2.0 * (medium.radius + h) * d)).clamp(-1.0, 1.0)
                } else {
                    1.0
                };
                let depth = optical_depth(medium, h, mu, d);
                for (table, depth) in depths.iter_mut().zip(depth) {
                    table.push(depth);
                }
            }
        }
        depths.map(|depths| Self { radius: medium.radius, height: medium.height, reach, depths })
    }

    /// The shortest and the longest distance to the top.
    fn range(height: f64, reach: f64, h: f64, away: f64) -> [f64; 2] {
        [height - h, away + reach]
    }

    /// The optical depth from altitude `h` in the air to its top, in a direction `mu` that passes the ground.
    pub fn depth(&self, h: f64, mu: f64) -> f64 {
        let away = horizon_distance(self.radius, h.clamp(0.0, self.height));
        let [least, most] = Self::range(self.height, self.reach, h, away);
        let d = distance_to_top(self.radius, self.height, h, mu);
        let (row, rows) = stencil(away / self.reach, Self::ROWS);
        let (column, columns) = stencil((d - least) / (most - least), Self::COLUMNS);
        let mut depth = 0.0;
        for (j, row_weight) in rows.into_iter().enumerate() {
            let start = (row + j) * Self::COLUMNS + column;
            let mut line = 0.0;
            for (value, weight) in self.depths[start..start + 4].iter().zip(columns) {
                line += value * weight;
            }
            depth += line * row_weight;
        }
        depth
    }

    /// The part of light that comes from outside: 0 where the ground is in the way.
    pub fn transmittance(&self, h: f64, mu: f64) -> f64 {
        if hits_ground(self.radius, h, mu) { 0.0 } else { (-self.depth(h, mu)).exp() }
    }
    /// The optical depth between two points of a ray, of which the second lies ahead, from their altitudes and local
    /// cosines: as a difference in the sense in which the further one looks up.
    pub fn between(&self, [h, mu]: [f64; 2], [h_ahead, mu_ahead]: [f64; 2]) -> f64 {
        let depth = if mu_ahead > 0.0 {
            self.depth(h, mu) - self.depth(h_ahead, mu_ahead)
        } else {
            self.depth(h_ahead, -mu_ahead) - self.depth(h, -mu)
        };
        depth.max(0.0)
    }
}
