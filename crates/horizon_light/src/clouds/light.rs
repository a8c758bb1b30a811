//! The sun's light in a cloud. WGSL twin: `light.wgsl`.
//!
//! Scattered once, light at a point is the sun's, less what lies between. What was scattered more often is taken as octaves of the
//! same (Wrenninge, Kulla and Lundqvist 2013, *Oz: the great and volumetric*): each with less of the light, less extinction towards the
//! sun, and a flatter phase function. The octaves' constants are fitted to the reference: `tests::truth` has the errors.

use super::density::{Cloud, Weather};
use super::march::{CloudRay, Marched, Sample, Steps};
use super::phase::Phase;
use super::span::Span;
use super::volume::CloudVolume;
use crate::profile::Light;
use horizon_field::Real;

/// Octaves of light.
pub const OCTAVES: usize = 6;

/// How octaves differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves<T> {
    /// How many, 1 to [`OCTAVES`]; 1 is light scattered once.
    pub count: usize,
    /// Light of each against the last.
    pub light: T,
    /// Extinction towards the sun of each against the last.
    pub extinction: T,
    /// The phase function's asymmetry of each against the last.
    pub asymmetry: T,
}

impl<T: Real> Octaves<T> {
    /// Scattered once.
    pub fn once() -> Self {
        Self { count: 1, light: T::ZERO, extinction: T::ONE, asymmetry: T::ONE }
    }

    /// As fitted.
    pub fn fitted() -> Self {
        Self { count: OCTAVES, light: T::of(LIGHT), extinction: T::of(EXTINCTION), asymmetry: T::of(ASYMMETRY) }
    }

    /// Light per irradiance and scattering, per steradian, behind an optical depth towards the sun, where it turns by an angle of
    /// cosine `nu`.
    #[inline]
    pub fn source(&self, phase: &Phase<T>, nu: T, depth: T) -> T
    where
        T: Light,
    {
        let (mut sum, mut light, mut extinction, mut asymmetry) = (T::ZERO, T::ONE, T::ONE, T::ONE);
        for _ in 0..self.count.min(OCTAVES) {
            sum += light * phase.flattened(asymmetry).at(nu) * (-extinction * depth).exp();
            light = light * self.light;
            extinction = extinction * self.extinction;
            asymmetry = asymmetry * self.asymmetry;
        }
        sum
    }
}

/// [`Octaves::light`] as fitted.
pub const LIGHT: f64 = 0.5;
/// [`Octaves::extinction`] as fitted.
pub const EXTINCTION: f64 = 0.4;
/// [`Octaves::asymmetry`] as fitted.
pub const ASYMMETRY: f64 = 0.6;

/// Optical depth along a ray towards the sun, through its spans up to `reach` metres. Samples, at least 1, lie closer near its start,
/// where depth matters most.
pub fn sun_depth<T: Real>(spans: [Span<T>; 2], samples: u32, reach: T, mut extinction: impl FnMut(T) -> T) -> T {
    let mut depth = T::ZERO;
    let per = T::ONE / T::of_u32(samples.max(1));
    for [near, far] in spans {
        let length = far.min(reach) - near;
        if length <= T::ZERO {
            continue;
        }
        for i in 0..samples.max(1) {
            // From x² to (x + 1/n)² of the way, sampled in the middle.
            let [a, b] = [i, i + 1].map(|i| T::of_u32(i) * per);
            depth += (b - a) * (b + a) * length * extinction(near + T::of(0.5) * (a * a + b * b) * length);
        }
    }
    depth
}

/// How a ray is marched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudQuality<T> {
    /// Cells over each span.
    pub steps: u32,
    /// Samples towards the sun.
    pub sun_samples: u32,
    /// How far is looked towards the sun, in metres.
    pub reach: T,
    /// By which part of a cell all are shifted: 0 to 1.
    pub jitter: T,
    /// Of what lies behind: less is nothing.
    pub least: T,
    /// Light scattered more than once.
    pub octaves: Octaves<T>,
}

/// A cloud seen along a ray, as far as `cut` says, under a sun in the direction `sun` of an irradiance of 1. `weather` is asked at
/// points; `most` bounds all its answers.
pub fn seen<T: Light>(
    cloud: &Cloud<T>,
    volume: &CloudVolume,
    ray: &CloudRay<T>,
    cut: Span<T>,
    sun: [T; 3],
    quality: &CloudQuality<T>,
    weather: impl Fn([T; 3]) -> Weather<T>,
    most: &Weather<T>,
) -> Marched<T> {
    let mut marched = Marched::new();
    let nu = (0..3).fold(T::ZERO, |sum, k| sum + ray.toward[k] * sun[k]).clamp(-T::ONE, T::ONE);
    for span in ray.spans(cloud) {
        let steps = Steps::even(span, quality.steps, quality.jitter);
        marched.through(
            span,
            cut,
            &steps,
            quality.least,
            |distance| ray.empty_until(cloud, volume, distance, most),
            |distance| {
                let point = ray.point(distance);
                let extinction = cloud.extinction * cloud.density(volume, &point, &weather(point.at));
                if extinction <= T::ZERO {
                    return Sample { extinction, source: [T::ZERO; 3] };
                }
                let from = CloudRay { from: point, toward: sun, ..*ray };
                let depth = sun_depth(from.spans(cloud), quality.sun_samples, quality.reach, |distance| {
                    let point = from.point(distance);
                    cloud.extinction * cloud.density(volume, &point, &weather(point.at))
                });
                Sample { extinction, source: [extinction * quality.octaves.source(&cloud.phase, nu, depth); 3] }
            },
        );
    }
    marched
}
