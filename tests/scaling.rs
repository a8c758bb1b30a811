//! A lower resolution, brought to the view's: depth where ground is flat, edges where it is not.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::Stage;
use bevy_horizon_workspace::views::{Seen, four};

fn depth(stage: &mut Stage, render_scale: f32) -> Vec<f32> {
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().render_scale = render_scale;
    stage.off.update();
    stage.depth()
}

/// Nearest-neighbour scaling of a picture at half the size, which keeps no edge.
fn nearest(small: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    (0..width * height).map(|i| small[i / width / 2 * (width / 2) + i % width / 2]).collect()
}

#[test]
fn edges_are_kept_at_half_the_resolution() {
    const SIZE: [usize; 2] = [320, 180];
    for view in [four()[1].clone(), four()[3].clone()] {
        let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
        let show = |size: [usize; 2]| {
            let mut stage = Stage::new(size[0] as u32, size[1] as u32);
            stage.world().spawn(Terrain::new(view.field.clone()));
            let camera = stage.camera;
            stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = view.far;
            stage.look(seen.pose(0.0));
            stage.settle();
            stage
        };
        let mut stage = show(SIZE);
        let whole = depth(&mut stage, 1.0);
        let scaled = depth(&mut stage, 0.5);
        let naive = nearest(&depth(&mut show([160, 90]), 1.0), SIZE);
        // Off by over a twentieth of the distance: another hill.
        let wrong = |picture: &[f32]| {
            let off = |(a, b): (&f32, &f32)| (a - b).abs() > 0.05 * a.max(*b);
            picture.iter().zip(&whole).filter(|pair| off(*pair)).count()
        };
        let (ours, theirs) = (wrong(&scaled), wrong(&naive));
        println!("{}: {ours} of {} pixels at another depth, {theirs} by nearest neighbour", view.name, whole.len());
        assert!(theirs > 500, "{}: nearest neighbour must fail: {theirs}", view.name);
        assert!(ours * 5 < theirs, "{}: {ours} against {theirs}", view.name);
    }
}

#[test]
fn a_scale_out_of_range_is_brought_into_it() {
    let mut stage = Stage::new(64, 36);
    stage.world().spawn(Terrain::default());
    stage.look(Transform::from_xyz(0.0, 900.0, 0.0).looking_to(Vec3::new(0.0, -0.5, -1.0), Vec3::Y));
    stage.settle();
    let whole = depth(&mut stage, 1.0);
    assert_eq!(depth(&mut stage, f32::NAN), whole);
    assert_eq!(depth(&mut stage, 7.0), whole);
    let least = depth(&mut stage, 0.25);
    assert_eq!(depth(&mut stage, -1.0), least);
    assert_ne!(least, whole);
}

/// What of a picture is less than half as bright as another, or over twice.
fn share_that_differs(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| a[1].min(b[1]) < 0.5 * a[1].max(b[1]);
    a.iter().zip(b).filter(differs).count() as f64 / a.len() as f64
}

#[test]
fn all_ground_is_lit_at_any_resolution() {
    let view = four()[1].clone();
    let seen = Seen::new(view.clone(), Place::ORIGIN).unwrap();
    for deferred in [false, true] {
        let mut stage = Stage::new(320, 180);
        stage.light();
        stage.world().spawn(Terrain::new(view.field.clone()));
        let camera = stage.camera;
        if deferred {
            use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
            stage.world().entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
        }
        stage.look(seen.pose(0.0));
        stage.settle();
        let shown = |stage: &mut Stage, render_scale: f32, debug: DebugView| {
            let mut camera = stage.off.app.world_mut().get_mut::<HorizonCamera>(camera).unwrap();
            (camera.render_scale, camera.debug) = (render_scale, debug);
            stage.off.update();
            stage.colour()
        };
        for debug in [DebugView::None, DebugView::Normal] {
            let whole = shown(&mut stage, 1.0, debug);
            for scale in [0.75, 0.5, 0.25] {
                let differs = share_that_differs(&whole, &shown(&mut stage, scale, debug));
                println!("deferred {deferred}, {debug:?} at {scale}: {:.2} % differ", 100.0 * differs);
                assert!(differs < 0.01, "deferred {deferred}, {debug:?} at {scale}: {differs}");
            }
        }
    }
}
