//! The bodies of water around a view, as shaders see them: relative to the eye, so that no absolute coordinate is in them.

use std::sync::Arc;

use bevy::camera::visibility::RenderLayers;
use bevy::math::Vec3Swizzles;
use bevy::prelude::*;
use bevy::render::render_resource::{
    BindingResource, DynamicUniformBuffer, Extent3d, ShaderType, TextureDataOrder, TextureDescriptor, TextureDimension,
    TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, TextureViewDimension,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::view::ExtractedView;
use horizon_field::CELL;
use horizon_field::waves::{CASCADES, Sea};
use horizon_light::water::WaterOptics;

use super::extract::{ExtractedHorizonCamera, ExtractedWorld};
use crate::world::{Atmosphere, MASK_TEXELS, MaskTable, Water, WaterDisc, WaterMask, WaterOutline, WaterRectangle};

/// How many bodies of water a view sees.
pub const BODIES: usize = 8;

/// A body of water.
pub struct ExtractedWater {
    pub water: Arc<Water>,
    /// Its waves, by their index among the seas of this frame.
    pub sea: Option<(usize, Arc<Sea>)>,
    pub translation: Vec3,
    /// The table of its outline, where that is a mask.
    pub(crate) mask: Option<Arc<MaskTable>>,
    pub layers: RenderLayers,
}

/// `Water` of horizon_light's `water.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct OpticsUniform {
    pub absorption: Vec3,
    pub index: f32,
    pub scattering: Vec3,
    pub anisotropy: f32,
    pub molecules: Vec3,
    pub foam: f32,
}

impl OpticsUniform {
    fn new(optics: &WaterOptics) -> Self {
        Self {
            absorption: optics.absorption.into(),
            index: optics.index,
            scattering: optics.scattering.into(),
            anisotropy: optics.anisotropy,
            molecules: optics.molecules.into(),
            foam: optics.foam,
        }
    }
}

/// `WaveCascade` of `water_bodies.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct CascadeUniform {
    #[shader(align(16))]
    pub phase: Vec2,
    pub per_metre: f32,
    pub bound: f32,
    pub layer: u32,
}

/// `WaterBody` of `water_bodies.wgsl`.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub struct WaterUniform {
    pub optics: OpticsUniform,
    pub centre: Vec2,
    pub half: Vec2,
    pub outline: u32,
    pub mask: u32,
    pub above: f32,
    pub bound: f32,
    pub slope: f32,
    pub foam: f32,
    pub ripples: f32,
    pub count: u32,
    pub cascades: [CascadeUniform; CASCADES],
}

/// `Waters` of `water_bodies.wgsl`.
#[derive(Clone, Debug, Default, ShaderType)]
pub struct WatersUniform {
    pub count: u32,
    pub sun_radius: f32,
    #[shader(align(16))]
    pub bodies: [WaterUniform; BODIES],
}

impl WatersUniform {
    /// What a view sees: the nearest bodies, by their level and outline.
    pub fn new(
        world: &ExtractedWorld,
        masks: &WaterMasks,
        camera: &ExtractedHorizonCamera,
        view: &ExtractedView,
    ) -> Self {
        let eye = view.world_from_view.translation();
        let mut bodies: Vec<_> = world
            .waters
            .iter()
            .filter(|water| camera.layers.intersects(&water.layers))
            .map(|water| (distance(water, eye), water))
            .collect();
        bodies.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let sun_radius = world.risen_sun().map_or(Atmosphere::EARTH_SUN_RADIUS, |(_, radius)| radius);
        let mut uniform = Self { sun_radius, ..default() };
        for (body, (_, water)) in uniform.bodies.iter_mut().zip(bodies) {
            *body = WaterUniform::new(water, world, masks, eye);
            uniform.count += 1;
        }
        uniform
    }

    /// Whether any of it has waves.
    pub fn moves(&self) -> bool {
        self.bodies.iter().any(|body| body.count > 0)
    }
}

/// How far the eye is from a body, along the plane.
fn distance(water: &ExtractedWater, eye: Vec3) -> f32 {
    let from = (eye - water.translation).xz();
    match &water.water.outline {
        WaterOutline::Endless => 0.0,
        WaterOutline::Disc(WaterDisc { radius }) => (from.length() - *radius).max(0.0),
        WaterOutline::Rectangle(WaterRectangle { half }) | WaterOutline::Mask(WaterMask { half, .. }) => {
            (from.abs() - Vec2::from_array(*half)).max(Vec2::ZERO).length()
        }
    }
}

impl WaterUniform {
    fn new(water: &ExtractedWater, world: &ExtractedWorld, masks: &WaterMasks, eye: Vec3) -> Self {
        let body = &water.water;
        let (outline, half) = match &body.outline {
            WaterOutline::Endless => (0, Vec2::ZERO),
            WaterOutline::Disc(WaterDisc { radius }) => (1, Vec2::splat(*radius)),
            WaterOutline::Rectangle(WaterRectangle { half }) => (2, Vec2::from_array(*half)),
            WaterOutline::Mask(WaterMask { half, .. }) => (3, Vec2::from_array(*half)),
        };
        let mut uniform = Self {
            optics: OpticsUniform::new(&body.optics),
            centre: (water.translation - eye).xz(),
            half,
            outline,
            mask: water.mask.as_ref().map_or(0, |mask| masks.layer(mask)),
            above: eye.y - water.translation.y,
            foam: body.foam,
            ripples: body.ripples,
            ..default()
        };
        let Some((index, sea)) = &water.sea else { return uniform };
        uniform.ripples += sea.rest as f32;
        // Where the eye stands in the world, in f64: tiles do not move with Bevy's origin.
        let place = world.origin.translated(eye.as_dvec3().to_array());
        let at = [0, 2].map(|i| place.cell[i] as f64 * CELL + place.offset[i]);
        let mut variance = 0.0;
        for (i, (to, cascade)) in uniform.cascades.iter_mut().zip(&sea.cascades).enumerate() {
            let phase = at.map(|x| (x / cascade.side).rem_euclid(1.0) as f32);
            *to = CascadeUniform {
                phase: Vec2::from_array(phase),
                per_metre: (1.0 / cascade.side) as f32,
                bound: cascade.bound,
                layer: (CASCADES * index + i) as u32,
            };
            uniform.count += 1;
            uniform.bound += cascade.bound;
            variance += cascade.slope_variance() as f32;
        }
        // Three deviations of the slope along a ray; crests of displaced waves are steeper.
        uniform.slope = (3.0 * (0.5 * variance).sqrt()).clamp(0.05, 1.5);
        uniform
    }
}

/// The views' bodies of water; no buffer before a view sees any.
#[derive(Resource, Default)]
pub struct HorizonWaters(DynamicUniformBuffer<WatersUniform>);

impl HorizonWaters {
    pub fn clear(&mut self) {
        self.0.clear();
    }

    pub fn push(&mut self, waters: &WatersUniform) -> u32 {
        self.0.push(waters)
    }

    pub fn write(&mut self, device: &RenderDevice, queue: &RenderQueue) {
        if !self.0.is_empty() {
            self.0.write_buffer(device, queue);
        }
    }

    pub fn binding(&self) -> Option<BindingResource<'_>> {
        self.0.binding()
    }
}

/// The masks of all bodies, a layer each; a single texel where there is none.
#[derive(Resource, Default)]
pub struct WaterMasks {
    of: Vec<Arc<MaskTable>>,
    view: Option<TextureView>,
}

impl WaterMasks {
    /// Makes the texture, where the masks are others than those that it holds.
    pub fn prepare(&mut self, world: &ExtractedWorld, device: &RenderDevice, queue: &RenderQueue) {
        let masks: Vec<_> = world.waters.iter().filter_map(|water| water.mask.clone()).collect();
        let same = masks.len() == self.of.len() && masks.iter().zip(&self.of).all(|(a, b)| Arc::ptr_eq(a, b));
        if self.view.is_some() && same {
            return;
        }
        let side = if masks.is_empty() { 1 } else { MASK_TEXELS as u32 };
        let mut values: Vec<f32> = masks.iter().flat_map(|mask| mask.values.iter().copied()).collect();
        values.resize((side * side) as usize * masks.len().max(1), 1.0);
        let texture = device.create_texture_with_data(
            queue,
            &TextureDescriptor {
                label: Some("horizon_water_masks"),
                size: Extent3d { width: side, height: side, depth_or_array_layers: masks.len().max(1) as u32 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: TextureDimension::D2,
                format: TextureFormat::R32Float,
                usage: TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&values),
        );
        let dimension = Some(TextureViewDimension::D2Array);
        self.view = Some(texture.create_view(&TextureViewDescriptor { dimension, ..default() }));
        self.of = masks;
    }

    fn layer(&self, mask: &Arc<MaskTable>) -> u32 {
        self.of.iter().position(|other| Arc::ptr_eq(mask, other)).unwrap_or(0) as u32
    }

    /// What the pass binds.
    pub fn view(&self) -> Option<&TextureView> {
        self.view.as_ref()
    }
}
