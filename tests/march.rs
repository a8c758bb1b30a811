//! The drawn ground against the certified truth.

use bevy::math::DVec3;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::{Fractal, NoImages};
use horizon_field::fractal::Rule;
use horizon_field::march::Anchored;
use horizon_field::metrics::Report;
use horizon_field::truth::{Projection as TruthProjection, TruthCamera, TruthPicture};

use crate::stage::{FOV, NEAR, Stage};

const SIZE: [usize; 2] = [321, 181];

/// Alpine ground of 13 octaves: waves from 6 km down to 1.5 m.
fn mountains() -> Field {
    Field::Fractal(Fractal { wavelength: 6000.0, amplitude: 1500.0, octaves: 13.0, gain: 0.47, seed: 5, ..default() })
}

/// A canyon with pillars some 20 m wide, cut off at the top: thinner than a usual fixed step (5 m + 0.4 % of the distance)
/// beyond 4 km, and than three pixels.
fn canyon() -> Field {
    Field::Add(vec![
        Field::Fractal(Fractal {
            rule: Rule::Fbm,
            wavelength: 900.0,
            amplitude: 260.0,
            octaves: 10.0,
            gain: 0.42,
            seed: 9,
            ..default()
        }),
        Field::Clamp(horizon_field::field::Clamp {
            field: Field::Fractal(Fractal { wavelength: 60.0, amplitude: 330.0, octaves: 1.0, seed: 3, ..default() })
                .into(),
            low: 105.0,
            high: 160.0,
        }),
    ])
}

struct View {
    name: &'static str,
    field: fn() -> Field,
    at: [f64; 2],
    above: f64,
    /// Forward, before it is normalised.
    forward: [f32; 3],
    far: f32,
}

const VIEWS: [View; 6] = [
    // Level, and along the lattice: the middle column's rays have x = 0, the middle row's y = 0.
    View { name: "valley", field: mountains, at: [120.0, 40.0], above: 1.7, forward: [0.0, 0.0, -1.0], far: 30_000.0 },
    View {
        name: "ridge",
        field: mountains,
        at: [900.5, -340.25],
        above: 60.0,
        forward: [1.0, -0.05, 0.0],
        far: 30_000.0,
    },
    View { name: "aerial", field: mountains, at: [0.0, 0.0], above: 1500.0, forward: [0.6, -0.5, -0.7], far: 30_000.0 },
    View { name: "down", field: mountains, at: [0.0, 0.0], above: 400.0, forward: [0.0, -1.0, 0.0], far: 30_000.0 },
    View { name: "canyon", field: canyon, at: [10.0, 25.0], above: 12.0, forward: [0.3, -0.02, -1.0], far: 4_000.0 },
    View { name: "diagonal", field: canyon, at: [64.0, 64.0], above: 30.0, forward: [1.0, 0.0, 1.0], far: 4_000.0 },
];

/// The report of a view with Bevy's origin at `origin` (metres along x and z from the world's).
fn report(view: &View, origin: f64) -> Report {
    let field = (view.field)();
    let compiled = field.compile::<2>(&NoImages).expect("the field is good");
    let place = Place::from_metres([origin, 0.0, -origin]);
    let eye_y = compiled.value_f64(&compiled.anchor(&place), view.at, 0.0) + view.above;
    let eye = Vec3::new(view.at[0] as f32, eye_y as f32, view.at[1] as f32);
    let forward = Vec3::from_array(view.forward).normalize();

    let mut stage = Stage::new(SIZE[0] as u32, SIZE[1] as u32);
    stage.world().insert_resource(WorldOrigin(place));
    stage.world().spawn(Terrain::new(field));
    let camera = stage.camera;
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().far = view.far;
    let up = if forward.y.abs() > 0.99 { Vec3::NEG_Z } else { Vec3::Y };
    let transform = Transform::from_translation(eye).looking_to(forward, up);
    stage.look(transform);
    stage.settle();
    let depth = stage.depth();

    let axis = |v: Vec3| v.as_dvec3().normalize().to_array();
    let truth_camera = TruthCamera {
        position: eye.as_dvec3().to_array(),
        right: axis(*transform.right()),
        up: axis(*transform.up()),
        forward: axis(*transform.forward()),
        projection: TruthProjection::Perspective { fov: f64::from(FOV) },
        width: SIZE[0],
        height: SIZE[1],
    };
    let surface = Anchored::new(&compiled, &place);
    let truth = TruthPicture::compute(&surface, truth_camera, f64::from(view.far), 2);
    let distances: Vec<Option<f64>> = depth
        .iter()
        .enumerate()
        .map(|(i, depth)| {
            let ray = truth_camera.pixel_ray(i);
            let cosine = DVec3::from_array(ray.direction()).dot(DVec3::from_array(truth_camera.forward));
            (*depth > 0.0).then(|| f64::from(NEAR) / f64::from(*depth) / cosine)
        })
        .collect();
    let report = Report::new(&surface, &truth, &distances);
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
    for view in &VIEWS {
        assert_true(view, &report(view, 0.0));
    }
}

#[test]
fn far_from_the_origin_it_is_as_true() {
    for origin in [1e6, 1e9] {
        for view in &VIEWS {
            assert_true(view, &report(view, origin));
        }
    }
}
