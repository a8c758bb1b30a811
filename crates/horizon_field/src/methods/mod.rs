//! The rival ways to march a height field without a cache: what the certified march and the cache are measured against.
//!
//! Each counts its [`Work`], and each is as good as its source lets it be: rays start where they come down to the highest
//! ground and end where they leave it, the last sample lies at the far end, a camera under the ground is noticed at once,
//! and what is printed wrongly is put right. The first three are plain loops over heights, generic over the scalar; in
//! f32 they are the twins of [`WGSL`], which has the same operations in the same order. The last two need bounds and stay
//! on the CPU, in f64.
//!
//! `ground` (what can be marched, [`Setting`]) → one file per method → `picture` (all rays of a camera).

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::march::Ray;
use crate::real::Real;

mod bisection;
mod ground;
mod path;
mod picture;
mod segment;
mod sphere;
mod steps;
mod stretch;
mod work;

#[cfg(test)]
mod tests;

pub use ground::{Ground, HeightField, Setting};
pub use path::MARCH_STEPS;
pub use picture::picture;
pub use work::Work;

use path::{BISECTIONS, Path};
use stretch::Bounded;

/// The twins in WGSL: `march_fixed`, `march_linear` and `march_sphere`. Whoever includes it defines
/// `fn ground(p: vec2<f32>) -> f32`, the height in metres at x and z in metres from the same place as the rays' origins.
pub const WGSL: &str = include_str!("methods.wgsl");

/// A way to find where a ray first meets the ground. Lengths in pixels are shares of a pixel's width at the depth in
/// question.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Method {
    /// Seed 000's march (§3.2.2, eq. 3.4): steps of `a + b·d + c·h`, d metres from the camera and h above the ground, then
    /// bisection, and linear interpolation in what is left. It guarantees nothing.
    FixedStep {
        /// The least step, in metres; at least 0.
        a: f64,
        /// Metres of step per metre of distance; at least 0.
        b: f64,
        /// Metres of step per metre of height above the ground; at least 0. From 1/√(1 + L²) on, with the ground's slope
        /// L, height steps leap through the ground even where `a` and `b` are 0.
        c: f64,
        /// Bisections once the ray is under the ground; at most 64.
        k: u32,
    },
    /// Seed 002's march: steps in proportion to the distance, and linear interpolation. It guarantees nothing.
    Linear {
        /// Metres of step per metre of distance, above 0. Over 30 km the steps run out below 0.003.
        delta: f64,
    },
    /// Sphere tracing (Hart 1996): steps of the height above the ground over √(1 + L²), with the whole field's slope bound
    /// L; it leaps through nothing. Over-relaxation, the stop on screen and the choice of the best candidate are those of
    /// Keinert et al., "Enhanced sphere tracing", STAG 2014.
    SphereTracing {
        /// The over-relaxation: 1 for none, else below 2.
        omega: f64,
        /// A ray that comes this near to the ground meets it; in pixels, above 0. Half a pixel is the pixel's radius.
        pixel: f64,
    },
    /// Segment tracing (Galin et al., "Segment tracing using local Lipschitz bounds", CGF 2020) by octaves: what a
    /// stretch's own bound proves clear is stepped over, where octaves too short for the stretch count by their amplitude
    /// alone. It leaps through nothing that is longer than `pixel`.
    Segment {
        /// A stretch this short is decided by the height at its end; in pixels. 0 for 10⁻⁷ of the distance.
        pixel: f64,
    },
    /// Interval bisection (Mitchell, "Robust ray intersection with interval arithmetic", Graphics Interface 1990), by the
    /// interval of heights under a stretch alone. It leaps through nothing that is longer than `pixel`.
    Bisection {
        /// A stretch this short is decided by the height at its end; in pixels. 0 for 10⁻⁷ of the distance.
        pixel: f64,
    },
}

/// Why a method can't march.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MethodError {
    /// A setting is outside its range.
    #[error("`{method}`: {setting} must be {range}")]
    Range {
        /// The method, with its settings.
        method: Method,
        /// The setting's name.
        setting: &'static str,
        /// What it may be.
        range: &'static str,
    },
}

impl Method {
    /// Refuses settings outside their ranges. What isn't refused ends, if not sooner then after [`MARCH_STEPS`].
    pub fn check(&self) -> Result<(), MethodError> {
        let at_least_0 = |x: f64| x >= 0.0 && x.is_finite();
        let wrong = |setting, range| Err(MethodError::Range { method: *self, setting, range });
        match *self {
            Self::FixedStep { a, .. } if !at_least_0(a) => wrong("a", "at least 0"),
            Self::FixedStep { b, .. } if !at_least_0(b) => wrong("b", "at least 0"),
            Self::FixedStep { c, .. } if !at_least_0(c) => wrong("c", "at least 0"),
            Self::FixedStep { k, .. } if k > BISECTIONS => wrong("k", "at most 64"),
            Self::Linear { delta } if !(at_least_0(delta) && delta > 0.0) => wrong("delta", "above 0"),
            Self::SphereTracing { omega, .. } if !(1.0..2.0).contains(&omega) => wrong("omega", "in [1, 2)"),
            Self::SphereTracing { pixel, .. } if !(at_least_0(pixel) && pixel > 0.0) => wrong("pixel", "above 0"),
            Self::Segment { pixel } | Self::Bisection { pixel } if !at_least_0(pixel) => wrong("pixel", "at least 0"),
            _ => Ok(()),
        }
    }

    /// The distance in metres at which a ray first meets the ground, as this method has it; 0 for a ray that starts under
    /// the ground.
    pub fn cast<G: Ground>(&self, setting: &Setting<'_, G>, ray: &Ray, work: &mut Work) -> Option<f64> {
        match *self {
            Self::Segment { pixel } => segment::march(Bounded { setting, ray, work }, pixel * setting.pixel_angle),
            Self::Bisection { pixel } => bisection::march(Bounded { setting, ray, work }, pixel * setting.pixel_angle),
            _ => self.plain(setting, ray, |q| setting.surface.height(q), work),
        }
    }

    /// The same in single precision, as the device computes it. `None` also for the methods that need bounds.
    pub fn cast_f32<G: Ground>(&self, setting: &Setting<'_, G>, ray: &Ray, work: &mut Work) -> Option<f32> {
        self.plain(setting, ray, |q| setting.surface.height_f32(q), work)
    }

    /// The plain loops over full heights.
    fn plain<T: Real, G: Ground>(
        &self,
        setting: &Setting<'_, G>,
        ray: &Ray,
        height: impl Fn([T; 2]) -> T,
        work: &mut Work,
    ) -> Option<T> {
        let path = Path::new(ray, setting.far, setting.high);
        let traced = match *self {
            Self::FixedStep { a, b, c, k } => steps::fixed(&height, &path, [a, b, c].map(T::of), k),
            Self::Linear { delta } => steps::linear(&height, &path, T::of(delta)),
            Self::SphereTracing { omega, pixel } => {
                let pixel = T::of(pixel * setting.pixel_angle);
                sphere::march(&height, &path, T::of(setting.slope), pixel, T::of(omega))
            }
            Self::Segment { .. } | Self::Bisection { .. } => return None,
        };
        let evaluations = u64::from(traced.evaluations);
        let noise = evaluations * setting.octaves;
        *work += Work { evaluations, noise, bounds: 0, steps: u64::from(traced.steps) };
        traced.t
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FixedStep { a, b, c, k } => write!(f, "fixed step a={a} b={b} c={c} k={k}"),
            Self::Linear { delta } => write!(f, "linear delta={delta}"),
            Self::SphereTracing { omega, pixel } => write!(f, "sphere tracing omega={omega} pixel={pixel}"),
            Self::Segment { pixel } => write!(f, "segment pixel={pixel}"),
            Self::Bisection { pixel } => write!(f, "bisection pixel={pixel}"),
        }
    }
}
