//! A mountain lake in the evening: clear water with a light breeze, a raft that floats on it, a buoy, and a look under the surface.
use bevy::camera::{Exposure, Hdr};
use bevy::post_process::bloom::Bloom;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::world::towards_sun;
use bevy_horizon_workspace::example;
use horizon_field::field::Fractal;

/// The lake's level, in metres.
const LEVEL: f32 = -14.0;

/// What floats, and how far its middle is over the water.
#[derive(Component)]
struct Floats(f32);

fn main() {
    App::new()
        .add_plugins((example::plugins(), HorizonPlugins))
        .add_systems(Startup, setup)
        .add_systems(Update, float)
        .run();
}

fn setup(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let valley = Fractal { wavelength: 1500.0, amplitude: 210.0, octaves: 12.0, gain: 0.44, seed: 9, ..default() };
    commands.spawn((Terrain::new(Field::Fractal(valley)), Atmosphere::default()));
    let lake = Water { waves: Waves::lake(), optics: WaterOptics::LAKE, ..default() };
    commands.spawn((lake, Transform::from_xyz(0.0, LEVEL, 0.0)));
    let evening = Transform::default().looking_to(-towards_sun(5.3, 0.22), Vec3::Y);
    commands.spawn((DirectionalLight { shadow_maps_enabled: true, ..default() }, Sunlight, evening));
    commands.spawn((
        Camera3d::default(),
        Hdr,
        Exposure { ev100: 12.5 },
        Bloom::NATURAL,
        HorizonCamera::default(),
        Transform::from_xyz(0.0, LEVEL + 2.2, 0.0).looking_to(Vec3::new(0.6, -0.09, -1.0), Vec3::Y),
    ));
    let wood = materials.add(StandardMaterial {
        base_color: Color::srgb(0.42, 0.27, 0.14),
        perceptual_roughness: 0.9,
        ..default()
    });
    let raft = meshes.add(Cuboid::new(2.4, 0.3, 1.8));
    commands.spawn((Floats(0.05), Mesh3d(raft), MeshMaterial3d(wood), Transform::from_xyz(4.5, 0.0, -8.0)));
    let red = materials.add(Color::srgb(0.75, 0.06, 0.04));
    let buoy = meshes.add(Sphere::new(0.35));
    commands.spawn((Floats(0.1), Mesh3d(buoy), MeshMaterial3d(red), Transform::from_xyz(1.2, 0.0, -7.0)));
}

/// Whatever floats stands on the water where it is now, and lies as that lies.
fn float(world: HorizonQuery, time: Res<WaterTime>, mut floating: Query<(&Floats, &mut Transform)>) {
    for (Floats(above), mut transform) in &mut floating {
        if let Some(water) = world.water_surface(transform.translation, time.0) {
            transform.translation.y = water.height + above;
            transform.rotation = Quat::from_rotation_arc(Vec3::Y, water.normal);
        }
    }
}
