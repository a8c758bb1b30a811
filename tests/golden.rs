//! Pictures against those that were blessed, by FLIP (Andersson et al. 2020). A missing picture fails. Only
//! `cargo bless` writes one.

use std::env;
use std::path::PathBuf;

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::scene::{WorldLoaded, WorldSun};
use bevy_horizon::world::towards_sun;
use flip_rs::{DEFAULT_PPD, RgbImage as FlipImage, ldr_flip};
use image::RgbaImage;

use bevy_horizon_workspace::stage::Stage;

/// The largest mean FLIP error that passes: below what a viewer notices, above what drivers differ by.
const TOLERANCE: f32 = 0.02;

fn flip_image(picture: &RgbaImage) -> FlipImage<u8> {
    let pixels = picture.pixels().flat_map(|p| [p[0], p[1], p[2]]).collect();
    FlipImage::new(picture.width() as usize, picture.height() as usize, pixels).expect("the sizes agree")
}

pub fn compare(name: &str, picture: &RgbaImage) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let golden = root.join("tests/golden").join(format!("{name}.png"));
    let blessed = env::var("BLESS").unwrap_or_default();
    if blessed == "all" || blessed.split(',').any(|b| b == name) {
        std::fs::create_dir_all(golden.parent().unwrap()).unwrap();
        picture.save(&golden).unwrap();
        println!("blessed {}", golden.display());
        return;
    }
    let actual = env::temp_dir().join(format!("{name}.png"));
    picture.save(&actual).unwrap();
    let Ok(expected) = image::open(&golden) else {
        panic!(
            "{} is missing: look at {}, and if it is right, run `cargo bless {name}`",
            golden.display(),
            actual.display()
        );
    };
    let expected = expected.to_rgba8();
    assert_eq!(expected.dimensions(), picture.dimensions(), "{name}");
    let error =
        ldr_flip(&flip_image(&expected), &flip_image(picture), DEFAULT_PPD).expect("the pictures are comparable");
    let mean = error.statistics().mean;
    println!("{name}: mean FLIP {mean:.4}");
    assert!(mean <= TOLERANCE, "{name}: mean FLIP {mean:.4}; compare {} with {}", actual.display(), golden.display());
}

/// A world file, from its own viewpoint, with meshes in it; under another sun, where one is given, by azimuth and elevation.
fn world_picture(file: &str, sun: Option<[f32; 2]>) -> RgbaImage {
    let mut stage = Stage::new(480, 270);
    // Waves and wind stand still.
    stage.world().resource_mut::<Time<Virtual>>().pause();
    let asset = format!("worlds/{file}.ron");
    let handle = stage.world().resource::<AssetServer>().load::<WorldFile>(asset);
    stage.world().spawn(HorizonWorld(handle.clone()));
    for _ in 0..1000 {
        stage.off.update();
        let loaded = stage.world().resource::<Messages<WorldLoaded>>().len();
        if loaded > 0 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let file = stage.world().resource::<Assets<WorldFile>>().get(&handle).expect("the world loads").clone();
    let mut system = bevy::ecs::system::SystemState::<HorizonQuery>::new(stage.world());
    stage.off.update();
    let [x, z] = file.view.position;
    let ground = system.get(stage.world()).unwrap().height(Vec3::new(x, 0.0, z)).expect("there is ground");
    let rotation = Quat::from_rotation_y(-file.view.heading) * Quat::from_rotation_x(file.view.pitch);
    let eye = Vec3::new(x, ground + file.view.above_ground, z);
    stage.look(Transform::from_translation(eye).with_rotation(rotation));
    if let Some([azimuth, elevation]) = sun {
        let mut suns = stage.world().query_filtered::<&mut Transform, With<WorldSun>>();
        for mut transform in suns.iter_mut(stage.world()) {
            transform.look_to(-towards_sun(azimuth, elevation), Vec3::Y);
        }
    }
    let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Sphere::new(12.0));
    let material = stage.world().resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.8, 0.15, 0.1));
    for i in 0..5 {
        let ahead = rotation * Vec3::new(30.0 * (i as f32 - 2.0), 0.0, -130.0 - 40.0 * i as f32) + eye;
        let ground = system.get(stage.world()).unwrap().height(ahead).expect("there is ground");
        let at = Transform::from_xyz(ahead.x, ground + 4.0 * i as f32 - 4.0, ahead.z);
        stage.world().spawn((Mesh3d(mesh.clone()), MeshMaterial3d(material.clone()), at));
    }
    stage.settle();
    stage.off.screenshot()
}

#[test]
fn golden_alpine() {
    compare("alpine", &world_picture("alpine", None));
}

#[test]
fn golden_mesas() {
    compare("mesas", &world_picture("mesas", None));
}

#[test]
fn golden_islands() {
    compare("islands", &world_picture("islands", None));
}

#[test]
fn golden_fault() {
    compare("fault", &world_picture("fault", None));
}

#[test]
fn golden_islands_at_a_low_sun() {
    compare("islands_low_sun", &world_picture("islands", Some([1.25, 0.09])));
}

#[test]
fn golden_forest() {
    compare("forest", &world_picture("forest", None));
}

#[test]
fn golden_forest_at_a_low_sun() {
    compare("forest_low_sun", &world_picture("forest", Some([2.6, 0.12])));
}
