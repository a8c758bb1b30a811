//! Pointers hit the ground where rays do, and meshes in front of it hide it from them.

use bevy::camera::visibility::RenderLayers;
use bevy::ecs::system::RunSystemOnce;
use bevy::picking::backend::ray::RayMap;
use bevy::picking::backend::{HitData, PointerHits};
use bevy::picking::pointer::{
    Location, PointerAction, PointerButton, PointerId, PointerInput, PointerInteraction, PointerLocation,
};
use bevy::picking::{Pickable, PickingSystems};
use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::truth_camera;
use horizon_field::field::Fractal;
use horizon_field::truth::TruthCamera;

const SIZE: [u32; 2] = [160, 90];
/// Every so many pixels, across and down, there is a pointer.
const APART: u32 = 10;

fn pose() -> Transform {
    Transform::from_xyz(0.0, 260.0, 0.0).looking_to(Vec3::new(0.1, -0.2, -1.0), Vec3::Y)
}

fn camera() -> TruthCamera {
    truth_camera(&pose(), FOV, SIZE.map(|side| side as usize))
}

/// The pixels that pointers are over.
fn pixels() -> impl Iterator<Item = UVec2> {
    let [across, down] = SIZE.map(|side| side / APART);
    (0..across * down).map(move |i| UVec2::new(i % across, i / across) * APART + APART / 2)
}

fn ray(pixel: UVec2) -> Dir3 {
    let direction = camera().pixel_ray((pixel.y * SIZE[0] + pixel.x) as usize).direction();
    Dir3::new(Vec3::from_array(direction.map(|x| x as f32))).unwrap()
}

/// Hills under a camera, and its terrain; with pointers over many pixels, which got their hits.
fn stage() -> (Stage, Entity) {
    let mut stage = Stage::with_plugins((HorizonPlugins, HorizonPickingPlugin), SIZE[0], SIZE[1]);
    // Bevy asks for one even where cameras draw into images.
    stage.world().spawn((Window::default(), PrimaryWindow));
    let hills = Fractal { wavelength: 900.0, amplitude: 220.0, octaves: 9.0, ..default() };
    let terrain = stage.world().spawn(Terrain::new(Field::Fractal(hills))).id();
    stage.look(pose());
    for (i, pixel) in pixels().enumerate() {
        let location = location(&stage, pixel);
        stage.world().spawn((PointerId::Touch(i as u64), PointerLocation::new(location)));
    }
    (0..4).for_each(|_| stage.off.update());
    (stage, terrain)
}

fn location(stage: &Stage, pixel: UVec2) -> Location {
    let target = stage.off.target().normalize(None).expect("an image");
    Location { target, position: pixel.as_vec2() + 0.5 }
}

/// What the pointers are over: the nearest of each.
fn hits(stage: &mut Stage) -> Vec<Option<(Entity, HitData)>> {
    let mut hits = vec![None; pixels().count()];
    let mut pointers = stage.world().query::<(&PointerId, &PointerInteraction)>();
    for (pointer, interaction) in pointers.iter(stage.off.app.world()) {
        if let Some(index) = pointer.get_touch_id() {
            hits[index as usize] = interaction.get_nearest_hit().cloned();
        }
    }
    hits
}

#[test]
fn pointers_hit_the_ground_where_rays_do() {
    let (mut stage, terrain) = stage();
    let picked = hits(&mut stage);
    let ask = move |world: HorizonQuery| {
        let (camera, eye) = (camera(), pose().translation);
        let (mut over_ground, mut off, mut aside) = (0, 0.0f32, 0.0f32);
        for (pixel, picked) in pixels().zip(&picked) {
            let direction = ray(pixel);
            let truth = world.ray_cast(eye, direction, HorizonCamera::default().far);
            assert_eq!(truth.is_some(), picked.is_some(), "{pixel}: {truth:?} and {picked:?}");
            let (Some(truth), Some((entity, data))) = (truth, picked) else { continue };
            over_ground += 1;
            assert_eq!((*entity, truth.entity), (terrain, terrain));
            let at = data.position.unwrap();
            let footprint = camera.footprint(truth.distance.into()) as f32;
            // Across the ray, and along the ground, which stretches a pixel where it is seen at a low angle.
            let across = (at - eye).reject_from(*direction).length() / footprint;
            let stretched = footprint / truth.normal.dot(*direction).abs();
            (aside, off) = (aside.max(across), off.max(at.distance(truth.position) / stretched));
            let start = NEAR / direction.dot(*pose().forward());
            assert!((data.depth + start - truth.distance).abs() < stretched, "{pixel}: {data:?} and {truth:?}");
            let normal = data.normal.unwrap();
            assert!(normal.is_normalized() && normal.dot(world.normal(at).unwrap()) > 0.9999);
        }
        println!("{over_ground} pointers over the ground; {aside} pixels across the rays, {off} along the ground");
        assert!(over_ground > 70 && over_ground < pixels().count(), "ground and sky must show: {over_ground}");
        assert!(aside < 0.1 && off < 1.0);
    };
    stage.world().run_system_once(ask).unwrap();
}

/// A mesh, as a picking backend sees it: a sphere of this radius.
#[derive(Component)]
struct Ball(f32);

/// As Bevy's mesh backend does: depth is the distance along the pointer's ray.
fn hit_balls(rays: Res<RayMap>, balls: Query<(Entity, &Transform, &Ball)>, mut hits: MessageWriter<PointerHits>) {
    for (id, ray) in rays.iter() {
        for (entity, transform, ball) in &balls {
            let to = transform.translation - ray.origin;
            let (along, aside) = (to.dot(*ray.direction), to.reject_from(*ray.direction).length());
            if aside < ball.0 {
                let depth = along - (ball.0 * ball.0 - aside * aside).sqrt();
                let data = HitData::new(id.camera, depth, Some(ray.get_point(depth)), None);
                hits.write(PointerHits::new(id.pointer, vec![(entity, data)], 0.0));
            }
        }
    }
}

#[test]
fn the_nearer_of_mesh_and_ground_is_hit() {
    let (mut stage, terrain) = stage();
    stage.off.app.add_systems(PreUpdate, hit_balls.in_set(PickingSystems::Backend));
    let bare = hits(&mut stage);
    // By turns just before the ground and just behind it, each in its pointer's ray, and too small for any other.
    let mut balls = Vec::new();
    for (i, (hit, pixel)) in bare.iter().zip(pixels()).enumerate() {
        let Some((_, data)) = hit else { continue };
        let before = balls.len() % 2 == 0;
        let distance = data.depth * if before { 0.96 } else { 1.04 };
        let at = Transform::from_translation(pose().translation + ray(pixel) * (NEAR + distance));
        balls.push((i, before, stage.world().spawn((Ball(0.01 * distance), at)).id()));
    }
    stage.off.update();
    let both = hits(&mut stage);
    for (i, before, ball) in &balls {
        let hit = both[*i].as_ref().map(|(entity, _)| *entity);
        assert_eq!(hit, Some(if *before { *ball } else { terrain }), "pointer {i}");
    }
    assert!(balls.len() > 70);
    for (a, b) in bare.iter().zip(&both) {
        assert_eq!(a.is_some(), b.is_some(), "the sky stays empty");
    }
}

#[test]
fn only_ground_that_is_drawn_is_hit() {
    let hit_after = |change: fn(&mut World, Entity, Entity)| {
        let (mut stage, terrain) = stage();
        let camera = stage.camera;
        change(stage.world(), terrain, camera);
        (0..3).for_each(|_| stage.off.update());
        hits(&mut stage).iter().flatten().count()
    };
    let plain = hit_after(|_, _, _| {});
    assert!(plain > 70, "{plain}");
    let none: [(&str, fn(&mut World, Entity, Entity)); 5] = [
        ("hidden", |world, terrain, _| {
            world.entity_mut(terrain).insert(Visibility::Hidden);
        }),
        ("on another layer", |world, terrain, _| {
            world.entity_mut(terrain).insert(RenderLayers::layer(3));
        }),
        ("not pickable", |world, terrain, _| {
            world.entity_mut(terrain).insert(Pickable::IGNORE);
        }),
        ("not drawn", |world, _, camera| {
            world.entity_mut(camera).remove::<HorizonCamera>();
        }),
        ("beyond the far distance", |world, _, camera| {
            world.entity_mut(camera).insert(HorizonCamera { far: 1.0, ..default() });
        }),
    ];
    for (name, change) in none {
        assert_eq!(hit_after(change), 0, "{name}");
    }
    // With the terrain, hits move.
    let moved = hit_after(|world, terrain, camera| {
        let by = Vec3::new(512.0, 64.0, -256.0);
        world.entity_mut(terrain).insert(Transform::from_translation(by));
        world.get_mut::<Transform>(camera).unwrap().translation += by;
    });
    assert_eq!(moved, plain);
}

#[derive(Resource, Default)]
struct Clicked(Vec<Vec3>);

#[test]
fn a_click_reaches_the_terrains_observers() {
    let (mut stage, terrain) = stage();
    stage.world().init_resource::<Clicked>();
    stage.world().entity_mut(terrain).observe(|click: On<Pointer<Click>>, mut clicked: ResMut<Clicked>| {
        clicked.0.extend(click.hit.position);
    });
    let middle = UVec2::new(SIZE[0] / 2, SIZE[1] / 2);
    let location = location(&stage, middle);
    let pointer = PointerId::Touch(1000);
    stage.world().spawn(pointer);
    let press = [PointerAction::Press(PointerButton::Primary), PointerAction::Release(PointerButton::Primary)];
    for action in [PointerAction::Move { delta: Vec2::ZERO }].into_iter().chain(press) {
        stage.world().write_message(PointerInput::new(pointer, location.clone(), action));
        stage.off.update();
    }
    let clicked = stage.world().resource::<Clicked>().0.clone();
    let expected = stage
        .world()
        .run_system_once(move |world: HorizonQuery| world.ray_cast(pose().translation, ray(middle), 60_000.0))
        .unwrap()
        .unwrap();
    assert_eq!(clicked.len(), 1);
    assert!(clicked[0].distance(expected.position) < 0.01 * expected.distance);
}
