//! Heat maps: what they count, and what errors they show.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::Stage;
use bevy_horizon_workspace::views::{Seen, four};

fn stage(size: [u32; 2]) -> Stage {
    let view = four()[1].clone();
    let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
    let mut stage = Stage::new(size[0], size[1]);
    stage.world().spawn(Terrain::new(view.field));
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = 3000.0;
    stage.look(seen.pose(0.0));
    stage.settle();
    stage
}

fn show(stage: &mut Stage, debug: DebugView) -> Vec<[f32; 4]> {
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = debug;
    stage.off.update();
    stage.colour()
}

#[test]
fn turns_and_loads_are_counted_alike_each_frame() {
    let mut stage = stage([160, 90]);
    let before = stage.depth();
    let first = show(&mut stage, DebugView::Work);
    assert_eq!(first, show(&mut stage, DebugView::Work));
    let mean = |channel: usize| first.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / first.len() as f64;
    println!("{:.2} turns and {:.2} loads a ray", mean(0), mean(1));
    // Without the table of clear distances a ray takes over 30 turns.
    assert!(mean(0) < 16.0 && mean(0) > 1.0, "{}", mean(0));
    assert!(mean(1) < 40.0 && mean(1) > mean(0), "{}", mean(1));
    // Looking does not change what is looked at.
    show(&mut stage, DebugView::None);
    assert_eq!(stage.depth(), before);
}

#[test]
fn errors_show_once_the_camera_stands_still() {
    let mut stage = stage([64, 36]);
    let unknown =
        |picture: &[[f32; 4]]| picture.iter().filter(|p| p[..3].iter().all(|c| (c - 0.2).abs() < 1e-3)).count();
    let all = 64 * 36;
    assert_eq!(unknown(&show(&mut stage, DebugView::Error)), all, "nothing is known at first");
    let mut left = all;
    for _ in 0..600 {
        std::thread::sleep(std::time::Duration::from_millis(20));
        stage.off.update();
        left = unknown(&stage.colour());
        if left == 0 {
            break;
        }
    }
    assert_eq!(left, 0, "the truth must become known");
    let picture = stage.colour();
    let magenta = picture.iter().filter(|p| p[0] > 0.9 && p[1] < 0.1 && p[2] > 0.9).count();
    let red = picture.iter().filter(|p| p[0] > 0.9 && p[2] < 0.1).count();
    println!("{magenta} pixels wrong, {red} a pixel off");
    assert!(magenta + red < all / 25, "{magenta} and {red}");
    // A camera that moves on has no truth.
    let camera = stage.camera;
    stage.world().get_mut::<Transform>(camera).unwrap().translation.y += 5.0;
    stage.off.update();
    assert_eq!(unknown(&stage.colour()), all, "the truth was of another place");
}
