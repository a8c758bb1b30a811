//! What the renderer takes from the main world, each frame.

use std::f64::consts::TAU;
use std::sync::Arc;

use bevy::camera::visibility::{InheritedVisibility, RenderLayers};
use bevy::light::{AmbientLight, DirectionalLight, GlobalAmbientLight};
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_component::SyncComponent;
use bevy::render::sync_world::RenderEntity;
use horizon_field::trees::Wind;
use horizon_field::{Place, Stamps};

use super::able::Able;
use super::air::ViewAir;
use super::kernel::TerrainKernel;
use super::passes::{ViewClearance, ViewGeometry, ViewPasses, ViewShade, ViewTrees, ViewWater};
use super::trees::ViewGrove;
use super::view::{ViewBefore, ViewGround};
use super::water::ExtractedWater;
use super::waves::{ExtractedSeas, MOST_SEAS};
use crate::camera::HorizonCamera;
use crate::world::{
    Atmosphere, CompiledAtmosphere, CompiledStamps, CompiledTerrain, CompiledTrees, CompiledWater, Sunlight,
    TerrainFields, Trees, WaterPlace, Woods, WorldOrigin,
};

/// The worlds, as they stand in this frame.
#[derive(Resource, Default)]
pub struct ExtractedWorld {
    pub terrains: Vec<ExtractedTerrain>,
    pub atmospheres: Vec<ExtractedAtmosphere>,
    pub waters: Vec<ExtractedWater>,
    pub sun: Option<ExtractedSun>,
    pub origin: Place,
    pub settings: super::cache::CacheSettings,
    /// What terrain without stamps has: always the same, so that it does not look changed.
    bare: Arc<Stamps>,
}

impl ExtractedWorld {
    /// The sun, and its angular radius in radians, while any of its disc stands over the level.
    pub fn risen_sun(&self) -> Option<(ExtractedSun, f32)> {
        let radius = self.atmospheres.first().map_or(Atmosphere::EARTH_SUN_RADIUS, |air| air.sun_radius);
        self.sun.filter(|sun| sun.direction.y > -radius.sin()).map(|sun| (sun, radius))
    }

    /// The sun whose shadows the ground casts onto itself.
    pub fn shading_sun(&self) -> Option<(ExtractedSun, f32)> {
        self.risen_sun().filter(|(sun, _)| sun.shadows)
    }

    /// What the shaders know of the ground's own shadow: 1 where the cache has it, 2 where the ground hides a sun that is down.
    pub fn self_shadow(&self) -> u32 {
        let below = self.sun.is_some_and(|sun| sun.shadows) && self.risen_sun().is_none();
        if below { 2 } else { u32::from(self.shading_sun().is_some()) }
    }

    /// Whether a camera sees water.
    pub fn has_water(&self, layers: &RenderLayers) -> bool {
        self.waters.iter().any(|water| layers.intersects(&water.layers))
    }

    /// The air that a camera sees, by its index.
    pub fn air(&self, layers: &RenderLayers) -> Option<usize> {
        self.atmospheres.iter().position(|air| layers.intersects(&air.layers))
    }
}

/// An atmosphere.
pub struct ExtractedAtmosphere {
    pub compiled: CompiledAtmosphere,
    pub sun_radius: f32,
    pub translation: Vec3,
    pub layers: RenderLayers,
}

pub struct ExtractedTerrain {
    pub entity: Entity,
    pub(crate) fields: Arc<TerrainFields>,
    pub(crate) stamps: Arc<Stamps>,
    pub kernel: TerrainKernel,
    pub translation: Vec3,
    pub layers: RenderLayers,
    /// What grows on it, and the wind there.
    pub(crate) woods: Option<Arc<Woods>>,
    pub(crate) wind: Wind,
}

/// The scene's [`Sunlight`], or else its brightest directional light.
#[derive(Clone, Copy)]
pub struct ExtractedSun {
    /// Towards it.
    pub direction: Vec3,
    /// In lux.
    pub illuminance: Vec3,
    /// Whether the air dims it.
    pub own: bool,
    /// Whether it casts shadows.
    pub shadows: bool,
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
    type Target = (
        ExtractedHorizonCamera,
        ViewGround,
        ViewBefore,
        ViewAir,
        ViewPasses,
        ViewGeometry,
        ViewShade,
        ViewClearance,
        ViewWater,
        ViewGrove,
        ViewTrees,
    );
}

type Terrains<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static CompiledTerrain,
        Option<&'static CompiledStamps>,
        Option<&'static CompiledTrees>,
        &'static TerrainKernel,
        &'static GlobalTransform,
        &'static InheritedVisibility,
        Option<&'static RenderLayers>,
    ),
>;

type Suns<'w, 's> = Query<
    'w,
    's,
    (
        &'static DirectionalLight,
        &'static GlobalTransform,
        &'static InheritedVisibility,
        Has<Sunlight>,
        Option<&'static RenderLayers>,
    ),
>;

pub fn extract_world(
    mut world: ResMut<ExtractedWorld>,
    terrains: Extract<Terrains>,
    suns: Extract<Suns>,
    origin: Extract<Res<WorldOrigin>>,
    settings: Extract<Res<super::cache::CacheSettings>>,
    time: Extract<Option<Res<Time>>>,
    mut able: Local<Option<Able>>,
    device: Res<RenderDevice>,
) {
    // Without what it takes there is no world to draw: as if none were there.
    if !able.get_or_insert_with(|| Able::new(&device)).0 {
        return;
    }
    world.origin = origin.0;
    world.settings = settings.clone();
    world.terrains.clear();
    let bare = world.bare.clone();
    for (entity, compiled, stamps, trees, kernel, transform, visibility, layers) in &terrains {
        if visibility.get() {
            world.terrains.push(ExtractedTerrain {
                entity,
                fields: compiled.0.clone(),
                stamps: stamps.map_or_else(|| bare.clone(), |stamps| stamps.0.clone()),
                kernel: kernel.clone(),
                translation: transform.translation(),
                layers: layers.cloned().unwrap_or_default(),
                woods: trees.map(|trees| trees.woods.clone()),
                wind: trees.map_or_else(Wind::default, |trees| wind_of(&trees.trees, time.as_deref())),
            });
        }
    }
    // A light of layers that no ground is in is no sun of it.
    let shines = |layers: Option<&RenderLayers>| {
        let layers = layers.cloned().unwrap_or_default();
        world.terrains.is_empty() || world.terrains.iter().any(|terrain| layers.intersects(&terrain.layers))
    };
    world.sun = suns
        .iter()
        .filter(|(_, _, visibility, _, layers)| visibility.get() && shines(*layers))
        .map(|(light, transform, _, own, _)| ExtractedSun {
            direction: *transform.back(),
            illuminance: light.color.to_linear().to_vec3() * light.illuminance,
            own,
            shadows: light.shadow_maps_enabled,
        })
        .max_by(|a, b| {
            let brighter = a.illuminance.element_sum().total_cmp(&b.illuminance.element_sum());
            a.own.cmp(&b.own).then(brighter)
        });
}

/// The wind as it blows now.
fn wind_of(trees: &Trees, time: Option<&Time>) -> Wind {
    let sway = trees.wind.map(f64::from);
    let seconds = time.filter(|_| sway != [0.0; 2]).map_or(0.0, Time::elapsed_secs_f64);
    Wind { sway, gust: (seconds / f64::from(trees.gust.max(0.1))).fract() * TAU }
}

pub fn extract_atmospheres(
    mut world: ResMut<ExtractedWorld>,
    atmospheres: Extract<Query<(&CompiledAtmosphere, &GlobalTransform, &InheritedVisibility, Option<&RenderLayers>)>>,
) {
    world.atmospheres.clear();
    for (compiled, transform, visibility, layers) in &atmospheres {
        if visibility.get() {
            world.atmospheres.push(ExtractedAtmosphere {
                compiled: compiled.clone(),
                sun_radius: compiled.atmosphere.medium.sun_radius as f32,
                translation: transform.translation(),
                layers: layers.cloned().unwrap_or_default(),
            });
        }
    }
}

type Waters<'w, 's> = Query<
    'w,
    's,
    (
        &'static CompiledWater,
        Option<&'static WaterPlace>,
        &'static GlobalTransform,
        &'static InheritedVisibility,
        Option<&'static RenderLayers>,
    ),
>;

/// Water is drawn only where the world is: after [`extract_world`].
pub fn extract_waters(mut world: ResMut<ExtractedWorld>, mut seas: ResMut<ExtractedSeas>, waters: Extract<Waters>) {
    let origin = WorldOrigin(world.origin);
    world.waters.clear();
    seas.0.clear();
    for (compiled, place, transform, visibility, layers) in &waters {
        if !visibility.get() {
            continue;
        }
        let sea = compiled.surface.as_ref().and_then(|surface| {
            let sea = surface.sea();
            let known = seas.0.iter().position(|other| Arc::ptr_eq(other, sea));
            let index = known.or_else(|| {
                (seas.0.len() < MOST_SEAS).then(|| {
                    seas.0.push(sea.clone());
                    seas.0.len() - 1
                })
            })?;
            Some((index, sea.clone()))
        });
        world.waters.push(ExtractedWater {
            water: compiled.water.clone(),
            mask: compiled.mask.clone(),
            sea,
            translation: place.map_or(transform.translation(), |place| origin.position(&place.0)),
            layers: layers.cloned().unwrap_or_default(),
        });
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
        let layers = layers.cloned().unwrap_or_default();
        entity.insert(ExtractedHorizonCamera { camera: camera.clone(), layers, ambient, cached: true });
    }
}
