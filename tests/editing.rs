//! Worlds that change while they are looked at: no hole, and no more work than the change asks for.

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::PipelineCache;
use bevy_horizon::prelude::*;
use bevy_horizon::render::cache::Caches;
use horizon_field::field::{Fractal, Noise};

use bevy_horizon_workspace::stage::Stage;

fn hills(amplitude: f64) -> Field {
    Field::Fractal(Fractal { wavelength: 3000.0, amplitude, octaves: 10.0, ..default() })
}

/// A stage that looks down on hills: every pixel shows ground.
fn stage() -> (Stage, Entity) {
    let mut stage = Stage::new(160, 90);
    stage.light();
    let terrain = stage.world().spawn(Terrain::new(hills(200.0))).id();
    stage.look(Transform::from_xyz(0.0, 900.0, 0.0).looking_to(Vec3::new(0.2, -1.0, -0.6), Vec3::Y));
    stage.settle();
    (stage, terrain)
}

fn pipelines(stage: &Stage) -> usize {
    stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines().count()
}

fn filled(stage: &Stage) -> u64 {
    stage.off.app.sub_app(RenderApp).world().resource::<Caches>().tiles_filled()
}

/// Draws frames, none of which may show a hole.
fn watch(stage: &mut Stage, frames: usize) -> Vec<f32> {
    let mut depth = Vec::new();
    for frame in 0..frames {
        depth = stage.depth();
        let holes = depth.iter().filter(|depth| **depth <= 0.0).count();
        assert_eq!(holes, 0, "holes in frame {frame}");
    }
    depth
}

#[test]
fn a_number_compiles_nothing() {
    let (mut stage, terrain) = stage();
    let (before, compiled) = (watch(&mut stage, 1), pipelines(&stage));
    stage.world().get_mut::<Terrain>(terrain).unwrap().field = hills(260.0);
    let after = watch(&mut stage, 12);
    assert_eq!(pipelines(&stage), compiled);
    assert!(before != after, "the ground must change");
}

#[test]
fn a_tree_compiles_one_kernel_once() {
    let (mut stage, terrain) = stage();
    let (before, compiled) = (watch(&mut stage, 1), pipelines(&stage));
    let bumpy = Field::Add(vec![hills(200.0), Field::Noise(Noise { wavelength: 200.0, amplitude: 40.0, ..default() })]);
    stage.world().get_mut::<Terrain>(terrain).unwrap().field = bumpy.clone();
    assert!(watch(&mut stage, 12) != before);
    assert_eq!(pipelines(&stage), compiled + 1);
    // Undone and done again: both kernels are there.
    for field in [hills(200.0), bumpy] {
        stage.world().get_mut::<Terrain>(terrain).unwrap().field = field;
        watch(&mut stage, 8);
    }
    assert_eq!(pipelines(&stage), compiled + 1);
}

#[test]
fn a_rejected_edit_leaves_the_ground() {
    let (mut stage, terrain) = stage();
    let before = watch(&mut stage, 1);
    stage.world().get_mut::<Terrain>(terrain).unwrap().field = hills(f64::NAN);
    assert!(watch(&mut stage, 6) == before);
}

#[test]
fn a_still_camera_fills_nothing_and_a_jump_shows_no_hole() {
    let (mut stage, _) = stage();
    let done = filled(&stage);
    watch(&mut stage, 5);
    assert_eq!(filled(&stage), done, "a still camera must fill nothing");
    // 10 m/s at 60 frames a second: strips alone.
    for step in 1..=30 {
        let x = step as f32 / 6.0;
        stage.look(Transform::from_xyz(x, 900.0, 0.0).looking_to(Vec3::new(0.2, -1.0, -0.6), Vec3::Y));
        watch(&mut stage, 1);
    }
    let strips = filled(&stage) - done;
    println!("{strips} tiles filled over 5 m, of {done} in all");
    assert!(strips < done / 10);
    stage.look(Transform::from_xyz(100_000.0, 900.0, -3.0).looking_to(Vec3::new(0.2, -1.0, -0.6), Vec3::Y));
    watch(&mut stage, 10);
}
