//! The drawn ground against the certified truth.

use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};
use bevy_horizon_workspace::views::{Seen, View, canyon, distances, four, mountains, truth_camera};
use horizon_field::march::Anchored;
use horizon_field::metrics::Report;

const SIZE: [usize; 2] = [321, 181];

/// The four views, straight down, and between pillars along the lattice's diagonal.
fn views() -> Vec<View> {
    let mut views = four().to_vec();
    views.push(View {
        name: "down",
        field: mountains(13.0),
        at: [0.0, 0.0],
        above: 400.0,
        forward: [0.0, -1.0, 0.0],
        far: 30_000.0,
    });
    views.push(View {
        name: "diagonal",
        field: canyon(),
        at: [64.0, 64.0],
        above: 30.0,
        forward: [1.0, 0.0, 1.0],
        far: 4_000.0,
    });
    views
}

/// The report of a view with Bevy's origin at `origin` (metres along x and z from the world's).
fn report(view: &View, origin: f64) -> Report {
    let place = Place::from_metres([origin, 0.0, -origin]);
    let seen = Seen::new(view.clone(), place).expect("the field is good");
    let mut stage = Stage::new(SIZE[0] as u32, SIZE[1] as u32);
    stage.world().insert_resource(WorldOrigin(place));
    stage.world().spawn(Terrain::new(view.field.clone()));
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = view.far;
    let pose = seen.pose(0.0);
    stage.look(pose);
    stage.settle();
    let depth = stage.depth();

    let truth_camera = truth_camera(&pose, FOV, SIZE);
    let surface = Anchored::new(&seen.ground, &place);
    let truth = surface.picture(truth_camera, f64::from(view.far), 2);
    let report = Report::new(&surface, &truth, &distances(&depth, &truth_camera, NEAR));
    println!("{} at {origin:e} m\n{report}", view.name);
    report
}

fn assert_true(view: &View, report: &Report) {
    let name = view.name;
    assert_eq!(report.missed, 0, "{name}: missed pixels");
    assert_eq!(report.false_hits, 0, "{name}: false pixels");
    assert!(report.silhouette_share() < 0.15, "{name}: {} silhouettes", report.silhouette_share());
    assert!(report.surface.p99 < 1.0, "{name}: {} px from the surface", report.surface.p99);
    assert!(report.ide_pixels.mean < 0.5, "{name}: IDE of {} px", report.ide_pixels.mean);
}

#[test]
fn drawn_ground_is_the_true_ground() {
    for view in &views() {
        assert_true(view, &report(view, 0.0));
    }
}

#[test]
fn far_from_the_origin_it_is_as_true() {
    for origin in [1e6, 1e9] {
        for view in &views() {
            assert_true(view, &report(view, origin));
        }
    }
}
