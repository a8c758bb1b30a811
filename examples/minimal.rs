//! A world in about 20 lines.
use bevy::camera::Exposure;
use bevy::prelude::*;
use bevy_horizon::prelude::*;

fn main() {
    // A game writes `DefaultPlugins` here; these also run where there is no display.
    let plugins = bevy_horizon_workspace::example::plugins();
    App::new().add_plugins((plugins, HorizonPlugins)).add_systems(Startup, setup).run();
}

fn setup(mut commands: Commands) {
    commands.spawn((Terrain::default(), Atmosphere::default()));
    // Where the sun stands, by place, date and hour; the air says how bright it is, and how bright the sky.
    commands.spawn((DirectionalLight::default(), Sunlight, TimeOfDay::default()));
    commands.spawn((
        Camera3d::default(),
        Exposure { ev100: 13.0 },
        HorizonCamera::default(),
        Transform::from_xyz(0.0, 600.0, 0.0).looking_to(Vec3::new(0.0, -0.2, -1.0), Vec3::Y),
    ));
}
