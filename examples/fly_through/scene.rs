//! What the window and the film have in common: the world, the camera, the path, the meshes.

use std::path::PathBuf;

use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::scene::{WorldRejected, WorldSun};
use bevy_horizon::world::CompiledTerrain;

use crate::flight::Path;
use crate::props::{self, Prop};

/// The world, the camera, the path and the meshes.
pub struct ScenePlugin {
    /// The world file, for the asset server.
    pub world: PathBuf,
    /// The path's length, in metres.
    pub length: f32,
    /// The path's speed, in metres per second.
    pub speed: f32,
    /// Whether the flight starts at once.
    pub playing: bool,
}

/// The flight on the scripted path.
#[derive(Resource)]
pub struct Flight {
    /// Metres flown.
    pub metres: f32,
    /// Metres per second.
    pub speed: f32,
    /// Whether the camera follows the path.
    pub playing: bool,
    length: f32,
}

/// How far loading is.
#[derive(Resource, Default)]
pub struct Loading {
    /// Tiles that are up to date, and tiles in all.
    pub progress: Option<WorldProgress>,
    /// Whether the world with the camera in place was complete once.
    pub ready: bool,
    /// Why the world was refused.
    pub refused: Option<String>,
}

#[derive(Resource)]
struct WorldPath(PathBuf);

impl Plugin for ScenePlugin {
    fn build(&self, app: &mut App) {
        let flight = Flight { metres: 0.0, speed: self.speed, playing: self.playing, length: self.length };
        app.insert_resource(WorldPath(self.world.clone()))
            .insert_resource(flight)
            .init_resource::<Loading>()
            .add_systems(Startup, setup)
            .add_systems(Update, (plan, follow, meter, watch).chain());
    }
}

fn setup(mut commands: Commands, assets: Res<AssetServer>, path: Res<WorldPath>) {
    commands.spawn(HorizonWorld(assets.load(path.0.clone())));
    commands.spawn((
        Camera3d::default(),
        Hdr,
        Tonemapping::TonyMcMapface,
        HorizonCamera::default(),
        Projection::from(PerspectiveProjection { fov: 60_f32.to_radians(), near: 0.1, ..default() }),
    ));
}

/// New ground: the path and the meshes are laid out anew. The camera stays where it is, but for the first time.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are what it reads and writes")]
fn plan(
    mut commands: Commands,
    changed: Query<&HorizonWorld, Changed<CompiledTerrain>>,
    files: Res<Assets<WorldFile>>,
    query: HorizonQuery,
    flight: Res<Flight>,
    old: (Option<Res<Path>>, Query<Entity, With<Prop>>),
    mut camera: Single<&mut Transform, With<HorizonCamera>>,
    mut assets: (ResMut<Assets<Mesh>>, ResMut<Assets<StandardMaterial>>),
) {
    let Some(file) = changed.iter().next().and_then(|world| files.get(&world.0)) else { return };
    let Some(ground) = query.ground(None) else { return };
    for prop in &old.1 {
        commands.entity(prop).despawn();
    }
    let path = Path::plan(&ground, &file.view, flight.length);
    props::spawn(&mut commands, &mut assets.0, &mut assets.1, &ground, &path);
    if old.0.is_none() {
        **camera = path.pose(0.0, flight.speed);
    }
    commands.insert_resource(path);
}

fn follow(
    time: Res<Time>,
    path: Option<Res<Path>>,
    mut flight: ResMut<Flight>,
    mut camera: Single<&mut Transform, With<HorizonCamera>>,
) {
    let Some(path) = path.filter(|_| flight.playing) else { return };
    flight.metres = (flight.metres + flight.speed * time.delta_secs()) % path.length();
    **camera = path.pose(flight.metres, flight.speed);
}

/// Exposes as a light meter in the sun would: EV = log₂(E / 2.5 lx). Nearly two stops more, because the tone curve darkens.
fn meter(
    mut commands: Commands,
    suns: Query<(&DirectionalLight, &Transform), Added<WorldSun>>,
    ambient: Res<GlobalAmbientLight>,
    camera: Single<Entity, With<HorizonCamera>>,
) {
    for (light, transform) in &suns {
        let level = light.illuminance * light.color.luminance() * transform.back().y.max(0.35);
        let illuminance = level + std::f32::consts::PI * ambient.brightness;
        commands.entity(*camera).insert(Exposure { ev100: (illuminance / 2.5).log2() - 1.75 });
    }
}

fn watch(
    path: Option<Res<Path>>,
    mut progress: MessageReader<WorldProgress>,
    mut ready: MessageReader<WorldReady>,
    mut rejected: MessageReader<WorldRejected>,
    mut loading: ResMut<Loading>,
) {
    loading.progress = progress.read().last().copied().or(loading.progress);
    loading.ready |= ready.read().count() > 0 && path.is_some();
    loading.refused = rejected.read().last().map(|file| file.error.clone()).or(loading.refused.take());
}
