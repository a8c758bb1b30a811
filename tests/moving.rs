//! A camera on the move: what is filled, how evenly, and that no frame has a hole.

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy_horizon::prelude::*;
use bevy_horizon::render::cache::Caches;
use bevy_horizon::render::ready::Progress;
use bevy_horizon_workspace::stage::Stage;
use bevy_horizon_workspace::views::{Seen, View, four};

fn stage_of(view: &View, size: [u32; 2]) -> Stage {
    let mut stage = Stage::new(size[0], size[1]);
    stage.world().spawn(Terrain::new(view.field.clone()));
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = view.far;
    stage
}

fn tiles(stage: &Stage) -> u64 {
    stage.off.app.sub_app(RenderApp).world().resource::<Caches>().tiles_filled()
}

#[test]
fn a_jump_is_whole_within_ten_frames_and_never_has_a_hole() {
    // Down onto the ground: every pixel has some, in every frame.
    let view = View { above: 300.0, forward: [0.0, -1.0, 0.02], ..four()[1].clone() };
    let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
    let mut stage = stage_of(&view, [160, 90]);
    stage.look(seen.pose(0.0));
    stage.settle();
    let camera = stage.camera;
    for jump in [100_000.0, 250_000.0] {
        stage.look(seen.pose(jump));
        let mut whole = None;
        for frame in 1..=14 {
            let depth = stage.depth();
            assert!(depth.iter().all(|depth| *depth > 0.0), "a hole in frame {frame}");
            let progress = stage.off.app.world().resource::<Progress>().get();
            // The light, which comes last, is one more than the tiles.
            if progress.done + 1 >= progress.total && whole.is_none() {
                whole = Some(frame);
            }
        }
        println!("whole after {whole:?} frames");
        assert!(whole.is_some_and(|frame| frame <= 10), "{whole:?}");
    }
    assert!(stage.world().get::<Transform>(camera).unwrap().is_finite());
}

#[test]
fn a_fast_camera_fills_evenly() {
    let view = View { above: 50.0, ..four()[1].clone() };
    let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
    let mut stage = stage_of(&view, [320, 180]);
    stage.look(seen.pose(0.0));
    stage.settle();
    let mut counts = Vec::new();
    for frame in 1..=120 {
        let before = tiles(&stage);
        // 100 m/s at 60 frames a second.
        stage.look(seen.pose(f64::from(frame) * 100.0 / 60.0));
        stage.off.update();
        counts.push(tiles(&stage) - before);
    }
    let mean = counts.iter().sum::<u64>() as f64 / counts.len() as f64;
    let most = *counts.iter().max().unwrap();
    println!("{mean:.1} tiles a frame, at most {most}");
    // A tile is 64 × 64 texels; the picture has 57 600 pixels.
    assert!(mean > 0.1 && mean < 30.0, "{mean}");
    assert!(most <= 48, "{most}");
}
