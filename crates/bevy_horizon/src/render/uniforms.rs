//! What the shaders see: one struct each, laid out by `ShaderType`.

use bevy::math::{IVec2, Mat3, Mat4, UVec3, Vec2, Vec3, Vec4};
use bevy::render::render_resource::ShaderType;

use horizon_field::material::{CompiledMaterial, ROWS};
use horizon_light::models::air::Air;
use horizon_light::sun::SunDisc;

use super::cache::clipmap::{DrawnLevel, MAX_LEVELS};
use crate::world::Atmosphere;

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

/// `Material` of horizon_field's `material.wgsl`, in rows.
#[derive(Clone, Debug, PartialEq, ShaderType)]
pub struct MaterialUniform {
    pub rows: [Vec4; ROWS],
}

impl MaterialUniform {
    pub fn new(material: &CompiledMaterial) -> Self {
        Self { rows: material.rows().map(Vec4::from_array) }
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
    pub holes: u32,
    pub sun_towards: Vec3,
    pub self_shadow: u32,
    pub clip_from_offset: Mat4,
    pub previous_clip_from_offset: Mat4,
}

/// `GradientAir` of `sky_gradient.wgsl`.
#[derive(Clone, Debug, PartialEq, ShaderType)]
pub struct GradientUniform {
    pub zenith: Vec3,
    // Of the shader's own haze, which is not used: this one thins with height.
    pub level_haze: f32,
    pub horizon: Vec3,
    pub night: f32,
    pub sunset: Vec3,
    #[shader(align(16))]
    pub haze: f32,
    pub haze_height: f32,
    pub sun_cosine: f32,
    pub sun_luminance: f32,
}

impl GradientUniform {
    pub fn new(atmosphere: &Atmosphere) -> Self {
        let gradient = &atmosphere.gradient;
        Self {
            zenith: gradient.zenith.into(),
            level_haze: 0.0,
            horizon: gradient.horizon.into(),
            night: atmosphere.night,
            sunset: gradient.sunset.into(),
            haze: gradient.haze,
            haze_height: gradient.haze_height,
            sun_cosine: (atmosphere.medium.sun_radius as f32).max(1e-4).cos(),
            // Bright enough to bloom, dim enough for a half float.
            sun_luminance: 6e4,
        }
    }
}

/// `Medium` of horizon_light's `air.wgsl`: seven rows, each a colour and a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct MediumUniform {
    pub rows: [Vec4; 7],
}

impl MediumUniform {
    pub fn new(air: &Air<f32>) -> Self {
        Self { rows: air.uniform().map(Vec4::from_array) }
    }
}

/// `SunDisc` of horizon_light's `sun.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct DiscUniform {
    pub center: Vec3,
    pub sine: f32,
    pub limb: [Vec3; 6],
}

impl DiscUniform {
    pub fn new(disc: &SunDisc<f32>) -> Self {
        Self { center: disc.center.into(), sine: disc.sine, limb: disc.limb.map(Vec3::from_array) }
    }
}

/// `AirView` of `air_view.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct AirUniform {
    pub medium: MediumUniform,
    pub disc: DiscUniform,
    pub to_rgb: Mat3,
    pub diffuse: [Vec3; 6],
    pub sun: Vec3,
    pub h: f32,
    pub datum: f32,
    pub far: f32,
    pub night: f32,
    pub own_sun: u32,
}
