//! What a ray meets in a layer. WGSL twin: `march.wgsl`.
//!
//! The ray is cut into cells that are fixed to the span of the layer that it crosses, not to where it starts or what ends it, and the
//! medium is taken as even in each. So transmittance is the product of its parts wherever a segment is divided, and a mesh that moves
//! in a cloud shifts no sample. Light of an even cell is integrated in closed form, S(1 − e^{−σs})/σ: at any step it neither gains
//! nor loses energy. The source S is taken where the cell is seen from in the mean: near its front, if it is opaque.

use super::density::{Cloud, CloudPoint, Weather};
use super::layer::CloudModel;
use super::span::{FARTHEST, Span};
use super::volume::{CloudVolume, TEXELS};
use crate::geometry::advance;
use crate::models::scatter::faded;
use crate::profile::Light;
use horizon_field::Real;

/// Cells that a march takes at most.
pub const MOST_STEPS: u32 = 1024;

/// The mip whose blocks are skipped: 4 texels wide.
pub const SKIP_MIP: usize = 2;

/// A view ray, or one towards the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudRay<T> {
    /// The planet's radius in metres, 0 for a plane.
    pub radius: T,
    /// Where it starts.
    pub from: CloudPoint<T>,
    /// Its direction, of length 1.
    pub toward: [T; 3],
}

impl<T: Real> CloudRay<T> {
    /// Cosine between the local vertical and the ray at its start.
    #[inline]
    pub fn mu(&self) -> T {
        let ([x, y, z], [a, b, c]) = (self.from.up, self.toward);
        (x * a + y * b + z * c).clamp(-T::ONE, T::ONE)
    }

    /// The point after `distance` metres.
    #[inline]
    pub fn point(&self, distance: T) -> CloudPoint<T> {
        let CloudPoint { at, up, altitude } = self.from;
        let at = core::array::from_fn(|k| at[k] + distance * self.toward[k]);
        let mu = self.mu();
        if self.radius <= T::ZERO {
            return CloudPoint { at, up, altitude: altitude + mu * distance };
        }
        let (above, _) = advance(self.radius, altitude, mu, distance);
        let [from, now] = [self.radius + altitude, self.radius + above];
        let up = core::array::from_fn(|k| (up[k] * from + distance * self.toward[k]) / now);
        CloudPoint { at, up, altitude: above }
    }

    /// Where it is in the layer.
    pub fn spans(&self, cloud: &Cloud<T>) -> [Span<T>; 2] {
        super::span::spans(self.radius, cloud.base, cloud.base + cloud.thickness, self.from.altitude, self.mu())
    }

    /// How far the ray finds no cloud from `distance` on, in the block there: a distance not less.
    pub fn empty_until(&self, cloud: &Cloud<T>, volume: &CloudVolume, distance: T, most: &Weather<T>) -> T {
        // A sheet's blocks stand upright: the ray's way through them is another.
        if cloud.model == CloudModel::Sheet {
            return distance;
        }
        let point = self.point(distance);
        let blocks = T::of_u32((TEXELS >> SKIP_MIP) as u32);
        let u = cloud.shape_at(&point).map(|u| u * blocks);
        let mut until = T::of(FARTHEST);
        for (u, toward) in u.into_iter().zip(self.toward) {
            let (speed, part) = (toward * cloud.per_shape * blocks, u - u.floor());
            if speed > T::ZERO {
                until = until.min((T::ONE - part) / speed);
            } else if speed < T::ZERO {
                until = until.min(part / -speed);
            }
        }
        let end = self.point(distance + until);
        let (a, b) = (cloud.height(point.altitude), cloud.height(end.altitude));
        // Between its ends a straight ray sinks by d²/(8R) at most.
        let sag =
            if self.radius > T::ZERO { until * until / (T::of(8.0) * self.radius * cloud.thickness) } else { T::ZERO };
        let block = Cloud::block(cloud.shape_at(&point), SKIP_MIP);
        let bound = cloud.most(volume, block, SKIP_MIP, a.min(b) - sag, a.max(b), most);
        if bound > T::ZERO { distance } else { distance + until }
    }
}

/// How a span is cut into cells: after u of them the ray is at a·u + b·u²/2 metres from its start, less the jitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps<T> {
    /// Length of the first cell, in metres, more than 0.
    pub first: T,
    /// By how much each is longer than the last, in metres, at least 0.
    pub growth: T,
    /// By which part of a cell all are shifted towards the camera: 0 to 1, from blue noise.
    pub jitter: T,
}

impl<T: Real> Steps<T> {
    /// `count` cells of equal length over a span.
    pub fn even(span: Span<T>, count: u32, jitter: T) -> Self {
        let length = (span[1] - span[0]).max(T::of(1e-3));
        Self { first: length / T::of_u32(count.clamp(1, MOST_STEPS)), growth: T::ZERO, jitter }
    }

    /// Where cell `k` starts, from the span's start.
    #[inline]
    fn start(&self, k: u32) -> T {
        let u = (T::of_u32(k) - self.jitter).max(T::ZERO);
        u * (self.first + T::of(0.5) * self.growth * u)
    }

    /// The cell that holds a distance ≥ 0 from the span's start.
    #[inline]
    fn cell(&self, distance: T) -> u32 {
        let two = T::of(2.0);
        let root = (self.first * self.first + two * self.growth * distance).sqrt();
        let u = two * distance / (self.first + root) + self.jitter;
        u.floor().min(T::of_u32(MOST_STEPS)).to_i64() as u32
    }
}

/// Where in a cell of optical depth `x` what leaves it comes from in the mean: 1/x − 1/(eˣ − 1), from ½ to 0.
#[inline]
pub fn seen_at<T: Light>(x: T) -> T {
    if x < T::of(0.1) { T::of(0.5) - x * T::of(1.0 / 12.0) } else { T::ONE / x - T::ONE / (x.exp() - T::ONE) }
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marched<T> {
    /// Light that comes out of the cloud, in the unit of the sources.
    pub light: [T; 3],
    /// What is left of what lies behind.
    pub transmittance: T,
    /// Distance of what was met, weighed by what it took; 0 if nothing was.
    pub depth: T,
    /// Cells that were sampled.
    pub samples: u32,
}

impl<T: Real> Marched<T> {
    /// Before the first span.
    pub fn new() -> Self {
        Self { light: [T::ZERO; 3], transmittance: T::ONE, depth: T::ZERO, samples: 0 }
    }
}

impl<T: Real> Default for Marched<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Light> Marched<T> {
    /// Goes on through the part of `span` that lies in `cut`, until less than `least` is left of what lies behind. At distances along
    /// the ray, `empty_until` says how far there is nothing; `extinction`, per metre, is asked in the middle of a cell; `source`, light
    /// sent towards the eye per extinction, where the cell is seen, with the extinction found.
    pub fn through(
        &mut self,
        span: Span<T>,
        cut: Span<T>,
        steps: &Steps<T>,
        least: T,
        mut empty_until: impl FnMut(T) -> T,
        mut extinction: impl FnMut(T) -> T,
        mut source: impl FnMut(T, T) -> [T; 3],
    ) {
        let [near, far] = [span[0].max(cut[0]), span[1].min(cut[1])];
        if far <= near {
            return;
        }
        let met = T::ONE - self.transmittance;
        let mut moment = self.depth * met;
        let length = span[1] - span[0];
        let mut k = steps.cell(near - span[0]);
        while k < MOST_STEPS {
            let [start, end] = [steps.start(k), steps.start(k + 1).min(length)];
            let [from, to] = [(span[0] + start).max(near), (span[0] + end).min(far)];
            if span[0] + start >= far || self.transmittance < least {
                break;
            }
            let middle = span[0] + T::of(0.5) * (start + end);
            k += 1;
            if to <= from {
                continue;
            }
            let empty = empty_until(middle);
            if empty > middle {
                k = k.max(steps.cell((empty - span[0]).max(T::ZERO)));
                continue;
            }
            let found = extinction(middle);
            self.samples += 1;
            if found <= T::ZERO {
                continue;
            }
            let light = source(span[0] + start + (end - start) * seen_at(found * (end - start)), found);
            let depth = found * (to - from);
            let gathered = self.transmittance * depth * faded(depth);
            for (sum, light) in self.light.iter_mut().zip(light) {
                *sum += gathered * light;
            }
            let left = self.transmittance * (-depth).exp();
            moment += (self.transmittance - left) * middle;
            self.transmittance = left;
        }
        let met = T::ONE - self.transmittance;
        self.depth = if met > T::ZERO { moment / met } else { T::ZERO };
    }
}
