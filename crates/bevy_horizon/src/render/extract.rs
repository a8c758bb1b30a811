//! What the renderer takes from the main world, each frame.

use std::sync::Arc;

use bevy::camera::visibility::{InheritedVisibility, RenderLayers};
use bevy::light::{AmbientLight, DirectionalLight, GlobalAmbientLight};
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::sync_component::SyncComponent;
use bevy::render::sync_world::RenderEntity;
use horizon_field::Place;

use super::kernel::TerrainKernel;
use super::passes::{ViewClearance, ViewPasses};
use super::uniforms::SkyUniform;
use super::view::ViewGround;
use crate::camera::HorizonCamera;
use crate::world::{Atmosphere, CompiledTerrain, TerrainFields, WorldOrigin};

/// The worlds, as they stand in this frame.
#[derive(Resource, Default)]
pub struct ExtractedWorld {
    pub terrains: Vec<ExtractedTerrain>,
    pub atmospheres: Vec<(SkyUniform, f32, RenderLayers)>,
    pub sun: Option<ExtractedSun>,
    pub origin: Place,
    pub settings: super::cache::CacheSettings,
}

impl ExtractedWorld {
    /// The sun, and its angular radius in radians, while any of its disc stands over the level.
    pub fn risen_sun(&self) -> Option<(ExtractedSun, f32)> {
        let radius = self.atmospheres.first().map_or(Atmosphere::EARTH_SUN_RADIUS, |(_, radius, _)| *radius);
        self.sun.filter(|sun| sun.direction.y > -radius.sin()).map(|sun| (sun, radius))
    }

    /// The air that a camera sees.
    pub fn sky(&self, layers: &RenderLayers) -> Option<SkyUniform> {
        self.atmospheres.iter().find(|(_, _, l)| layers.intersects(l)).map(|(sky, _, _)| sky.clone())
    }
}

pub struct ExtractedTerrain {
    pub entity: Entity,
    pub fields: Arc<TerrainFields>,
    pub kernel: TerrainKernel,
    pub translation: Vec3,
    pub layers: RenderLayers,
}

/// The brightest directional light.
#[derive(Clone, Copy)]
pub struct ExtractedSun {
    /// Towards it.
    pub direction: Vec3,
    /// In lux.
    pub illuminance: Vec3,
}

/// A camera that draws worlds.
#[derive(Component, Clone)]
pub struct ExtractedHorizonCamera {
    pub camera: HorizonCamera,
    pub layers: RenderLayers,
    /// Luminance of the ambient light, in cd/m².
    pub ambient: Vec3,
    /// Whether its ground is drawn from a cache.
    pub cached: bool,
}

impl SyncComponent for HorizonCamera {
    type Target = (ExtractedHorizonCamera, ViewGround, ViewPasses, ViewClearance);
}

type Terrains<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static CompiledTerrain,
        &'static TerrainKernel,
        &'static GlobalTransform,
        &'static InheritedVisibility,
        Option<&'static RenderLayers>,
    ),
>;

pub fn extract_world(
    mut world: ResMut<ExtractedWorld>,
    terrains: Extract<Terrains>,
    suns: Extract<Query<(&DirectionalLight, &GlobalTransform, &InheritedVisibility)>>,
    origin: Extract<Res<WorldOrigin>>,
    settings: Extract<Res<super::cache::CacheSettings>>,
) {
    world.origin = origin.0;
    world.settings = settings.clone();
    world.terrains.clear();
    for (entity, compiled, kernel, transform, visibility, layers) in &terrains {
        if visibility.get() {
            world.terrains.push(ExtractedTerrain {
                entity,
                fields: compiled.0.clone(),
                kernel: kernel.clone(),
                translation: transform.translation(),
                layers: layers.cloned().unwrap_or_default(),
            });
        }
    }
    world.sun = suns
        .iter()
        .filter(|(_, _, visibility)| visibility.get())
        .map(|(light, transform, _)| ExtractedSun {
            direction: *transform.back(),
            illuminance: light.color.to_linear().to_vec3() * light.illuminance,
        })
        .max_by(|a, b| a.illuminance.element_sum().total_cmp(&b.illuminance.element_sum()));
}

pub fn extract_atmospheres(
    mut world: ResMut<ExtractedWorld>,
    atmospheres: Extract<Query<(&Atmosphere, &InheritedVisibility, Option<&RenderLayers>)>>,
) {
    world.atmospheres.clear();
    for (atmosphere, visibility, layers) in &atmospheres {
        if visibility.get() {
            let layers = layers.cloned().unwrap_or_default();
            world.atmospheres.push((SkyUniform::new(atmosphere), atmosphere.sun_radius, layers));
        }
    }
}

type Cameras<'w, 's> = Query<
    'w,
    's,
    (
        RenderEntity,
        &'static HorizonCamera,
        &'static Camera,
        Option<&'static RenderLayers>,
        Option<&'static AmbientLight>,
    ),
>;

pub fn extract_cameras(
    mut commands: Commands,
    cameras: Extract<Cameras>,
    global: Extract<Option<Res<GlobalAmbientLight>>>,
) {
    for (entity, camera, active, layers, ambient) in &cameras {
        let mut entity = commands.entity(entity);
        if !active.is_active {
            entity.remove::<<HorizonCamera as SyncComponent>::Target>();
            continue;
        }
        let ambient = match (ambient, global.as_deref()) {
            (Some(light), _) => light.color.to_linear().to_vec3() * light.brightness,
            (None, Some(light)) => light.color.to_linear().to_vec3() * light.brightness,
            (None, None) => Vec3::ZERO,
        };
        entity.insert(ExtractedHorizonCamera {
            camera: camera.clone(),
            layers: layers.cloned().unwrap_or_default(),
            ambient,
            cached: true,
        });
    }
}
