//! Balls roll down a mountain: collider tiles follow them, wherever they go.
use avian3d::prelude::*;
use bevy::camera::Exposure;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::Fractal;

const BALLS: u32 = 60;

#[derive(Component)]
struct Ball;

fn main() {
    let plugins = bevy_horizon_workspace::example::plugins();
    App::new()
        .add_plugins((plugins, PhysicsPlugins::default(), HorizonPlugins, HorizonAvianPlugin::default()))
        .add_systems(Startup, setup)
        .add_systems(Update, (drop_balls, follow).chain())
        .run();
}

fn setup(mut commands: Commands) {
    let mountain = Fractal { wavelength: 1500.0, amplitude: 420.0, octaves: 10.0, gain: 0.45, seed: 8, ..default() };
    // The tiles take the friction of their terrain.
    commands.spawn((Terrain::new(Field::Fractal(mountain)), Friction::new(0.8), Atmosphere::default()));
    commands.spawn((DirectionalLight::default(), Sunlight, TimeOfDay::default()));
    commands.spawn((Camera3d::default(), Exposure { ev100: 13.0 }, HorizonCamera::default()));
}

/// Where the mountain is steepest, as soon as there is one.
fn drop_balls(
    mut commands: Commands,
    world: HorizonQuery,
    balls: Query<(), With<Ball>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let Some(ground) = world.ground(None).filter(|_| balls.is_empty()) else { return };
    let places = (0..900).map(|i| 20.0 * Vec3::new((i % 30) as f32 - 15.0, 0.0, (i / 30) as f32 - 15.0));
    let Some(steepest) = places.max_by(|a, b| ground.slope(*a).total_cmp(&ground.slope(*b))) else { return };
    for i in 0..BALLS {
        let radius = 0.5 + 0.01 * (37 * i % BALLS) as f32;
        let mut at = steepest + 3.0 * Vec3::new((i % 8) as f32 - 3.5, 0.0, (i / 8) as f32 - 3.5);
        at.y = ground.height(at) + 2.0 * radius;
        commands.spawn((
            Ball,
            Mesh3d(meshes.add(Sphere::new(radius))),
            MeshMaterial3d(materials.add(Color::hsl(6.0 * i as f32, 0.7, 0.5))),
            Transform::from_translation(at),
            RigidBody::Dynamic,
            Collider::sphere(radius),
        ));
    }
}

/// From above, and never from under the ground.
fn follow(
    world: HorizonQuery,
    balls: Query<&Transform, (With<Ball>, Without<Camera3d>)>,
    mut camera: Single<&mut Transform, With<Camera3d>>,
) {
    let count = balls.iter().count();
    if count == 0 {
        return;
    }
    let middle = balls.iter().map(|ball| ball.translation).sum::<Vec3>() / count as f32;
    let mut eye = middle + Vec3::new(22.0, 16.0, 26.0);
    eye.y = eye.y.max(world.height(eye).unwrap_or(eye.y) + 8.0);
    **camera = Transform::from_translation(eye).looking_at(middle, Vec3::Y);
}
