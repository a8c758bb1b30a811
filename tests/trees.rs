//! Plants in the picture: they stand where the CPU says, hide meshes and ground and are hidden by them, one by one can be felled, and
//! cast shadows.

use bevy::camera::{Hdr, ScalingMode, Viewport};
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass, MotionVectorPrepass};
use bevy::ecs::system::RunSystemOnce;
use bevy::light::CascadeShadowConfigBuilder;
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::{CachedPipelineState, PipelineCache};
use bevy_horizon::prelude::*;
use bevy_horizon::stamp::Stamps;
use bevy_horizon::trees::{Cone, Forest, Grove, PlantGround, PlantShape, Species};
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::{distances, truth_camera};
use horizon_field::field::{Fractal, NoImages};
use horizon_field::march::{Anchored, Cast};

const SIZE: [usize; 2] = [192, 108];

fn hills() -> Field {
    Field::Fractal(Fractal { wavelength: 600.0, amplitude: 90.0, octaves: 7.0, gain: 0.4, seed: 12, ..default() })
}

/// Dense woods of two kinds.
fn forest() -> Forest {
    let spruce = Species { shape: PlantShape::Conifer, height: [6.0, 12.0], radius: 0.24, ..default() };
    Forest {
        density: Field::Constant(0.6),
        steepest: 100.0,
        shore: -1e6,
        species: vec![Species::default(), spruce],
        ..default()
    }
}

/// The height of the ground without stamps, at the origin of the world.
fn height(x: f32, z: f32) -> f32 {
    let compiled = hills().compile::<2>(&NoImages).expect("the field is good");
    compiled.value_f64(&compiled.anchor(&Place::ORIGIN), [x.into(), z.into()], 0.0) as f32
}

/// Over the woods, looking down on them at a slant; a hill stands before the sky.
fn pose() -> Transform {
    Transform::from_xyz(0.0, height(0.0, 0.0) + 25.0, 0.0).looking_to(Vec3::new(0.2, -0.25, -1.0), Vec3::Y)
}

struct Scene {
    trees: bool,
    meshes: bool,
    ground: bool,
    deferred: bool,
    projection: Option<Projection>,
}

const WOODS: Scene = Scene { trees: true, meshes: false, ground: true, deferred: false, projection: None };

impl Scene {
    fn stage(&self) -> Stage {
        let mut stage = Stage::new(SIZE[0] as u32, SIZE[1] as u32);
        stage.light();
        let camera = stage.camera;
        if self.deferred {
            stage.world().insert_resource(DefaultOpaqueRendererMethod::deferred());
            stage.world().entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
        }
        if let Some(projection) = &self.projection {
            stage.world().entity_mut(camera).insert(projection.clone());
        }
        if self.ground {
            let mut ground = stage.world().spawn(Terrain::new(hills()));
            if self.trees {
                ground.insert(Trees::new(forest()));
            }
        }
        if self.meshes {
            let ball = stage.world().resource_mut::<Assets<Mesh>>().add(Sphere::new(4.0));
            let red = stage.world().resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.8, 0.2, 0.1));
            for i in 0..60 {
                let (x, z) = ((i % 10) as f32 * 11.0 - 40.0, -20.0 - (i / 10) as f32 * 19.0);
                let at = Transform::from_xyz(x, height(x, z) + (i % 4) as f32 * 3.0, z);
                stage.world().spawn((Mesh3d(ball.clone()), MeshMaterial3d(red.clone()), at));
            }
        }
        stage.look(pose());
        if self.ground {
            stage.settle();
        }
        (0..8).for_each(|_| stage.off.update());
        stage
    }

    fn depth(&self) -> Vec<f32> {
        self.stage().depth()
    }
}

fn orthographic() -> Projection {
    Projection::Orthographic(OrthographicProjection {
        scaling_mode: ScalingMode::FixedVertical { viewport_height: 90.0 },
        far: 2000.0,
        ..OrthographicProjection::default_3d()
    })
}

#[test]
fn what_is_drawn_is_where_a_ray_meets_it_on_the_cpu() {
    let depth = WOODS.depth();
    let camera = truth_camera(&pose(), FOV, SIZE);
    let drawn = distances(&depth, &camera, NEAR);
    let field = hills().compile::<2>(&NoImages).expect("the field is good");
    let planting = forest().compile("forest", &NoImages).expect("the forest is good");
    let (stamps, felled) = (Stamps::default(), bevy_horizon::trees::Felled::default());
    let ground = PlantGround { field: &field, stamps: &stamps };
    let mut grove = Grove::new(&planting, ground, &felled);
    let surface = Anchored::new(&field, &Place::ORIGIN);
    let pixel = 2.0 * f64::from(0.5 * FOV).tan() / SIZE[1] as f64;
    let cone = Cone { start: 0.0, growth: pixel };
    let (mut of_plants, mut compared, mut off, mut unplanted) = (0, 0, 0, 0);
    for (i, drawn) in drawn.iter().enumerate() {
        let ray = camera.pixel_ray(i);
        let bare = match surface.cast(&ray, 2000.0) {
            Cast::Hit(hit) => hit.t,
            _ => f64::INFINITY,
        };
        let plant = grove.cast(&Place::ORIGIN, &ray, 2000.0, cone).map_or(f64::INFINITY, |hit| hit.t);
        let truth = plant.min(bare);
        // Farther away plants shrink, until none is left.
        if truth > 350.0 {
            continue;
        }
        let far = |of: f64| drawn.is_none_or(|drawn| (drawn - of).abs() > 0.1 + 2.0 * pixel * of);
        compared += 1;
        of_plants += usize::from(plant < bare);
        off += usize::from(far(truth));
        unplanted += usize::from(far(bare));
    }
    println!("{compared} pixels, {of_plants} of plants: {off} are off; {unplanted} would be without plants");
    assert!(compared > 10_000 && of_plants > compared / 4, "{of_plants} of {compared}");
    // Single pixels at the edges of crowns, where a ray grazes.
    assert!(off < compared / 100, "{off} of {compared}");
    assert!(unplanted > compared / 4);
}

#[test]
fn the_nearest_of_mesh_ground_and_plant_shows() {
    for deferred in [false, true] {
        for projection in [None, Some(orthographic())] {
            let scene =
                |trees, meshes, ground| Scene { trees, meshes, ground, deferred, projection: projection.clone() };
            let all = scene(true, true, true).depth();
            let woods = scene(true, false, true).depth();
            let bare = scene(false, false, true).depth();
            let meshes = scene(false, true, false).depth();
            let (mut hides, mut hidden, mut over_ground, mut cut) = (0, 0, 0, 0);
            for (((all, woods), bare), mesh) in all.iter().zip(&woods).zip(&bare).zip(&meshes) {
                // Reverse z: the nearer is the larger, to the bit; but where a mesh ends a ray within a crown's last step, that is shorter.
                let nearer = woods.max(*mesh);
                assert!((all - nearer).abs() <= 5e-4 * nearer, "deferred: {deferred}: {all}, not {nearer}");
                cut += usize::from(*all != nearer);
                assert!(woods >= bare);
                over_ground += usize::from(woods > bare);
                hides += usize::from(woods > bare && *mesh > 0.0 && woods > mesh && mesh > bare);
                hidden += usize::from(woods > bare && mesh > woods);
            }
            println!("deferred {deferred}: {over_ground} of plants, {hides} before a mesh, {hidden} behind one");
            assert!(cut < 10, "{cut} pixels are not to the bit");
            assert!(over_ground > 4_000 && hides > 50 && hidden > 50, "{over_ground}, {hides}, {hidden}");
        }
    }
}

#[test]
fn plants_stand_before_the_sky() {
    for projection in [None, Some(orthographic())] {
        let level = |trees| {
            let scene = Scene { trees, meshes: false, ground: true, deferred: false, projection: projection.clone() };
            let mut stage = scene.stage();
            // From the ground, slightly upwards.
            let eye = Transform::from_xyz(0.0, height(0.0, 0.0) + 2.5, 0.0);
            stage.look(eye.looking_to(Vec3::new(0.2, 0.12, -1.0), Vec3::Y));
            stage.settle();
            stage.depth()
        };
        let (woods, bare) = (level(true), level(false));
        let sky = bare.iter().filter(|depth| **depth == 0.0).count();
        let before = woods.iter().zip(&bare).filter(|(woods, bare)| **bare == 0.0 && **woods > 0.0).count();
        println!("{sky} pixels of sky, {before} behind plants");
        assert!(sky > 1000 && before > sky / 20, "{before} of {sky}");
    }
}

#[test]
fn one_that_is_felled_is_gone_alone() {
    let mut stage = WOODS.stage();
    let before = stage.depth();
    let around = |stage: &mut Stage| {
        let ask = |world: HorizonQuery| world.trees_in(Rect::new(-25.0, -60.0, 35.0, -20.0)).expect("a small area");
        stage.world().run_system_once(ask).expect("the query's resources are there")
    };
    let standing = around(&mut stage);
    // About the middle of the picture.
    let away = |plant: &StandingPlant| plant.position.xz().distance(Vec2::new(10.0, -45.0));
    let one = *standing.iter().min_by(|a, b| away(a).total_cmp(&away(b))).expect("the woods are dense");
    let ground = stage.world().query_filtered::<Entity, With<Trees>>().single(stage.world()).expect("one terrain");
    let mut felled = Felled::default();
    assert!(felled.fell(one.id));
    stage.world().entity_mut(ground).insert(felled);
    stage.settle();
    (0..20).for_each(|_| stage.off.update());
    let left = around(&mut stage);
    assert_eq!(left.len() + 1, standing.len());
    assert!(left.iter().all(|plant| plant.id != one.id && standing.contains(plant)));
    let after = stage.depth();
    let camera = truth_camera(&pose(), FOV, SIZE);
    let mut changed = 0;
    for (i, (before, distance)) in before.iter().zip(distances(&before, &camera, NEAR)).enumerate() {
        // Within what rounding makes of other bounds.
        if (before - after[i]).abs() <= 1e-4 * before {
            continue;
        }
        changed += 1;
        assert!(after[i] < *before, "what was behind it is farther away");
        let at = Vec3::from_array(camera.pixel_ray(i).at(distance.expect("a plant")).map(|x| x as f32));
        let off = (at - one.position).xz().length();
        assert!(off < 1.2 * one.radius + 0.2 && at.y < one.position.y + 1.05 * one.height, "{off} m from the trunk");
    }
    println!("{} plants stood, and {changed} pixels changed", standing.len());
    assert!(changed > 10, "{changed}");
    // And it stands again, to the bit.
    stage.world().entity_mut(ground).remove::<Felled>();
    stage.settle();
    (0..20).for_each(|_| stage.off.update());
    assert_eq!(stage.depth(), before);
}

/// A stage under a high sun, looking straight down on a square of 60 m.
fn from_above(trees: bool, plate: bool, deferred: bool) -> Vec<[f32; 4]> {
    let mut stage = Stage::new(128, 128);
    let camera = stage.camera;
    let world = stage.world();
    if deferred {
        world.insert_resource(DefaultOpaqueRendererMethod::deferred());
        world.entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    }
    let mut ground = world.spawn(Terrain::new(Field::Constant(0.0)));
    if trees {
        // Far enough apart that the ground between them shows.
        let forest = Forest { spacing: 14.0, density: Field::Constant(1.0), ..forest() };
        ground.insert(Trees::new(forest));
    }
    world.insert_resource(GlobalAmbientLight { brightness: 800.0, ..default() });
    let cascades = CascadeShadowConfigBuilder { num_cascades: 1, maximum_distance: 400.0, ..default() }.build();
    let light = DirectionalLight { illuminance: 60_000.0, shadow_maps_enabled: true, ..default() };
    let down = Transform::default().looking_to(Vec3::new(-0.6, -0.7, 0.0), Vec3::Y);
    world.spawn((light, cascades, down));
    if plate {
        // Under the crowns, over the ground.
        let mesh = world.resource_mut::<Assets<Mesh>>().add(Cuboid::new(80.0, 0.2, 80.0));
        let grey = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.5, 0.5, 0.5));
        world.spawn((Mesh3d(mesh), MeshMaterial3d(grey), Transform::from_xyz(0.0, 0.3, 0.0)));
    }
    let lens = OrthographicProjection {
        scaling_mode: ScalingMode::FixedVertical { viewport_height: 60.0 },
        ..OrthographicProjection::default_3d()
    };
    world.entity_mut(camera).insert(Projection::Orthographic(lens));
    stage.look(Transform::from_xyz(0.0, 60.0, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
    stage.settle();
    (0..10).for_each(|_| stage.off.update());
    stage.colour()
}

#[test]
fn plants_cast_shadows_on_ground_and_mesh() {
    for deferred in [false, true] {
        for plate in [false, true] {
            let [with, without] = [true, false].map(|trees| from_above(trees, plate, deferred));
            let ratios = with.iter().zip(&without).map(|(with, without)| with[1] / without[1]);
            // The surface is grey or brown; crowns are green: of these, green is much over red.
            let surface = |(with, without): &(&[f32; 4], &[f32; 4])| {
                (with[1] / with[0].max(1e-9)) / (without[1] / without[0].max(1e-9)) < 1.15
            };
            let seen: Vec<_> =
                with.iter().zip(&without).zip(ratios).filter(|(pair, _)| surface(pair)).map(|(_, r)| r).collect();
            let dark = seen.iter().filter(|ratio| **ratio < 0.6).count();
            let bright = seen.iter().filter(|ratio| **ratio > 0.9 && **ratio < 1.1).count();
            println!(
                "deferred {deferred}, plate {plate}: {} of the surface, {dark} dark, {bright} as before",
                seen.len()
            );
            assert!(dark > 300 && bright > 500, "{dark} dark, {bright} bright of {}", seen.len());
        }
    }
}

/// Pipelines of plants, in whatever state.
fn pipelines(stage: &Stage) -> usize {
    let cache = stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>();
    let ours = |text: &str| text.contains("horizon_trees") || text.contains("horizon_cast_trees");
    cache.pipelines().filter(|pipeline| ours(&format!("{:?}", pipeline.descriptor))).count()
}

#[test]
fn every_kind_of_view_draws_them_and_a_scene_without_pays_nothing() {
    let changes: [(&str, fn(&mut Stage)); 5] = [
        ("as it is", |_| {}),
        ("LDR, with four samples", |stage| {
            let camera = stage.camera;
            stage.world().entity_mut(camera).remove::<Hdr>().insert(Msaa::Sample4);
        }),
        ("deferred, with motion vectors", |stage| {
            let camera = stage.camera;
            stage.world().entity_mut(camera).insert((DepthPrepass, DeferredPrepass, MotionVectorPrepass));
        }),
        ("in a viewport", |stage| {
            let camera = stage.camera;
            let part =
                Viewport { physical_position: UVec2::new(60, 20), physical_size: UVec2::new(120, 80), ..default() };
            stage.world().get_mut::<Camera>(camera).expect("a camera").viewport = Some(part);
        }),
        ("under air that makes light", |stage| {
            stage.world().spawn(Atmosphere::default());
        }),
    ];
    for (name, change) in changes {
        let [woods, bare] = [true, false].map(|trees| {
            let scene = Scene { trees, ..WOODS };
            let mut stage = scene.stage();
            change(&mut stage);
            stage.settle();
            (0..8).for_each(|_| stage.off.update());
            assert_eq!(pipelines(&stage) > 0, trees, "{name}");
            let picture = stage.off.screenshot();
            assert!(stage.off.app.should_exit().is_none(), "{name}: the device refused something");
            for pipeline in stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines() {
                assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{name}: {:?}", pipeline.state);
            }
            picture
        });
        let other = woods.pixels().zip(bare.pixels()).filter(|(a, b)| (0..3).any(|k| a[k].abs_diff(b[k]) > 8)).count();
        println!("{name}: {other} pixels are others");
        assert!(other > 2500, "{name}: {other}");
    }
}

#[test]
fn the_wind_moves_the_tops_and_they_come_back() {
    let mut stage = WOODS.stage();
    let still = stage.depth();
    let again = stage.depth();
    assert_eq!(still, again, "without wind nothing moves");
    let ground = stage.world().query_filtered::<Entity, With<Trees>>().single(stage.world()).expect("one terrain");
    stage.world().get_mut::<Trees>(ground).expect("woods").wind = [0.2, 0.0];
    (0..4).for_each(|_| stage.off.update());
    let first = stage.depth();
    std::thread::sleep(std::time::Duration::from_millis(300));
    (0..2).for_each(|_| stage.off.update());
    let second = stage.depth();
    let moved = first.iter().zip(&second).filter(|(a, b)| a != b).count();
    println!("{moved} pixels moved");
    assert!(moved > 1000, "{moved}");
    stage.world().get_mut::<Trees>(ground).expect("woods").wind = [0.0; 2];
    (0..4).for_each(|_| stage.off.update());
    assert_eq!(stage.depth(), still);
}
