//! The drawn surface is the one that `HorizonQuery` answers, to a centimetre: what floats by it floats.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::waves::{FbmWaves, Gerstner, Sines};

use super::{Eye, Stage, answers, settle, stage};

/// Metres that what floats may be off.
const CLOSE: f32 = 0.01;

/// Waves, how high the eye is over their level, and its field of view: a pixel is narrower than any texel of their tiles.
fn cases() -> [(&'static str, Waves, f32, f32); 6] {
    let gerstner = Gerstner { steepness: 0.9, ..default() };
    // One wave, as high as its bound over and over.
    let sine = Sines { count: 1, ..default() };
    [
        ("still", Waves::Still, 6.0, 0.1),
        ("one sine", Waves::Sines(sine), 6.0, 0.1),
        ("Gerstner", Waves::Gerstner(gerstner), 6.0, 0.1),
        ("fBm", Waves::Fbm(FbmWaves::default()), 6.0, 0.1),
        ("breeze", Waves::breeze(), 6.0, 0.1),
        ("gale", Waves::gale(), 40.0, 0.03),
    ]
}

#[test]
fn the_drawn_surface_is_the_one_that_is_answered() {
    const SIZE: [u32; 2] = [64, 64];
    for (name, waves, above, fov) in cases() {
        let (moves, fast) = (waves != Waves::Still, name == "gale");
        let mut stage = stage(SIZE, Water { waves, ..default() });
        settle(&mut stage);
        // How far it is off at most: ours, the level, and the waves of the last frame but one.
        let mut worst = [0.0f32; 3];
        let mut count = 0;
        for (origin, time) in
            [(Place::ORIGIN, 0.0), (Place::ORIGIN, 3.7), (Place::from_metres([1e7 + 0.3, 0.0, -3e6]), 1e6 + 0.37)]
        {
            stage.world().insert_resource(WorldOrigin(origin));
            stage.world().resource_mut::<WaterTime>().0 = time;
            for at in [Vec2::ZERO, Vec2::new(137.3, -52.1), Vec2::new(-4021.0, 3333.0)] {
                let eye = Eye::down(Vec3::new(at.x, above, at.y), fov, SIZE);
                eye.put(&mut stage);
                let depth = stage.depth();
                assert!(depth.iter().all(|depth| *depth > 0.0), "{name}: the sea has holes");
                let points: Vec<Vec3> = (0..eye.pixels()).map(|i| eye.point(i, depth[i])).collect();
                let now = answers(&mut stage, points.clone(), 0.0);
                let late = answers(&mut stage, points.clone(), -1.0 / 30.0);
                for ((point, now), late) in points.iter().zip(now).zip(late) {
                    let [now, late] = [now, late].map(|height| height.expect("the sea has no end"));
                    for (worst, height) in worst.iter_mut().zip([now, 0.0, late]) {
                        *worst = worst.max((point.y - height).abs());
                    }
                    count += 1;
                }
            }
        }
        println!(
            "{name}: {:.4} m off at {count} points; its level {:.3} m, two frames ago {:.3} m",
            worst[0], worst[1], worst[2]
        );
        assert!(worst[0] < CLOSE, "{name}: {} m", worst[0]);
        assert!(!moves || worst[1] > 5.0 * CLOSE, "{name} must be waves: {worst:?}");
        assert!(!fast || worst[2] > CLOSE, "{name} must have moved in two frames: {worst:?}");
    }
}

/// The lowest point of the surface within some hundred metres.
fn trough(stage: &mut Stage) -> Vec3 {
    let points: Vec<Vec3> =
        (0..200).flat_map(|i| (0..200).map(move |j| Vec3::new(i as f32 - 100.0, 0.0, j as f32 - 100.0))).collect();
    let heights = answers(stage, points.clone(), 0.0);
    let placed = points.into_iter().zip(heights).map(|(p, h)| p.with_y(h.expect("the sea has no end")));
    placed.min_by(|a, b| a.y.total_cmp(&b.y)).expect("there are points")
}

/// A small disc that lies level.
fn disc(stage: &mut Stage, radius: f32) -> Entity {
    let world = stage.world();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Circle::new(radius));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.9, 0.1, 0.1));
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::default())).id()
}

fn lay(stage: &mut Stage, disc: Entity, at: Vec3) {
    let level = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    stage.world().entity_mut(disc).insert(Transform::from_translation(at).with_rotation(level));
}

/// From above, in a place where the surface is far from its level.
#[test]
fn a_centimetre_over_the_answer_is_out_of_the_water_and_a_centimetre_under_it_is_in() {
    const SIZE: [u32; 2] = [64, 64];
    let mut stage = stage(SIZE, Water::default());
    stage.light();
    let disc = disc(&mut stage, 0.02);
    (0..4).for_each(|_| stage.off.update());
    let low = trough(&mut stage);
    assert!(low.y < -0.15, "a trough must be low: {low}");
    for by in [Vec2::ZERO, Vec2::new(0.7, 0.0), Vec2::new(-0.4, 1.1), Vec2::new(3.0, -2.0)] {
        let at = low + Vec3::new(by.x, 0.0, by.y);
        let height = answers(&mut stage, vec![at], 0.0)[0].expect("the sea has no end");
        let eye = Eye::down(Vec3::new(at.x, 6.0, at.z), 0.05, SIZE);
        eye.put(&mut stage);
        for over in [CLOSE, -CLOSE] {
            lay(&mut stage, disc, at.with_y(height + over));
            settle(&mut stage);
            let depth = stage.depth();
            let middle = eye.pixel(at.with_y(height));
            let drawn = eye.point(middle, depth[middle]).y;
            println!("{over} m over the answer {height:.3} m: what is drawn lies at {drawn:.4} m");
            let expected = height + over.max(0.0);
            assert!((drawn - expected).abs() < 0.6 * CLOSE, "{over} m over {height} m: {drawn} m");
        }
    }
}

/// At a slant, in a trough: the level itself, which is over it, must not be drawn there.
#[test]
fn what_floats_in_a_trough_shows() {
    const SIZE: [u32; 2] = [320, 180];
    for waves in [Waves::breeze(), Waves::Gerstner(Gerstner::default())] {
        let mut stage = stage(SIZE, Water { waves, ..default() });
        stage.light();
        let all = [Vec2::ZERO, Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y].map(|by| 0.5 * by);
        let discs = all.map(|_| disc(&mut stage, 0.1));
        (0..4).for_each(|_| stage.off.update());
        let low = trough(&mut stage);
        let pose = Transform::from_translation(low + Vec3::new(0.0, 2.5, 6.0)).looking_at(low, Vec3::Y);
        let eye = Eye { pose, fov: 0.3, size: SIZE };
        eye.put(&mut stage);
        let places: Vec<Vec3> = all.map(|by| low + Vec3::new(by.x, 0.0, by.y)).to_vec();
        let heights = answers(&mut stage, places.clone(), 0.0);
        for over in [0.05, -0.05] {
            let mut placed = Vec::new();
            for ((disc, place), height) in discs.into_iter().zip(&places).zip(&heights) {
                let at = place.with_y(height.expect("the sea has no end") + over);
                lay(&mut stage, disc, at);
                placed.push(at);
            }
            settle(&mut stage);
            let depth = stage.depth();
            for at in placed {
                let i = eye.pixel(at);
                let drawn = eye.point(i, depth[i]);
                let water = answers(&mut stage, vec![drawn], 0.0)[0].expect("the sea has no end");
                println!(
                    "a disc {over} m over the water at {:.3} m: drawn at {:.3} m, the water there at {water:.3} m",
                    at.y, drawn.y
                );
                if over > 0.0 {
                    // The disc itself, to the width of a pixel.
                    assert!((drawn.y - at.y).abs() < 0.01 && drawn.y > water, "{at}: {drawn} is drawn");
                } else {
                    assert!((drawn.y - water).abs() < 2.0 * CLOSE, "{at}: {drawn} is drawn, the water is at {water}");
                }
            }
        }
    }
}
