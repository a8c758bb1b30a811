//! A mountain lake in the evening: clear water in a basin, with a light breeze, a raft that floats on it, a buoy, and a look under the surface.
use bevy::camera::{Exposure, Hdr};
use bevy::post_process::bloom::Bloom;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::stamp::{Disc, Edit, Mode, Shape};
use bevy_horizon::world::towards_sun;
use bevy_horizon_workspace::example;
use horizon_field::field::Fractal;
use horizon_field::trees::Forest;
use horizon_field::waves::Sines;

/// Snow water: some plankton, hardly any silt.
const CLEAR_LAKE: WaterOptics =
    WaterOptics { absorption: [0.29, 0.075, 0.065], scattering: [0.12, 0.13, 0.15], ..WaterOptics::PURE };

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

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let valley = Fractal { wavelength: 1500.0, amplitude: 210.0, octaves: 12.0, gain: 0.44, seed: 9, ..default() };
    let shores = Forest { level: f64::from(LEVEL), shore: 1.5, ..default() };
    let woods = Trees { forest: shores, ..default() };
    commands.spawn((Terrain::new(Field::Fractal(valley)), woods, Atmosphere::default()));
    // A basin, in which the water stands seven metres deep.
    let basin = Edit { shape: Shape::Disc(Disc { radius: 90.0 }), mode: Mode::Flatten, falloff: 160.0, ..default() };
    commands.spawn((Stamp(basin), Transform::from_xyz(60.0, LEVEL - 7.0, -110.0)));
    let lake = Water {
        waves: Waves::Sines(Sines { wavelength: 5.0, amplitude: 0.035, ..default() }),
        optics: CLEAR_LAKE,
        ripples: 2e-5,
        ..default()
    };
    commands.spawn((lake, Transform::from_xyz(0.0, LEVEL, 0.0)));
    let evening = Transform::default().looking_to(-towards_sun(2.6, 0.4), Vec3::Y);
    commands.spawn((DirectionalLight { shadow_maps_enabled: true, ..default() }, Sunlight, evening));
    commands.spawn((
        Camera3d::default(),
        Hdr,
        Exposure { ev100: 12.8 },
        Bloom::NATURAL,
        HorizonCamera::default(),
        Transform::from_xyz(0.0, LEVEL + 2.2, 0.0).looking_to(Vec3::new(0.6, -0.09, -1.0), Vec3::Y),
    ));
    let wood = materials.add(StandardMaterial {
        base_color: Color::srgb(0.78, 0.6, 0.4),
        perceptual_roughness: 0.9,
        ..default()
    });
    let raft = meshes.add(Cuboid::new(2.4, 0.3, 1.8));
    commands.spawn((Floats(0.05), Mesh3d(raft), MeshMaterial3d(wood), Transform::from_xyz(4.5, 0.0, -8.0)));
    let red = materials.add(Color::srgb(0.75, 0.06, 0.04));
    let buoy = meshes.add(Sphere::new(0.35));
    commands.spawn((Floats(0.1), Mesh3d(buoy), MeshMaterial3d(red), Transform::from_xyz(1.2, 0.0, -7.0)));
}

/// Whatever floats stands on the water where it is now, and lies as the water does under its ends.
fn float(world: HorizonQuery, time: Res<WaterTime>, mut floating: Query<(&Floats, &mut Transform)>) {
    for (Floats(above), mut transform) in &mut floating {
        let at = transform.translation;
        let height = |offset: Vec3| world.water_height(at + offset, time.0);
        let ends = [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z].map(height);
        let [Some(east), Some(west), Some(south), Some(north)] = ends else { continue };
        transform.translation.y = 0.25 * (east + west + south + north) + above;
        let up = Vec3::new(west - east, 2.0, north - south).normalize();
        transform.rotation = Quat::from_rotation_arc(Vec3::Y, up);
    }
}
