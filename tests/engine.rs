//! What the plugin costs and survives as a part of Bevy.

use bevy::camera::Viewport;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::{CachedPipelineState, PipelineCache, PollType};
use bevy::render::renderer::RenderDevice;
use bevy_horizon::prelude::*;
use bevy_horizon::render::HorizonSkyPlugin;

use bevy_horizon_workspace::stage::Stage;

struct NoPlugins;

impl Plugin for NoPlugins {
    fn build(&self, _: &mut App) {}
}

/// The count of pipelines, and the names of the device's allocations, after some frames. Staging and wgpu's own buffers
/// come and go with the frames in flight, and the copies of depth are this test's own.
fn counts(stage: &Stage) -> (usize, Vec<String>) {
    let render = stage.off.app.sub_app(RenderApp).world();
    let device = render.resource::<RenderDevice>();
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let report = device.wgpu_device().generate_allocator_report().expect("the device reports its allocations");
    let passing = |name: &str| {
        name.to_lowercase().contains("staging") || name.contains("wgpu internal") || name == "kept"
            // Bevy has as many of these as frames are under way.
            || name.starts_with("render_statistics")
    };
    let mut names: Vec<String> = report.allocations.into_iter().map(|a| a.name).filter(|name| !passing(name)).collect();
    names.sort();
    (render.resource::<PipelineCache>().pipelines().count(), names)
}

/// Those that are ours.
fn own(names: &[String]) -> Vec<&String> {
    names.iter().filter(|name| name.contains("horizon")).collect()
}

fn with_mesh(stage: &mut Stage) {
    stage.light();
    let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Sphere::new(1.0));
    let material = stage.world().resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::default());
    stage.world().spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_xyz(0.0, 0.0, -5.0)));
    (0..12).for_each(|_| stage.off.update());
}

#[test]
fn without_a_world_nothing_is_built() {
    let mut bare = Stage::with_plugins(NoPlugins, 160, 90);
    let camera = bare.camera;
    bare.world().entity_mut(camera).remove::<HorizonCamera>();
    with_mesh(&mut bare);
    let mut idle = Stage::new(160, 90);
    with_mesh(&mut idle);
    let (bare, idle) = (counts(&bare), counts(&idle));
    println!(
        "bare Bevy {} pipelines, {} allocations; with the plugin {} and {}",
        bare.0,
        bare.1.len(),
        idle.0,
        idle.1.len()
    );
    assert!(!bare.1.is_empty(), "the device must report its allocations");
    assert_eq!(bare.0, idle.0, "pipelines");
    assert_eq!(bare.1, idle.1, "allocations");
    assert!(own(&idle.1).is_empty(), "{:?}", own(&idle.1));
}

/// Bytes on the device in buffers of ours.
fn own_bytes(stage: &Stage) -> u64 {
    let device = stage.off.app.sub_app(RenderApp).world().resource::<RenderDevice>();
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let report = device.wgpu_device().generate_allocator_report().expect("the device reports its allocations");
    report.allocations.iter().filter(|a| a.name.contains("horizon")).map(|a| a.size).sum()
}

#[test]
fn device_memory_stays_within_its_limit() {
    for size in [[1280, 720], [160, 90]] {
        let mut stage = Stage::new(size[0], size[1]);
        stage.light();
        stage.world().spawn(Terrain::default());
        stage.look(Transform::from_xyz(0.0, 900.0, 0.0).looking_to(Vec3::new(0.0, -0.2, -1.0), Vec3::Y));
        stage.settle();
        let used = own_bytes(&stage) as f64 / f64::from(1 << 20);
        println!("{size:?}: {used:.1} MiB");
        assert!(used > 4.0 && used <= 128.0, "{size:?}: {used} MiB");
    }
}

#[test]
fn terrain_adds_only_its_own() {
    let mut stage = Stage::new(160, 90);
    with_mesh(&mut stage);
    let before = counts(&stage);
    stage.world().spawn(Terrain::default());
    stage.settle();
    let with = counts(&stage);
    println!("terrain adds {} pipelines: {:?}", with.0 - before.0, own(&with.1));
    // Fill, pyramid, light, clearance, ground and its shade.
    assert_eq!(with.0 - before.0, 6);
    assert!(own(&with.1).iter().any(|name| name.contains("horizon_heights")));
}

#[test]
fn every_pipeline_compiles() {
    // A shader that is not found, or not valid, is tried again for ever in silence.
    for msaa in [Msaa::Off, Msaa::Sample4] {
        for hdr in [true, false] {
            let mut stage = Stage::new(160, 90);
            stage.light();
            stage.world().spawn((Terrain::default(), Atmosphere::default()));
            let camera = stage.camera;
            stage.world().entity_mut(camera).insert(msaa).remove::<bevy_horizon_workspace::stage::KeepDepth>();
            if !hdr {
                stage.world().entity_mut(camera).remove::<bevy::camera::Hdr>();
            }
            stage.look(Transform::from_xyz(0.0, 500.0, 0.0).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y));
            stage.settle();
            let picture = stage.off.screenshot();
            let cache = stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>();
            for pipeline in cache.pipelines() {
                assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{:?}", pipeline.descriptor);
            }
            // Ground at the bottom, sky at the top, and neither black nor white.
            for y in [5, 85] {
                let pixel = picture.get_pixel(80, y).0;
                assert!(
                    pixel[..3].iter().any(|c| *c > 20) && pixel[..3].iter().any(|c| *c < 250),
                    "{pixel:?} in {msaa:?}, HDR {hdr}"
                );
            }
        }
    }
}

#[test]
fn several_cameras_and_viewports_each_show_the_world() {
    let mut stage = Stage::new(320, 180);
    stage.light();
    stage.world().spawn((Terrain::default(), Atmosphere::default()));
    let look = Transform::from_xyz(0.0, 500.0, 0.0).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y);
    stage.look(look);
    let camera = stage.camera;
    let half = |x| Viewport { physical_position: UVec2::new(x, 0), physical_size: UVec2::new(160, 180), ..default() };
    stage.world().get_mut::<Camera>(camera).unwrap().viewport = Some(half(0));
    let target = stage.off.target();
    stage.world().spawn((
        Camera3d::default(),
        target,
        Camera { order: 1, clear_color: ClearColorConfig::None, viewport: Some(half(160)), ..default() },
        bevy::camera::Hdr,
        Msaa::Off,
        bevy::camera::Exposure { ev100: 13.5 },
        bevy::core_pipeline::tonemapping::Tonemapping::AgX,
        Projection::Perspective(PerspectiveProjection { fov: bevy_horizon_workspace::stage::FOV, ..default() }),
        HorizonCamera::default(),
        look,
    ));
    stage.settle();
    let picture = stage.off.screenshot();
    // The same view twice, side by side: the same picture.
    let differing = (0..180).flat_map(|y| (0..160).map(move |x| (x, y))).filter(|(x, y)| {
        let (a, b) = (picture.get_pixel(*x, *y).0, picture.get_pixel(x + 160, *y).0);
        a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 2)
    });
    assert!(differing.count() < 40);
}

#[test]
fn four_cameras_stay_within_the_memory() {
    let mut stage = Stage::new(640, 360);
    stage.light();
    stage.world().spawn((Terrain::default(), Atmosphere::default()));
    let target = stage.off.target();
    let quarter = |i: u32| Viewport {
        physical_position: UVec2::new(320 * (i % 2), 180 * (i / 2)),
        physical_size: UVec2::new(320, 180),
        ..default()
    };
    // Far apart, so that none can share another's cache.
    let look = |i: u32| {
        let at = Vec3::new(40_000.0 * i as f32, 600.0, 0.0);
        Transform::from_translation(at).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y)
    };
    stage.look(look(0));
    let camera = stage.camera;
    stage.world().get_mut::<Camera>(camera).unwrap().viewport = Some(quarter(0));
    for i in 1..4 {
        stage.world().spawn((
            Camera3d::default(),
            target.clone(),
            Camera { order: i as isize, clear_color: ClearColorConfig::None, viewport: Some(quarter(i)), ..default() },
            bevy::camera::Hdr,
            Msaa::Off,
            HorizonCamera::default(),
            look(i),
        ));
    }
    stage.settle();
    let used = own_bytes(&stage) as f64 / f64::from(1 << 20);
    println!("four cameras: {used:.1} MiB");
    assert!(used > 16.0 && used <= 128.0, "{used} MiB");
}

/// What Bevy can't have, or a device lacks, is said once, and everything goes on.
#[test]
fn impossible_cameras_are_survived() {
    use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
    let mut stage = Stage::new(96, 54);
    stage.light();
    let terrain = stage.world().spawn((Terrain::default(), Atmosphere::default())).id();
    stage.look(Transform::from_xyz(0.0, 600.0, 0.0).looking_to(Vec3::new(0.0, -0.5, -1.0), Vec3::Y));
    stage.settle();
    let camera = stage.camera;
    // Bevy turns multisampling off in the deferred route, with a warning.
    stage.world().entity_mut(camera).insert((Msaa::Sample4, DepthPrepass, DeferredPrepass));
    (0..6).for_each(|_| stage.off.update());
    assert_eq!(stage.world().get::<Msaa>(camera), Some(&Msaa::Off));
    let lit = |stage: &mut Stage| stage.off.screenshot().pixels().filter(|p| p[1] > 20).count();
    assert!(lit(&mut stage) > 96 * 54 / 2);
    // More samples than the driver has: it gets what there is. The game's own component stays.
    stage
        .world()
        .entity_mut(camera)
        .remove::<(DepthPrepass, DeferredPrepass, bevy_horizon_workspace::stage::KeepDepth)>();
    stage.world().entity_mut(camera).insert(Msaa::Sample8);
    (0..6).for_each(|_| stage.off.update());
    assert_eq!(stage.world().get::<Msaa>(camera), Some(&Msaa::Sample8));
    assert!(lit(&mut stage) > 96 * 54 / 2);
    stage.world().entity_mut(camera).insert(Msaa::Off);
    // Out of use and in again.
    (0..3).for_each(|_| stage.off.update());
    stage.world().entity_mut(camera).remove::<HorizonCamera>();
    (0..3).for_each(|_| stage.off.update());
    stage.world().entity_mut(camera).insert(HorizonCamera::default());
    stage.world().entity_mut(terrain).remove::<Terrain>();
    (0..3).for_each(|_| stage.off.update());
    stage.world().entity_mut(terrain).insert(Terrain::default());
    stage.settle();
    // A target without a size, as a minimised window has it.
    stage.world().entity_mut(camera).insert(bevy::camera::RenderTarget::None { size: UVec2::ZERO });
    (0..3).for_each(|_| stage.off.update());
    let target = stage.off.target();
    stage.world().entity_mut(camera).insert(target);
    stage.settle();
    assert!(lit(&mut stage) > 96 * 54 / 2);
}

#[test]
fn resizing_and_removal_in_use_are_survived() {
    let mut stage = Stage::new(64, 64);
    stage.light();
    let terrain = stage.world().spawn((Terrain::default(), Atmosphere::default())).id();
    stage.settle();
    for size in [1, 3, 200, 64] {
        let image = stage.off.image();
        let mut images = stage.world().resource_mut::<Assets<Image>>();
        images.get_mut(&image).unwrap().resize(bevy::render::render_resource::Extent3d {
            width: size,
            height: size,
            depth_or_array_layers: 1,
        });
        (0..4).for_each(|_| stage.off.update());
    }
    stage.world().entity_mut(terrain).remove::<Atmosphere>();
    stage.off.update();
    stage.world().entity_mut(terrain).insert(Atmosphere::default()).remove::<Terrain>();
    (0..3).for_each(|_| stage.off.update());
    stage.world().entity_mut(terrain).insert(Terrain::default());
    stage.settle();
}

#[test]
fn the_sky_can_be_left_out() {
    let mut stage = Stage::with_plugins(HorizonPlugins.build().disable::<HorizonSkyPlugin>(), 64, 64);
    stage.world().spawn((Terrain::default(), Atmosphere::default()));
    stage.settle();
}
