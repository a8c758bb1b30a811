//! A material for tests, here and of the shader.

use super::nodes::{
    CurvatureRule, HeightRule, MaskRule, MaterialLayer, NoiseLayer, NoiseRule, SlopeRule, StrataRule, Surface,
    TerrainMaterial,
};
use crate::field::{Edge, Fractal, ImageField};

/// A material with every rule, alone and with others; with noises of their own and shared ones, masks by image and by noise.
/// The images are those of [`Pictures`](crate::field::arbitrary::Pictures).
pub fn all_rules() -> TerrainMaterial {
    let surface = |colour, roughness, reflectance| Surface { colour, roughness, reflectance, ..Default::default() };
    let image = ImageField {
        path: "large".into(),
        size: [3000.0; 2],
        low: 0.0,
        high: 1.0,
        edge: Edge::Mirror,
        ..Default::default()
    };
    let own = NoiseLayer { wavelength: 500.0, amplitude: 80.0, octaves: 4.0, seed: 21 };
    let wild = Fractal { wavelength: 900.0, amplitude: 1.0, octaves: 4.0, seed: 22, ..Default::default() };
    TerrainMaterial {
        layers: vec![
            MaterialLayer {
                surface: surface([0.9, 0.1, 0.1], 0.3, 0.9),
                height: Some(HeightRule {
                    low: -100.0,
                    high: 300.0,
                    soft: 30.0,
                    noise: Some(own.clone()),
                    ..Default::default()
                }),
                ..Default::default()
            },
            MaterialLayer {
                surface: Surface {
                    second: Some([0.8, 0.1, 0.9]),
                    tint: Some(own),
                    blend: 20.0,
                    ..surface([0.1, 0.9, 0.1], 0.9, 0.1)
                },
                slope: Some(SlopeRule { low: 0.6, high: 0.9, shift: 0.1, ..Default::default() }),
                ..Default::default()
            },
            MaterialLayer {
                surface: surface([0.1, 0.1, 0.9], 0.6, 0.3),
                curvature: Some(CurvatureRule { low: 0.05, ..Default::default() }),
                ..Default::default()
            },
            MaterialLayer {
                surface: surface([0.9, 0.9, 0.1], 0.2, 0.7),
                noise: Some(NoiseRule { low: 0.05, high: 0.3, ..Default::default() }),
                ..Default::default()
            },
            MaterialLayer {
                surface: surface([0.1, 0.9, 0.9], 0.7, 0.0),
                mask: Some(MaskRule { field: image.into(), low: 0.2, ..Default::default() }),
                strata: Some(StrataRule { thickness: 30.0, ..Default::default() }),
                ..Default::default()
            },
            MaterialLayer {
                surface: surface([0.05, 0.05, 0.05], 0.1, 1.0),
                mask: Some(MaskRule { field: wild.into(), low: -0.05, high: 0.4, soft: 0.05 }),
                height: Some(HeightRule { low: -200.0, soft: 50.0, ..Default::default() }),
                ..Default::default()
            },
        ],
        ..Default::default()
    }
}
