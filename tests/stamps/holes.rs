//! Holes: what shows through them and what they let through, in the picture and for all who ask.

use bevy::camera::ScalingMode;
use bevy::light::CascadeShadowConfigBuilder;
use bevy_horizon::world::GroundChanged;

use super::*;

/// The top of the cellar's floor, 4 m under the plate.
const FLOOR: f32 = 26.0;
/// The floor's half extents.
const HALF: Vec3 = Vec3::new(10.0, 0.5, 10.0);

fn hole() -> (Stamp, Transform) {
    let shape = Shape::Rectangle(Rectangle { size: [8.0, 6.0], corner: 1.0 });
    let at = Transform::from_xyz(1.0, 0.0, -1.0).with_rotation(Quat::from_rotation_y(0.5));
    (Stamp::new(shape, Mode::Hole), at)
}

fn mesh(world: &mut World, mesh: impl Into<Mesh>, at: Transform) {
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: LinearRgba::rgb(0.3, 0.3, 0.3).into(),
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..default()
    });
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material), at));
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    Nothing,
    Ground,
    Floor,
}

/// Where a ray meets the floor, and the cosine between the two.
fn floor_ahead(from: Vec3, direction: Vec3) -> Option<(f32, f32)> {
    let middle = Vec3::Y * (FLOOR - HALF.y);
    let [a, b] = [middle - HALF, middle + HALF].map(|corner| (corner - from) / direction);
    let (near, far) = (a.min(b), a.max(b));
    let t = near.max_element();
    let against = direction.abs().to_array();
    let side = near.to_array().iter().position(|x| *x == t).map_or(0.0, |axis| against[axis]);
    (t > 0.0 && t <= far.min_element()).then_some((t, side))
}

/// What a ray meets first, how far away, and how steeply.
fn truth(world: &HorizonQuery, from: Vec3, direction: Vec3) -> (Shown, f32, f32) {
    let hit = world.ray_cast(from, Dir3::new(direction).unwrap(), HorizonCamera::default().far);
    let ground = hit.map(|hit| (Shown::Ground, hit.distance, direction.dot(hit.normal).abs()));
    let floor = floor_ahead(from, direction).map(|(t, against)| (Shown::Floor, t, against));
    let nearest = ground.into_iter().chain(floor).min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.unwrap_or((Shown::Nothing, f32::INFINITY, 1.0))
}

/// Of the pixels that lie within something: how many there are of nothing, ground and floor, how many show something else or are a
/// pixel off, and how many lie at an edge.
fn compare_shown(stage: &mut Stage, pose: &Transform) -> ([usize; 3], usize, usize) {
    let camera = truth_camera(pose, FOV, SIZE);
    let seen = distances(&stage.depth(), &camera, NEAR);
    let from = pose.translation;
    let directions: Vec<Vec3> =
        (0..seen.len()).map(|i| Vec3::from_array(camera.pixel_ray(i).direction().map(|x| x as f32))).collect();
    let ask = move |world: HorizonQuery| -> Vec<(Shown, f32, f32)> {
        directions.iter().map(|direction| truth(&world, from, *direction)).collect()
    };
    let truths = stage.world().run_system_once(ask).unwrap();
    let pixel = 2.0 * (0.5 * FOV).tan() / SIZE[1] as f32;
    let (mut of, mut wrong, mut edges) = ([0; 3], 0, 0);
    for (i, (shown, t, against)) in truths.iter().enumerate() {
        let [x, y] = [i % SIZE[0], i / SIZE[0]];
        let near = |x: usize, size: usize| x.saturating_sub(1)..=(x + 1).min(size - 1);
        let mut around = near(y, SIZE[1]).flat_map(|y| near(x, SIZE[0]).map(move |x| y * SIZE[0] + x));
        // Another thing beside it, or another hill.
        let apart = |j: usize| truths[j].0 != *shown || (truths[j].1 - t).abs() > 0.2 * t;
        if around.any(apart) {
            edges += 1;
            continue;
        }
        of[*shown as usize] += 1;
        wrong += usize::from(match seen[i] {
            Some(drawn) => *shown == Shown::Nothing || (drawn as f32 - t).abs() * against > pixel * t,
            None => *shown != Shown::Nothing,
        });
    }
    (of, wrong, edges)
}

#[test]
fn a_cellar_shows_through_its_hole() {
    let (mut stage, _) = stage();
    mesh(stage.world(), Cuboid::from_size(2.0 * HALF), Transform::from_xyz(0.0, FLOOR - HALF.y, 0.0));
    let above = Transform::from_xyz(0.0, 44.0, 10.0).looking_at(Vec3::new(0.0, 28.0, -1.0), Vec3::Y);
    stage.look(above);
    stage.settle();
    // Without a hole the ground covers the floor.
    let (covered, wrong, _) = compare_shown(&mut stage, &above);
    assert_eq!((covered[Shown::Floor as usize], wrong), (0, 0), "{covered:?}");
    let without = stage.depth();

    let hole = stage.world().spawn(hole()).id();
    stage.settle();
    let with = stage.depth();
    let (of, wrong, edges) = compare_shown(&mut stage, &above);
    let naive = with.iter().zip(&without).filter(|(with, without)| with < without).count();
    println!(
        "from above {of:?} pixels of nothing, ground, floor; {wrong} wrong, {edges} at edges; {naive} were covered"
    );
    assert!(of[Shown::Floor as usize] > 300 && wrong == 0 && naive >= of[Shown::Floor as usize]);
    assert!(edges < SIZE[0] * SIZE[1] / 8);

    // From the cellar: nothing of the ground overhead; out through the hole, and under it to hills that stand higher.
    let inside = Vec3::new(1.0, 27.5, -1.0);
    for direction in [Vec3::new(0.02, 1.0, 0.1), Vec3::new(0.3, 0.25, -1.0), Vec3::new(-1.0, -0.3, 0.4)] {
        let below = Transform::from_translation(inside).looking_to(direction, Vec3::Z);
        stage.look(below);
        stage.settle();
        let (of, wrong, edges) = compare_shown(&mut stage, &below);
        println!("from below, towards {direction}: {of:?}; {wrong} wrong, {edges} at edges");
        // Rays that come out under a hill graze its far side.
        assert!(wrong <= SIZE[0] * SIZE[1] / 200, "{wrong}");
        assert!(of.iter().sum::<usize>() > SIZE[0] * SIZE[1] / 2);
    }
    let up = Transform::from_translation(inside).looking_to(Vec3::Y, Vec3::Z);
    stage.look(up);
    stage.settle();
    assert!(stage.depth().iter().all(|depth| *depth == 0.0), "the sky shows through the hole");
    // It is filled in, and who stands in the ground sees ground.
    stage.world().despawn(hole);
    stage.settle();
    assert!(stage.depth().iter().all(|depth| *depth > 0.0));
}

#[test]
fn the_sun_shines_through_a_hole() {
    const SIDE: u32 = 160;
    const METRES: f32 = 8.0;
    let mut stage = Stage::new(SIDE, SIDE);
    let world = stage.world();
    world.spawn(Terrain::new(Field::Constant(0.0)));
    world.insert_resource(GlobalAmbientLight { brightness: 500.0, ..default() });
    let cascades = CascadeShadowConfigBuilder { num_cascades: 1, maximum_distance: 24.0, ..default() }.build();
    let light = DirectionalLight { illuminance: 60_000.0, shadow_maps_enabled: true, ..default() };
    // From −x, at 45°: what comes in at x = −2 to 2 reaches the floor, 3 m down, at 1 to 5.
    world.spawn((light, cascades, Transform::default().looking_to(Vec3::new(1.0, -1.0, 0.0), Vec3::Y)));
    world.spawn(Stamp::new(Shape::Rectangle(Rectangle { size: [4.0, 4.0], corner: 0.0 }), Mode::Hole));
    mesh(world, Plane3d::default().mesh().size(20.0, 20.0), Transform::from_xyz(0.0, -3.0, 0.0));
    let camera = stage.camera;
    let scaling_mode = ScalingMode::FixedVertical { viewport_height: METRES };
    let lens = OrthographicProjection { scaling_mode, near: 0.1, ..OrthographicProjection::default_3d() };
    stage.world().entity_mut(camera).insert(Projection::Orthographic(lens));
    // Under the ground, straight down; x to the right.
    stage.look(Transform::from_xyz(3.0, -0.5, 0.0).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
    stage.settle();
    let picture = stage.colour();
    let first = (SIDE / 2 * SIDE) as usize;
    let row: Vec<f32> = picture[first..first + SIDE as usize].iter().map(|pixel| pixel[1]).collect();
    let (dark, light) = row.iter().fold((f32::MAX, 0.0f32), |(low, high), x| (low.min(*x), high.max(*x)));
    let at = |i: usize| 3.0 + (i as f32 + 0.5 - 0.5 * SIDE as f32) * METRES / SIDE as f32;
    let lit: Vec<f32> = (0..row.len()).filter(|i| row[*i] > 0.5 * (dark + light)).map(at).collect();
    let ends = [lit[0], lit[lit.len() - 1]];
    println!("the floor has {light} in the light and {dark} in the dark, and is lit from {} to {} m", ends[0], ends[1]);
    assert!(light > 3.0 * dark && (ends[0] - 1.0).abs() < 0.3 && (ends[1] - 5.0).abs() < 0.3);
}

#[test]
fn all_who_ask_know_it() {
    let mut app = server();
    app.insert_resource(WorldOrigin::from_metres([1e9, 0.0, -1e9]));
    app.world_mut().spawn(Terrain::new(hills()));
    app.update();
    build(app.world_mut());
    app.update();
    let hole = app.world_mut().spawn(hole()).id();
    app.update();
    let changes = app.world().resource::<Messages<GroundChanged>>();
    let last = changes.iter_current_update_messages().last().expect("the ground has changed");
    // 8 by 6 m, turned: its own outline, without a falloff.
    assert!(last.areas.len() == 1 && last.areas[0].size.iter().all(|size| *size < 11.0), "{last:?}");
    let ask = |world: HorizonQuery| {
        let (inside, beside) = (Vec3::new(1.0, 0.0, -1.0), Vec3::new(7.0, 0.0, 3.0));
        let ground = world.ground(None).unwrap();
        assert!(ground.has_holes() && ground.is_hole(inside) && !ground.is_hole(beside));
        assert_eq!((world.height(inside), world.normal(inside), world.slope(inside)), (None, None, None));
        assert!((world.height(beside).unwrap() - LEVEL).abs() < 1e-5);
        // What would be there.
        assert!(world.heights(&[inside, beside]).iter().all(|height| (height - LEVEL).abs() < 1e-5));
        assert_eq!([inside, beside].map(|at| ground.clearing(at)), [1.0, 0.0]);
        let down = |at: Vec3| world.ray_cast(at.with_y(50.0), Dir3::NEG_Y, 1e3);
        assert!(down(inside).is_none() && (down(beside).unwrap().distance - 20.0).abs() < 1e-3);
        assert!(world.ray_cast(inside.with_y(20.0), Dir3::Y, 1e3).is_none());
    };
    app.world_mut().run_system_once(ask).unwrap();
    app.world_mut().despawn(hole);
    app.update();
    assert!((height(&mut app, Vec3::new(1.0, 0.0, -1.0)) - LEVEL).abs() < 1e-5);
}

#[test]
fn world_files_hold_holes() {
    let text = WORLD.replace("mode: Lower(2.0)", "shape: Disc(radius: 2.0), mode: Hole");
    let file = WorldFile::from_ron(&text).unwrap();
    assert_eq!(file.stamps[1].edit.mode, Mode::Hole);
    assert!(WorldFile::from_ron(&file.to_ron().unwrap()).unwrap() == file);
    let stamps = Stamps::compile(&file.stamps).unwrap();
    assert!(stamps.has_holes() && stamps.at(&Place::ORIGIN).is_hole([0.0, -51.0], 0.0));
}
