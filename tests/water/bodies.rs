//! Bodies of water: where they end, how many there may be, and what a scene without them has.

use bevy::camera::{Exposure, Hdr, Viewport};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::math::Vec3Swizzles;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::PipelineCache;
use bevy_horizon::prelude::*;
use bevy_horizon::render::waves::{MOST_SEAS, SeaTiles};
use horizon_field::field::Fractal;
use horizon_field::waves::{CASCADES, Sines};

use super::{Eye, FOV, NEAR, Stage, accepted, answers, finite, settle, stage, still};

const SIZE: [u32; 2] = [160, 90];

fn disc(radius: f32) -> Water {
    Water { outline: WaterOutline::Disc(WaterDisc { radius }), ..still() }
}

fn rectangle(half: [f32; 2]) -> Water {
    Water { outline: WaterOutline::Rectangle(WaterRectangle { half }), ..still() }
}

#[test]
fn two_lakes_lie_at_their_levels_within_their_outlines() {
    let at = [Vec3::new(-25.0, 0.0, 4.0), Vec3::new(22.0, 5.0, -6.0)];
    let inside: [fn(Vec3) -> bool; 2] =
        [|away| away.xz().length() <= 14.0, |away| away.x.abs() <= 16.0 && away.z.abs() <= 7.0];
    let slant = Transform::from_xyz(10.0, 40.0, 60.0).looking_at(Vec3::new(0.0, 2.0, 0.0), Vec3::Y);
    for waves in [Waves::Still, Waves::lake()] {
        let moves = waves != Waves::Still;
        let mut stage = stage(SIZE, Water { waves: waves.clone(), ..disc(14.0) });
        let round = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
        stage.world().entity_mut(round).insert(Transform::from_translation(at[0]));
        stage.world().spawn((Water { waves, ..rectangle([16.0, 7.0]) }, Transform::from_translation(at[1])));
        for eye in [Eye::down(Vec3::Y * 60.0, FOV, SIZE), Eye::new(slant, SIZE)] {
            eye.put(&mut stage);
            settle(&mut stage);
            let depth = stage.depth();
            // The higher one hides the lower one.
            let lake = |pixel: Vec2| {
                [1, 0]
                    .into_iter()
                    .find(|i| eye.on_plane(pixel, at[*i].y).is_some_and(|point| inside[*i](point - at[*i])))
            };
            for (i, middle) in at.iter().enumerate() {
                // A lake's waves are some centimetres high; a pixel is half a metre wide.
                let drawn = |k: usize| depth[k] > 0.0 && (eye.point(k, depth[k]).y - middle.y).abs() < 0.5;
                let wrong = eye.misplaced(drawn, |pixel| lake(pixel) == Some(i));
                let count = (0..eye.pixels()).filter(|k| drawn(*k)).count();
                println!("lake {i}, waves {moves}: {count} pixels, {wrong} more than a pixel off");
                assert!(count > 150 && wrong == 0, "lake {i}, waves {moves}: {count} pixels, {wrong} are wrong");
                let level =
                    (0..eye.pixels()).filter(|k| drawn(*k)).map(|k| (eye.point(k, depth[k]).y - middle.y).abs());
                let off = level.fold(0.0, f32::max);
                assert!(moves || off < 1e-3, "lake {i} is {off} m off its level");
            }
            let neither = |k: usize| depth[k] <= 0.0;
            assert_eq!(eye.misplaced(neither, |pixel| lake(pixel).is_none()), 0);
            assert!(finite(&stage.colour()));
        }
        let outside = Vec3::new(-5.0, 0.0, 0.0);
        let heights = answers(&mut stage, vec![at[0], at[1], outside], 0.0);
        assert!(heights[0].is_some_and(|h| h.abs() < 0.5) && heights[1].is_some_and(|h| (h - 5.0).abs() < 0.5));
        assert_eq!(heights[2], None);
    }
}

#[test]
fn a_masked_lake_is_where_its_field_is_above_nothing() {
    let field: Field = Fractal { wavelength: 30.0, amplitude: 1.0, octaves: 2.0, seed: 3, ..default() }.into();
    let mask = WaterMask { half: [20.0; 2], field, ..default() };
    let mut stage = stage(SIZE, Water { outline: WaterOutline::Mask(mask), ..disc(1.0) });
    let eye = Eye::down(Vec3::Y * 60.0, FOV, SIZE);
    eye.put(&mut stage);
    settle(&mut stage);
    let depth = stage.depth();
    let places: Vec<Vec3> = (0..eye.pixels()).filter_map(|k| eye.on_plane(eye.centre(k), 0.0)).collect();
    assert_eq!(places.len(), eye.pixels());
    let answers = answers(&mut stage, places, 0.0);
    let wrong = (0..eye.pixels()).filter(|k| (depth[*k] > 0.0) != answers[*k].is_some()).count();
    let count = answers.iter().flatten().count();
    println!("{count} of {} pixels are water, {wrong} are not as answered", eye.pixels());
    assert!(count > 300 && count < eye.pixels() * 9 / 10, "{count}");
    // On the very outline single precision decides.
    assert!(wrong < 5, "{wrong}");
    assert!(finite(&stage.colour()));
}

#[test]
fn the_nearest_eight_are_drawn() {
    let mut stage = stage(SIZE, disc(4.0));
    let at = |i: usize| Vec3::new(10.0 * i as f32, 0.0, 0.0);
    (1..12).for_each(|i| {
        stage.world().spawn((disc(4.0), Transform::from_translation(at(i))));
    });
    let eye = Eye::down(Vec3::Y * 150.0, FOV, SIZE);
    eye.put(&mut stage);
    settle(&mut stage);
    let depth = stage.depth();
    let drawn: Vec<bool> = (0..12).map(|i| depth[eye.pixel(at(i))] > 0.0).collect();
    assert_eq!(drawn, (0..12).map(|i| i < 8).collect::<Vec<_>>());
    assert!(finite(&stage.colour()));
}

/// Lakes beside each other, each with a sea of its own.
#[test]
fn more_seas_than_there_are_tiles_for_are_still() {
    let lake = |seed: u32| {
        let waves = Waves::Sines(Sines { wavelength: 2.0, amplitude: 0.3, seed, ..default() });
        Water { waves, ..rectangle([3.0, 3.0]) }
    };
    let at = |i: u32| Vec3::new(8.0 * (i % 3) as f32 - 8.0, 0.0, 8.0 * (i / 3) as f32 - 4.0);
    let mut stage = stage(SIZE, lake(0));
    let first = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
    stage.world().entity_mut(first).insert(Transform::from_translation(at(0)));
    (1..6).for_each(|i| {
        stage.world().spawn((lake(i), Transform::from_translation(at(i))));
    });
    let eye = Eye::down(Vec3::Y * 16.0, FOV, SIZE);
    eye.put(&mut stage);
    settle(&mut stage);
    let depth = stage.depth();
    let spread = |i: u32| {
        let near =
            |k: &usize| eye.on_plane(eye.centre(*k), 0.0).is_some_and(|p| (p - at(i)).abs().xz().max_element() < 2.0);
        let heights = || (0..eye.pixels()).filter(near).map(|k| eye.point(k, depth[k]).y);
        heights().fold(f32::MIN, f32::max) - heights().fold(f32::MAX, f32::min)
    };
    let spreads: Vec<f32> = (0..6).map(spread).collect();
    println!("{spreads:.3?} m");
    assert_eq!(spreads.iter().filter(|spread| **spread > 0.05).count(), MOST_SEAS);
    assert_eq!(spreads.iter().filter(|spread| **spread < 1e-4).count(), 6 - MOST_SEAS);
    let tiles = stage.off.app.sub_app(RenderApp).world().resource::<SeaTiles>();
    assert_eq!(tiles.textures[0].depth_or_array_layers() as usize, CASCADES * MOST_SEAS);
    assert!(finite(&stage.colour()));
}

/// Whether the device has tiles of waves, and how many pipelines of water.
fn of_water(stage: &Stage) -> (bool, usize) {
    let world = stage.off.app.sub_app(RenderApp).world();
    let labels = world.resource::<PipelineCache>().pipelines().map(|pipeline| format!("{:?}", pipeline.descriptor));
    let count = labels.filter(|label| label.contains("horizon_water") || label.contains("\"sea_")).count();
    (world.contains_resource::<SeaTiles>(), count)
}

#[test]
fn a_scene_without_water_pays_nothing_and_water_that_is_removed_is_gone() {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    stage.light();
    stage.world().spawn(Atmosphere::default());
    stage.look(Transform::from_xyz(0.0, 30.0, 0.0).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y));
    settle(&mut stage);
    assert_eq!(of_water(&stage), (false, 0));
    let (colour, depth) = (stage.colour(), stage.depth());

    let water = stage.world().spawn(Water::default()).id();
    settle(&mut stage);
    let (tiles, pipelines) = of_water(&stage);
    assert!(tiles && pipelines >= 6, "{pipelines} pipelines");
    assert!(stage.depth() != depth && stage.colour() != colour);
    assert!(answers(&mut stage, vec![Vec3::ZERO], 0.0)[0].is_some());

    stage.world().entity_mut(water).remove::<Water>();
    (0..3).for_each(|_| stage.off.update());
    assert!(!of_water(&stage).0, "its tiles are gone");
    assert!(stage.depth() == depth && stage.colour() == colour, "the picture is what it was");
    assert_eq!(answers(&mut stage, vec![Vec3::ZERO], 0.0), [None::<f32>]);
    stage.world().entity_mut(water).insert(still());
    settle(&mut stage);
    assert!(stage.depth() != depth);
}

/// One view twice, side by side, with all that has dynamic offsets.
#[test]
fn two_cameras_see_the_same_water() {
    let half = |x| Viewport { physical_position: UVec2::new(x, 0), physical_size: UVec2::new(80, 90), ..default() };
    let look = Transform::from_xyz(0.0, 3.0, 0.0).looking_to(Vec3::new(0.0, -0.2, -1.0), Vec3::Y);
    let mut stage = stage(SIZE, Water::default());
    stage.light();
    stage.world().spawn(Atmosphere::default());
    stage.look(look);
    let camera = stage.camera;
    stage.world().get_mut::<Camera>(camera).expect("a camera").viewport = Some(half(0));
    let target = stage.off.target();
    for order in [1, 2] {
        // The third is over the second: three offsets are more than the air's buffer is long.
        stage.world().spawn((
            Camera3d::default(),
            target.clone(),
            Camera { order, clear_color: ClearColorConfig::None, viewport: Some(half(80)), ..default() },
            Hdr,
            Msaa::Off,
            Exposure { ev100: 13.5 },
            Tonemapping::AgX,
            Projection::Perspective(PerspectiveProjection { fov: FOV, near: NEAR, ..default() }),
            HorizonCamera::default(),
            look,
        ));
    }
    settle(&mut stage);
    let picture = stage.off.screenshot();
    accepted(&stage);
    let apart = |(x, y): (u32, u32)| {
        let (a, b) = (picture.get_pixel(x, y).0, picture.get_pixel(x + 80, y).0);
        a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 2)
    };
    let all = (0..90).flat_map(|y| (0..80).map(move |x| (x, y)));
    let differing = all.filter(|at| apart(*at)).count();
    assert!(picture.get_pixel(40, 80)[2] > 10, "the sea must show");
    assert!(differing < 20, "{differing} pixels differ");
}
