//! The shaders, put together from their files: plain WGSL, joined in order, so that nothing depends on an import being
//! found. Only the tonemapping of LDR views imports, from Bevy.

use std::marker::PhantomData;

use bevy::asset::uuid::Uuid;
use bevy::asset::{Assets, Handle};
use bevy::shader::Shader;
use horizon_field::stamp;
use horizon_light::models::{gradient, shaders as light};
use horizon_light::sun;

use crate::world::SkyModel;

const SURFACE: &str = include_str!("cache/surface.wgsl");
const VIEW: &str = include_str!("passes/view.wgsl");
const AIR_VIEW: &str = include_str!("air/air_view.wgsl");
const PRESENT_HDR: &str = "fn present(colour: vec4<f32>) -> vec4<f32> {\n    return colour;\n}\n";
const DEPTH_SINGLE: &str = "@group(0) @binding(2) var depth_texture: texture_depth_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, 0);\n}\n";
const DEPTH_MULTISAMPLED: &str = "@group(0) @binding(2) var depth_texture: texture_depth_multisampled_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, sample_index);\n}\n";

const HEAT: &str = "const HEAT: bool = true;\n@group(0) @binding(9) var<storage, read> truths: array<f32>;\n\
    fn truth_at(i: u32) -> f32 {\n    if (i >= arrayLength(&truths)) {\n        return 0.0;\n    }\n    return truths[i];\n}\n";
const NO_HEAT: &str = "const HEAT: bool = false;\nfn truth_at(i: u32) -> f32 {\n    return 0.0;\n}\n";

/// A shader that is the same for every world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The pyramid of a tile.
    Pyramid,
    /// The light on a tile.
    Light,
    /// The table of clear distances.
    Clearance,
    /// The geometry pass; under air that lights it, and as a debug view.
    Geometry { ldr: bool, heat: bool, air: bool },
    /// The pass that brings the ground to the view's resolution.
    Upsample { ldr: bool, heat: bool, air: bool },
    /// The simplest air.
    Gradient { ldr: bool, multisampled: bool },
    /// The air by a model that has tables.
    Air { model: SkyModel, ldr: bool, multisampled: bool },
    /// The transmittance of the air.
    Transmittance,
    /// The first order of scattering, or those that follow.
    Moments { first: bool },
    /// The fast model's table.
    Isotropic,
    /// A camera's tables.
    ViewTables { model: SkyModel },
}

/// Models that have tables.
const MODELS: [SkyModel; 3] = [SkyModel::Single, SkyModel::Fast, SkyModel::Full];
const EITHER: [bool; 2] = [false, true];

impl Source {
    /// All of them.
    fn all() -> Vec<Self> {
        let mut all = vec![Self::Pyramid, Self::Light, Self::Clearance, Self::Transmittance, Self::Isotropic];
        all.extend(EITHER.map(|first| Self::Moments { first }));
        all.extend(MODELS.map(|model| Self::ViewTables { model }));
        for ldr in EITHER {
            for heat in EITHER {
                for air in EITHER {
                    all.extend([Self::Geometry { ldr, heat, air }, Self::Upsample { ldr, heat, air }]);
                }
            }
            for multisampled in EITHER {
                all.push(Self::Gradient { ldr, multisampled });
                all.extend(MODELS.map(|model| Self::Air { model, ldr, multisampled }));
            }
        }
        all
    }

    fn number(self) -> u128 {
        let bits = |bits: &[bool]| bits.iter().fold(0, |sum, bit| 2 * sum + u128::from(*bit));
        match self {
            Self::Pyramid => 0x00,
            Self::Light => 0x01,
            Self::Clearance => 0x02,
            Self::Transmittance => 0x03,
            Self::Isotropic => 0x04,
            Self::Moments { first } => 0x06 + bits(&[first]),
            Self::ViewTables { model } => 0x08 + model as u128,
            Self::Geometry { ldr, heat, air } => 0x10 + bits(&[ldr, heat, air]),
            Self::Upsample { ldr, heat, air } => 0x18 + bits(&[ldr, heat, air]),
            Self::Gradient { ldr, multisampled } => 0x20 + bits(&[ldr, multisampled]),
            Self::Air { model, ldr, multisampled } => 0x30 + 4 * model as u128 + bits(&[ldr, multisampled]),
        }
    }

    /// What pipelines name it by.
    pub fn handle(self) -> Handle<Shader> {
        Handle::Uuid(Uuid::from_u128(0x6e3f_0f52_7b57_4b0f_9f0a_0d6a_4d1c_0000 + self.number()), PhantomData)
    }

    /// Its name, in messages.
    fn name(self) -> &'static str {
        match self {
            Self::Pyramid => "pyramid",
            Self::Light => "light",
            Self::Clearance => "clearance",
            Self::Geometry { heat: false, air: false, .. } => "geometry",
            Self::Geometry { heat: false, air: true, .. } => "geometry_air",
            Self::Geometry { heat: true, air: false, .. } => "heat",
            Self::Geometry { heat: true, air: true, .. } => "heat_air",
            Self::Upsample { heat: false, air: false, .. } => "upsample",
            Self::Upsample { heat: false, air: true, .. } => "upsample_air",
            Self::Upsample { heat: true, air: false, .. } => "upsample_heat",
            Self::Upsample { heat: true, air: true, .. } => "upsample_heat_air",
            Self::Gradient { multisampled: false, .. } => "sky_gradient",
            Self::Gradient { multisampled: true, .. } => "sky_gradient_multisampled",
            Self::Air { multisampled: false, .. } => "sky_air",
            Self::Air { multisampled: true, .. } => "sky_air_multisampled",
            Self::Transmittance => "transmittance_table",
            Self::Moments { first: true } => "moments_first",
            Self::Moments { first: false } => "moments_table",
            Self::Isotropic => "isotropic_table",
            Self::ViewTables { .. } => "view_tables",
        }
    }

    fn text(self) -> String {
        match self {
            Self::Pyramid => [SURFACE, include_str!("cache/pyramid.wgsl")].join("\n"),
            Self::Light => [SURFACE, include_str!("cache/light.wgsl")].join("\n"),
            Self::Clearance => [VIEW, SURFACE, include_str!("passes/clearance.wgsl")].join("\n"),
            Self::Geometry { ldr, heat, air } => geometry(ldr, heat, air),
            Self::Upsample { ldr, heat, air } => {
                [&geometry(ldr, heat, air), include_str!("passes/upsample.wgsl")].join("\n")
            }
            Self::Gradient { ldr, multisampled } => {
                [&sky_common(ldr, multisampled), gradient::WGSL, include_str!("passes/sky_gradient.wgsl")].join("\n")
            }
            Self::Air { model, ldr, multisampled } => {
                [&sky_common(ldr, multisampled), &air_model(model), include_str!("passes/sky_air.wgsl")].join("\n")
            }
            Self::Transmittance => [light::BASE, include_str!("air/transmittance_table.wgsl")].join("\n"),
            Self::Moments { first: true } => {
                let parts =
                    [light::SCATTER, light::ONCE, light::MOMENTS_COMPUTE, include_str!("air/moments_table.wgsl")];
                [&[light::BASE], &parts[..], &[include_str!("air/moments_first.wgsl")]].concat().join("\n")
            }
            Self::Moments { first: false } => {
                let parts =
                    [light::SCATTER, light::MOMENTS_COMPUTE, light::MOMENTS, include_str!("air/moments_table.wgsl")];
                [&[light::BASE], &parts[..], &[include_str!("air/moments_next.wgsl")]].concat().join("\n")
            }
            Self::Isotropic => {
                let parts = [light::SCATTER, light::ONCE, light::ISOTROPIC_COMPUTE];
                [&[light::BASE], &parts[..], &[include_str!("air/isotropic_table.wgsl")]].concat().join("\n")
            }
            Self::ViewTables { model } => [&air_model(model), include_str!("air/view_tables.wgsl")].join("\n"),
        }
    }
}

/// Adds the shaders that are the same for every world. They are text until a pipeline asks for them.
pub fn add_shaders(shaders: &mut Assets<Shader>) {
    for source in Source::all() {
        let path = format!("bevy_horizon/{}.wgsl", source.name());
        let shader = Shader::from_wgsl(source.text(), path);
        shaders.insert(&source.handle(), shader).expect("a handle by UUID is always valid");
    }
}

/// The fill pass behind a field's kernel and the stamps.
pub fn fill_source(kernel: &str) -> String {
    [kernel, stamp::WGSL, include_str!("cache/material.wgsl"), include_str!("cache/fill.wgsl")].join("\n")
}

fn present(ldr: bool) -> &'static str {
    if ldr { include_str!("passes/present_ldr.wgsl") } else { PRESENT_HDR }
}

fn geometry(ldr: bool, heat: bool, air: bool) -> String {
    let daylight = if air {
        let parts = [light::BASE, light::TRANSMITTANCE, light::HARMONICS, sun::WGSL, AIR_VIEW];
        [&parts[..], &[include_str!("passes/daylight_air.wgsl")]].concat().join("\n")
    } else {
        include_str!("passes/daylight_plain.wgsl").to_owned()
    };
    [
        present(ldr),
        if heat { HEAT } else { NO_HEAT },
        VIEW,
        SURFACE,
        include_str!("cache/march.wgsl"),
        include_str!("passes/clear_start.wgsl"),
        include_str!("passes/heat.wgsl"),
        &daylight,
        include_str!("passes/geometry.wgsl"),
    ]
    .join("\n")
}

fn sky_common(ldr: bool, multisampled: bool) -> String {
    let depth = if multisampled { DEPTH_MULTISAMPLED } else { DEPTH_SINGLE };
    [present(ldr), VIEW, depth, include_str!("passes/sky_common.wgsl")].join("\n")
}

/// A model, the tables that it reads, and the camera's.
fn air_model(model: SkyModel) -> String {
    let multiple: &[&str] = match model {
        SkyModel::Full => &[light::MOMENTS_COMPUTE, light::MOMENTS],
        SkyModel::Fast => &[light::ISOTROPIC],
        SkyModel::Single | SkyModel::Gradient => &[light::ONCE],
    };
    let before = [light::BASE, sun::WGSL, AIR_VIEW, include_str!("air/read_tables.wgsl"), light::SCATTER];
    let after = [light::SKY_VIEW_COMPUTE, light::SKY_VIEW, include_str!("air/aerial.wgsl")];
    [&before, multiple, &after[..]].concat().join("\n")
}

/// Every shader of this crate that stands without Bevy's imports, by name: for tests that translate them to other
/// shading languages. `kernel` is a field's, from [`horizon_field::field::kernel`].
pub fn shader_sources(kernel: &str) -> Vec<(&'static str, String)> {
    let alone = |source: &Source| {
        use Source::{Air, Geometry, Gradient, Upsample};
        !matches!(
            source,
            Geometry { ldr: true, .. }
                | Upsample { ldr: true, .. }
                | Gradient { ldr: true, .. }
                | Air { ldr: true, .. }
        )
    };
    let own = Source::all().into_iter().filter(alone).map(|source| (source.name(), source.text()));
    [("fill", fill_source(kernel))].into_iter().chain(own).collect()
}
