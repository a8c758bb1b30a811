//! The look of a place, generic over f32 and f64, by the same operations in the same order as `material.wgsl`.

use super::MAX_LAYERS;
use super::compile::{CUTOFF, CompiledMaterial, MaterialAnchors, WIDENING};
use super::resolve::{Band, Layer, Strata};
use crate::field::{Anchors, Compiled};
use crate::hash::pcg;
use crate::real::Real;

/// How a place of the ground looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look<T> {
    /// The albedo, linear.
    pub albedo: [T; 3],
    /// The perceptual roughness.
    pub roughness: T,
    /// The reflectance, as Bevy's standard material has it.
    pub reflectance: T,
    /// How much of the place shows the base, then each layer; together 1.
    pub shares: [T; 1 + MAX_LAYERS],
}

/// A place of a height field.
#[derive(Clone, Copy, Debug)]
pub struct GroundPoint<'a, T> {
    /// The height.
    pub height: &'a Compiled<2>,
    /// Where its lattices lie at an anchor.
    pub anchors: &'a Anchors<2>,
    /// From the anchor, in metres.
    pub q: [T; 2],
    /// The side of the square of ground that is looked at, in metres: what is finer counts by its mean. 0 for a point.
    pub texel: T,
}

/// What the rules ask of a place.
struct Ground<T> {
    height: T,
    /// The normal's y.
    up: T,
    /// The heights that its slope spans, as what they widen edges by; and that of its cut-off, in metres.
    relief: T,
    span: T,
    curvature: T,
    /// Each field's value, and by how much it widens edges, squared.
    values: Vec<[T; 2]>,
}

impl CompiledMaterial {
    /// The look at a point, whose noises and masks have these anchors.
    pub fn look<T: Real>(&self, anchors: &MaterialAnchors, at: &GroundPoint<T>) -> Look<T> {
        let ground = self.ground(anchors, at);
        let mut look =
            Look { albedo: [T::ZERO; 3], roughness: T::ZERO, reflectance: T::ZERO, shares: [T::ZERO; 1 + MAX_LAYERS] };
        for (i, layer) in self.layers.iter().enumerate() {
            let weight = layer.weight(&ground);
            let albedo = layer.albedo(&ground);
            let mix = |a: T, b: T| a * (T::ONE - weight) + b * weight;
            look.albedo = core::array::from_fn(|k| mix(look.albedo[k], albedo[k]));
            look.roughness = mix(look.roughness, T::of(layer.roughness));
            look.reflectance = mix(look.reflectance, T::of(layer.reflectance));
            look.shares[..i].iter_mut().for_each(|share| *share *= T::ONE - weight);
            look.shares[i] = weight;
        }
        look
    }

    fn ground<T: Real>(&self, anchors: &MaterialAnchors, at: &GroundPoint<T>) -> Ground<T> {
        let cutoff = T::of(CUTOFF) * at.texel;
        let jet = at.height.jet(at.anchors, at.q, cutoff);
        let slope = (jet.g[0] * jet.g[0] + jet.g[1] * jet.g[1]).sqrt();
        let spread = at.texel * slope;
        let value = |(field, anchors): (&super::compile::LayerField, &Anchors<2>)| {
            let v = field.field.jet(anchors, at.q, cutoff);
            let steep = v.g[0] * v.g[0] + v.g[1] * v.g[1];
            let lost = T::of(field.widening(cutoff.f64()));
            [v.v, lost + T::of(field.steepness()) * at.texel * at.texel * steep]
        };
        Ground {
            height: jet.v,
            up: T::ONE / (T::ONE + slope * slope).sqrt(),
            relief: T::of(WIDENING / 12.0) * spread * spread,
            span: cutoff * slope,
            curvature: if self.is_curved() { self.curvature(at, cutoff) } else { T::ZERO },
            values: self.fields.iter().zip(&anchors.0).map(value).collect(),
        }
    }

    /// How much the slope grows over the material's scale, in f32 and f64 alike: the Laplacian by differences of gradients.
    fn curvature<T: Real>(&self, at: &GroundPoint<T>, cutoff: T) -> T {
        let scale = T::of(self.curvature_scale);
        let span = scale.max(cutoff);
        let half = T::of(0.5) * span;
        let mut sum = T::ZERO;
        for (axis, side) in [(0, half), (0, -half), (1, half), (1, -half)] {
            let mut q = at.q;
            q[axis] += side;
            let slope = at.height.jet(at.anchors, q, span).g[axis];
            sum += if side > T::ZERO { slope } else { -slope };
        }
        sum * (scale / span)
    }
}

fn ramp<T: Real>(x: T, half_width: T) -> T {
    let t = (T::of(0.5) * x / half_width + T::of(0.5)).clamp(T::ZERO, T::ONE);
    t * t * (T::of(3.0) - T::of(2.0) * t)
}

impl Band {
    /// How much of a place lies in the range. The difference of two steps: as they widen, the share of the range stays.
    fn of<T: Real>(&self, x: T, widening: T) -> T {
        let half_width = (T::of(self.soft) + widening).sqrt();
        (ramp(x - T::of(self.low), half_width) - ramp(x - T::of(self.high), half_width)).max(T::ZERO)
    }

    /// As [`Band::of`], of a value to which the range's field is added.
    fn shifted<T: Real>(&self, x: T, widening: T, values: &[[T; 2]]) -> T {
        let shift = T::of(self.shift);
        let [v, w] = values[self.field];
        self.of(x + shift * v, widening + shift * shift * w)
    }
}

impl Strata {
    fn of<T: Real>(&self, ground: &Ground<T>) -> T {
        let per_metre = T::of(self.per_metre);
        let s = (ground.height + T::of(self.shift) * ground.values[self.field][0]) * per_metre;
        let fade = (T::ONE / (per_metre * ground.span.max(T::of(1e-20))) - T::ONE).clamp(T::ZERO, T::ONE);
        let half = T::of(0.5);
        half + (bands(s) - half) * fade
    }
}

/// Value noise along the height.
fn bands<T: Real>(s: T) -> T {
    let whole = s.floor();
    let f = s - whole;
    let value = |cell: i64| T::of_u32(pcg(cell as u32) >> 8) / T::of(16_777_215.0);
    let (a, b) = (value(whole.to_i64()), value(whole.to_i64() + 1));
    let smooth = f * f * f * (f * (f * T::of(6.0) - T::of(15.0)) + T::of(10.0));
    a + (b - a) * smooth
}

impl Layer {
    /// How much of a place the layer covers.
    fn weight<T: Real>(&self, ground: &Ground<T>) -> T {
        let values = &ground.values;
        let rules = [
            self.height.map(|band| band.shifted(ground.height, ground.relief, values)),
            self.slope.map(|band| band.shifted(ground.up, T::ZERO, values)),
            self.curvature.map(|band| band.of(ground.curvature, T::ZERO)),
            self.noise.map(|band| band.shifted(T::ZERO, T::ZERO, values)),
            self.mask.map(|band| band.shifted(T::ZERO, T::ZERO, values)),
            self.strata.map(|strata| strata.of(ground)),
        ];
        rules.into_iter().flatten().fold(T::ONE, |weight, rule| weight * rule)
    }

    fn albedo<T: Real>(&self, ground: &Ground<T>) -> [T; 3] {
        let Some(tint) = self.tint else { return self.colour.map(T::of) };
        let [v, w] = ground.values[tint.field];
        let mix = ramp(v, (T::of(tint.soft) + w).sqrt());
        core::array::from_fn(|k| T::of(self.colour[k]) * (T::ONE - mix) + T::of(tint.second[k]) * mix)
    }
}

impl Look<f32> {
    /// The four bytes that a cache keeps of the look, at this texel of its tile: the albedo as its square root, 8 bits each,
    /// then roughness in five bits over reflectance in three, which are rounded by lot. The roughness is 1 at least: a cache writes 0
    /// where there is a hole.
    pub fn packed(&self, texel: [u32; 2]) -> u32 {
        let lot = pcg(pcg(texel[0].wrapping_add(texel[1] << 6)));
        let part = |x: f32, steps: f32, lot: u32| (x * steps + lot as f32 / 65_536.0).floor().clamp(0.0, steps) as u32;
        let (roughness, reflectance) =
            (part(self.roughness, 31.0, lot & 0xffff).max(1), part(self.reflectance, 7.0, lot >> 16));
        let [r, g, b] = self.albedo.map(|x| (x.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5).floor() as u32);
        r | (g << 8) | (b << 16) | (((roughness << 3) | reflectance) << 24)
    }
}
