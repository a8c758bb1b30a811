//! What the shaders see: one struct each, laid out by `ShaderType`.

use bevy::math::{IVec2, Mat4, UVec3, Vec2, Vec3, Vec4};
use bevy::render::render_resource::ShaderType;

use super::cache::clipmap::{DrawnLevel, MAX_LEVELS};
use crate::world::{Atmosphere, TerrainMaterial};

/// `Level` of `surface.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct LevelUniform {
    pub texel: f32,
    pub per_metre: f32,
    pub inner: f32,
    pub outer: f32,
    pub base: IVec2,
    pub fraction: Vec2,
    pub low: IVec2,
    pub high: IVec2,
    #[shader(size(16))]
    pub slot: u32,
}

/// `Clipmap` of `surface.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub struct ClipmapUniform {
    pub levels: [LevelUniform; MAX_LEVELS],
    pub count: u32,
    pub side: u32,
}

impl ClipmapUniform {
    pub fn new(drawn: &[DrawnLevel], side: u32) -> Self {
        let mut uniform = Self { count: drawn.len() as u32, side, ..Default::default() };
        for (to, from) in uniform.levels.iter_mut().zip(drawn) {
            *to = LevelUniform {
                texel: (from.exponent as f32).exp2(),
                per_metre: (-from.exponent as f32).exp2(),
                inner: from.inner,
                outer: from.outer,
                base: IVec2::from_array(from.base),
                fraction: Vec2::from_array(from.fraction),
                low: IVec2::from_array(from.low),
                high: IVec2::from_array(from.high),
                slot: from.slot,
            };
        }
        uniform
    }
}

/// `Sun` of `light.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct SunUniform {
    pub towards: Vec2,
    pub low: f32,
    pub centre: f32,
    pub high: f32,
    pub radius: f32,
    pub highest: f32,
}

impl SunUniform {
    /// The sun's disc as seen along the ground. Straight overhead it has no azimuth, and any will do.
    pub fn new(direction: Vec3, radius: f32, highest: f32) -> Self {
        let towards = Vec2::new(direction.x, direction.z).try_normalize().unwrap_or(Vec2::X);
        let elevation = direction.y.clamp(-1.0, 1.0).asin();
        let tangent = |angle: f32| angle.clamp(-1.57, 1.57).tan();
        let centre = tangent(elevation);
        Self {
            towards,
            low: tangent(elevation - radius),
            centre,
            // The disc's upper edge as far above its centre as keeps the penumbra's formula finite near the zenith.
            high: tangent(elevation + radius).max(centre + 1e-6 + 1e-4 * centre.abs()),
            radius,
            highest,
        }
    }
}

/// `Material` of `material.wgsl`.
#[derive(Clone, Debug, PartialEq, ShaderType)]
pub struct MaterialUniform {
    pub mud: Vec4,
    pub sand: Vec4,
    pub grass: Vec4,
    pub dry_grass: Vec4,
    pub rock: Vec4,
    pub strata: Vec4,
    pub snow: Vec4,
    pub boundaries: Vec4,
    pub softness: Vec4,
    pub grass_flatness: f32,
    pub snow_flatness: f32,
    pub strata_thickness: f32,
}

impl MaterialUniform {
    pub fn new(material: &TerrainMaterial) -> Self {
        let colour = |rgb: [f32; 3], gloss: f32| Vec3::from_array(rgb).extend(gloss);
        Self {
            mud: colour(material.mud, 0.5),
            sand: colour(material.sand, 0.2),
            grass: colour(material.grass, 0.12),
            dry_grass: colour(material.dry_grass, 0.1),
            rock: colour(material.rock, 0.25),
            strata: colour(material.strata, 0.25),
            snow: colour(material.snow, 0.6),
            boundaries: Vec4::from_array(material.boundaries),
            softness: Vec4::from_array(material.softness),
            grass_flatness: material.grass_flatness,
            snow_flatness: material.snow_flatness,
            strata_thickness: material.strata_thickness,
        }
    }
}

/// `View` of `view.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub struct HorizonViewUniform {
    pub view_from_clip: Mat4,
    pub clip_from_view: Mat4,
    pub right: Vec3,
    pub up: Vec3,
    pub back: Vec3,
    pub eye: Vec3,
    pub viewport: Vec4,
    pub sun_direction: Vec3,
    pub exposure: f32,
    pub sun: Vec3,
    pub far: f32,
    pub ambient: Vec3,
    pub debug: u32,
    pub pixel: f32,
    pub orthographic: u32,
    pub slopes: Vec2,
    pub columns: UVec3,
    pub rings: Vec2,
}

/// `Sky` of `sky.wgsl`.
#[derive(Clone, Debug, PartialEq, ShaderType)]
pub struct SkyUniform {
    pub zenith: Vec4,
    pub horizon: Vec4,
    pub glow: Vec4,
    pub haze: f32,
    pub haze_height: f32,
    pub sun_cosine: f32,
    pub sun_luminance: f32,
}

impl SkyUniform {
    pub fn new(atmosphere: &Atmosphere) -> Self {
        let colour = |rgb: [f32; 3]| Vec3::from_array(rgb).extend(0.0);
        Self {
            zenith: colour(atmosphere.zenith),
            horizon: colour(atmosphere.horizon),
            glow: colour(atmosphere.glow),
            // `max` also takes the limit in place of NaN.
            haze: atmosphere.haze.max(0.0),
            haze_height: atmosphere.haze_height.max(1.0),
            sun_cosine: atmosphere.sun_radius.max(1e-4).cos(),
            // Bright enough to bloom, dim enough for a half float.
            sun_luminance: 6e4,
        }
    }
}
