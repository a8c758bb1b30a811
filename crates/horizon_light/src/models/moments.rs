//! The default model: multiple scattering by spherical moments. WGSL twin: `moments.wgsl`.
//!
//! Scattering blurs light over directions, each phase function by its Legendre moments, and of Rayleigh's only those of degree 0 and 2
//! differ from nothing. So of the light that arrives at a point, its six even real spherical harmonics of degree 0 to 2 (those that are
//! symmetric about the plane of vertical and sun) say all that molecules scatter on; for aerosols the degrees above 2 are left out, of
//! light that was scattered before, never of the sun's own. These six colours depend on altitude and sun alone: a table of two coordinates,
//! smooth in both as the densities are not in it, stands where Bruneton's method has one of four.
//!
//! That is enough where molecules rule: RMS errors against the Monte Carlo are below 1.2 % on Earth and 2.5 % in the haze of
//! [`Medium::LEEDS`](crate::medium::Medium::LEEDS). In the thick dust of [`Medium::MARS`](crate::medium::Medium::MARS), where light
//! goes forward from grain to grain, they are 9 to 48 %, under a low sun no better than with isotropic scattering; finer tables and
//! more passes do not help there.
//!
//! Each pass marches the light of the last pass' moments, from every texel into a few directions, and projects what arrives. Orders
//! soon fall in a ratio of their own at each place; the last one is extended by that geometric series, as Hillaire (2020) does from
//! the second. Two further passes suit thin air. The series overshoots by up to 4 % where nothing absorbs and the ground is white,
//! and in [`Medium::ALIEN`](crate::medium::Medium::ALIEN), whose blue light scatters many times, errors of 59 % under a sun at 80°
//! fall to 2 % with eight passes.

use super::air::{Air, Rgb};
use super::directions::{DIRECTIONS, Direction, direction, sine, sunward};
use super::scatter::{Multiple, Once, Scene, SkyRay};
use super::table::{Table, coordinate};
use super::transmittance::Transmittance;
use crate::phase::mie_phase;
use crate::profile::Light;

/// Real spherical harmonics up to degree 2 that are even in azimuth from the sun, in the order of [`harmonics`].
pub const HARMONICS: usize = 6;

/// How finely the table is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Texels over the sun's height.
    pub suns: usize,
    /// Texels over altitude.
    pub altitudes: usize,
    /// Samples along each ray.
    pub steps: usize,
    /// Passes after the first.
    pub passes: usize,
}

impl Resolution {
    /// What the shader has.
    pub const DEFAULT: Self = Self { suns: 32, altitudes: 12, steps: 8, passes: 2 };

    /// Marching steps that a build takes: each looks once into the last table, and in the first pass into transmittance
    /// instead.
    pub fn evaluations(&self) -> usize {
        self.suns * self.altitudes * DIRECTIONS * self.steps * (1 + self.passes)
    }
}

/// Diffuse light by its moments, in W m⁻² sr^−½ nm⁻¹ (harmonics are normalised over the sphere): over the sun's height,
/// then altitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments<T>(pub Table<T, HARMONICS>);

/// [`HARMONICS`] of a direction with cosine `mu` to the vertical and component `x` along the sun's azimuth.
#[inline]
pub fn harmonics<T: Light>(mu: T, x: T) -> [T; HARMONICS] {
    let square = ((T::ONE - mu) * (T::ONE + mu) - x * x).max(T::ZERO);
    [
        T::of(0.282_094_791_773_878_14),
        T::of(0.488_602_511_902_919_9) * mu,
        T::of(0.488_602_511_902_919_9) * x,
        T::of(0.315_391_565_252_520_05) * (T::of(3.0) * mu * mu - T::ONE),
        T::of(1.092_548_430_592_079_2) * mu * x,
        T::of(0.546_274_215_296_039_6) * (x * x - square),
    ]
}

/// The table's first coordinate for a sun at `mu_s`: a square root on either side of the horizon, to 0 at [`Air::night`].
#[inline]
pub fn sun_coordinate<T: Light>(air: &Air<T>, mu_s: T) -> T {
    let night = (-air.night).sqrt();
    let root = mu_s.abs().sqrt();
    ((if mu_s < T::ZERO { -root } else { root }) + night) / (T::ONE + night)
}

/// The sun that the coordinate stands for.
#[inline]
pub fn sun_cosine<T: Light>(air: &Air<T>, u: T) -> T {
    let night = (-air.night).sqrt();
    let root = u * (T::ONE + night) - night;
    (root * root.abs()).clamp(-T::ONE, T::ONE)
}

impl<T: Light> Moments<T> {
    /// The table of [`Resolution::DEFAULT`].
    pub fn new(air: &Air<T>, transmittance: &Transmittance<T>) -> Self {
        Self::resolved(air, transmittance, Resolution::DEFAULT)
    }

    /// A table of any resolution.
    pub fn resolved(air: &Air<T>, transmittance: &Transmittance<T>, resolution: Resolution) -> Self {
        let mut orders = Self::orders(air, transmittance, resolution).into_iter();
        let mut last = Self(Table::of(resolution.suns, resolution.altitudes, |_, _| [[T::ZERO; 3]; HARMONICS]));
        let mut total = last.clone();
        for i in 0..=resolution.passes {
            let Some(order) = orders.next() else { break };
            for (sum, (new, old)) in total.0.texels.iter_mut().zip(order.0.texels.iter().zip(&last.0.texels)) {
                let series = if i == resolution.passes { geometric_series(old[0], new[0]) } else { [T::ONE; 3] };
                for (sum, new) in sum.iter_mut().zip(new) {
                    for k in 0..3 {
                        sum[k] += new[k] * series[k];
                    }
                }
            }
            last = order;
        }
        total
    }

    /// Each order's own table: light that was scattered once, twice and so on, by air or ground.
    pub fn orders(air: &Air<T>, transmittance: &Transmittance<T>, resolution: Resolution) -> Vec<Self> {
        let first = Scene { air, transmittance, multiple: &Once, sunlit: true };
        let mut orders = vec![Self::pass(&first, resolution)];
        for i in 0..resolution.passes {
            let again = Scene { air, transmittance, multiple: &orders[i], sunlit: false };
            let next = Self::pass(&again, resolution);
            orders.push(next);
        }
        orders
    }

    fn pass(scene: &Scene<T, impl Multiple<T>>, resolution: Resolution) -> Self {
        let Resolution { suns, altitudes, steps, .. } = resolution;
        Self(Table::of(suns, altitudes, |x, y| {
            let mu_s = sun_cosine(scene.air, coordinate(x, suns));
            let v = coordinate::<T>(y, altitudes);
            project(scene, v * v * scene.air.height, mu_s, steps)
        }))
    }

    /// The moments at altitude `h` under a sun at `mu_s`.
    #[inline]
    pub fn at(&self, air: &Air<T>, h: T, mu_s: T) -> [Rgb<T>; HARMONICS] {
        self.0.at(sun_coordinate(air, mu_s), (h / air.height).max(T::ZERO).sqrt())
    }

    /// Diffuse irradiance at altitude `h` of a surface whose normal has the cosine `up` to the vertical and `to_sun` to
    /// the sun, with light from the ground in it; W m⁻² nm⁻¹. A cosine lobe hardly has moments beyond degree 2
    /// (Ramamoorthi and Hanrahan 2001).
    ///
    /// Those of a surface that faces up are not the lobe's own: its degree 2 is raised from π/4 to 3π/10, which is
    /// exact for any even light from below, for an even sky, and for one that brightens to the horizon as (1 − μ)³.
    /// Level ground has 2 to 7 % too much light otherwise, which a white ground gives on to each further order.
    pub fn irradiance(&self, air: &Air<T>, h: T, mu_s: T, up: T, to_sun: T) -> Rgb<T> {
        use core::f64::consts::{FRAC_PI_4, PI};
        let level = up.max(T::ZERO) * up.max(T::ZERO);
        let lobe = [T::of(PI), T::of(2.0 * PI / 3.0), T::of(FRAC_PI_4) + T::of(0.3 * PI - FRAC_PI_4) * level];
        let light = self.at(air, h.min(air.height), mu_s);
        blurred(&light, harmonics(up, sunward(up, mu_s, to_sun)), [lobe; 3])
    }
}

impl<T: Light> Multiple<T> for Moments<T> {
    #[inline]
    fn source(&self, air: &Air<T>, densities: [T; 3], at: &SkyRay<T>) -> Rgb<T> {
        let light = self.at(air, at.h, at.mu_s);
        let [first, second] = air.mie_moments;
        let phase = core::array::from_fn(|k| {
            let (rayleigh, mie) = (air.rayleigh[k] * densities[0], air.mie_scattering[k] * densities[1]);
            [rayleigh + mie, mie * first, rayleigh * T::of(0.1) + mie * second]
        });
        blurred(&light, harmonics(at.mu, sunward(at.mu, at.mu_s, at.nu)), phase)
    }

    fn ground_irradiance(&self, air: &Air<T>, mu_s: T) -> Rgb<T> {
        self.irradiance(air, T::ZERO, mu_s, T::ONE, mu_s)
    }
}

/// The light of these moments, each degree weighted by `degrees`, for one direction's harmonics. Never below 0, to which a
/// cut series may swing.
#[inline]
fn blurred<T: Light>(light: &[Rgb<T>; HARMONICS], direction: [T; HARMONICS], degrees: [[T; 3]; 3]) -> Rgb<T> {
    core::array::from_fn(|k| {
        let part = |i: usize| light[i][k] * direction[i];
        let [isotropic, linear, square] = degrees[k];
        (isotropic * part(0) + linear * (part(1) + part(2)) + square * (part(3) + part(4) + part(5))).max(T::ZERO)
    })
}

/// Cosines and sines of ±5.625° and ±16.875°, which part the 45° that a direction stands for evenly.
const FAN: [[f64; 2]; 4] = [
    [0.956_940_335_732_208_9, -0.290_284_677_254_462_33],
    [0.995_184_726_672_196_9, -0.098_017_140_329_560_6],
    [0.995_184_726_672_196_9, 0.098_017_140_329_560_6],
    [0.956_940_335_732_208_9, 0.290_284_677_254_462_33],
];

/// The moments of the light that arrives at altitude `h` under a sun at `mu_s`. The aureole is narrower than the
/// directions are apart. What the air sends varies little between them, so that aerosols' phase alone is summed more
/// finely: without, a wall towards a low sun lacked a quarter of its red light.
fn project<T: Light>(scene: &Scene<T, impl Multiple<T>>, h: T, mu_s: T, steps: usize) -> [Rgb<T>; HARMONICS] {
    let air = scene.air;
    let mut moments = [[T::ZERO; 3]; HARMONICS];
    let mut add = |light: Rgb<T>, weight: T, harmonics: [T; HARMONICS]| {
        for (moment, harmonic) in moments.iter_mut().zip(harmonics) {
            for k in 0..3 {
                moment[k] += light[k] * harmonic * weight;
            }
        }
    };
    for index in 0..DIRECTIONS {
        let Direction { view, sunward, distance, ground, weight } = direction(air, h, mu_s, index);
        let light = scene.gather_all(&view, distance, ground, steps);
        add(light.soft, weight, harmonics(view.mu, sunward));
        if scene.sunlit {
            let aside = (sine(view.mu) * sine(view.mu) - sunward * sunward).max(T::ZERO).sqrt();
            for [cosine, turn] in FAN {
                let x = sunward * T::of(cosine) - aside * T::of(turn);
                let nu = (view.mu * mu_s + x * sine(mu_s)).clamp(-T::ONE, T::ONE);
                let part = weight * T::of(1.0 / FAN.len() as f64) * mie_phase(air.mie_asymmetry, nu);
                add(light.mie, part, harmonics(view.mu, x));
            }
        }
    }
    moments
}

/// What to multiply the last order by, so that all further ones are in it, from the mean light of the last two.
fn geometric_series<T: Light>(before: Rgb<T>, last: Rgb<T>) -> Rgb<T> {
    core::array::from_fn(|k| {
        let ratio = if before[k] > T::ZERO { (last[k] / before[k]).clamp(T::ZERO, T::of(0.95)) } else { T::ZERO };
        T::ONE / (T::ONE - ratio)
    })
}
