//! Motion vectors of the ground: that they tell where each pixel's ground was. That effects which follow them do not smear is a matter of
//! the test `lighting`, whose camera moves.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::mountains;

const SIZE: [u32; 2] = [160, 90];

fn stage() -> Stage {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    stage.light();
    stage.world().spawn(Terrain::new(mountains(13.0)));
    stage.look(pose(0));
    stage.settle();
    stage
}

/// A camera that flies on, turns, and rolls.
fn pose(frame: u32) -> Transform {
    let t = frame as f32;
    let at = Vec3::new(400.0 + 3.0 * t, 900.0 + 0.7 * t, 200.0 - 6.0 * t);
    Transform::from_translation(at).with_rotation(Quat::from_euler(
        EulerRot::YXZ,
        0.012 * t,
        -0.25 + 0.004 * t,
        0.006 * t,
    ))
}

/// The pixel that shows a point, given from the camera of that pose.
fn pixel_of(pose: &Transform, point: Vec3) -> Option<Vec2> {
    let p = pose.rotation.inverse() * (point - pose.translation);
    let scale = 1.0 / (FOV / 2.0).tan();
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let ndc = Vec2::new(p.x * scale / aspect, p.y * scale) / -p.z;
    (p.z < 0.0).then(|| (ndc * Vec2::new(0.5, -0.5) + 0.5) * Vec2::new(SIZE[0] as f32, SIZE[1] as f32))
}

#[test]
fn motion_vectors_tell_where_the_ground_was() {
    let mut stage = stage();
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Motion;
    (0..3).for_each(|_| stage.off.update());
    for frame in 1..4 {
        stage.look(pose(frame));
        let colours = stage.colour();
        // The same pose again, for its depth.
        let depth = stage.depth();
        let (now, before) = (pose(frame), pose(frame - 1));
        let (mut worst, mut largest, mut seen) = (0.0f32, 0.0f32, 0);
        for (i, depth) in depth.iter().enumerate() {
            if *depth <= 0.0 {
                continue;
            }
            let pixel = Vec2::new((i as u32 % SIZE[0]) as f32, (i as u32 / SIZE[0]) as f32) + 0.5;
            let ndc = (pixel / Vec2::new(SIZE[0] as f32, SIZE[1] as f32) - 0.5) * Vec2::new(2.0, -2.0);
            let half = (FOV / 2.0).tan();
            let ahead = Vec3::new(ndc.x * half * SIZE[0] as f32 / SIZE[1] as f32, ndc.y * half, -1.0);
            let point = now.translation + now.rotation * ahead * (NEAR / depth);
            let Some(was) = pixel_of(&before, point) else { continue };
            let motion = pixel - was;
            let told = Vec2::new(colours[i][0] - 0.5, colours[i][1] - 0.5) * 64.0;
            worst = worst.max(told.distance(motion));
            largest = largest.max(motion.length());
            seen += 1;
        }
        println!("frame {frame}: off by at most {worst:.3} px of motions up to {largest:.1} px, over {seen} pixels");
        assert!(seen > 5000 && largest > 2.0, "{seen} pixels, {largest} px");
        assert!(worst < 0.1, "frame {frame}: off by {worst} px");
        // Back, so that the next step has this pose before it.
        stage.look(pose(frame));
        stage.off.update();
    }
}
