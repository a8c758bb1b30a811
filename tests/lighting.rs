//! One plane, as a mesh and as a field: under every light, and with every feature of a camera that moves, they are the same
//! picture.

use bevy::anti_alias::taa::TemporalAntiAliasing;
use bevy::camera::{Hdr, ScalingMode};
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass, MotionVectorPrepass, NormalPrepass};
use bevy::diagnostic::FrameCount;
use bevy::light::{CascadeShadowConfigBuilder, FogVolume, VolumetricFog, VolumetricLight};
use bevy::pbr::{
    ContactShadows, DefaultOpaqueRendererMethod, DistanceFog, ScreenSpaceAmbientOcclusion, ScreenSpaceReflections,
};
use bevy::post_process::auto_exposure::AutoExposure;
use bevy::post_process::bloom::Bloom;
use bevy::post_process::dof::DepthOfField;
use bevy::post_process::motion_blur::MotionBlur;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::world::Surface;
use bevy_horizon_workspace::stage::Stage;
use image::RgbaImage;

const SIZE: [u32; 2] = [192, 108];
/// What a cache keeps exactly: the square of a multiple of 1/255, a multiple of 1/31, a multiple of 1/7.
const ALBEDO: f32 = (140.0 / 255.0) * (140.0 / 255.0);
const ROUGHNESS: f32 = 22.0 / 31.0;
/// The smoothest that ground can be: what it mirrors is no lottery.
const POLISHED: f32 = 3.0 / 31.0;
const REFLECTANCE: f32 = 4.0 / 7.0;

/// The plane as a field.
fn field(height: f64, roughness: f32) -> Terrain {
    let surface = Surface {
        colour: [f64::from(ALBEDO); 3],
        second: None,
        roughness: f64::from(roughness),
        reflectance: f64::from(REFLECTANCE),
        ..default()
    };
    let material = TerrainMaterial { base: surface, layers: Vec::new(), ..default() };
    Terrain { material, ..Terrain::new(Field::Constant(height)) }
}

fn mesh(world: &mut World, roughness: f32) -> impl Bundle + use<> {
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Plane3d::default().mesh().size(2000.0, 2000.0));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: LinearRgba::rgb(ALBEDO, ALBEDO, ALBEDO).into(),
        perceptual_roughness: roughness,
        reflectance: REFLECTANCE,
        ..default()
    });
    (Mesh3d(mesh), MeshMaterial3d(material))
}

/// A stage on which a box stands on the plane, and another hangs over it.
fn stage(deferred: bool) -> Stage {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    let camera = stage.camera;
    let world = stage.world();
    if deferred {
        world.insert_resource(DefaultOpaqueRendererMethod::deferred());
        world.entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    }
    world.insert_resource(GlobalAmbientLight { brightness: 0.0, ..default() });
    let cube = world.resource_mut::<Assets<Mesh>>().add(Cuboid::from_length(1.0));
    let red = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: Color::srgb(0.7, 0.2, 0.15),
        perceptual_roughness: 1.0,
        ..default()
    });
    for at in [Vec3::new(-1.5, 0.5, 0.0), Vec3::new(1.5, 1.6, -0.6)] {
        let turned = Transform::from_translation(at).with_rotation(Quat::from_rotation_y(0.5));
        world.spawn((Mesh3d(cube.clone()), MeshMaterial3d(red.clone()), turned));
    }
    stage.look(Transform::from_xyz(0.0, 3.2, 5.0).looking_at(Vec3::new(0.0, 0.0, 0.6), Vec3::Y));
    stage
}

fn sun(stage: &mut Stage) {
    let light = DirectionalLight { illuminance: 40_000.0, shadow_maps_enabled: true, ..default() };
    let cascades = CascadeShadowConfigBuilder { maximum_distance: 60.0, ..default() }.build();
    let down = Transform::default().looking_to(Vec3::new(-0.6, -0.7, -0.35), Vec3::Y);
    stage.world().spawn((light, cascades, down, VolumetricLight));
}

fn of_camera(stage: &mut Stage, bundle: impl Bundle) {
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(bundle);
}

/// The picture of the plane as a mesh, with a field far below it, and as a field. What changes from frame to frame, as jitter and
/// noise do, is at the same turn in both.
fn pictures(mut stage: Stage, roughness: f32) -> [RgbaImage; 2] {
    let plane = mesh(stage.world(), roughness);
    let plane = stage.world().spawn(plane).id();
    let ground = stage.world().spawn(field(-40.0, roughness)).id();
    let as_mesh = picture(&mut stage);
    stage.world().entity_mut(plane).despawn();
    stage.world().entity_mut(ground).insert(field(0.0, roughness));
    [as_mesh, picture(&mut stage)]
}

/// The last of some frames in which the camera moves to its place.
fn picture(stage: &mut Stage) -> RgbaImage {
    stage.settle();
    for i in 0.. {
        stage.off.update();
        if i >= 12 && stage.world().resource::<FrameCount>().0 % 64 == 40 {
            break;
        }
    }
    let camera = stage.camera;
    let end = *stage.world().get::<Transform>(camera).expect("the camera stands somewhere");
    for frame in (0..12).rev() {
        let back = frame as f32;
        let way = Transform::from_xyz(0.04 * back, 0.01 * back, 0.03 * back)
            .with_rotation(Quat::from_rotation_y(0.004 * back));
        stage.look(Transform {
            rotation: end.rotation * way.rotation,
            translation: end.translation + way.translation,
            ..end
        });
        if frame > 0 {
            stage.off.update();
        }
    }
    stage.off.screenshot()
}

/// By how much two pictures differ, in 255ths: on average, and at the 99.9th percentile.
fn difference([a, b]: &[RgbaImage; 2]) -> [f64; 2] {
    let pairs = a.pixels().zip(b.pixels());
    let mut all: Vec<u8> = pairs.flat_map(|(a, b)| [0, 1, 2].map(|k| a[k].abs_diff(b[k]))).collect();
    all.sort_unstable();
    let mean = all.iter().map(|d| f64::from(*d)).sum::<f64>() / all.len() as f64;
    [mean, f64::from(all[(all.len() - 1) * 999 / 1000])]
}

/// What stands on the stage, or is put on its camera.
type Case = (&'static str, fn(&mut Stage));

const LIGHTS: [Case; 6] = [
    ("sun", sun),
    ("sun without shadows", |stage| {
        let light = DirectionalLight { illuminance: 40_000.0, ..default() };
        stage.world().spawn((light, Transform::default().looking_to(Vec3::new(-0.6, -0.7, -0.35), Vec3::Y)));
    }),
    ("point", |stage| {
        let light = PointLight { intensity: 4e7, range: 40.0, shadow_maps_enabled: true, ..default() };
        stage.world().spawn((light, Transform::from_xyz(2.5, 4.0, 2.0)));
    }),
    ("spot", |stage| {
        let light = SpotLight { intensity: 1e8, range: 40.0, outer_angle: 0.7, shadow_maps_enabled: true, ..default() };
        stage.world().spawn((light, Transform::from_xyz(2.5, 4.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    }),
    ("ambient", |stage| {
        stage.world().insert_resource(GlobalAmbientLight { brightness: 9000.0, ..default() });
    }),
    ("sun under air", |stage| {
        sun(stage);
        stage.world().spawn(Atmosphere::default());
        let world = stage.world();
        let sun = world.query_filtered::<Entity, With<DirectionalLight>>().single(world).expect("one sun");
        world.entity_mut(sun).insert(Sunlight);
    }),
];

const FEATURES: [Case; 16] = [
    ("temporal antialiasing", |stage| of_camera(stage, TemporalAntiAliasing::default())),
    ("ambient occlusion", |stage| {
        stage.world().insert_resource(GlobalAmbientLight { brightness: 9000.0, ..default() });
        of_camera(stage, ScreenSpaceAmbientOcclusion::default());
    }),
    ("prepass of depth, normals and motion", |stage| {
        of_camera(stage, (DepthPrepass, NormalPrepass, MotionVectorPrepass));
    }),
    ("reflections", |stage| {
        of_camera(stage, ScreenSpaceReflections::default());
    }),
    ("bloom", |stage| of_camera(stage, Bloom::NATURAL)),
    ("depth of field", |stage| {
        of_camera(stage, DepthOfField { focal_distance: 4.0, aperture_f_stops: 0.05, ..default() });
    }),
    ("motion blur", |stage| of_camera(stage, MotionBlur { shutter_angle: 1.0, samples: 4 })),
    ("auto exposure", |stage| of_camera(stage, AutoExposure::default())),
    ("fog", |stage| {
        let falloff = FogFalloff::Exponential { density: 0.05 };
        of_camera(stage, DistanceFog { color: Color::srgb(0.4, 0.5, 0.6), falloff, ..default() });
    }),
    ("volumetric fog", |stage| {
        of_camera(stage, VolumetricFog { ambient_intensity: 0.1, ..default() });
        let around = Transform::from_scale(Vec3::splat(30.0));
        stage.world().spawn((FogVolume { density_factor: 0.05, ..default() }, around));
    }),
    ("contact shadows", |stage| {
        of_camera(stage, ContactShadows::default());
        let world = stage.world();
        for mut light in world.query::<&mut DirectionalLight>().iter_mut(world) {
            light.contact_shadows_enabled = true;
        }
    }),
    ("a transparent mesh", |stage| {
        let world = stage.world();
        let pane = world.resource_mut::<Assets<Mesh>>().add(Cuboid::new(3.0, 1.5, 0.02));
        let glass = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgba(0.2, 0.5, 0.9, 0.5));
        world.spawn((Mesh3d(pane), MeshMaterial3d(glass), Transform::from_xyz(0.0, 0.8, 1.5)));
    }),
    ("orthographic", |stage| {
        let scaling_mode = ScalingMode::FixedVertical { viewport_height: 5.0 };
        let lens = OrthographicProjection { scaling_mode, ..OrthographicProjection::default_3d() };
        of_camera(stage, Projection::Orthographic(lens));
    }),
    ("LDR", |stage| {
        let camera = stage.camera;
        stage.world().entity_mut(camera).remove::<Hdr>();
    }),
    ("four samples", |stage| of_camera(stage, Msaa::Sample4)),
    ("contact shadows and four samples", |stage| {
        of_camera(stage, (ContactShadows::default(), Msaa::Sample4));
        let world = stage.world();
        for mut light in world.query::<&mut DirectionalLight>().iter_mut(world) {
            light.contact_shadows_enabled = true;
        }
    }),
];

/// What a route can't have: Bevy's own restrictions.
fn possible(name: &str, deferred: bool) -> bool {
    match name {
        "reflections" => deferred,
        "four samples" | "contact shadows and four samples" => !deferred,
        _ => true,
    }
}

fn compare(cases: &[Case], deferred: bool, base: fn(&mut Stage)) {
    let mut failed = Vec::new();
    for (name, set) in cases.iter().filter(|(name, _)| possible(name, deferred)) {
        let mut stage = stage(deferred);
        base(&mut stage);
        set(&mut stage);
        let shots = pictures(stage, if *name == "reflections" { POLISHED } else { ROUGHNESS });
        let [mean, p999] = difference(&shots);
        println!("{name}, {}: mean {mean:.3}, p99.9 {p999}", if deferred { "deferred" } else { "forward" });
        let lit = shots[0].pixels().filter(|p| p[1] > 30).count();
        if mean >= 2.0 || p999 >= 8.0 || lit < shots[0].pixels().count() / 4 {
            for (shot, kind) in shots.iter().zip(["mesh", "field"]) {
                let route = if deferred { "deferred" } else { "forward" };
                shot.save(std::env::temp_dir().join(format!("plane {name} {route} {kind}.png"))).unwrap();
            }
            failed.push(format!("{name}: mean {mean:.2}, p99.9 {p999}, {lit} pixels lit"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn a_plane_is_lit_as_a_mesh_is() {
    compare(&LIGHTS, false, |_| {});
}

#[test]
fn a_plane_is_lit_as_a_mesh_is_from_the_g_buffer() {
    compare(&LIGHTS, true, |_| {});
}

#[test]
fn every_feature_of_a_camera_takes_a_field_as_a_mesh() {
    compare(&FEATURES, false, sun);
}

#[test]
fn every_feature_of_a_deferred_camera_takes_a_field_as_a_mesh() {
    compare(&FEATURES, true, sun);
}
