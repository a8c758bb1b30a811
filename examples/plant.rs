//! A click plants a tree on the ground. Where there is no display, a pretended pointer clicks along the picture.
use bevy::camera::{Exposure, RenderTarget};
use bevy::picking::PickingSystems;
use bevy::picking::pointer::{Location, PointerAction, PointerButton, PointerId, PointerInput};
use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::example;
use horizon_field::field::Fractal;

/// Of a tree, in metres.
const HEIGHT: f32 = 9.0;

#[derive(Resource)]
struct Tree(Handle<Mesh>, Handle<StandardMaterial>);

fn main() {
    let mut app = App::new();
    app.add_plugins((example::plugins(), HorizonPlugins, HorizonPickingPlugin))
        .add_systems(Startup, setup)
        .add_systems(Update, stand_on_ground);
    if !example::has_display() {
        // Bevy's picking asks for a primary window, even where cameras draw into images.
        app.world_mut().spawn((Window::default(), PrimaryWindow));
        app.add_systems(First, pretend_pointer.in_set(PickingSystems::Input));
    }
    app.run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let crown = meshes.add(Cone { radius: 0.3 * HEIGHT, height: HEIGHT });
    commands.insert_resource(Tree(crown, materials.add(Color::srgb(0.06, 0.16, 0.05))));

    let hills = Fractal { wavelength: 700.0, amplitude: 90.0, octaves: 10.0, gain: 0.42, seed: 2, ..default() };
    commands.spawn((Terrain::new(Field::Fractal(hills)), Atmosphere::default())).observe(plant);
    commands.spawn((DirectionalLight::default(), Sunlight, TimeOfDay::default()));
    let look = Transform::default().looking_to(Vec3::new(0.3, -0.35, -1.0), Vec3::Y);
    commands.spawn((Camera3d::default(), Exposure { ev100: 13.0 }, HorizonCamera::default(), look));
}

fn plant(click: On<Pointer<Click>>, tree: Res<Tree>, mut commands: Commands) {
    let Some(position) = click.hit.position else { return };
    info!("a tree is planted at {position}");
    let at = Transform::from_translation(position + 0.45 * HEIGHT * Vec3::Y);
    commands.spawn((Mesh3d(tree.0.clone()), MeshMaterial3d(tree.1.clone()), at));
}

fn stand_on_ground(world: HorizonQuery, mut camera: Single<&mut Transform, With<Camera3d>>) {
    camera.translation.y = world.height(camera.translation).unwrap_or(0.0) + 35.0;
}

/// Moves, presses and releases, in a frame each; then on to the next place.
fn pretend_pointer(
    camera: Single<(&Camera, &RenderTarget)>,
    mut input: MessageWriter<PointerInput>,
    mut frame: Local<u32>,
) {
    let (camera, target) = *camera;
    let (Some(size), Some(target)) = (camera.logical_viewport_size(), target.normalize(None)) else { return };
    let (column, row) = (*frame / 3 % 7, *frame / 21 % 3);
    let position = size * Vec2::new(0.08 + 0.14 * column as f32, 0.55 + 0.14 * row as f32);
    let action = match *frame % 3 {
        0 => PointerAction::Move { delta: Vec2::ZERO },
        1 => PointerAction::Press(PointerButton::Primary),
        _ => PointerAction::Release(PointerButton::Primary),
    };
    input.write(PointerInput::new(PointerId::Mouse, Location { target, position }, action));
    *frame += 1;
}
