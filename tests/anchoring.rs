//! No absolute coordinate reaches single precision: pictures far from the origin, origins that shift, cameras that creep.

use bevy::math::DVec3;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::{Fractal, NoImages};

use bevy_horizon_workspace::stage::{FOV, NEAR, Stage};

const SIZE: [u32; 2] = [160, 90];

fn meadow() -> Field {
    Field::Fractal(Fractal { wavelength: 500.0, amplitude: 60.0, octaves: 12.0, seed: 21, ..default() })
}

fn stage(origin: Place, transform: Transform) -> Stage {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    stage.light();
    stage.world().insert_resource(WorldOrigin(origin));
    stage.world().spawn((Terrain::new(meadow()), Atmosphere::default()));
    stage.look(transform);
    stage.settle();
    stage
}

fn height(at: &Place) -> f64 {
    let compiled = meadow().compile::<2>(&NoImages).unwrap();
    compiled.value_f64(&compiled.anchor(at), [0.0; 2], 0.0)
}

#[test]
fn a_shifted_origin_changes_no_pixel() {
    let far = Place::from_metres([1e9, 0.0, -1e9]);
    let eye = Vec3::new(20.5, height(&far.translated([20.5, 0.0, 7.25])) as f32 + 3.0, 7.25);
    let look = |eye: Vec3| Transform::from_translation(eye).looking_to(Vec3::new(0.4, -0.15, -1.0), Vec3::Y);
    let here = stage(far, look(eye)).off.screenshot();
    // By whole cells and by odd metres: exact in f32, so that the camera stands at the very same place.
    let by = DVec3::new(4096.0 * 3.0 + 96.5, 0.0, -1000.25);
    let there = stage(far.translated((-by).to_array()), look(eye + by.as_vec3())).off.screenshot();
    assert!(here == there);
}

/// The height of each pixel's point over the true ground, in metres, with the point.
fn residuals(stage: &mut Stage, origin: &Place, eye: Vec3, forward: Vec3) -> Vec<Option<(DVec3, f64)>> {
    let compiled = meadow().compile::<2>(&NoImages).unwrap();
    let anchors = compiled.anchor(origin);
    let transform = Transform::default().looking_to(forward, Vec3::Y);
    let depth = stage.depth();
    let tan = (f64::from(FOV) / 2.0).tan();
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    depth
        .iter()
        .enumerate()
        .map(|(i, depth)| {
            let x = ((i as u32 % SIZE[0]) as f64 + 0.5) / f64::from(SIZE[0]) * 2.0 - 1.0;
            let y = 1.0 - ((i as u32 / SIZE[0]) as f64 + 0.5) / f64::from(SIZE[1]) * 2.0;
            let local = DVec3::new(x * tan * aspect, y * tan, -1.0);
            let point = eye.as_dvec3() + transform.rotation.as_dquat() * local * (f64::from(NEAR) / f64::from(*depth));
            let ground = compiled.value_f64(&anchors, [point.x, point.z], 0.0);
            (*depth > 0.0).then_some((point, point.y - ground))
        })
        .collect()
}

#[test]
fn a_creeping_camera_sees_features_where_they_are() {
    // What a camera sees from two places a millimetre apart must be one surface: the two pictures' points, each held
    // against the true ground, must be off by the same, up to a twentieth of a pixel.
    for origin in [Place::ORIGIN, Place::from_metres([1e6, 0.0, 1e6]), Place::from_metres([1e9, 0.0, -1e9])] {
        let forward = Vec3::new(0.3, -0.35, -1.0).normalize();
        let eye = Vec3::new(1.25, height(&origin.translated([1.25, 0.0, 2.5])) as f32 + 1.7, 2.5);
        let mut stage = stage(origin, Transform::from_translation(eye).looking_to(forward, Vec3::Y));
        let before = residuals(&mut stage, &origin, eye, forward);
        let step = Vec3::new(0.001, 0.0, 0.0);
        stage.look(Transform::from_translation(eye + step).looking_to(forward, Vec3::Y));
        let after = residuals(&mut stage, &origin, eye + step, forward);
        let pixel = 2.0 * (f64::from(FOV) / 2.0).tan() / f64::from(SIZE[1]);
        let mut shifts: Vec<f64> = before
            .iter()
            .zip(&after)
            .filter_map(|(before, after)| {
                let ((a, off_a), (b, off_b)) = ((*before)?, (*after)?);
                let distance = (a - eye.as_dvec3()).length();
                // Neighbouring points of one patch: their residuals differ by the patch's bow over a millimetre.
                ((a - b).length() < 0.2 * pixel * distance).then(|| (off_a - off_b).abs() / (distance * pixel))
            })
            .collect();
        shifts.sort_by(f64::total_cmp);
        let (p99, max) = (shifts[shifts.len() * 99 / 100], shifts[shifts.len() - 1]);
        println!("{} pixels, shift beyond the predicted: p99 {p99:.4} px, most {max:.4} px", shifts.len());
        assert!(shifts.len() > 4000);
        assert!(max < 0.05, "features shifted by {max} px beyond the prediction");
    }
}

#[test]
fn unanchored_single_precision_fails_where_ours_holds() {
    for (metres, naive_must_exceed) in [(1e6, 0.01), (1e9, 1.0)] {
        let compiled = meadow().compile::<2>(&NoImages).unwrap();
        let place = Place::from_metres([metres, 0.0, metres]);
        let (here, origin) = (compiled.anchor(&place), compiled.anchor(&Place::ORIGIN));
        let (mut naive, mut anchored) = (0.0f64, 0.0f64);
        for i in 0..1000 {
            let q = [f64::from(i) * 0.037, f64::from(i) * 0.053];
            let truth = compiled.value_f64(&here, q, 0.0);
            let absolute = q.map(|q| (metres + q) as f32);
            naive = naive.max((f64::from(compiled.value_f32(&origin, absolute, 0.0)) - truth).abs());
            anchored = anchored.max((f64::from(compiled.value_f32(&here, q.map(|q| q as f32), 0.0)) - truth).abs());
        }
        println!("at {metres:e} m: unanchored off by {naive:.4} m, anchored by {anchored:.6} m");
        assert!(naive > naive_must_exceed, "the naive way must fail: {naive}");
        assert!(anchored < 1e-3, "ours must hold: {anchored}");
    }
}
