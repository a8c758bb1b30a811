//! What the ground looks like.

use bevy::prelude::*;
use horizon_field::Field;
use horizon_field::field::{Fractal, Param};
use serde::{Deserialize, Serialize};

/// The ground's look: four regions by height (mud, sand, grass, rock) with soft boundaries that noise shifts, grass in
/// two tints on flat ground only, strata on steep rock, and snow by height and slope.
///
/// Colours are linear albedos from 0 to 1.
#[derive(Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainMaterial {
    /// Albedo of the lowest ground. Default: wet brown.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of the lowest ground" })]
    pub mud: [f32; 3],
    /// Albedo of the shore. Default: pale sand.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of sand" })]
    pub sand: [f32; 3],
    /// Albedo of fresh grass. Default: deep green.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of fresh grass" })]
    pub grass: [f32; 3],
    /// Albedo of dry grass. Default: olive.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of dry grass" })]
    pub dry_grass: [f32; 3],
    /// Albedo of rock. Default: warm grey.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of rock" })]
    pub rock: [f32; 3],
    /// Albedo of the strata that show on steep rock. Default: dark brown.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of the strata on steep rock" })]
    pub strata: [f32; 3],
    /// Albedo of snow. Default: 0.85.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "Albedo of snow" })]
    pub snow: [f32; 3],
    /// Heights of the boundaries between mud and sand, sand and grass, grass and rock, and of the snow line, in metres;
    /// rising. Default: 0, 4, 900, 1500.
    #[reflect(@Param { min: -1e6, max: 1e6, unit: "m", help: "Heights of the boundaries mud, sand, grass, rock, snow" })]
    pub boundaries: [f32; 4],
    /// Half-widths of the boundaries, in metres. Default: 2, 3, 120, 150.
    #[reflect(@Param { min: 1e-3, max: 1e5, unit: "m", help: "Half-widths of the boundaries" })]
    pub softness: [f32; 4],
    /// The normal's y below which nothing grows, 0 to 1. Default: 0.8, a slope of 37°.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "The normal's y below which nothing grows" })]
    pub grass_flatness: f32,
    /// The normal's y below which no snow lies, 0 to 1. Default: 0.7, a slope of 46°.
    #[reflect(@Param { min: 0.0, max: 1.0, unit: "", help: "The normal's y below which no snow lies" })]
    pub snow_flatness: f32,
    /// Thickness of a stratum, in metres. Default: 14.
    #[reflect(@Param { min: 0.01, max: 1e4, unit: "m", help: "Thickness of a stratum" })]
    pub strata_thickness: f32,
    /// The noise that shifts the boundaries, in metres.
    pub edge: NoiseLayer,
    /// The noise that tints grass and rock; its amplitude is a pure number.
    pub tint: NoiseLayer,
}

/// An fBm of a material.
#[derive(Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct NoiseLayer {
    /// The longest wavelength, in metres. Default: 300.
    #[reflect(@Param { min: 1e-3, max: 1e8, unit: "m", help: "The longest wavelength" })]
    pub wavelength: f32,
    /// The amplitude, in the unit of what it changes. Default: 60.
    #[reflect(@Param { min: -1e6, max: 1e6, unit: "", help: "The amplitude" })]
    pub amplitude: f32,
    /// How many octaves, 0 to 24. Default: 5.
    #[reflect(@Param { min: 0.0, max: 24.0, unit: "", help: "How many octaves" })]
    pub octaves: f32,
    /// The seed.
    pub seed: u32,
}

impl Default for NoiseLayer {
    fn default() -> Self {
        Self { wavelength: 300.0, amplitude: 60.0, octaves: 5.0, seed: 11 }
    }
}

impl NoiseLayer {
    /// The layer as a field.
    pub fn field(&self) -> Field {
        Field::Fractal(Fractal {
            wavelength: f64::from(self.wavelength),
            amplitude: f64::from(self.amplitude),
            octaves: f64::from(self.octaves),
            gain: 0.6,
            seed: self.seed,
            ..default()
        })
    }
}

impl Default for TerrainMaterial {
    fn default() -> Self {
        Self {
            mud: [0.10, 0.075, 0.05],
            sand: [0.42, 0.34, 0.22],
            grass: [0.055, 0.115, 0.025],
            dry_grass: [0.15, 0.14, 0.045],
            rock: [0.21, 0.19, 0.17],
            strata: [0.12, 0.095, 0.075],
            snow: [0.85, 0.87, 0.9],
            boundaries: [0.0, 4.0, 900.0, 1500.0],
            softness: [2.0, 3.0, 120.0, 150.0],
            grass_flatness: 0.8,
            snow_flatness: 0.7,
            strata_thickness: 14.0,
            edge: NoiseLayer::default(),
            tint: NoiseLayer { wavelength: 90.0, amplitude: 0.9, octaves: 9.0, seed: 12 },
        }
    }
}
