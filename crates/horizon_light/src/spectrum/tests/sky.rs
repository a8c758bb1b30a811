//! Light of a clear sky at any wavelength: single scattering over a sphere, as a truth for colours.

use crate::medium::Medium;
use crate::spectrum::earth::{ozone_absorption, rayleigh_scattering};
use crate::spectrum::solar_irradiance;
use core::f64::consts::PI;
use libm::{cos, exp, pow, sqrt};

const EARTH: Medium = Medium::BRUNETON;

/// Densities of molecules, aerosols and ozone.
fn densities(h: f64) -> [f64; 3] {
    let ozone = 1.0 - (h - EARTH.absorption_peak).abs() / EARTH.absorption_width;
    [exp(-h / EARTH.rayleigh_height), exp(-h / EARTH.mie_height), ozone.max(0.0)]
}

/// Altitude after `d` metres.
fn altitude(h: f64, mu: f64, d: f64) -> f64 {
    let r = EARTH.radius;
    let c = h * (2.0 * r + h) + d * (d + 2.0 * (r + h) * mu);
    c / (sqrt(r * r + c) + r)
}

/// Distance to the top of the air.
fn top(h: f64, mu: f64) -> f64 {
    let b = (EARTH.radius + h) * mu;
    sqrt(b * b + (EARTH.height - h) * (2.0 * EARTH.radius + EARTH.height + h)) - b
}

/// Column of each density to the top of the air, in metres, by the midpoint rule.
fn columns(h: f64, mu: f64) -> [f64; 3] {
    const STEPS: u32 = 300;
    let step = top(h, mu) / f64::from(STEPS);
    let mut sum = [0.0; 3];
    for i in 0..STEPS {
        let density = densities(altitude(h, mu, (f64::from(i) + 0.5) * step));
        (0..3).for_each(|k| sum[k] += density[k] * step);
    }
    sum
}

/// A view of the sky from the ground. Columns do not depend on the wavelength, so they are made once.
pub struct Scene {
    nu: f64,
    ozone: bool,
    haze: bool,
    /// Step, in metres; densities; columns from the sun to there and on to the eye.
    samples: Vec<(f64, [f64; 3], [f64; 3])>,
}

impl Scene {
    /// Angles in degrees: the sun's and the view's from the zenith, and the azimuth between them.
    pub fn new(sun: f64, view: f64, azimuth: f64, ozone: bool, haze: bool) -> Self {
        const STEPS: u32 = 300;
        let [sun, view, azimuth] = [sun, view, azimuth].map(f64::to_radians);
        let (mu_s, mu) = (cos(sun), cos(view));
        let nu = mu_s * mu + libm::sin(sun) * libm::sin(view) * cos(azimuth);
        let (far, mut eye, mut samples) = (top(0.0, mu), [0.0; 3], Vec::new());
        for i in 0..STEPS {
            let [from, to] = [i, i + 1].map(|i| far * pow(f64::from(i) / f64::from(STEPS), 2.0));
            let (d, step) = (0.5 * (from + to), to - from);
            let (h, r) = (altitude(0.0, mu, d), EARTH.radius);
            let density = densities(h);
            let half: [f64; 3] = core::array::from_fn(|k| eye[k] + 0.5 * step * density[k]);
            (0..3).for_each(|k| eye[k] += step * density[k]);
            let here = (r * mu_s + d * nu) / (r + h);
            if here > -sqrt(h * (2.0 * r + h)) / (r + h) {
                let lit = columns(h, here);
                samples.push((step, density, core::array::from_fn(|k| half[k] + lit[k])));
            }
        }
        Self { nu, ozone, haze, samples }
    }

    /// Spectral radiance in W m⁻² sr⁻¹ nm⁻¹.
    pub fn radiance(&self, nm: f64) -> f64 {
        let (nu, g) = (self.nu, EARTH.mie_asymmetry);
        let ozone = if self.ozone { ozone_absorption(nm) } else { 0.0 };
        let extinction = [rayleigh_scattering(nm), if self.haze { 4.44e-6 } else { 0.0 }, ozone];
        let phase = [
            3.0 / (16.0 * PI) * (1.0 + nu * nu),
            3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + nu * nu) / ((2.0 + g * g) * pow(1.0 + g * g - 2.0 * g * nu, 1.5)),
        ];
        let sum: f64 = self
            .samples
            .iter()
            .map(|(step, density, column)| {
                let depth: f64 = (0..3).map(|k| extinction[k] * column[k]).sum();
                let scattering = extinction[0] * density[0] * phase[0] + 0.9 * extinction[1] * density[1] * phase[1];
                step * scattering * exp(-depth)
            })
            .sum();
        solar_irradiance(nm) * sum
    }
}
