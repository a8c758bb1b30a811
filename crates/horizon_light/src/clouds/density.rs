//! How dense a cloud is, from 0 to 1. WGSL twin: `density.wgsl`.
//!
//! Every model makes a base density of one number of noise that only grows with it, and fine noise then takes away from it. So
//! the base density of the most noise in a block bounds all density there: [`Cloud::most`].

use super::layer::{CloudLayer, CloudModel};
use super::phase::Phase;
use super::volume::{CloudVolume, MIPS, TEXELS};
use horizon_field::{CELL, Place, Real};

/// Over which part of the layer's thickness billows grow from their flat base.
pub const RISE: f64 = 0.07;
/// From where to where billows end, of the layer's thickness: of kind 0, then of kind 1.
pub const FALL: [[f64; 2]; 2] = [[0.15, 0.3], [0.35, 1.0]];
/// Over which part of the thickness, as its inverse, erosion turns from wisps at a billow's base to heaps.
pub const TURN: f64 = 5.0;

/// What the weather is at a place: numbers of the layer, or of whatever the host binds to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weather<T> {
    /// Which part of the noise is cloud, 0 to 1.
    pub coverage: T,
    /// From a deck, 0, to heaps, 1.
    pub kind: T,
}

/// A place in or about a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudPoint<T> {
    /// In metres from the place that the cloud was made for.
    pub at: [T; 3],
    /// The local vertical, of length 1.
    pub up: [T; 3],
    /// Altitude in metres.
    pub altitude: T,
}

/// A [`CloudLayer`] at a moment, seen from a place; the shader's `Cloud`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cloud<T> {
    /// Where shapes are, in their periods, for a point at the place itself: 0 to 1.
    pub offset: [T; 3],
    /// Shapes' periods per metre.
    pub per_shape: T,
    /// The same of the fine noise.
    pub detail_offset: [T; 3],
    /// Its periods per metre.
    pub per_detail: T,
    /// Altitude of the lower face, in metres.
    pub base: T,
    /// From face to face, in metres.
    pub thickness: T,
    /// Extinction where density is 1, per metre.
    pub extinction: T,
    /// Over how much of the noise's range density grows from 0 to 1.
    pub softness: T,
    /// How deep fine noise eats into the edges.
    pub erosion: T,
    /// How density comes about: in the shader 0, 1, 2 in the order of [`CloudModel`].
    pub model: CloudModel,
    /// The weather where nothing else is bound.
    pub weather: Weather<T>,
    /// Where droplets scatter light to.
    pub phase: Phase<T>,
}

/// The part of a period after `metres` from `place` along an axis, 0 to 1. Whole cells are taken apart exactly, so that neither the
/// place nor time costs digits.
fn periods(place: &Place, axis: usize, metres: f64, period: f64) -> f64 {
    let cells = libm::fmod(place.cell[axis] as f64 * CELL, period);
    let x = (cells + libm::fmod(place.offset[axis], period) + libm::fmod(metres, period)) / period;
    let part = x - x.floor();
    if part < 1.0 { part } else { 0.0 }
}

impl<T: Real> Cloud<T> {
    /// A layer that passes [`CloudLayer::check`], for points near `place`, after `seconds`.
    pub fn new(layer: &CloudLayer, place: &Place, seconds: f64) -> Self {
        let drift = layer.drift(seconds);
        let rise = f64::from(layer.evolution) * seconds;
        let of = |x: f32| T::of(f64::from(x));
        let [size, detail] = [layer.size, layer.detail].map(f64::from);
        Self {
            offset: [0, 1, 2].map(|k| T::of(periods(place, k, -drift[k], size))),
            per_shape: T::of(1.0 / size),
            detail_offset: [0, 1, 2].map(|k| {
                let rise = if k == 1 { rise } else { 0.0 };
                T::of(periods(place, k, -drift[k] - rise, detail))
            }),
            per_detail: T::of(1.0 / detail),
            base: of(layer.base),
            thickness: of(layer.top - layer.base),
            extinction: of(layer.extinction),
            softness: of(layer.softness),
            erosion: of(layer.erosion),
            model: layer.model,
            weather: Weather { coverage: of(layer.coverage), kind: of(layer.kind) },
            phase: Phase::new(layer),
        }
    }

    /// Height in the layer: 0 at its lower face, 1 at its upper one.
    #[inline]
    pub fn height(&self, altitude: T) -> T {
        (altitude - self.base) / self.thickness
    }

    /// Base density of the volume's `noise`, at the heights from `low` to `high`: at most. At one height it is the density there,
    /// before erosion.
    #[inline]
    pub fn base_density(&self, noise: [T; 3], low: T, high: T, weather: &Weather<T>) -> T {
        let (one, half) = (T::ONE, T::of(0.5));
        if high < T::ZERO || low > one {
            return T::ZERO;
        }
        let least = one - weather.coverage.clamp(T::ZERO, one);
        let above = match self.model {
            CloudModel::Sheet => noise[1] - least,
            CloudModel::Slab => {
                let off = (low - half).max(half - high).max(T::ZERO);
                T::of(2.0) * (noise[1] - least - off)
            }
            CloudModel::Billow => {
                let kind = weather.kind.clamp(T::ZERO, one);
                let [from, to] = [0, 1].map(|i| T::of(FALL[0][i]) + T::of(FALL[1][i] - FALL[0][i]) * kind);
                let rise = high * T::of(1.0 / RISE);
                let fall = (to - low) / (to - from);
                noise[0] * rise.min(fall).clamp(T::ZERO, one) - least
            }
        };
        (above / self.softness).clamp(T::ZERO, one)
    }

    /// What fine noise of `billows` leaves of a base density.
    #[inline]
    pub fn eroded(&self, base: T, billows: T, height: T) -> T {
        let turn =
            if self.model == CloudModel::Billow { (height * T::of(TURN)).clamp(T::ZERO, T::ONE) } else { T::ONE };
        let lost = self.erosion * (billows + turn * (T::ONE - billows - billows));
        ((base - lost) / (T::ONE - lost)).clamp(T::ZERO, T::ONE)
    }

    /// Where in the volume a point's shape is found, in periods.
    #[inline]
    pub fn shape_at(&self, point: &CloudPoint<T>) -> [T; 3] {
        // A sheet is alike along the vertical.
        let lift = if self.model == CloudModel::Sheet { point.altitude - self.base } else { T::ZERO };
        core::array::from_fn(|k| (point.at[k] - lift * point.up[k]) * self.per_shape + self.offset[k])
    }

    /// Density at a point, from 0 to 1.
    pub fn density(&self, volume: &CloudVolume, point: &CloudPoint<T>, weather: &Weather<T>) -> T {
        let height = self.height(point.altitude);
        if height < T::ZERO || height > T::ONE {
            return T::ZERO;
        }
        let base = self.base_density(volume.sample(self.shape_at(point)), height, height, weather);
        if base <= T::ZERO || self.erosion <= T::ZERO {
            return base;
        }
        let fine = core::array::from_fn(|k| point.at[k] * self.per_detail + self.detail_offset[k]);
        self.eroded(base, volume.sample(fine)[2], height)
    }

    /// Coarse bound: the most density in the volume's block of `mip` that holds a point, at the heights from `low` to `high`, under no
    /// more than this coverage and kind.
    pub fn most(&self, volume: &CloudVolume, block: [i64; 3], mip: usize, low: T, high: T, weather: &Weather<T>) -> T {
        self.base_density(volume.most(block, mip), low, high, weather)
    }

    /// The block of `mip` at `u` periods.
    #[inline]
    pub fn block(u: [T; 3], mip: usize) -> [i64; 3] {
        let blocks = T::of_u32((TEXELS >> mip.min(MIPS - 1)) as u32);
        u.map(|u| (u * blocks).floor().to_i64())
    }
}

impl Cloud<f32> {
    /// The shader's `Cloud`, word by word.
    pub fn words(&self) -> [u32; 20] {
        let [a, b, c] = self.offset.map(f32::to_bits);
        let [d, e, f] = self.detail_offset.map(f32::to_bits);
        let Phase { forward, other, alpha, share } = self.phase;
        let [forward, other, alpha, share] = [forward, other, alpha, share].map(f32::to_bits);
        let [per_shape, per_detail, base, thickness, extinction, softness, erosion] =
            [self.per_shape, self.per_detail, self.base, self.thickness, self.extinction, self.softness, self.erosion]
                .map(f32::to_bits);
        let [coverage, kind] = [self.weather.coverage, self.weather.kind].map(f32::to_bits);
        let model = self.model as u32;
        [
            a, b, c, per_shape, d, e, f, per_detail, base, thickness, extinction, softness, erosion, model, coverage,
            kind, forward, other, alpha, share,
        ]
    }
}
