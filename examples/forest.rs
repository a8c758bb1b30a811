//! A walk in the woods: a world file with plants, balls among them, and a clearing that a stamp keeps free, around a ball that hangs in
//! the sun. Of the plants around the first ball every other one is felled.
use bevy::camera::Exposure;
use bevy::math::Vec3Swizzles;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::stamp::{Disc, Mode, Shape};
use bevy_horizon_workspace::example;

/// Where the clearing is, from Bevy's origin.
const CLEARING: Vec2 = Vec2::new(12.0, -34.0);

#[derive(Component)]
struct Ball;

fn main() {
    App::new()
        .add_plugins((example::plugins(), HorizonPlugins))
        .add_systems(Startup, setup)
        .add_systems(Update, walk_in)
        .run();
}

fn setup(mut commands: Commands, assets: Res<AssetServer>) {
    let clearing = Stamp::new(Shape::Disc(Disc { radius: 11.0 }), Mode::KeepTrees);
    let at = Transform::from_xyz(CLEARING.x, 0.0, CLEARING.y);
    commands.spawn(HorizonWorld(assets.load("worlds/forest.ron"))).with_child((clearing, at));
    commands.spawn((Camera3d::default(), Exposure { ev100: 13.0 }, HorizonCamera::default()));
}

/// Once there is ground to stand on, and something grows there.
fn walk_in(
    mut commands: Commands,
    world: HorizonQuery,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut camera: Single<&mut Transform, With<Camera3d>>,
    mut forest: Single<&mut Felled>,
    balls: Query<(), With<Ball>>,
) {
    let on_ground = |at: Vec2| world.height(Vec3::new(at.x, 0.0, at.y)).map(|y| Vec3::new(at.x, y, at.y));
    let (true, Some(eye), Some(middle)) = (balls.is_empty(), on_ground(Vec2::new(11.0, 0.0)), on_ground(CLEARING))
    else {
        return;
    };
    **camera = Transform::from_translation(eye + 5.0 * Vec3::Y).looking_at(middle + 4.0 * Vec3::Y, Vec3::Y);
    let (ball, red) = (meshes.add(Sphere::new(1.2)), materials.add(Color::srgb(0.75, 0.18, 0.1)));
    for (away, above) in [(0.0, 3.0), (-14.0, 0.9), (19.0, 0.9)] {
        let Some(at) = on_ground(CLEARING + Vec2::new(away, 0.4 * away)) else { continue };
        let at = Transform::from_translation(at + above * Vec3::Y);
        commands.spawn((Ball, Mesh3d(ball.clone()), MeshMaterial3d(red.clone()), at));
    }
    // Nothing stands before the camera.
    let before = Rect::from_center_half_size(eye.xz() - 6.0 * Vec2::Y, Vec2::new(7.0, 10.0));
    for plant in world.trees_in(before).unwrap_or_default() {
        forest.fell(plant.id);
    }
    let around = Rect::from_center_half_size(CLEARING - Vec2::new(14.0, 5.6), Vec2::splat(14.0));
    match world.trees_in(around) {
        Ok(plants) => {
            info!("{} plants stand around the first ball; every other one is felled", plants.len());
            for plant in plants.iter().step_by(2) {
                forest.fell(plant.id);
            }
        }
        Err(error) => error!("{error}"),
    }
}
