//! With a display: a window with a free camera.

use std::process::ExitCode;

use bevy::camera_controller::free_camera::{FreeCamera, FreeCameraPlugin, FreeCameraState};
use bevy::input::mouse::AccumulatedMouseScroll;
use bevy::prelude::*;
use bevy::window::WindowResolution;
use bevy_horizon::prelude::*;

use crate::options::Options;
use crate::scene::{Flight, ScenePlugin};

const HELP: &str = "
    W A S D        fly; faster high above the ground, and with shift
    E, Q           up, down
    drag           look around
    scroll         focal length
    P              follow the scripted path, or leave it
    1              the picture
    2 – 7          normals, turns of the march, level, light, albedo, distance
    F1             this text
The world file may be edited meanwhile: the world follows.";

/// Of the scripted path, in seconds, before it begins anew.
const LAP: f32 = 240.0;
/// The camera's vertical angle of view, in degrees.
const ANGLES: [f32; 2] = [3.0, 100.0];

/// Opens the window.
pub fn run(options: &Options) -> ExitCode {
    let [width, height] = options.size;
    let world = options.asset_path();
    let title = format!("bevy_horizon: {}", world.file_stem().unwrap_or_default().to_string_lossy());
    let window = Window { title: title.clone(), resolution: WindowResolution::new(width, height), ..default() };
    let mut app = App::new();
    app.add_plugins((
        DefaultPlugins.set(WindowPlugin { primary_window: Some(window), ..default() }).set(options.assets()),
        HorizonPlugins,
        FreeCameraPlugin,
        ScenePlugin { world, length: LAP * options.speed, speed: options.speed, playing: options.path },
    ));
    app.insert_resource(Title(title)).add_observer(equip).add_systems(Update, (walk, zoom, keys, show_frame_time));
    if let Some(frames) = options.frames {
        app.insert_resource(FramesLeft(frames)).add_systems(Last, end);
    }
    match app.run() {
        AppExit::Success => ExitCode::SUCCESS,
        AppExit::Error(code) => ExitCode::from(code.get()),
    }
}

#[derive(Resource)]
struct Title(String);

#[derive(Resource)]
struct FramesLeft(u32);

fn equip(added: On<Add, HorizonCamera>, mut commands: Commands) {
    // Scrolling is for the focal length, not for the speed.
    let controls = FreeCamera { mouse_key_cursor_grab: MouseButton::Left, scroll_factor: 0.0, ..default() };
    commands.entity(added.entity).insert(controls);
    info!("{HELP}");
}

/// Walking pace on the ground, an aeroplane's over the mountains. The controller rests while the path is flown.
fn walk(
    world: HorizonQuery,
    flight: Res<Flight>,
    mut camera: Single<(&Transform, &mut FreeCamera, &mut FreeCameraState)>,
) {
    let (transform, controls, state) = &mut *camera;
    let height = world.height(transform.translation).map_or(0.0, |ground| (transform.translation.y - ground).abs());
    controls.walk_speed = (1.5 + 0.8 * height).min(1000.0);
    controls.run_speed = 4.0 * controls.walk_speed;
    if state.enabled == flight.playing {
        state.enabled = !flight.playing;
        // The controller keeps its own angles: it goes on from where the path left the camera.
        (state.yaw, state.pitch, _) = transform.rotation.to_euler(EulerRot::YXZ);
    }
}

fn zoom(scroll: Res<AccumulatedMouseScroll>, mut projection: Single<&mut Projection, With<HorizonCamera>>) {
    if scroll.delta.y != 0.0
        && let Projection::Perspective(perspective) = &mut **projection
    {
        let [least, most] = ANGLES.map(f32::to_radians);
        perspective.fov = (perspective.fov * (-0.08 * scroll.delta.y.clamp(-4.0, 4.0)).exp()).clamp(least, most);
    }
}

fn keys(keys: Res<ButtonInput<KeyCode>>, mut flight: ResMut<Flight>, mut camera: Single<&mut HorizonCamera>) {
    let views = [
        (KeyCode::Digit1, DebugView::None),
        (KeyCode::Digit2, DebugView::Normal),
        (KeyCode::Digit3, DebugView::Steps),
        (KeyCode::Digit4, DebugView::Level),
        (KeyCode::Digit5, DebugView::Light),
        (KeyCode::Digit6, DebugView::Albedo),
        (KeyCode::Digit7, DebugView::Distance),
    ];
    for (key, view) in views {
        if keys.just_pressed(key) {
            camera.debug = view;
        }
    }
    if keys.just_pressed(KeyCode::KeyP) {
        flight.playing = !flight.playing;
    }
    if keys.just_pressed(KeyCode::F1) {
        info!("{HELP}");
    }
}

/// The mean time of a frame, in the window's title, twice a second.
fn show_frame_time(
    time: Res<Time<Real>>,
    title: Res<Title>,
    mut window: Single<&mut Window>,
    mut since: Local<(f32, u32)>,
) {
    *since = (since.0 + time.delta_secs(), since.1 + 1);
    let (seconds, frames) = *since;
    if seconds > 0.5 {
        let mean = seconds / frames as f32;
        window.title = format!("{} – {:.1} ms, {:.0} frames a second – F1: help", title.0, 1e3 * mean, 1.0 / mean);
        *since = (0.0, 0);
    }
}

fn end(mut left: ResMut<FramesLeft>, mut exit: MessageWriter<AppExit>) {
    left.0 -= 1;
    if left.0 == 0 {
        exit.write(AppExit::Success);
    }
}
