//! Stamps: picture and answers agree, one that moves is little work, a thousand elsewhere are none.

mod holes;

use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy_horizon::HorizonWorldPlugin;
use bevy_horizon::prelude::*;
use bevy_horizon::render::cache::Caches;
use bevy_horizon::scene::{HorizonScenePlugin, WorldFileError, WorldStamp};
use bevy_horizon::stamp::{Disc, Edit, Mode, Path, Placed, Rectangle, Shape, Stamps};
use bevy_horizon::world::{CompiledStamps, CompiledTerrain};
use horizon_field::field::Fractal;
use horizon_field::field::arbitrary::Random;

use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::{distances, truth_camera};

const SIZE: [usize; 2] = [160, 90];

fn hills() -> Field {
    Field::Fractal(Fractal { wavelength: 900.0, amplitude: 120.0, octaves: 9.0, seed: 4, ..default() })
}

/// The height of the plate; the hills around are at 24 to 40 m.
const LEVEL: f32 = 30.0;

/// A plate for a house, 24 m across.
fn plate() -> Stamp {
    Stamp(Edit { shape: Shape::Disc(Disc { radius: 12.0 }), mode: Mode::Flatten, falloff: 10.0, order: 1 })
}

/// Three stamps around (0, 0): the plate, which is given back, a road past it, and a dyke.
fn build(world: &mut World) -> Entity {
    let points = vec![[-60.0, 0.0, 30.0], [-20.0, 4.0, 22.0], [20.0, 6.0, 26.0], [70.0, 3.0, 5.0]];
    let road = Stamp(Edit { shape: Shape::Path(Path { points, width: 6.0 }), falloff: 8.0, ..default() });
    let dyke = Rectangle { size: [40.0, 4.0], corner: 1.0 };
    let dyke = Stamp(Edit { shape: Shape::Rectangle(dyke), mode: Mode::Raise(5.0), falloff: 6.0, order: 0 });
    world.spawn((road, Transform::from_xyz(0.0, 28.0, 0.0)));
    world.spawn((dyke, Transform::from_xyz(10.0, 0.0, -40.0).with_rotation(Quat::from_rotation_y(0.5))));
    world.spawn((plate(), Transform::from_xyz(0.0, LEVEL, 0.0))).id()
}

/// A camera 80 m over the stamps, looking down on them at a slant.
fn pose() -> Transform {
    Transform::from_xyz(0.0, 100.0, 60.0).looking_at(Vec3::new(0.0, 10.0, 0.0), Vec3::Y)
}

fn stage() -> (Stage, Entity) {
    let mut stage = Stage::new(SIZE[0] as u32, SIZE[1] as u32);
    stage.light();
    stage.world().spawn(Terrain::new(hills()));
    let plate = build(stage.world());
    stage.look(pose());
    stage.settle();
    (stage, plate)
}

fn filled(stage: &Stage) -> u64 {
    stage.off.app.sub_app(RenderApp).world().resource::<Caches>().tiles_filled()
}

/// The drawn points that are not sky.
fn drawn(stage: &mut Stage, pose: &Transform) -> Vec<(Vec3, Vec3, f32)> {
    let camera = truth_camera(pose, FOV, SIZE);
    let distances = distances(&stage.depth(), &camera, NEAR);
    let ray = |(i, t): (usize, Option<f64>)| {
        let direction = Vec3::from_array(camera.pixel_ray(i).direction().map(|x| x as f32));
        t.map(|t| (pose.translation + direction * t as f32, direction, t as f32))
    };
    distances.into_iter().enumerate().filter_map(ray).collect()
}

/// How far the drawn ground is off what heights and ray casts say, and off the field without stamps, in pixels.
fn compare(stage: &mut Stage, pose: &Transform) -> [f32; 3] {
    let (points, from) = (drawn(stage, pose), pose.translation);
    assert!(points.len() > SIZE[0] * SIZE[1] / 2, "{} pixels show ground", points.len());
    let pixel = 2.0 * (0.5 * FOV).tan() / SIZE[1] as f32;
    let ask = move |world: HorizonQuery, terrains: Query<&CompiledTerrain>| {
        let field = terrains.single().unwrap().height();
        let anchors = field.anchor(&Place::ORIGIN);
        let mut off = [0.0f32; 3];
        for (point, direction, distance) in &points {
            let footprint = pixel * distance;
            let height = world.height(*point).unwrap();
            off[0] = off[0].max((height - point.y).abs() / footprint);
            let hit = world.ray_cast(from, Dir3::new(*direction).unwrap(), 2.0 * distance).expect("ground is drawn");
            // A height's error is that much longer along a ray that grazes.
            let against = direction.dot(hit.normal).abs();
            off[1] = off[1].max((hit.distance - distance).abs() * against / footprint);
            let bare = field.value_f64(&anchors, [point.x.into(), point.z.into()], 0.0);
            off[2] = off[2].max((bare as f32 - point.y).abs() / footprint);
        }
        off
    };
    stage.world().run_system_once(ask).unwrap()
}

#[test]
fn picture_and_answers_agree() {
    let (mut stage, _) = stage();
    let [height, ray, bare] = compare(&mut stage, &pose());
    println!("drawn ground is off heights by {height} px, off ray casts by {ray} px, off the bare field by {bare} px");
    assert!(height < 0.5 && ray < 1.0 && bare > 3.0);
}

#[test]
fn one_that_moves_refills_its_own_tiles() {
    let (mut stage, plate) = stage();
    let (all, before) = (filled(&stage), drawn(&mut stage, &pose()));
    stage.world().get_mut::<Transform>(plate).unwrap().translation += Vec3::new(4.0, 3.0, -2.0);
    stage.settle();
    let moved = filled(&stage) - all;
    println!("{moved} tiles filled for a stamp that moved, of {all} in all");
    assert!(moved > 0 && moved < all / 8);
    let after = drawn(&mut stage, &pose());
    // Beyond both outlines, and a blended texel, no pixel is another.
    let aside = |p: Vec3| p.xz().distance(Vec2::ZERO) > 22.0 + 8.0 + 4.5;
    // A tile's bounds steer rays through it, and rounding with them.
    let differ = |pair: &(&(Vec3, Vec3, f32), &(Vec3, Vec3, f32))| (pair.0.2 - pair.1.2).abs() > 1e-5 * pair.0.2;
    let changed: Vec<_> = before.iter().zip(&after).filter(differ).collect();
    assert!(changed.len() > 20 && changed.iter().all(|(a, b)| !(aside(a.0) && aside(b.0))), "{}", changed.len());
    let [height, ray, _] = compare(&mut stage, &pose());
    assert!(height < 0.5 && ray < 1.0, "{height} and {ray}");
    // Gone, and the ground is as without it; and nothing else is filled again.
    let count = filled(&stage);
    stage.world().despawn(plate);
    stage.settle();
    assert!(filled(&stage) - count <= moved);
    assert!(compare(&mut stage, &pose())[0] < 0.5);
}

#[test]
fn an_origin_that_moves_on_refills_nothing() {
    let (mut stage, _) = stage();
    let shift = Vec3::new(70_000.5, 0.0, -30_000.25);
    let set = |stage: &mut Stage| {
        let mut sets = stage.world().query::<&CompiledStamps>();
        sets.single(stage.world()).unwrap().0.clone()
    };
    let (count, before) = (filled(&stage), set(&mut stage));
    stage.world().insert_resource(WorldOrigin::from_metres(shift.to_array().map(f64::from)));
    let mut stamps = stage.world().query_filtered::<&mut Transform, With<Stamp>>();
    for mut transform in stamps.iter_mut(stage.world()) {
        transform.translation -= shift;
    }
    stage.look(pose().with_translation(pose().translation - shift));
    stage.settle();
    assert_eq!(filled(&stage), count);
    assert!(std::sync::Arc::ptr_eq(&before, &set(&mut stage)), "the set was made again");
}

#[test]
fn a_thousand_elsewhere_cost_the_march_nothing() {
    let (mut stage, _) = stage();
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Work;
    stage.settle();
    let (count, before) = (filled(&stage), stage.colour());
    let mut random = Random::new(61);
    for _ in 0..1000 {
        // Behind the camera.
        let [x, z] = [random.within(-600.0, 600.0) as f32, random.within(300.0, 1500.0) as f32];
        stage.world().spawn((plate(), Transform::from_xyz(x, 30.0, z)));
    }
    stage.settle();
    println!("{} tiles filled for a thousand stamps, after {count}", filled(&stage) - count);
    assert!(filled(&stage) > count);
    let after = stage.colour();
    let turns =
        |picture: &[[f32; 4]]| picture.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / picture.len() as f64;
    println!("{} turns a ray before, {} with them", turns(&before), turns(&after));
    assert_eq!(before, after);
}

/// An app without a renderer.
fn server() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, AssetPlugin::default(), HorizonWorldPlugin, HorizonScenePlugin));
    app
}

fn height(app: &mut App, at: Vec3) -> f32 {
    app.world_mut().run_system_once(move |world: HorizonQuery| world.height(at).unwrap()).unwrap()
}

#[test]
fn a_server_knows_them_too() {
    let mut app = server();
    app.insert_resource(WorldOrigin::from_metres([1e9, 0.0, -1e9]));
    let terrain = app.world_mut().spawn(Terrain::new(hills())).id();
    app.update();
    let bare = height(&mut app, Vec3::new(3.0, 0.0, 2.0));
    let plate = build(app.world_mut());
    app.update();
    let ask = |world: HorizonQuery| {
        let points: Vec<_> = (0..9).map(|i| Vec3::new(i as f32 - 4.0, 0.0, 0.5 * i as f32 - 2.0)).collect();
        let hit = world.ray_cast(Vec3::new(3.0, 500.0, 2.0), Dir3::NEG_Y, 1e4).unwrap();
        assert!((hit.position.y - LEVEL).abs() < 1e-4 && hit.normal.y > 0.999_999, "{hit:?}");
        assert!(world.heights(&points).iter().all(|height| (height - LEVEL).abs() < 1e-5));
        assert!(points.iter().all(|p| world.slope(*p).unwrap() < 1e-6 && world.normal(*p).unwrap().y > 0.999_999));
    };
    app.world_mut().run_system_once(ask).unwrap();
    // What is saved or sent makes the same ground elsewhere.
    let placed: Vec<Placed> = app.world().get::<CompiledStamps>(terrain).unwrap().0.placed().cloned().collect();
    assert_eq!(placed.len(), 3);
    assert!(Stamps::compile(&placed).unwrap().placed().eq(placed.iter()));
    // A bad edit is refused, and what it was stays.
    app.world_mut().get_mut::<Stamp>(plate).unwrap().falloff = f64::NAN;
    app.update();
    assert_eq!(height(&mut app, Vec3::new(3.0, 0.0, 2.0)), LEVEL);
    app.world_mut().despawn(plate);
    app.update();
    assert_eq!(height(&mut app, Vec3::new(3.0, 0.0, 2.0)), bare);
}

#[test]
fn a_stamp_below_a_terrain_is_of_that_one_alone() {
    let mut app = server();
    let [one, other] = [(); 2].map(|()| app.world_mut().spawn(Terrain::new(hills())).id());
    app.world_mut().spawn((plate(), Transform::from_xyz(0.0, LEVEL, 0.0), ChildOf(one)));
    app.update();
    assert!(app.world().get::<CompiledStamps>(one).is_some() && app.world().get::<CompiledStamps>(other).is_none());
}

const WORLD: &str = "(
    version: 1,
    terrain: (field: Constant(5.0)),
    stamps: [
        (
            place: (cell: (0, 0, 0), offset: (100.0, 8.0, 50.0)),
            edit: (shape: Rectangle(size: (20.0, 10.0)), falloff: 4.0),
        ),
        (place: (offset: (0.0, 0.0, -50.0)), edit: (mode: Lower(2.0))),
    ],
)
";

#[test]
fn world_files_hold_stamps() {
    let file = WorldFile::from_ron(WORLD).unwrap();
    assert!(WorldFile::from_ron(&file.to_ron().unwrap()).unwrap() == file && file.stamps.len() == 2);
    let bad = WorldFile::from_ron(&WORLD.replace("falloff: 4.0", "falloff: -4.0")).unwrap_err();
    assert!(matches!(bad, WorldFileError::Value { line: Some(7), .. }), "{bad:?}");
    assert!(bad.to_string().contains("stamps[0].edit.falloff"), "{bad}");

    let mut app = server();
    app.finish();
    app.cleanup();
    let handle = app.world_mut().resource_mut::<Assets<WorldFile>>().add(file.clone());
    app.world_mut().spawn(HorizonWorld(handle.clone()));
    for _ in 0..3 {
        app.update();
    }
    let at = [Vec3::new(100.0, 0.0, 50.0), Vec3::new(0.0, 0.0, -50.0), Vec3::new(50.0, 0.0, 0.0)];
    assert_eq!(at.map(|at| height(&mut app, at)), [8.0, 3.0, 5.0]);
    // The file changes: so does the ground.
    let mut edited = file;
    edited.stamps.remove(1);
    edited.stamps[0].place.offset[1] = 9.5;
    app.world_mut().resource_mut::<Assets<WorldFile>>().insert(&handle, edited).unwrap();
    for _ in 0..3 {
        app.update();
    }
    assert_eq!(at.map(|at| height(&mut app, at)), [9.5, 5.0, 5.0]);
    let mut stamps = app.world_mut().query_filtered::<(), With<WorldStamp>>();
    assert_eq!(stamps.iter(app.world()).count(), 1);
}
