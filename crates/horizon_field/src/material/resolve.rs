//! The layers, with the noises and masks that they use looked up: each different one stands once in a list.

use super::nodes::{MaterialLayer, NoiseLayer, Surface, TerrainMaterial};
use crate::field::Field;

/// A field that layers use.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Source {
    Noise(NoiseLayer),
    /// With the layer whose it is first.
    Mask(Field, usize),
}

/// A range with soft edges, of a value to which some of a field is added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    pub low: f64,
    pub high: f64,
    /// The edges' half-width, squared.
    pub soft: f64,
    /// How much of the field.
    pub shift: f64,
    pub field: usize,
}

/// Bands by height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strata {
    pub per_metre: f64,
    pub shift: f64,
    pub field: usize,
}

/// The mix of two colours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tint {
    pub second: [f64; 3],
    /// The blend, squared.
    pub soft: f64,
    pub field: usize,
}

/// A layer, or the base, which has no rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    pub colour: [f64; 3],
    pub roughness: f64,
    pub reflectance: f64,
    pub tint: Option<Tint>,
    pub height: Option<Band>,
    pub slope: Option<Band>,
    pub curvature: Option<Band>,
    pub noise: Option<Band>,
    pub mask: Option<Band>,
    pub strata: Option<Strata>,
}

/// The base and the layers, and what they use.
#[derive(Clone, Debug, Default)]
pub(super) struct Resolved {
    pub layers: Vec<Layer>,
    pub fields: Vec<Source>,
}

impl Resolved {
    pub fn new(material: &TerrainMaterial) -> Self {
        let mut resolved = Self::default();
        let base = resolved.surface(material, &material.base);
        resolved.layers.push(base);
        for (at, layer) in material.layers.iter().enumerate() {
            let layer = resolved.layer(material, layer, at);
            resolved.layers.push(layer);
        }
        resolved
    }

    fn index(&mut self, source: Source) -> usize {
        let same = |known: &Source| match (known, &source) {
            (Source::Mask(a, _), Source::Mask(b, _)) => a == b,
            (a, b) => *a == *b,
        };
        self.fields.iter().position(same).unwrap_or_else(|| {
            self.fields.push(source);
            self.fields.len() - 1
        })
    }

    fn noise(&mut self, own: Option<&NoiseLayer>, shared: &NoiseLayer) -> usize {
        self.index(Source::Noise(own.unwrap_or(shared).clone()))
    }

    fn surface(&mut self, material: &TerrainMaterial, surface: &Surface) -> Layer {
        let tint = surface.second.map(|second| Tint {
            second,
            soft: surface.blend * surface.blend,
            field: self.noise(surface.tint.as_ref(), &material.tint),
        });
        Layer {
            colour: surface.colour,
            roughness: surface.roughness,
            reflectance: surface.reflectance,
            tint,
            height: None,
            slope: None,
            curvature: None,
            noise: None,
            mask: None,
            strata: None,
        }
    }

    fn layer(&mut self, material: &TerrainMaterial, layer: &MaterialLayer, at: usize) -> Layer {
        let band = |low, high, soft: f64, shift, field| Band { low, high, soft: soft * soft, shift, field };
        let surface = self.surface(material, &layer.surface);
        Layer {
            height: layer.height.as_ref().map(|rule| {
                let noise = self.noise(rule.noise.as_ref(), &material.edge);
                band(rule.low, rule.high, rule.soft, rule.shift, noise)
            }),
            slope: layer.slope.as_ref().map(|rule| {
                let noise = self.noise(None, &material.tint);
                band(rule.low, rule.high, rule.soft, rule.shift, noise)
            }),
            curvature: layer.curvature.as_ref().map(|rule| band(rule.low, rule.high, rule.soft, 0.0, 0)),
            noise: layer.noise.as_ref().map(|rule| {
                let noise = self.index(Source::Noise(rule.noise.clone()));
                band(rule.low, rule.high, rule.soft, 1.0, noise)
            }),
            mask: layer.mask.as_ref().map(|rule| {
                let mask = self.index(Source::Mask(rule.field.clone(), at));
                band(rule.low, rule.high, rule.soft, 1.0, mask)
            }),
            strata: layer.strata.as_ref().map(|rule| Strata {
                per_metre: 1.0 / rule.thickness,
                shift: rule.shift,
                field: self.noise(None, &material.edge),
            }),
            ..surface
        }
    }
}
