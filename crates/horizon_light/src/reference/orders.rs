//! The sky by successive orders of scattering, without noise: for whole pictures, once it agrees with the paths.
//!
//! The radiance of each order is found along rays from a grid of altitudes, suns and directions, and kept as spherical
//! harmonics, from which the phase functions make the next order's source. Light that was scattered once never is
//! approximated so: it is integrated along each ray with the exact phase functions.

use core::f64::consts::FRAC_1_PI;

use crate::geometry::{advance, advance_sun, distance_to_end, hits_ground};
use crate::medium::Medium;
use crate::phase::{mie_phase, rayleigh_phase};
use crate::reference::transmittance::DepthTable;
use crate::reference::{Ray, accumulate, harmonics, single};

mod field;
mod grid;
#[cfg(test)]
mod tests;

use field::Field;
use grid::Grid;
pub use grid::Resolution;

/// Orders after which the sum ends, however slowly it grows.
const MOST: usize = 300;

/// All orders of scattered light in a medium.
pub struct Orders<'a> {
    medium: &'a Medium,
    depths: [DepthTable; 3],
    grid: Grid,
    /// Legendre moments of the phase functions.
    molecules: Vec<f64>,
    aerosols: Vec<f64>,
    /// The sum of all orders.
    sum: Field,
    /// What leaves through the top in each order, at each wavelength, as a part of what the sun sends onto the top's
    /// disc.
    pub leaving: Vec<[f64; 3]>,
}

/// What a ray meets at one point: where, what arrives from there at the ray's start, and what scatters.
struct Point {
    distance: f64,
    h: f64,
    mu: f64,
    /// Transmittance to the start times the length stood for.
    seen: [f64; 3],
    rayleigh: [f64; 3],
    mie: [f64; 3],
}

impl<'a> Orders<'a> {
    /// Adds orders until one lets less than `until` of their sum out of the air.
    pub fn new(medium: &'a Medium, resolution: Resolution, until: f64) -> Self {
        let grid = Grid::new(medium, resolution);
        let mut orders = Self {
            medium,
            depths: DepthTable::all(medium),
            molecules: harmonics::moments(resolution.degree, rayleigh_phase),
            aerosols: harmonics::moments(resolution.degree, |nu| mie_phase(medium.mie_asymmetry, nu)),
            sum: Field::dark(&grid),
            grid,
            leaving: Vec::new(),
        };
        let mut last: Option<Field> = None;
        let mut total = [0.0; 3];
        while orders.leaving.len() < MOST {
            let next = orders.next(last.as_ref());
            let leaving = orders.leaving_of(&next);
            orders.leaving.push(leaving);
            orders.sum.add(&next);
            last = Some(next);
            accumulate(&mut total, |k| leaving[k]);
            if (0..3).all(|k| leaving[k] <= until * total[k]) {
                break;
            }
        }
        orders
    }

    /// The radiance that comes along `view`, in W m⁻² sr⁻¹ nm⁻¹; the sun's disc is not in it.
    pub fn radiance(&self, view: &Ray) -> [f64; 3] {
        let Some(start) = view.into_air(self.medium) else { return [0.0; 3] };
        let mut more = [0.0; 3];
        for point in self.points(start.h, start.mu) {
            let here = start.advanced(self.medium, point.distance);
            let source = self.source(&self.sum, &point, here.mu_s, cosine_of_azimuth(&here));
            accumulate(&mut more, |k| point.seen[k] * source[k]);
        }
        if let Some((distance, seen)) = self.ground(start.h, start.mu) {
            let light = self.sum.irradiance_at(&self.grid, start.advanced(self.medium, distance).mu_s);
            accumulate(&mut more, |k| seen[k] * light[k]);
        }
        let once = single::radiance(self.medium, &start);
        core::array::from_fn(|k| once[k] + self.medium.irradiance[k] * more[k])
    }

    /// The irradiance of the sky, without the sun, on level ground under a sun of cosine `mu_s`, in W m⁻² nm⁻¹.
    pub fn irradiance(&self, mu_s: f64) -> [f64; 3] {
        let found = self.sum.irradiance_at(&self.grid, mu_s);
        core::array::from_fn(|k| self.medium.irradiance[k] * found[k])
    }

    /// The order after `last`, or the first.
    fn next(&self, last: Option<&Field>) -> Field {
        let (grid, Resolution { suns, azimuths, .. }) = (&self.grid, self.grid.resolution);
        let mut next = Field::dark(grid);
        let mut light = vec![[0.0; 3]; suns * azimuths];
        for i in 0..grid.resolution.altitudes {
            let h = grid.altitude(i);
            for (mu, weight) in grid.directions(h) {
                light.fill([0.0; 3]);
                let rays: Vec<Ray> =
                    (0..suns * azimuths).map(|n| self.grid_ray(h, mu, n / azimuths, n % azimuths)).collect();
                match last {
                    Some(last) => self.scatter(last, h, mu, &rays, &mut light),
                    None => self.scatter_sun(h, mu, &rays, &mut light),
                }
                if let Some((distance, seen)) = self.ground(h, mu) {
                    for (ray, light) in rays.iter().zip(&mut light) {
                        let mu_s = ray.advanced(self.medium, distance).mu_s.max(-1.0);
                        let below = match last {
                            Some(last) => last.irradiance_at(grid, mu_s),
                            None => self.depths.each_ref().map(|t| mu_s.max(0.0) * t.transmittance(0.0, mu_s)),
                        };
                        accumulate(light, |k| seen[k] * below[k]);
                    }
                }
                next.gather(grid, i, mu, weight, &light);
            }
        }
        next
    }

    fn grid_ray(&self, h: f64, mu: f64, sun: usize, azimuth: usize) -> Ray {
        let mu_s = self.grid.sun(sun);
        let sines = ((1.0 - mu * mu) * (1.0 - mu_s * mu_s)).max(0.0).sqrt();
        let nu = (mu * mu_s + sines * self.grid.azimuth(azimuth).cos()).clamp(-1.0, 1.0);
        Ray { h, mu, mu_s, nu }
    }

    /// Adds the sun's light, scattered into rays that share altitude and cosine.
    fn scatter_sun(&self, h: f64, mu: f64, rays: &[Ray], light: &mut [[f64; 3]]) {
        let phases: Vec<_> =
            rays.iter().map(|ray| (rayleigh_phase(ray.nu), mie_phase(self.medium.mie_asymmetry, ray.nu))).collect();
        for point in self.points(h, mu) {
            for ((ray, light), (molecules, aerosols)) in rays.iter().zip(light.iter_mut()).zip(&phases) {
                let mu_s = advance_sun(self.medium.radius, h, ray.mu_s, ray.nu, point.distance, point.h);
                if hits_ground(self.medium.radius, point.h, mu_s) {
                    continue;
                }
                accumulate(light, |k| {
                    let scattered = point.rayleigh[k] * molecules + point.mie[k] * aerosols;
                    point.seen[k] * scattered * (-self.depths[k].depth(point.h, mu_s)).exp()
                });
            }
        }
    }

    /// Adds the light of a field, scattered into rays that share altitude and cosine. What their points have in common,
    /// all but sun and azimuth, is summed first.
    fn scatter(&self, field: &Field, h: f64, mu: f64, rays: &[Ray], light: &mut [[f64; 3]]) {
        let Resolution { suns, degree, .. } = self.grid.resolution;
        let mut by_order = vec![[0.0; 3]; (degree + 1) * suns];
        let mut legendre = vec![0.0; harmonics::count(degree)];
        for point in self.points(h, mu) {
            let used = self.used_degree(&point);
            harmonics::legendre(degree, point.mu, &mut legendre);
            by_order.fill([0.0; 3]);
            let (first, weights) = self.grid.altitude_stencil(point.h);
            for m in 0..=used {
                for l in m..=used {
                    let n = harmonics::index(degree, l, m);
                    let share = self.share(&point, l);
                    for (row, weight) in weights.into_iter().enumerate() {
                        let factor: [f64; 3] =
                            core::array::from_fn(|k| weight * legendre[n] * share[k] * point.seen[k]);
                        let line = field.line(first + row, n);
                        for (into, value) in by_order[m * suns..(m + 1) * suns].iter_mut().zip(line) {
                            accumulate(into, |k| factor[k] * value[k]);
                        }
                    }
                }
            }
            for (ray, light) in rays.iter().zip(light.iter_mut()) {
                let mu_s = advance_sun(self.medium.radius, h, ray.mu_s, ray.nu, point.distance, point.h);
                let here = Ray { h: point.h, mu: point.mu, mu_s, nu: ray.nu };
                let (first, weights) = self.grid.sun_stencil(mu_s);
                let cosine = cosine_of_azimuth(&here);
                let (mut before, mut turn) = (cosine, 1.0);
                for m in 0..=used {
                    for (column, weight) in weights.into_iter().enumerate() {
                        let value = by_order[m * suns + first + column];
                        accumulate(light, |k| turn * weight * value[k]);
                    }
                    // cos((m + 1)φ) from the two before.
                    (before, turn) = (turn, 2.0 * cosine * turn - before);
                }
            }
        }
    }

    /// What `field` scatters at a point into the ray, per metre and irradiance; `cosine` is that of the azimuth between
    /// ray and sun.
    fn source(&self, field: &Field, point: &Point, mu_s: f64, cosine: f64) -> [f64; 3] {
        let degree = self.grid.resolution.degree;
        let mut legendre = vec![0.0; harmonics::count(degree)];
        harmonics::legendre(degree, point.mu, &mut legendre);
        let rows = self.grid.altitude_stencil(point.h);
        let columns = self.grid.sun_stencil(mu_s);
        let (mut before, mut turn) = (cosine, 1.0);
        let mut source = [0.0; 3];
        for m in 0..=self.used_degree(point) {
            for l in m..=self.used_degree(point) {
                let n = harmonics::index(degree, l, m);
                let (share, value) = (self.share(point, l), field.at(n, rows, columns));
                accumulate(&mut source, |k| turn * legendre[n] * share[k] * value[k]);
            }
            (before, turn) = (turn, 2.0 * cosine * turn - before);
        }
        source
    }

    /// What scatters the harmonics of degree `l` at a point, per metre.
    fn share(&self, point: &Point, l: usize) -> [f64; 3] {
        core::array::from_fn(|k| point.rayleigh[k] * self.molecules[l] + point.mie[k] * self.aerosols[l])
    }

    /// Molecules scatter no harmonic above degree 2: where there is next to no aerosol, the others are left out.
    fn used_degree(&self, point: &Point) -> usize {
        let degree = self.grid.resolution.degree;
        if (0..3).all(|k| point.mie[k] <= 1e-4 * point.rayleigh[k]) { degree.min(2) } else { degree }
    }

    fn points(&self, h: f64, mu: f64) -> Vec<Point> {
        let medium = self.medium;
        let steps = self.grid.steps(h, mu).into_iter();
        steps
            .map(|(distance, weight)| {
                let (above, ahead) = advance(medium.radius, h, mu, distance);
                let above = above.min(medium.height);
                let [molecules, aerosols, _] = medium.densities(above);
                Point {
                    distance,
                    h: above,
                    mu: ahead,
                    seen: self.depths.each_ref().map(|t| weight * (-t.between([h, mu], [above, ahead])).exp()),
                    rayleigh: medium.rayleigh.map(|k| k * molecules),
                    mie: medium.mie_scattering.map(|k| k * aerosols),
                }
            })
            .collect()
    }

    /// The distance of the ground that a ray hits, and what its irradiance is multiplied by on the way to the ray's
    /// start.
    fn ground(&self, h: f64, mu: f64) -> Option<(f64, [f64; 3])> {
        let medium = self.medium;
        hits_ground(medium.radius, h, mu).then(|| {
            let distance = distance_to_end(medium.radius, medium.height, h, mu);
            let end = [0.0, advance(medium.radius, h, mu, distance).1];
            let seen =
                core::array::from_fn(|k| (-self.depths[k].between([h, mu], end)).exp() * medium.albedo[k] * FRAC_1_PI);
            (distance, seen)
        })
    }

    /// What a field sends out, over the whole planet: its mean over all suns times the top's area, against the top's
    /// disc.
    fn leaving_of(&self, field: &Field) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let n = 2000;
        for i in 0..n {
            let mu_s = 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
            if mu_s < self.grid.sun(0) {
                continue;
            }
            let flux = field.leaving_at(&self.grid, mu_s);
            accumulate(&mut sum, |k| 4.0 * flux[k] / n as f64);
        }
        sum
    }
}

/// The cosine of the azimuth between ray and sun; anything where either is vertical, for harmonics with an azimuth
/// vanish there.
fn cosine_of_azimuth(ray: &Ray) -> f64 {
    let sines = ((1.0 - ray.mu * ray.mu) * (1.0 - ray.mu_s * ray.mu_s)).max(0.0).sqrt();
    if sines > 0.0 { ((ray.nu - ray.mu * ray.mu_s) / sines).clamp(-1.0, 1.0) } else { 1.0 }
}
