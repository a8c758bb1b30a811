//! Compilation: the fields that the layers use, the rows of the uniform that the shader reads, and the kernel that fills a
//! cache with ground and look.

use super::nodes::{NoiseLayer, TerrainMaterial};
use super::resolve::{Band, Layer, Resolved, Source};
use super::{MAX_FIELDS, MAX_LAYERS, MaterialError};
use crate::field::kernel::{module_with, shapes};
use crate::field::{Anchors, Compiled, ImageSource, Kernel};
use crate::fractal::{Octaves, fade};
use crate::place::Place;

const WGSL: &str = include_str!("material.wgsl");
const CURVATURE: &str = include_str!("curvature.wgsl");
const NO_CURVATURE: &str = "fn material_curvature(anchor: u32, q: vec2<f32>, scale: f32, cutoff: f32) -> f32 {\n    \
    return 0.0;\n}\n";

/// Waves shorter than this many texels are gone; from twice that on they are whole.
pub const CUTOFF: f64 = 0.75;
/// The variance of gradient noise in the plane.
pub const NOISE_VARIANCE: f64 = 0.031;
/// A smooth step of half-width w blurs as much as a bell of variance w² / 5: variances that blur, times this, widen it.
pub(super) const WIDENING: f64 = 5.0;
/// The exponent of the finest texel in the uniform, as a power of two metres; and how many there are.
const FIRST_TEXEL: i32 = -10;
const TEXELS: usize = 24;
/// Rows of a layer in the uniform.
const LAYER_ROWS: usize = 10;
/// Rows of the uniform, four numbers each: `Material` of `material.wgsl`.
pub const ROWS: usize = 1 + TEXELS * MAX_FIELDS + LAYER_ROWS * (1 + MAX_LAYERS);

/// A noise or a mask.
#[derive(Clone, Debug)]
pub(super) struct LayerField {
    pub field: Compiled<2>,
    shape: usize,
    /// Its largest absolute value.
    reach: f64,
    /// The octaves of a noise, as wavelength and variance.
    octaves: Vec<[f64; 2]>,
}

impl LayerField {
    /// By how much the octaves that a cut-off takes away widen a range's edges, squared: of an octave that fades to f, the
    /// share f² of its variance stays.
    pub fn widening(&self, cutoff: f64) -> f64 {
        let lost = |[wavelength, variance]: &[f64; 2]| variance * (1.0 - fade(*wavelength, cutoff).powi(2));
        WIDENING * self.octaves.iter().map(lost).sum::<f64>()
    }

    /// By how much its own steepness does, as a share of its difference over a texel, squared: a texel of a mask holds
    /// the values that its slope spans. What a cut-off leaves of a noise is that already.
    pub fn steepness(&self) -> f64 {
        if self.octaves.is_empty() { WIDENING / 12.0 } else { 0.0 }
    }
}

/// A material, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct CompiledMaterial {
    pub(super) layers: Vec<Layer>,
    pub(super) fields: Vec<LayerField>,
    pub(super) curvature_scale: f64,
}

/// Where a material's noises and masks lie at a place of the world.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialAnchors(pub(super) Vec<Anchors<2>>);

impl TerrainMaterial {
    /// Compiles.
    ///
    /// # Errors
    /// What [`TerrainMaterial::check`] refuses, and masks whose image can't be had.
    pub fn compile(&self, images: &dyn ImageSource) -> Result<CompiledMaterial, MaterialError> {
        self.check()?;
        let Resolved { layers, fields } = Resolved::new(self);
        let compiled = |source: &Source| match source {
            Source::Noise(noise) => Ok(noise.field().compile::<2>(images)?),
            Source::Mask(field, layer) => field
                .compile::<2>(images)
                .map_err(|source| MaterialError::Mask { path: format!("material.layers[{layer}].mask"), source }),
        };
        let trees = fields.iter().map(compiled).collect::<Result<Vec<_>, MaterialError>>()?;
        let shapes = shapes(&trees.iter().collect::<Vec<_>>());
        let fields = fields.iter().zip(trees).zip(shapes);
        let fields = fields.map(|((source, field), shape)| LayerField {
            reach: field.range().0.abs().max(field.range().1.abs()),
            octaves: match source {
                Source::Noise(noise) => noise.octaves(),
                Source::Mask(..) => Vec::new(),
            },
            field,
            shape,
        });
        Ok(CompiledMaterial { layers, fields: fields.collect(), curvature_scale: self.curvature_scale })
    }
}

impl NoiseLayer {
    /// The wavelength and the variance of each octave.
    fn octaves(&self) -> Vec<[f64; 2]> {
        let fractal = self.fractal();
        let octaves =
            Octaves { count: fractal.octaves, lacunarity: fractal.lacunarity, gain: fractal.gain, offset: 0.0 };
        let each = octaves.iter().map(|octave| {
            let amplitude = fractal.amplitude * octave.weight * octave.presence;
            [fractal.wavelength / octave.frequency, NOISE_VARIANCE * amplitude * amplitude]
        });
        each.collect()
    }
}

impl CompiledMaterial {
    /// The noises and masks, in the order in which the kernel, its buffers and its anchors have them: after the height.
    pub fn fields(&self) -> impl Iterator<Item = &Compiled<2>> {
        self.fields.iter().map(|field| &field.field)
    }

    /// Where the noises and masks lie at a place.
    pub fn anchor(&self, place: &Place) -> MaterialAnchors {
        MaterialAnchors(self.fields().map(|field| field.anchor(place)).collect())
    }

    /// The shortest wave that shows, in metres; infinite where there is none.
    pub fn finest_wavelength(&self) -> f64 {
        self.fields().map(Compiled::finest_wavelength).fold(f64::INFINITY, f64::min)
    }

    pub(super) fn is_curved(&self) -> bool {
        self.layers.iter().any(|layer| layer.curvature.is_some())
    }

    /// The shader that computes ground and look, without entry point: a [`module_with`] of the function `height` and of
    /// the material's fields, with `material.wgsl` behind it. A global `material: Material` is the caller's to declare.
    pub fn kernel(&self, group: u32, height: &Compiled<2>) -> Kernel {
        let fields: Vec<_> = self.fields().collect();
        let module = module_with(group, &[("height", height)], "material_field", &fields);
        let curvature = if self.is_curved() { CURVATURE } else { NO_CURVATURE };
        Kernel::new([&module.source, curvature, WGSL].join("\n"))
    }

    /// The uniform: what `Material` of `material.wgsl` holds.
    pub fn rows(&self) -> [[f32; 4]; ROWS] {
        let mut rows = [[0.0; 4]; ROWS];
        rows[0] = [self.layers.len() as f32, self.fields.len() as f32, self.curvature_scale as f32, 0.0];
        for texel in 0..TEXELS {
            let cutoff = CUTOFF * 2f64.powi(FIRST_TEXEL + texel as i32);
            for (i, field) in self.fields.iter().enumerate() {
                let numbers = [field.shape as f64, field.reach, field.steepness(), field.widening(cutoff)];
                rows[1 + texel * MAX_FIELDS + i] = numbers.map(|x| x as f32);
            }
        }
        let layers = rows[1 + TEXELS * MAX_FIELDS..].chunks_exact_mut(LAYER_ROWS);
        layers.zip(&self.layers).for_each(|(rows, layer)| layer.write(rows));
        rows
    }
}

impl Layer {
    /// `MaterialLayer` of `material.wgsl`.
    fn write(&self, rows: &mut [[f32; 4]]) {
        let four = |[r, g, b]: [f64; 3], w: f64| [r, g, b, w].map(|x| x as f32);
        let bands = [self.height, self.slope, self.curvature, self.noise, self.mask];
        let index = |band: Option<Band>| band.map_or(0.0, |band| band.field as f32);
        let mut rules = 0;
        rows[0] = four(self.colour, self.roughness);
        rows[1] = four(self.tint.map_or(self.colour, |tint| tint.second), self.reflectance);
        for (bit, (row, band)) in rows[2..7].iter_mut().zip(bands).enumerate() {
            if let Some(band) = band {
                *row = [band.low, band.high, band.soft, band.shift].map(|x| x as f32);
                rules |= 1 << bit;
            }
        }
        if let Some(strata) = self.strata {
            rows[7] = [strata.per_metre as f32, strata.shift as f32, 0.0, 0.0];
            rows[8][2] = strata.field as f32;
            rules |= 1 << 5;
        }
        if let Some(tint) = self.tint {
            rows[7][2] = tint.soft as f32;
            rows[8][3] = tint.field as f32;
            rules |= 1 << 6;
        }
        (rows[8][0], rows[8][1]) = (index(self.height), index(self.slope));
        rows[9] = [index(self.noise), index(self.mask), rules as f32, 0.0];
    }
}
