//! A world in about 20 lines.
use bevy::prelude::*;
use bevy_horizon::prelude::*;

fn main() {
    App::new().add_plugins((DefaultPlugins, HorizonPlugins)).add_systems(Startup, setup).run();
}

fn setup(mut commands: Commands) {
    commands.spawn((Terrain::default(), Atmosphere::default()));
    commands.spawn((DirectionalLight::default(), Sun::default().transform()));
    commands.spawn((Camera3d::default(), HorizonCamera::default(), Transform::from_xyz(0.0, 600.0, 0.0)));
}
