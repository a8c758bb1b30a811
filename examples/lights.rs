//! A camp at dusk: a fire and a torch, Bevy's own lights, on ground and meshes alike, with shadows both ways, in the deferred route
//! with temporal antialiasing and ambient occlusion.
use bevy::anti_alias::taa::TemporalAntiAliasing;
use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::prepass::DeferredPrepass;
use bevy::pbr::{DefaultOpaqueRendererMethod, ScreenSpaceAmbientOcclusion};
use bevy::post_process::bloom::Bloom;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::world::towards_sun;
use bevy_horizon_workspace::example;
use horizon_field::field::Fractal;

#[derive(Component)]
struct Fire;

fn main() {
    App::new()
        .add_plugins((example::plugins(), HorizonPlugins))
        .insert_resource(DefaultOpaqueRendererMethod::deferred())
        .add_systems(Startup, setup)
        .add_systems(Update, (pitch_camp, flicker))
        .run();
}

fn setup(mut commands: Commands) {
    let hills = Fractal { wavelength: 900.0, amplitude: 130.0, octaves: 12.0, gain: 0.45, seed: 6, ..default() };
    commands.spawn((Terrain::new(Field::Fractal(hills)), Atmosphere::default()));
    // The sun has just gone.
    let down = Transform::default().looking_to(-towards_sun(2.6, -0.07), Vec3::Y);
    commands.spawn((DirectionalLight { shadow_maps_enabled: true, ..default() }, Sunlight, down));
    commands.spawn((
        Camera3d::default(),
        Hdr,
        Exposure { ev100: 4.5 },
        (Msaa::Off, DeferredPrepass, TemporalAntiAliasing::default(), ScreenSpaceAmbientOcclusion::default()),
        Bloom::NATURAL,
        HorizonCamera::default(),
    ));
}

/// Once there is ground to stand on.
fn pitch_camp(
    mut commands: Commands,
    world: HorizonQuery,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut camera: Single<&mut Transform, With<Camera3d>>,
    fire: Query<(), With<Fire>>,
) {
    let on_ground = |x: f32, z: f32| world.height(Vec3::new(x, 0.0, z)).map(|y| Vec3::new(x, y, z));
    let (true, Some(middle), Some(eye)) = (fire.is_empty(), on_ground(0.0, 0.0), on_ground(5.0, 9.0)) else { return };
    **camera = Transform::from_translation(eye + 2.4 * Vec3::Y).looking_at(middle + 0.4 * Vec3::Y, Vec3::Y);
    let ember = materials.add(StandardMaterial { emissive: LinearRgba::rgb(4000.0, 900.0, 100.0), ..default() });
    let light = PointLight {
        color: Color::linear_rgb(1.0, 0.45, 0.12),
        intensity: 60_000.0,
        range: 60.0,
        shadow_maps_enabled: true,
        ..default()
    };
    let ball = meshes.add(Sphere::new(0.18));
    let flame = Transform::from_translation(middle + 0.55 * Vec3::Y);
    commands.spawn((Fire, light, flame)).with_child((
        Mesh3d(ball),
        MeshMaterial3d(ember),
        Transform::from_xyz(0.0, -0.4, 0.0),
    ));
    // Stones around it, and a tent lit by a torch.
    let (stone, grey) = (meshes.add(Sphere::new(0.45)), materials.add(Color::srgb(0.35, 0.33, 0.3)));
    for i in 0..7 {
        let (sin, cos) = (i as f32 * 0.9).sin_cos();
        let Some(at) = on_ground(2.1 * cos, 2.1 * sin) else { continue };
        commands.spawn((Mesh3d(stone.clone()), MeshMaterial3d(grey.clone()), Transform::from_translation(at)));
    }
    if let (Some(tent), Some(torch)) = (on_ground(-5.5, -4.0), on_ground(-1.5, -7.5)) {
        let cloth = materials.add(Color::srgb(0.75, 0.6, 0.35));
        let cone = meshes.add(Cone { radius: 2.0, height: 3.2 });
        commands.spawn((Mesh3d(cone), MeshMaterial3d(cloth), Transform::from_translation(tent + 1.5 * Vec3::Y)));
        let beam =
            SpotLight { intensity: 120_000.0, range: 50.0, outer_angle: 0.5, shadow_maps_enabled: true, ..default() };
        let from = torch + 1.2 * Vec3::Y;
        commands.spawn((beam, Transform::from_translation(from).looking_at(tent + Vec3::Y, Vec3::Y)));
    }
}

fn flicker(time: Res<Time>, mut fires: Query<&mut PointLight, With<Fire>>) {
    for mut light in &mut fires {
        let t = time.elapsed_secs();
        light.intensity = 60_000.0 * (1.0 + 0.12 * (11.0 * t).sin() + 0.08 * (23.0 * t).sin());
    }
}
