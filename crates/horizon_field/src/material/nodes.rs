//! The material's parameters: meaning, unit, range and default, once each. Colours are linear albedos.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use crate::field::param::{Numbers, Param, Params, node};
use crate::field::{Field, Fractal};

node! {
    /// The ground's look: a base, and layers that lie over it, the later over the earlier, each as far as its rules say.
    TerrainMaterial {
        base: Surface = rock(), "What shows where no layer lies.";
        layers: Vec<MaterialLayer> = temperate(), "The layers, from the lowest to the uppermost; at most 16.";
        edge: NoiseLayer = NoiseLayer { amplitude: 60.0, ..NoiseLayer::default() }, "The noise, in metres, that shifts heights where a rule has none of its own.";
        tint: NoiseLayer = NoiseLayer { wavelength: 90.0, amplitude: 0.9, octaves: 9.0, seed: 12 }, "The noise that mixes a surface's two colours and perturbs slopes, where these have none of their own.";
        curvature_scale: f64 = 40.0, "The length over which curvature is measured.", in 1e-2 .. 1e6 "m";
    }
}

node! {
    /// A layer: a surface, and the rules for where it lies. What the rules give is multiplied; without any, it lies
    /// everywhere.
    MaterialLayer {
        name: String = String::new(), "What games call it.";
        surface: Surface = Surface::default(), "How it looks.";
        height: Option<HeightRule> = None, "Where, by height.";
        slope: Option<SlopeRule> = None, "Where, by slope.";
        curvature: Option<CurvatureRule> = None, "Where, by curvature. The ground is computed at four more points.";
        noise: Option<NoiseRule> = None, "Where, by a noise.";
        mask: Option<MaskRule> = None, "Where, by a field, such as an image.";
        strata: Option<StrataRule> = None, "In bands by height, as sediments lie.";
    }
}

node! {
    /// How ground looks: Bevy's standard material, and a second colour that a noise mixes in.
    Surface {
        colour: [f64; 3] = [0.21, 0.19, 0.17], "The albedo, linear.", in 0.0 .. 1.0 "";
        second: Option<[f64; 3]> = None, "A second albedo; without one, there is no noise.", in 0.0 .. 1.0 "";
        blend: f64 = 0.35, "The noise that is all second colour; minus that, and it is all the first.", in 1e-3 .. 1e3 "";
        tint: Option<NoiseLayer> = None, "The noise; without one, the material's `tint`.";
        roughness: f64 = 0.85, "The perceptual roughness: 0.089 a mirror, 1 chalk.", in 0.089 .. 1.0 "";
        reflectance: f64 = 0.25, "The reflectance head on, as Bevy has it: 0.5 is that of polished minerals, 4 %; soil and leaves shade most of theirs.", in 0.0 .. 1.0 "";
    }
}

node! {
    /// An fBm of a material, of gain 0.6.
    NoiseLayer {
        wavelength: f64 = 300.0, "The longest wavelength.", in 1e-3 .. 1e8 "m";
        amplitude: f64 = 1.0, "What the first octave's 1 stands for, in the unit of what it changes.", in -1e6 .. 1e6 "";
        octaves: f64 = 5.0, "How many octaves.", in 0.0 .. 24.0 "";
        seed: u32 = 11, "The seed.", in 0.0 .. 4294967295.0 "";
    }
}

node! {
    /// A range of heights.
    HeightRule {
        low: f64 = -1e6, "The lower edge.", in -1e6 .. 1e6 "m";
        high: f64 = 1e6, "The upper edge.", in -1e6 .. 1e6 "m";
        soft: f64 = 5.0, "The edges' half-width.", in 1e-3 .. 1e5 "m";
        shift: f64 = 1.0, "How much of the noise is added to the height.", in -1e3 .. 1e3 "";
        noise: Option<NoiseLayer> = None, "The noise, in metres; without one, the material's `edge`.";
    }
}

node! {
    /// A range of slopes, by the normal's y: 1 is level, 0.71 are 45°, 0 is a wall.
    SlopeRule {
        low: f64 = -1.0, "The steepest, as the normal's y.", in -1.0 .. 2.0 "";
        high: f64 = 2.0, "The flattest, as the normal's y.", in -1.0 .. 2.0 "";
        soft: f64 = 0.06, "The edges' half-width.", in 1e-4 .. 1.0 "";
        shift: f64 = 0.0, "How much of the material's `tint` is added to the normal's y.", in -10.0 .. 10.0 "";
    }
}

node! {
    /// A range of curvatures: how much the slope grows over the material's `curvature_scale`. Above 0 in hollows, below on
    /// crests.
    CurvatureRule {
        low: f64 = -1e4, "The lower edge.", in -1e4 .. 1e4 "";
        high: f64 = 1e4, "The upper edge.", in -1e4 .. 1e4 "";
        soft: f64 = 0.1, "The edges' half-width.", in 1e-4 .. 1e3 "";
    }
}

node! {
    /// A range of a noise.
    NoiseRule {
        noise: NoiseLayer = NoiseLayer::default(), "The noise.";
        low: f64 = 0.0, "The lower edge.", in -1e6 .. 1e6 "";
        high: f64 = 1e6, "The upper edge.", in -1e6 .. 1e6 "";
        soft: f64 = 0.1, "The edges' half-width.", in 1e-4 .. 1e5 "";
    }
}

node! {
    /// A range of a field.
    MaskRule {
        field: Field = Field::Constant(1.0), "The field, over x and z.";
        low: f64 = 0.5, "The lower edge.", in -1e6 .. 1e6 "";
        high: f64 = 1e6, "The upper edge.", in -1e6 .. 1e6 "";
        soft: f64 = 0.1, "The edges' half-width.", in 1e-4 .. 1e5 "";
    }
}

node! {
    /// Bands by height, of random strength.
    StrataRule {
        thickness: f64 = 14.0, "The thickness of a band.", in 1e-2 .. 1e4 "m";
        shift: f64 = 0.3, "How much of the material's `edge` is added to the height.", in -1e3 .. 1e3 "";
    }
}

impl NoiseLayer {
    /// The layer as a field.
    pub fn field(&self) -> Field {
        Field::Fractal(self.fractal())
    }

    pub(super) fn fractal(&self) -> Fractal {
        let Self { wavelength, amplitude, octaves, seed } = *self;
        Fractal { wavelength, amplitude, octaves, seed, gain: 0.6, ..Fractal::default() }
    }
}

impl TerrainMaterial {
    /// The paths of all images in masks, each once, in the order of the layers.
    pub fn image_paths(&self) -> Vec<String> {
        let mut paths = Vec::new();
        for mask in self.layers.iter().filter_map(|layer| layer.mask.as_ref()) {
            for path in mask.field.image_paths() {
                if !paths.contains(&path) {
                    paths.push(path);
                }
            }
        }
        paths
    }
}

/// Warm grey, lighter and darker.
fn rock() -> Surface {
    Surface { colour: [0.16, 0.145, 0.13], second: Some([0.26, 0.235, 0.21]), blend: 0.8, ..Surface::default() }
}

/// Strata on steep rock, grass in two tints on flat ground, sand and mud at the shore, snow on the heights.
fn temperate() -> Vec<MaterialLayer> {
    let surface = |colour, roughness| Surface { colour, roughness, ..Surface::default() };
    let height = |low, high, soft| Some(HeightRule { low, high, soft, ..HeightRule::default() });
    vec![
        MaterialLayer {
            name: "strata".into(),
            surface: surface([0.12, 0.095, 0.075], 0.85),
            slope: Some(SlopeRule { high: 0.75, soft: 0.13, ..SlopeRule::default() }),
            strata: Some(StrataRule::default()),
            ..MaterialLayer::default()
        },
        MaterialLayer {
            name: "grass".into(),
            surface: Surface { second: Some([0.15, 0.14, 0.045]), ..surface([0.055, 0.115, 0.025], 0.95) },
            height: height(-1e6, 900.0, 120.0),
            slope: Some(SlopeRule { low: 0.8, shift: 0.04, ..SlopeRule::default() }),
            ..MaterialLayer::default()
        },
        MaterialLayer {
            name: "sand".into(),
            surface: surface([0.42, 0.34, 0.22], 0.9),
            height: height(-1e6, 4.0, 3.0),
            ..MaterialLayer::default()
        },
        MaterialLayer {
            name: "mud".into(),
            surface: surface([0.10, 0.075, 0.05], 0.5),
            height: height(-1e6, 0.0, 2.0),
            ..MaterialLayer::default()
        },
        MaterialLayer {
            name: "snow".into(),
            surface: surface([0.85, 0.87, 0.9], 0.6),
            height: height(1500.0, 1e6, 150.0),
            slope: Some(SlopeRule { low: 0.7, soft: 0.08, ..SlopeRule::default() }),
            ..MaterialLayer::default()
        },
    ]
}
