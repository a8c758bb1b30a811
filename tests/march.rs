//! The drawn ground against the certified truth.

use bevy_horizon::prelude::*;
use bevy_horizon_workspace::judge::{Judge, by_lot};
use bevy_horizon_workspace::views::{View, canyon, four, mountains};
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
fn report(judge: &mut Judge, view: &View, origin: f64) -> Report {
    let report = judge.report(view, Place::from_metres([origin, 0.0, -origin])).expect("the field is good");
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
    let mut judge = Judge::new(SIZE);
    for view in &views() {
        assert_true(view, &report(&mut judge, view, 0.0));
    }
}

#[test]
fn far_from_the_origin_it_is_as_true() {
    let mut judge = Judge::new(SIZE);
    for origin in [1e6, 1e9] {
        for view in &views() {
            assert_true(view, &report(&mut judge, view, origin));
        }
    }
}

/// `cargo charts --only cameras --seeds N` tries others.
#[test]
fn no_pixel_is_missed_by_cameras_drawn_by_lot() {
    let mut judge = Judge::new([134, 76]);
    for seed in 0..20 {
        let view = by_lot(seed);
        let report = judge.report(&view, Place::ORIGIN).expect("the lot draws good fields");
        println!("seed {seed}: {report}");
        assert_eq!((report.missed, report.false_hits), (0, 0), "seed {seed}");
        assert!(report.ide_pixels.mean < 0.5, "seed {seed}: IDE of {} px", report.ide_pixels.mean);
    }
}
