//! Worlds as files: RON, versioned, through Bevy's asset loader, with hot reload. A file that makes no sense is refused
//! with the field and the line, and the world that was loaded stays.

use std::collections::BTreeMap;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoadError, AssetLoadFailedEvent, AssetLoader, LoadContext};
#[cfg(feature = "render")]
use bevy::light::{CascadeShadowConfig, CascadeShadowConfigBuilder};
use bevy::prelude::*;
use horizon_field::FieldError;
use horizon_field::Place;
use horizon_field::field::HeightImage;
use horizon_field::field::check::MAX_DEPTH;
use horizon_field::material::MaterialError;
use horizon_field::stamp::{Placed, StampError};
use horizon_field::trees::ForestError;
use horizon_field::waves::WavesError;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::HorizonSystems;
use crate::world::{
    Atmosphere, CompiledTerrain, Felled, HeightImages, ParamError, Stamp, StampPlace, Sun, Terrain, TerrainError,
    Trees, TreesError, Water, WaterError, WaterOutline, WaterPlace, check_atmosphere, check_params,
};
#[cfg(feature = "render")]
use crate::world::{SkyModel, Sunlight, illuminance};

/// The version of world files that this crate reads and writes.
pub const WORLD_VERSION: u32 = 1;

/// A world, as it stands in a file.
#[derive(Asset, TypePath, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldFile {
    /// The file's version: 1.
    pub version: u32,
    /// The ground. Default: none.
    #[serde(default)]
    pub terrain: Option<Terrain>,
    /// The air. Default: none.
    #[serde(default)]
    pub atmosphere: Option<Atmosphere>,
    /// The sun. Default: none, the game's own lights are used.
    #[serde(default)]
    pub sun: Option<Sun>,
    /// Bodies of water. Default: none.
    #[serde(default)]
    pub waters: Vec<PlacedWater>,
    /// Local edits of the ground. Default: none.
    #[serde(default)]
    pub stamps: Vec<Placed>,
    /// What grows on the ground. Default: nothing.
    #[serde(default)]
    pub trees: Option<Trees>,
    /// Plants that stand no more, by their names. Default: none.
    #[serde(default)]
    pub felled: Felled,
    /// A good place to look from.
    #[serde(default)]
    pub view: Viewpoint,
}

/// A body of water, and where it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlacedWater {
    /// Its level above the ground's zero, in metres. Default: 0.
    pub level: f32,
    /// Its middle, as x and z, in metres. Default: the origin.
    pub middle: [f32; 2],
    /// The water.
    pub water: Water,
}

/// A place to look from. The world itself does not use it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Viewpoint {
    /// Where, as x and z, in metres. Default: the origin.
    pub position: [f32; 2],
    /// Metres above the ground. Default: 80.
    pub above_ground: f32,
    /// Where to, from −z (north) towards +x (east), in radians. Default: 0.
    pub heading: f32,
    /// Up or down, in radians. Default: −0.1.
    pub pitch: f32,
}

impl Default for Viewpoint {
    fn default() -> Self {
        Self { position: [0.0; 2], above_ground: 80.0, heading: 0.0, pitch: -0.1 }
    }
}

/// Why a world file was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WorldFileError {
    /// The file can't be read.
    #[error("the file can't be read: {0}")]
    Read(#[from] std::io::Error),
    /// The file is not text, or not RON, or has an unknown or a missing field.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// The file is of a version that this crate does not know.
    #[error("version {found} is not known: this is version {WORLD_VERSION} of world files")]
    Version {
        /// The file's version.
        found: u32,
    },
    /// A parameter or a field makes no sense.
    #[error("{}{source}", line.map(|line| format!("line {line}: ")).unwrap_or_default())]
    Value {
        /// The line, where it could be found.
        line: Option<usize>,
        /// What is wrong, with the path of the field.
        source: TerrainError,
    },
    /// A height image can't be had.
    #[error("{}the height image \"{path}\" can't be had: {reason}", line.map(|line| format!("line {line}: ")).unwrap_or_default())]
    Image {
        /// The line, where it could be found.
        line: Option<usize>,
        /// The image's path, from the root of the assets.
        path: String,
        /// Why.
        reason: String,
    },
}

impl WorldFile {
    /// Reads a world from RON, and checks all but its images.
    ///
    /// # Errors
    /// See [`WorldFileError`].
    pub fn from_ron(text: &str) -> Result<Self, WorldFileError> {
        let syntax = |error: ron::error::SpannedError| WorldFileError::Syntax {
            line: error.span.start.line,
            column: error.span.start.col,
            message: error.code.to_string(),
        };
        // The version first: another version's fields are not this one's mistakes.
        #[derive(Deserialize)]
        struct Version {
            version: u32,
        }
        if let Ok(Version { version: found }) = options().from_str(text)
            && found != WORLD_VERSION
        {
            return Err(WorldFileError::Version { found });
        }
        let world: Self = options().from_str(text).map_err(syntax)?;
        world.check().map_err(|source| WorldFileError::Value { line: line_of(text, &source), source })?;
        Ok(world)
    }

    /// Writes the world as RON, in a stable order.
    ///
    /// # Errors
    /// None for any world that [`WorldFile::from_ron`] reads.
    pub fn to_ron(&self) -> Result<String, ron::Error> {
        options().to_string_pretty(self, ron::ser::PrettyConfig::default().struct_names(false))
    }

    /// The images that its fields name.
    fn image_paths(&self) -> Vec<String> {
        let ground = self
            .terrain
            .iter()
            .flat_map(|terrain| terrain.field.image_paths().into_iter().chain(terrain.material.image_paths()));
        let grown = self.trees.iter().flat_map(|trees| [&trees.forest.density, &trees.forest.species_of]);
        let lakes = self.waters.iter().filter_map(|placed| match &placed.water.outline {
            WaterOutline::Mask(mask) => Some(&mask.field),
            _ => None,
        });
        ground.chain(grown.chain(lakes).flat_map(|field| field.image_paths())).collect()
    }

    fn check(&self) -> Result<(), TerrainError> {
        if let Some(terrain) = &self.terrain {
            terrain.field.check()?;
            terrain.material.check()?;
        }
        if let Some(atmosphere) = &self.atmosphere {
            check_atmosphere(atmosphere)?;
        }
        if let Some(sun) = &self.sun {
            check_params("sun", sun)?;
        }
        for (i, PlacedWater { level, middle: [x, z], water }) in self.waters.iter().enumerate() {
            water.check(&format!("waters[{i}].water"))?;
            for (name, value) in [("level", level), ("middle[0]", x), ("middle[1]", z)] {
                check_length(&format!("waters[{i}].{name}"), *value)?;
            }
        }
        if let Some(trees) = &self.trees {
            trees.check("trees")?;
            trees.forest.density.check()?;
            trees.forest.species_of.check()?;
        }
        for (i, stamp) in self.stamps.iter().enumerate() {
            stamp.check(&format!("stamps[{i}]"))?;
        }
        Ok(())
    }
}

/// A length in a world file, in metres.
fn check_length(field: &str, value: f32) -> Result<(), ParamError> {
    let (min, max) = (-1e7, 1e7);
    if (min as f32..=max as f32).contains(&value) {
        return Ok(());
    }
    Err(ParamError { field: field.into(), value: value.into(), min, max, unit: "m" })
}

/// RON without ceremony: `Fractal(wavelength: 4000.0)`, and no `Some`.
fn options() -> ron::Options {
    use ron::extensions::Extensions;
    // Deep enough for every tree that a field may be: each node takes a few of RON's levels.
    ron::Options::default().with_recursion_limit(8 * MAX_DEPTH).with_default_extension(
        Extensions::UNWRAP_VARIANT_NEWTYPES | Extensions::UNWRAP_NEWTYPES | Extensions::IMPLICIT_SOME,
    )
}

/// The line on which a refused parameter stands: the first one that has its name with its value.
fn line_of(text: &str, error: &TerrainError) -> Option<usize> {
    let (path, value) = match error {
        TerrainError::Param(ParamError { field, value, .. })
        | TerrainError::Water(WaterError::Param(ParamError { field, value, .. }))
        | TerrainError::Trees(TreesError::Param(ParamError { field, value, .. })) => (field.as_str(), Some(*value)),
        TerrainError::Trees(TreesError::Forest(
            ForestError::Species { path, .. } | ForestError::Reach { path, .. },
        )) => (path.as_str(), None),
        TerrainError::Material(MaterialError::TooManyLayers { .. }) => ("layers", None),
        TerrainError::Field(error)
        | TerrainError::Stamp(StampError::Param(error))
        | TerrainError::Water(WaterError::Waves(WavesError::Param(error)) | WaterError::Mask(error))
        | TerrainError::Trees(TreesError::Forest(ForestError::Param(error) | ForestError::Field { error, .. }))
        | TerrainError::Material(MaterialError::Value(error) | MaterialError::Mask { source: error, .. }) => {
            match error {
                FieldError::OutOfRange { path, value, .. } | FieldError::NotFinite { path, value } => {
                    (path.as_str(), Some(*value))
                }
                FieldError::Empty { path, low, .. } => (path.as_str(), Some(*low)),
                _ => return None,
            }
        }
        _ => return None,
    };
    let name = path.rsplit('.').next()?.split('[').next()?;
    let has = |line: &str| {
        let Some((_, rest)) = line.split_once(&format!("{name}:")) else { return false };
        let mut numbers = rest
            .split(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)))
            .filter_map(|n| n.parse::<f64>().ok());
        value.is_none_or(|value| {
            numbers.any(|n| n == value || (n.is_nan() && value.is_nan()) || n as f32 == value as f32)
        })
    };
    text.lines().position(has).map(|at| at + 1)
}

/// Loads [`WorldFile`]s, and the height images that they name by their path from the root of the assets.
#[derive(Default, TypePath)]
pub struct WorldLoader;

impl AssetLoader for WorldLoader {
    type Asset = WorldFile;
    type Settings = ();
    type Error = WorldFileError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<WorldFile, WorldFileError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            WorldFileError::Syntax { line, column: 1, message: "not UTF-8 text".into() }
        })?;
        let mut world = WorldFile::from_ron(&text)?;
        let mut images = BTreeMap::new();
        for path in world.image_paths() {
            if images.contains_key(&path) {
                continue;
            }
            let line = text.lines().position(|line| line.contains(&path)).map(|at| at + 1);
            let failed = |reason: String| WorldFileError::Image { line, path: path.clone(), reason };
            let bytes = context.read_asset_bytes(path.clone()).await.map_err(|error| failed(error.to_string()))?;
            images.insert(path.clone(), HeightImage::from_png(&bytes).map_err(failed)?);
        }
        let images: HeightImages = images.into_iter().collect();
        for PlacedWater { water, .. } in &mut world.waters {
            if let WaterOutline::Mask(mask) = &mut water.outline {
                mask.images = images.clone();
            }
        }
        if let Some(terrain) = &mut world.terrain {
            terrain.images = images;
            CompiledTerrain::new(terrain)
                .map_err(|source| WorldFileError::Value { line: line_of(&text, &source), source })?;
            if let Some(trees) = &world.trees {
                trees.forest.compile("trees.forest", &terrain.images).map_err(|error| {
                    let source = TerrainError::Trees(error.into());
                    WorldFileError::Value { line: line_of(&text, &source), source }
                })?;
            }
        }
        Ok(world)
    }

    fn extensions(&self) -> &[&str] {
        &["ron"]
    }
}

/// Put it on an entity, and the file's terrain and air appear on it, its sun, its waters and its stamps as children. When the file changes, they do.
/// Put it on an entity, and the file's terrain, plants and air appear on it, its sun and its stamps as children. When the file changes, they do.
/// A file with a sun also sets Bevy's `GlobalAmbientLight`: to the sky's light, or without air that makes it, to the sun's `ambient`.
#[derive(Component, Clone, Debug, Default, Reflect)]
#[reflect(Component, Default, Clone)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
pub struct HorizonWorld(pub Handle<WorldFile>);

/// The sun that a world file brought, as a `DirectionalLight` under its [`HorizonWorld`].
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Clone)]
pub struct WorldSun;

/// A stamp that a world file brought, under its [`HorizonWorld`].
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Clone)]
pub struct WorldStamp;

/// A body of water that a world file brought, under its [`HorizonWorld`].
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Clone)]
pub struct WorldWater;

/// A world file was put into components.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorldLoaded {
    /// The entity of the [`HorizonWorld`].
    pub entity: Entity,
}

/// A world file was refused; the world that was loaded before stays.
#[derive(Message, Clone, Debug, PartialEq, Eq)]
pub struct WorldRejected {
    /// The file.
    pub path: String,
    /// Why, with field and line.
    pub error: String,
}

/// World files. Needs Bevy's `AssetPlugin`; without it, it does nothing.
pub struct HorizonScenePlugin;

impl Plugin for HorizonScenePlugin {
    fn build(&self, app: &mut App) {
        app.add_message::<WorldLoaded>().add_message::<WorldRejected>().register_type::<HorizonWorld>();
        if app.world().contains_resource::<AssetServer>() {
            app.init_asset::<WorldFile>()
                .register_asset_loader(WorldLoader)
                .add_systems(PreUpdate, (apply_worlds, report_failures).in_set(HorizonSystems::Load));
        }
    }
}

/// Cascades for a landscape: meshes cast shadows over half a kilometre.
#[cfg(feature = "render")]
fn cascades() -> CascadeShadowConfig {
    CascadeShadowConfigBuilder { first_cascade_far_bound: 16.0, maximum_distance: 500.0, ..default() }.build()
}

fn apply_worlds(
    mut commands: Commands,
    mut events: MessageReader<AssetEvent<WorldFile>>,
    files: Res<Assets<WorldFile>>,
    worlds: Query<(Entity, Ref<HorizonWorld>, Option<&Terrain>, Option<&Children>)>,
    brought: Query<(), Or<(With<WorldSun>, With<WorldStamp>, With<WorldWater>)>>,
    mut loaded: MessageWriter<WorldLoaded>,
) {
    let changed: Vec<_> = events
        .read()
        .filter_map(|event| match event {
            AssetEvent::LoadedWithDependencies { id } | AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (entity, world, current, children) in &worlds {
        if !(world.is_changed() || changed.contains(&world.0.id())) {
            continue;
        }
        let Some(file) = files.get(&world.0) else { continue };
        let owner = entity;
        let mut entity = commands.entity(owner);
        match &file.terrain {
            // Only a change fills caches anew.
            Some(terrain) if current == Some(terrain) => &mut entity,
            Some(terrain) => entity.insert(terrain.clone()),
            None => entity.remove::<Terrain>(),
        };
        match &file.trees {
            Some(trees) => entity.insert((trees.clone(), file.felled.clone())),
            None => entity.remove::<(Trees, Felled)>(),
        };
        match &file.atmosphere {
            Some(atmosphere) => entity.insert(atmosphere.clone()),
            None => entity.remove::<Atmosphere>(),
        };
        loaded.write(WorldLoaded { entity: owner });
        for child in children.into_iter().flatten().filter(|child| brought.contains(**child)) {
            commands.entity(*child).despawn();
        }
        for PlacedWater { level, middle: [x, z], water } in &file.waters {
            let place = Place::ORIGIN.translated([*x, *level, *z].map(f64::from));
            commands.spawn((WorldWater, water.clone(), WaterPlace(place), ChildOf(owner)));
        }
        for Placed { place, heading, edit } in &file.stamps {
            let at = StampPlace { place: *place, heading: *heading };
            commands.spawn((WorldStamp, Stamp(edit.clone()), at, ChildOf(owner)));
        }
        #[cfg(feature = "render")]
        if let Some(sun) = &file.sun {
            // Air that has tables makes the light itself.
            if let Some(air) = file.atmosphere.as_ref().filter(|air| air.model != SkyModel::Gradient) {
                let [r, g, b] = illuminance(&air.medium, 0.0, sun.direction().y.into()).map(|x| x as f32);
                let brightest = r.max(g).max(b).max(1e-9);
                let color = Color::linear_rgb(r / brightest, g / brightest, b / brightest);
                let light = DirectionalLight { color, illuminance: brightest, shadow_maps_enabled: true, ..default() };
                commands.spawn((WorldSun, Sunlight, light, cascades(), sun.transform(), ChildOf(owner)));
                continue;
            }
            let [r, g, b] = sun.colour;
            let light = DirectionalLight {
                color: Color::linear_rgb(r, g, b),
                illuminance: sun.illuminance,
                shadow_maps_enabled: true,
                ..default()
            };
            commands.spawn((WorldSun, light, cascades(), sun.transform(), ChildOf(owner)));
            commands.insert_resource(GlobalAmbientLight {
                color: Color::linear_rgb(0.62, 0.78, 1.0),
                brightness: sun.ambient,
                ..default()
            });
        }
    }
}

/// Bevy's asset server has logged the failure by now; this says it to the game.
fn report_failures(
    mut failed: MessageReader<AssetLoadFailedEvent<WorldFile>>,
    mut rejected: MessageWriter<WorldRejected>,
) {
    for failure in failed.read() {
        let own = match &failure.error {
            AssetLoadError::AssetLoaderError(error) => error.error().downcast_ref::<WorldFileError>(),
            _ => None,
        };
        let error = own.map_or_else(|| failure.error.to_string(), ToString::to_string);
        rejected.write(WorldRejected { path: failure.path.to_string(), error });
    }
}
