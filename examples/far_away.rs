//! A flight a million kilometres from the world's origin, in a big space: ground and meshes are as exact as here.
use bevy::camera::Exposure;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use big_space::prelude::*;

/// In metres a second.
const SPEED: f32 = 120.0;
/// Posts stand so far apart, in metres.
const APART: f32 = 30.0;

#[derive(Resource)]
struct Post(Handle<Mesh>, Handle<StandardMaterial>);

fn main() {
    let plugins = bevy_horizon_workspace::example::plugins().disable::<TransformPlugin>();
    App::new()
        .add_plugins((plugins, BigSpaceDefaultPlugins, HorizonPlugins, HorizonBigSpacePlugin))
        .add_systems(Startup, setup)
        .add_systems(Update, (fly, raise_posts).chain())
        .run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let post = meshes.add(Cuboid::new(0.6, 8.0, 0.6));
    commands.insert_resource(Post(post, materials.add(Color::srgb(0.8, 0.15, 0.05))));

    // Outside of the big space: the origin says which of their places are seen.
    commands.spawn((Terrain::default(), Atmosphere::default()));
    commands.spawn((DirectionalLight::default(), Sunlight, TimeOfDay::default()));

    commands.spawn_big_space(Grid::new(2000.0, 100.0), |root| {
        root.insert(Visibility::default());
        root.spawn_spatial((
            Camera3d::default(),
            Exposure { ev100: 13.0 },
            HorizonCamera::default(),
            FloatingOrigin,
            // Half a million cells of 2 km.
            CellCoord::new(500_000, 0, -500_000),
            Transform::default().looking_to(Vec3::new(0.0, -0.12, -1.0), Vec3::Y),
        ));
    });
}

/// Along the ground, 20 m over it. The camera's cell is Bevy's origin, so that its transform is in Bevy's coordinates.
fn fly(time: Res<Time>, world: HorizonQuery, mut camera: Single<&mut Transform, With<FloatingOrigin>>) {
    camera.translation.z -= SPEED * time.delta_secs();
    camera.translation.y = world.height(camera.translation).unwrap_or(0.0) + 20.0;
}

/// Two rows of posts, 300 m ahead: in the cell that the camera is in.
fn raise_posts(
    mut commands: Commands,
    mut way: Local<f32>,
    time: Res<Time>,
    world: HorizonQuery,
    post: Res<Post>,
    space: Single<Entity, With<BigSpace>>,
    camera: Single<(&Transform, &CellCoord), With<FloatingOrigin>>,
) {
    let Some(ground) = world.ground(None) else { return };
    let (camera, cell) = *camera;
    *way += SPEED * time.delta_secs();
    while *way > APART {
        *way -= APART;
        for x in [-12.0, 12.0] {
            let mut at = camera.translation + Vec3::new(x, 0.0, -300.0 - *way);
            at.y = ground.height(at) + 3.0;
            let look = (Mesh3d(post.0.clone()), MeshMaterial3d(post.1.clone()));
            commands.spawn((look, *cell, Transform::from_translation(at), ChildOf(*space)));
        }
    }
}
