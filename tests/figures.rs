//! The README's figures and charts are those of the committed summary, and the summary's counts those of this code.

use std::path::Path;

use bevy_horizon::prelude::Place;
use bevy_horizon_workspace::stage::FOV;
use bevy_horizon_workspace::views::{Seen, four, truth_camera};
use horizon_charts::{run, summary};
use horizon_field::methods::{HeightField, Method, picture};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_readme_quotes_the_summary() {
    run::check_readme(root()).unwrap_or_else(|error| panic!("{error}"));
}

/// What no clock has a say in: work and error of the CPU's marches, computed again.
#[test]
fn the_summary_is_of_this_code() {
    let summary = summary::read(&root().join(run::PUBLISHED)).expect("there is a published summary");
    let rows = summary["march_cpu"].as_array().expect("rows of the CPU's marches");
    for view in four() {
        let method = Method::FixedStep { a: 10.0, b: 0.01, c: 0.5, k: 6 };
        let row = rows.iter().find(|row| row["view"] == view.name && row["settings"] == "a=10 b=0.01 c=0.5 k=6");
        let published = row.expect("a row of each view")["evals_per_ray"].as_f64().expect("a number");
        let seen = Seen::new(view, Place::ORIGIN).unwrap();
        let camera = truth_camera(&seen.pose(0.0), FOV, [160, 90]);
        let ground = HeightField::new(&seen.ground, &seen.place);
        let (depth, work) = picture(&method, &ground, &camera, f64::from(seen.view.far), 2);
        let counted = work.evaluations as f64 / depth.len() as f64;
        assert!((counted - published).abs() < 1e-3 * published, "{}: {counted}, not {published}", seen.view.name);
    }
}

#[test]
fn the_summary_keeps_what_it_promises() {
    let summary = summary::read(&root().join(run::PUBLISHED)).expect("there is a published summary");
    let rows = summary["march"].as_array().expect("rows of the march");
    for key in [
        "view",
        "method",
        "settings",
        "ms",
        "fill_ms",
        "evals_per_ray",
        "loads_per_ray",
        "missed",
        "false",
        "silhouette_share",
        "ide_px_mean",
        "normal_px_p99",
        "hde_px_mean",
    ] {
        assert!(rows.iter().all(|row| !row[key].is_null()), "{key}");
    }
    for view in four() {
        let ours = rows.iter().find(|row| row["view"] == view.name && row["method"] == "cached");
        let ours = ours.expect("ours in each view");
        assert_eq!((ours["missed"].as_u64(), ours["false"].as_u64()), (Some(0), Some(0)), "{}", view.name);
        assert!(summary["march_speedup_at_equal_error"][view.name].is_number(), "{}", view.name);
    }
}
