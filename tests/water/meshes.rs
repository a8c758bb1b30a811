//! Meshes and water in one picture: a pole through the surface, a ball before it, a block deep in it; in every kind of view.

use bevy::camera::{Hdr, ScalingMode, Viewport};
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass, MotionVectorPrepass};
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy_horizon::prelude::*;

use super::{Stage, accepted, finite, settle, stage, still};

const SIZE: [u32; 2] = [192, 128];
/// The ball, before the water.
const BALL: Vec3 = Vec3::new(1.2, 1.6, 4.5);

/// Down on the pole, 29° below the level.
fn pose() -> Transform {
    Transform::from_xyz(0.0, 3.0, 8.0).looking_at(Vec3::new(0.0, -1.5, 0.0), Vec3::Y)
}

/// The same from further away, so that all of the near plane is over the water.
fn orthographic(stage: &mut Stage) {
    let pose = pose();
    stage.look(Transform { translation: pose.translation - 20.0 * pose.forward(), ..pose });
    let scaling_mode = ScalingMode::FixedVertical { viewport_height: 9.0 };
    let lens = OrthographicProjection { scaling_mode, ..OrthographicProjection::default_3d() };
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(Projection::Orthographic(lens));
}

fn mesh(stage: &mut Stage, mesh: impl Into<Mesh>, at: Vec3) -> Entity {
    let world = stage.world();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let white = StandardMaterial {
        base_color: LinearRgba::rgb(0.6, 0.6, 0.6).into(),
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..default()
    };
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(white);
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_translation(at))).id()
}

/// From 14 m under the water to 4 m over it, 60 cm wide; and the ball.
fn pole_and_ball(stage: &mut Stage) {
    mesh(stage, Cuboid::new(0.6, 18.0, 0.6), Vec3::new(0.0, -5.0, 0.0));
    mesh(stage, Sphere::new(0.3), BALL);
}

/// At a height of the pole's front.
fn on_pole(y: f32) -> Vec3 {
    Vec3::new(0.0, y, 0.3)
}

/// At every pixel the nearer of the two shows, to the bit where water is still.
fn assert_nearer(project: fn(&mut Stage), waves: Waves) {
    let depth = |water: bool, meshes: bool| {
        let mut stage = stage(SIZE, Water { waves: waves.clone(), ..still() });
        if !water {
            let it = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
            stage.world().entity_mut(it).despawn();
        }
        stage.light();
        if meshes {
            pole_and_ball(&mut stage);
        }
        stage.look(pose());
        project(&mut stage);
        settle(&mut stage);
        stage.depth()
    };
    let [both, water, meshes] = [(true, true), (true, false), (false, true)].map(|(w, m)| depth(w, m));
    let off = if waves == Waves::Still { 0.0 } else { 1e-3 };
    let (mut wrong, mut shown, mut hidden) = (0, [0; 2], 0);
    for ((both, water), meshes) in both.iter().zip(&water).zip(&meshes) {
        let nearer = water.max(*meshes);
        wrong += usize::from((both - nearer).abs() > off * nearer);
        shown[usize::from(meshes > water)] += 1;
        hidden += usize::from(*meshes > 0.0 && water > meshes);
    }
    println!(
        "{}: {wrong} are neither, {shown:?} of water and meshes, {hidden} pixels of meshes are under water",
        waves.name()
    );
    // Where a crest's edge is, the last step of the march depends on what stands behind.
    assert!(wrong * 1000 <= if waves == Waves::Still { 0 } else { both.len() }, "{}: {wrong} pixels", waves.name());
    assert!(shown[0] > 10_000 && shown[1] > 300 && hidden > 300, "{shown:?}, {hidden}");
}

#[test]
fn the_nearer_of_mesh_and_water_shows() {
    assert_nearer(|_| {}, Waves::Still);
    assert_nearer(|_| {}, Waves::breeze());
}

#[test]
fn the_nearer_shows_in_an_orthographic_view() {
    assert_nearer(orthographic, Waves::Still);
    assert_nearer(orthographic, Waves::breeze());
}

type Case = (&'static str, fn(&mut Stage));

const VIEWS: [Case; 7] = [
    ("as it is", |_| {}),
    ("four samples", |stage| {
        let camera = stage.camera;
        stage.world().entity_mut(camera).insert(Msaa::Sample4);
    }),
    ("deferred", |stage| {
        let camera = stage.camera;
        stage.world().insert_resource(DefaultOpaqueRendererMethod::deferred());
        stage.world().entity_mut(camera).insert((DepthPrepass, DeferredPrepass, MotionVectorPrepass));
    }),
    ("orthographic", orthographic),
    ("viewport", |stage| {
        let camera = stage.camera;
        let part = Viewport { physical_position: UVec2::new(40, 20), physical_size: UVec2::new(120, 90), ..default() };
        stage.world().get_mut::<Camera>(camera).expect("a camera").viewport = Some(part);
    }),
    ("LDR", |stage| {
        let camera = stage.camera;
        stage.world().entity_mut(camera).remove::<Hdr>();
    }),
    ("LDR, with four samples", |stage| {
        let camera = stage.camera;
        stage.world().entity_mut(camera).remove::<Hdr>().insert(Msaa::Sample4);
    }),
];

/// A picture: linear, or where the view is LDR what is shown, made linear.
fn picture(stage: &mut Stage) -> Vec<[f32; 4]> {
    let camera = stage.camera;
    if stage.world().get::<Hdr>(camera).is_some() {
        return stage.colour();
    }
    let shot = stage.off.screenshot();
    shot.pixels().map(|p| p.0.map(|c| (f32::from(c) / 255.0).powf(2.2))).collect()
}

/// What a picture has where a point would show, if nothing were before it.
fn seen(stage: &mut Stage, picture: &[[f32; 4]], at: Vec3) -> Vec3 {
    let camera = stage.camera;
    let world = stage.world();
    let (lens, place) = (world.get::<Camera>(camera).expect("a camera"), world.get::<GlobalTransform>(camera));
    let pixel = lens.world_to_viewport(place.expect("a place"), at).expect("it is in view");
    let [x, y] = pixel.to_array().map(|c| c as usize);
    Vec3::from_slice(&picture[y * SIZE[0] as usize + x])
}

#[test]
fn a_pole_is_bluer_and_darker_the_deeper_it_stands() {
    for (name, change) in VIEWS {
        let mut stage = stage(SIZE, still());
        let water = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
        stage.light();
        stage.world().insert_resource(ClearColor(Color::BLACK));
        stage.look(pose());
        change(&mut stage);
        pole_and_ball(&mut stage);
        let [dry, wet] = [Visibility::Hidden, Visibility::Visible].map(|visibility| {
            stage.world().entity_mut(water).insert(visibility);
            settle(&mut stage);
            picture(&mut stage)
        });
        accepted(&stage);
        assert!(finite(&wet), "{name}");
        // Over the water and before it nothing has changed.
        for at in [on_pole(1.0), on_pole(2.0), on_pole(2.6), BALL] {
            let [a, b] = [&dry, &wet].map(|picture| seen(&mut stage, picture, at));
            assert!((a - b).abs().max_element() < 1.0 / 255.0, "{name}: {at} was {a} and is {b}");
            assert!(a.y > 0.05, "{name}: {at} must be lit: {a}");
        }
        // Under it, deeper and deeper.
        let depths = [0.8, 2.0, 4.0];
        let before = depths.map(|under| seen(&mut stage, &dry, on_pole(-under)));
        let under = depths.map(|under| seen(&mut stage, &wet, on_pole(-under)));
        println!("{name}: {:.3} in air; {under:.3?}", before[0]);
        let reds = under.map(|c| c.x / c.z);
        // AgX takes colour from what is bright.
        let fall = if name.contains("LDR") { 0.98 } else { 0.9 };
        assert!(reds[0] < 0.95 * before[0].x / before[0].z, "{name}: {reds:?} of {}", before[0]);
        assert!(under[0].element_sum() < 0.9 * before[0].element_sum(), "{name}: {under:?} of {}", before[0]);
        for k in 1..3 {
            assert!(reds[k] < fall * reds[k - 1], "{name}: red over blue {reds:?}");
            assert!(under[k].element_sum() < under[k - 1].element_sum(), "{name}: {under:?}");
        }
        // And beside it there is water where nothing was.
        let beside = Vec3::new(3.0, 0.0, -2.0);
        let [a, b] = [&dry, &wet].map(|picture| seen(&mut stage, picture, beside));
        assert!((a - b).abs().max_element() > 1.0 / 255.0, "{name}: {a} and {b} beside it");
    }
}

/// Peat's water hides a block 4 m under its surface, and clear water shows it.
#[test]
fn murky_water_hides_what_stands_deep_in_it() {
    let apart = |optics: WaterOptics| {
        let mut stage = stage(SIZE, Water { optics, ..still() });
        stage.light();
        stage.look(pose());
        settle(&mut stage);
        let without = (stage.colour(), stage.depth());
        mesh(&mut stage, Cuboid::new(3.0, 1.0, 3.0), Vec3::new(0.0, -4.5, 0.0));
        (0..4).for_each(|_| stage.off.update());
        settle(&mut stage);
        assert!(without.1 == stage.depth(), "the surface is where it was");
        let pairs = without.0.iter().flatten().zip(stage.colour().into_iter().flatten()).map(|(a, b)| (a - b).abs());
        pairs.fold(0.0, f32::max)
    };
    let [clear, murky] = [WaterOptics::CLEAR_SEA, WaterOptics::SWAMP].map(apart);
    println!("the block changes clear water by {clear:.4}, murky water by {murky:.4}");
    assert!(clear > 0.03 && murky < 1.0 / 255.0, "{clear}, {murky}");
}
