//! Functions of one number, which shape heights: all are continuous and never fall. `curve.wgsl` is the twin.

use crate::real::Real;

/// The WGSL twin: one function per curve, which returns the value and the slope.
pub(super) const WGSL: &str = include_str!("curve.wgsl");

/// A curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Curve {
    /// Limited to a range.
    Clamp { low: f64, high: f64 },
    /// 0 below `low`, 1 above the height that lies 1/`inverse` higher, linear between.
    Ramp { low: f64, inverse: f64 },
    /// As the ramp, but by the smoothstep 3t² − 2t³, whose slope is continuous.
    Step { low: f64, inverse: f64 },
    /// With t = u/step = k + f: step · (k + f + s (3f² − 2f³ − f)). The slope is 1 − s between any two steps.
    Terrace { step: f64, inverse: f64, sharpness: f64 },
    /// The polynomial smooth minimum of u and 0: u below −r, 0 above r, −(r − u)²/4r between; `quarter` is 1/4r.
    Round { radius: f64, quarter: f64 },
}

/// What is proven of a curve over an interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurveBound {
    /// The smallest and the largest value.
    pub value: [f64; 2],
    /// The smallest and the largest slope.
    pub slope: [f64; 2],
    /// The largest second derivative, as an absolute value; infinite where the slope jumps.
    pub curvature: f64,
}

impl Curve {
    pub(super) fn ramp(low: f64, high: f64) -> Self {
        Self::Ramp { low, inverse: 1.0 / (high - low) }
    }

    pub(super) fn step(low: f64, high: f64) -> Self {
        Self::Step { low, inverse: 1.0 / (high - low) }
    }

    pub(super) fn terrace(step: f64, sharpness: f64) -> Self {
        Self::Terrace { step, inverse: 1.0 / step, sharpness }
    }

    pub(super) fn round(radius: f64) -> Self {
        Self::Round { radius, quarter: 0.25 / radius }
    }

    /// The function's name in WGSL.
    pub(super) const fn function(&self) -> &'static str {
        match self {
            Self::Clamp { .. } => "curve_clamp",
            Self::Ramp { .. } => "curve_ramp",
            Self::Step { .. } => "curve_step",
            Self::Terrace { .. } => "curve_terrace",
            Self::Round { .. } => "curve_round",
        }
    }

    /// The numbers, in the order in which the WGSL function takes them.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match *self {
            Self::Clamp { low, high } => vec![low, high],
            Self::Ramp { low, inverse } | Self::Step { low, inverse } => vec![low, inverse],
            Self::Terrace { step, inverse, sharpness } => vec![step, inverse, sharpness],
            Self::Round { radius, quarter } => vec![radius, quarter],
        }
    }

    /// The value and the slope at `u`.
    #[inline]
    pub(super) fn at<T: Real>(&self, u: T) -> [T; 2] {
        let inside = |yes: bool, slope: T| if yes { slope } else { T::ZERO };
        match *self {
            Self::Clamp { low, high } => {
                let (low, high) = (T::of(low), T::of(high));
                [u.clamp(low, high), inside(u > low && u < high, T::ONE)]
            }
            Self::Ramp { low, inverse } => {
                let inverse = T::of(inverse);
                let t = (u - T::of(low)) * inverse;
                [t.clamp(T::ZERO, T::ONE), inside(t > T::ZERO && t < T::ONE, inverse)]
            }
            Self::Step { low, inverse } => {
                let inverse = T::of(inverse);
                let t = ((u - T::of(low)) * inverse).clamp(T::ZERO, T::ONE);
                [t * t * (T::of(3.0) - T::of(2.0) * t), T::of(6.0) * t * (T::ONE - t) * inverse]
            }
            Self::Terrace { step, inverse, sharpness } => {
                let sharpness = T::of(sharpness);
                let t = u * T::of(inverse);
                let k = t.floor();
                let f = t - k;
                let shaped = f + sharpness * (f * f * (T::of(3.0) - T::of(2.0) * f) - f);
                [(k + shaped) * T::of(step), T::ONE + sharpness * (T::of(6.0) * f * (T::ONE - f) - T::ONE)]
            }
            Self::Round { radius, quarter } => {
                let (radius, quarter) = (T::of(radius), T::of(quarter));
                let left = radius - u;
                if u <= -radius {
                    [u, T::ONE]
                } else if u >= radius {
                    [T::ZERO, T::ZERO]
                } else {
                    [-(left * left * quarter), T::of(2.0) * left * quarter]
                }
            }
        }
    }

    /// What is proven for all u in `[low, high]`. No curve falls, so the ends bound the value.
    pub(super) fn bound(&self, low: f64, high: f64) -> CurveBound {
        let ends = [self.at(low), self.at(high)];
        let value = [ends[0][0].min(ends[1][0]), ends[0][0].max(ends[1][0])];
        let slopes = [ends[0][1].min(ends[1][1]), ends[0][1].max(ends[1][1])];
        // A ridge of slope `peak` halfway: it counts where the interval holds it.
        let ridge = |holds: bool, peak: f64| [slopes[0], if holds { peak } else { slopes[1] }];
        let (slope, curvature) = match *self {
            Self::Clamp { low: from, high: to } => broken([low, high], [from, to], 1.0),
            Self::Ramp { low: from, inverse } => broken([low, high].map(|u| (u - from) * inverse), [0.0, 1.0], inverse),
            Self::Step { low: from, inverse } => {
                let t = [low, high].map(|u| ((u - from) * inverse).clamp(0.0, 1.0));
                let steepest = (1.0 - 2.0 * t[0]).abs().max((1.0 - 2.0 * t[1]).abs());
                let curvature = if t[0] == t[1] { 0.0 } else { 6.0 * steepest * inverse * inverse };
                (ridge(t[0] <= 0.5 && t[1] >= 0.5, 1.5 * inverse), curvature)
            }
            Self::Terrace { inverse, sharpness, .. } => {
                let t = [low * inverse, high * inverse];
                let k = t[0].floor();
                if t[1].floor() == k {
                    let f = t.map(|t| t - k);
                    let steepest = (1.0 - 2.0 * f[0]).abs().max((1.0 - 2.0 * f[1]).abs());
                    let slope = ridge(f[0] <= 0.5 && f[1] >= 0.5, 1.0 + 0.5 * sharpness);
                    (slope, 6.0 * sharpness * inverse * steepest)
                } else {
                    ([1.0 - sharpness, 1.0 + 0.5 * sharpness], 6.0 * sharpness * inverse)
                }
            }
            Self::Round { radius, quarter } => {
                let blended = low < radius && high > -radius;
                (slopes, if blended { 2.0 * quarter } else { 0.0 })
            }
        };
        CurveBound { value, slope, curvature }
    }

    /// The largest number that is met on the way to a value, besides u and the value: what rounding is relative to.
    pub(super) fn scale(&self) -> f64 {
        match *self {
            Self::Clamp { .. } => 0.0,
            Self::Ramp { .. } | Self::Step { .. } => 1.0,
            Self::Terrace { step, .. } => step,
            Self::Round { radius, .. } => radius,
        }
    }

    /// The largest slope anywhere.
    pub(super) fn steepest(&self) -> f64 {
        match *self {
            Self::Clamp { .. } | Self::Round { .. } => 1.0,
            Self::Ramp { inverse, .. } => inverse,
            Self::Step { inverse, .. } => 1.5 * inverse,
            Self::Terrace { sharpness, .. } => 1.0 + 0.5 * sharpness,
        }
    }
}

/// Slope and curvature of a curve that is level outside `[from, to]` and has this slope inside.
fn broken([low, high]: [f64; 2], [from, to]: [f64; 2], slope: f64) -> ([f64; 2], f64) {
    if low > from && high < to {
        ([slope; 2], 0.0)
    } else if high <= from || low >= to {
        ([0.0; 2], 0.0)
    } else {
        ([0.0, slope], f64::INFINITY)
    }
}
