//! The shaders, put together from their files: plain WGSL, joined in order, so that nothing depends on an import being
//! found. Only the tonemapping of LDR views imports, from Bevy.

use std::marker::PhantomData;

use bevy::asset::uuid::Uuid;
use bevy::asset::{Assets, Handle};
use bevy::shader::Shader;
use horizon_field::material::compile::CUTOFF;
use horizon_field::{stamp, trees, waves};
use horizon_light::models::{gradient, shaders as light};
use horizon_light::{sun, water as water_light};

use super::cache::clipmap::{BOUNDS_HEAD, LIGHTS_AT, MAX_LEVELS, TILE, TILE_BOUNDS, TILE_LOOKS, TILE_TEXELS};
use super::passes::{CAST_PUSH, CAST_QUADS};
use crate::world::SkyModel;

const SURFACE: &str = include_str!("cache/surface.wgsl");
const SUN_SEEN: &str = include_str!("cache/sun_seen.wgsl");
const LOOK: &str = include_str!("passes/look.wgsl");
const RAY: &str = include_str!("cache/ray.wgsl");
const PIXEL_RAY: &str = include_str!("passes/pixel_ray.wgsl");
const SOLIDS: &str = trees::WGSL;
const GROVE: &str = include_str!("trees/grove.wgsl");
const CANOPY: &str = include_str!("trees/canopy_light.wgsl");
const CANOPY_PLAIN: &str = include_str!("passes/canopy_plain.wgsl");
const SUNLIT: &str = include_str!("passes/sunlit.wgsl");
const MOTION: &str = include_str!("passes/motion.wgsl");
const VIEW: &str = include_str!("passes/view.wgsl");
const AIR_VIEW: &str = include_str!("air/air_view.wgsl");
const SKYLIGHT: &str = include_str!("passes/skylight_air.wgsl");
const GRADIENT_AIR: &str = include_str!("passes/gradient_air.wgsl");
const FOLIAGE: &str = "@group(0) @binding(9) var plant_foliage: texture_3d<f32>;\n\
    @group(0) @binding(10) var plant_foliage_sampler: sampler;\n";
const PRESENT_HDR: &str = "fn present(colour: vec4<f32>) -> vec4<f32> {\n    return colour;\n}\n";
const DEPTH_SINGLE: &str = "@group(0) @binding(2) var depth_texture: texture_depth_2d;\n\
    fn depth_samples() -> i32 {\n    return 1;\n}\nfn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, 0);\n}\n";
const DEPTH_MULTISAMPLED: &str = "@group(0) @binding(2) var depth_texture: texture_depth_multisampled_2d;\n\
    fn depth_samples() -> i32 {\n    return i32(textureNumSamples(depth_texture));\n}\nfn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, sample_index);\n}\n";

const COUNTED: &str = "const HEAT: bool = true;\n";
const UNCOUNTED: &str = "const HEAT: bool = false;\n";

/// A shader that is the same for every world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The pyramid of a tile.
    Pyramid,
    /// The light on a tile.
    Light,
    /// The table of clear distances.
    Clearance,
    /// The ground's geometry: from the depth of a lower resolution; with what a prepass has beside depth.
    Geometry { scaled: bool, beside: Beside },
    /// A debug view.
    Heat { ldr: bool },
    /// Light on the ground, or on a G-buffer; under air that makes it; under plants.
    Shade { deferred: bool, multisampled: bool, air: bool, trees: bool },
    /// Plants, lit as the ground is.
    Trees { multisampled: bool, air: bool },
    /// The ground in shadow maps; with holes in it.
    Cast { holes: bool },
    /// Water; with waves, among ground.
    Water { sky: WaterSky, multisampled: bool, waves: bool, ground: bool },
    /// Plants in shadow maps.
    CastTrees,
    /// Waves at a time.
    SeaTransform,
    /// Waves over the plane.
    SeaSurface,
    /// Waves at every size.
    SeaMeans,
    /// The motion vectors of plants.
    TreeMotion,
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

/// What of a prepass is drawn beside the depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    Nothing,
    Motion,
    Surfaces,
}

/// What water mirrors where nothing is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WaterSky {
    /// The ambient light.
    Nothing,
    Gradient,
    /// The sky's table.
    Air,
}

/// Models that have tables.
const MODELS: [SkyModel; 3] = [SkyModel::Single, SkyModel::Fast, SkyModel::Full];
const EITHER: [bool; 2] = [false, true];

impl Source {
    /// All of them.
    fn all() -> Vec<Self> {
        let mut all =
            vec![Self::Pyramid, Self::Light, Self::Clearance, Self::Transmittance, Self::Isotropic, Self::CastTrees];
        all.extend([Self::SeaTransform, Self::SeaSurface, Self::SeaMeans]);
        all.push(Self::TreeMotion);
        all.extend(EITHER.map(|holes| Self::Cast { holes }));
        all.extend(EITHER.map(|first| Self::Moments { first }));
        all.extend(MODELS.map(|model| Self::ViewTables { model }));
        for a in EITHER {
            all.extend(
                [Beside::Nothing, Beside::Motion, Beside::Surfaces].map(|beside| Self::Geometry { scaled: a, beside }),
            );
            for b in EITHER {
                all.push(Self::Trees { multisampled: a, air: b });
                all.extend(EITHER.map(|trees| Self::Shade { deferred: false, multisampled: a, air: b, trees }));
                all.push(Self::Shade { deferred: true, multisampled: false, air: a, trees: b });
            }
            all.push(Self::Heat { ldr: a });
        }
        for sky in [WaterSky::Nothing, WaterSky::Gradient, WaterSky::Air] {
            for bits in 0..8 {
                let bit = |i: u32| bits >> i & 1 != 0;
                all.push(Self::Water { sky, multisampled: bit(2), waves: bit(1), ground: bit(0) });
            }
        }
        for ldr in EITHER {
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
            Self::Cast { holes } => 0x0c + bits(&[holes]),
            Self::Geometry { scaled, beside } => 0x0e + 3 * bits(&[scaled]) + beside as u128,
            Self::Heat { ldr } => 0x14 + bits(&[ldr]),
            Self::CastTrees => 0x16,
            Self::TreeMotion => 0x17,
            Self::Trees { multisampled, air } => 0x18 + bits(&[multisampled, air]),
            Self::Gradient { ldr, multisampled } => 0x20 + bits(&[ldr, multisampled]),
            Self::Air { model, ldr, multisampled } => 0x30 + 4 * model as u128 + bits(&[ldr, multisampled]),
            Self::Water { sky, multisampled, waves, ground } => {
                0x60 + 8 * sky as u128 + bits(&[multisampled, waves, ground])
            }
            Self::Shade { deferred, multisampled, air, trees } => 0x40 + bits(&[deferred, multisampled, air, trees]),
            Self::SeaTransform => 0x58,
            Self::SeaSurface => 0x59,
            Self::SeaMeans => 0x5a,
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
            Self::Cast { holes: false } => "cast",
            Self::Cast { holes: true } => "cast_holes",
            Self::CastTrees => "cast_trees",
            Self::TreeMotion => "tree_motion",
            Self::Trees { .. } => "trees",
            Self::Geometry { scaled: false, beside: Beside::Nothing } => "geometry",
            Self::Geometry { scaled: false, beside: Beside::Motion } => "geometry_motion",
            Self::Geometry { scaled: false, beside: Beside::Surfaces } => "geometry_surfaces",
            Self::Geometry { scaled: true, beside: Beside::Nothing } => "geometry_scaled",
            Self::Geometry { scaled: true, beside: Beside::Motion } => "geometry_scaled_motion",
            Self::Geometry { scaled: true, beside: Beside::Surfaces } => "geometry_scaled_surfaces",
            Self::Heat { .. } => "heat",
            Self::Shade { deferred: false, .. } => "shade_forward",
            Self::Shade { deferred: true, .. } => "shade_deferred",
            Self::Water { .. } => "water",
            Self::SeaTransform => "sea_transform",
            Self::SeaSurface => "sea_surface",
            Self::SeaMeans => "sea_means",
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
            Self::Pyramid => [&surface(), include_str!("cache/pyramid.wgsl")].join("\n"),
            Self::Light => [&surface(), SUN_SEEN, include_str!("cache/light.wgsl")].join("\n"),
            Self::Clearance => [VIEW, &surface(), include_str!("passes/clearance.wgsl")].join("\n"),
            Self::Cast { holes: false } => [&surface(), include_str!("passes/cast.wgsl")].join("\n"),
            Self::Cast { holes: true } => {
                [&surface(), LOOK, include_str!("passes/cast.wgsl"), include_str!("passes/cast_holes.wgsl")].join("\n")
            }
            Self::CastTrees => [FOLIAGE, SOLIDS, GROVE, include_str!("passes/cast_trees.wgsl")].join("\n"),
            Self::TreeMotion => [VIEW, MOTION, include_str!("passes/tree_motion.wgsl")].join("\n"),
            Self::Geometry { scaled, beside } => geometry(scaled, beside),
            Self::Heat { ldr } => heat(ldr),
            Self::Shade { deferred, multisampled, air, trees } => shade(deferred, multisampled, air, trees),
            Self::Trees { multisampled, air } => plants(multisampled, air),
            Self::Gradient { ldr, multisampled } => {
                let parts = [gradient::WGSL, GRADIENT_AIR, include_str!("passes/sky_gradient.wgsl")];
                [&[sky_common(ldr, multisampled).as_str()], &parts[..]].concat().join("\n")
            }
            Self::Air { model, ldr, multisampled } => {
                [&sky_common(ldr, multisampled), &air_model(model), include_str!("passes/sky_air.wgsl")].join("\n")
            }
            Self::Water { sky, multisampled, waves, ground } => water(sky, multisampled, waves, ground),
            Self::SeaTransform => sea(include_str!("waves/transform.wgsl")),
            Self::SeaSurface => sea(include_str!("waves/surface.wgsl")),
            Self::SeaMeans => include_str!("waves/means.wgsl").to_owned(),
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

/// The fill pass behind the kernel of a terrain's height and material, and the stamps.
pub fn fill_source(kernel: &str) -> String {
    [&shader_constants(), kernel, stamp::WGSL, include_str!("cache/fill.wgsl")].join("\n")
}

/// What Rust and the shaders both count by: declared in Rust, and told to the shaders that lay out or read tiles, or cast the ground.
pub fn shader_constants() -> String {
    let (bits, vertices) = (TILE.ilog2(), CAST_QUADS + 1);
    format!(
        "const MAX_LEVELS: u32 = {MAX_LEVELS}u;\nconst TILE: u32 = {TILE}u;\nconst TILE_BITS: u32 = {bits}u;\n\
         const TILE_TEXELS: u32 = {TILE_TEXELS}u;\nconst TILE_BOUNDS: u32 = {TILE_BOUNDS}u;\n\
         const BOUNDS_HEAD: u32 = {BOUNDS_HEAD}u;\nconst TILE_LOOKS: u32 = {TILE_LOOKS}u;\n\
         const LIGHTS_AT: u32 = {LIGHTS_AT}u;\nconst CUTOFF: f32 = {CUTOFF:?};\n\
         const CAST_VERTICES: u32 = {vertices}u;\nconst CAST_PUSH: f32 = {CAST_PUSH:?};\n"
    )
}

/// The drawn surface, behind what it counts by.
fn surface() -> String {
    [&shader_constants(), SURFACE].join("\n")
}

/// A pass over the buffers of the waves.
fn sea(pass: &str) -> String {
    [&waves::constants(), include_str!("waves/bindings.wgsl"), pass].join("\n")
}

fn present(ldr: bool) -> &'static str {
    if ldr { include_str!("passes/present_ldr.wgsl") } else { PRESENT_HDR }
}

/// The march of a pixel's ray.
fn rays(counted: bool) -> String {
    [
        if counted { COUNTED } else { UNCOUNTED },
        VIEW,
        RAY,
        PIXEL_RAY,
        &surface(),
        LOOK,
        include_str!("cache/march.wgsl"),
        include_str!("passes/clear_start.wgsl"),
        include_str!("passes/geometry.wgsl"),
    ]
    .join("\n")
}

fn geometry(scaled: bool, beside: Beside) -> String {
    let rays = rays(false);
    let found = if scaled { include_str!("passes/upsample.wgsl") } else { include_str!("passes/whole.wgsl") };
    match beside {
        Beside::Nothing => [&rays, found, include_str!("passes/depth_alone.wgsl")].join("\n"),
        Beside::Motion => [&rays, found, MOTION, include_str!("passes/depth_motion.wgsl")].join("\n"),
        Beside::Surfaces => [&rays, found, MOTION, include_str!("passes/surfaces.wgsl")].join("\n"),
    }
}

fn heat(ldr: bool) -> String {
    [present(ldr), &rays(true), SUN_SEEN, SUNLIT, MOTION, include_str!("passes/heat.wgsl")].join("\n")
}

/// Bevy's groups 0 and 1 come first: ours is 2.
fn behind_bevy(parts: &[&str]) -> String {
    parts.join("\n").replace("@group(0)", "@group(2)")
}

fn daylight(air: bool) -> String {
    if air {
        let parts = [light::BASE, light::TRANSMITTANCE, light::HARMONICS, sun::WGSL, AIR_VIEW];
        [&parts[..], &[include_str!("passes/daylight_air.wgsl"), SKYLIGHT]].concat().join("\n")
    } else {
        include_str!("passes/daylight_plain.wgsl").to_owned()
    }
}

/// What lights surfaces.
fn lights(multisampled: bool, air: bool, trees: bool) -> String {
    let depth = if multisampled { DEPTH_MULTISAMPLED } else { DEPTH_SINGLE };
    let canopy = if trees { [SOLIDS, GROVE, CANOPY].join("\n") } else { CANOPY_PLAIN.to_owned() };
    let bindings = include_str!("passes/shade_bindings.wgsl");
    let shade = include_str!("passes/shade.wgsl");
    [bindings, VIEW, &surface(), SUN_SEEN, LOOK, SUNLIT, depth, &daylight(air), &canopy, shade].join("\n")
}

fn shade(deferred: bool, multisampled: bool, air: bool, trees: bool) -> String {
    let entry =
        if deferred { include_str!("passes/shade_deferred.wgsl") } else { include_str!("passes/shade_forward.wgsl") };
    // The solids name the table of foliage, which the light of crowns does not ask.
    let foliage = if trees { FOLIAGE } else { "" };
    behind_bevy(&[foliage, &lights(multisampled, air, trees), entry])
}

fn plants(multisampled: bool, air: bool) -> String {
    behind_bevy(&[FOLIAGE, &lights(multisampled, air, true), RAY, PIXEL_RAY, include_str!("passes/trees.wgsl")])
}

/// Bevy's group 0 comes first: ours is 1.
fn water(sky: WaterSky, multisampled: bool, waves: bool, ground: bool) -> String {
    let depth = if multisampled { DEPTH_MULTISAMPLED } else { DEPTH_SINGLE };
    let mut parts = vec![VIEW, depth, water_light::WGSL];
    let surface = surface();
    let grid = format!("const WAVE_GRID: f32 = {}.0;\n", waves::GRID);
    parts.extend([grid.as_str(), include_str!("passes/water_bodies.wgsl")]);
    parts.push(if waves { include_str!("passes/water_waves.wgsl") } else { include_str!("passes/water_still.wgsl") });
    match sky {
        WaterSky::Nothing => parts.push(include_str!("passes/water_sky_none.wgsl")),
        WaterSky::Gradient => {
            parts.extend([gradient::WGSL, GRADIENT_AIR, include_str!("passes/water_sky_gradient.wgsl")]);
        }
        WaterSky::Air => {
            let tables = [light::DIRECTIONS, light::SKY_VIEW, SKYLIGHT];
            parts.extend([light::BASE, light::HARMONICS, sun::WGSL, AIR_VIEW, include_str!("air/aerial.wgsl")]);
            parts.extend([&tables[..], &[include_str!("passes/water_sky.wgsl")]].concat());
        }
    }
    if ground {
        parts.extend([UNCOUNTED, RAY, &surface, SUN_SEEN, LOOK, SUNLIT, include_str!("cache/march.wgsl")]);
        parts.push(include_str!("passes/water_ground.wgsl"));
    } else {
        parts.push(include_str!("passes/water_no_ground.wgsl"));
    }
    parts.extend([include_str!("passes/water_sun.wgsl"), include_str!("passes/water_mirror.wgsl")]);
    parts.push(include_str!("passes/water.wgsl"));
    parts.join("\n").replace("@group(0)", "@group(1)")
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
/// shading languages. `kernel` is a terrain's, from [`CompiledMaterial::kernel`](horizon_field::material::CompiledMaterial::kernel).
pub fn shader_sources(kernel: &str) -> Vec<(&'static str, String)> {
    let alone = |source: &Source| {
        use Source::{Air, Gradient, Heat, Shade, Trees, Water};
        !matches!(
            source,
            Shade { .. }
                | Trees { .. }
                | Water { .. }
                | Heat { ldr: true }
                | Gradient { ldr: true, .. }
                | Air { ldr: true, .. }
        )
    };
    let own = Source::all().into_iter().filter(alone).map(|source| (source.name(), source.text()));
    [("fill", fill_source(kernel))].into_iter().chain(own).collect()
}
