//! Several samples a pixel: at edges too, what was cleared, or stands behind the water, does not come through.

use bevy::prelude::*;

use super::{Eye, Stage, finite, settle, stage, still};

const SIZE: [u32; 2] = [160, 90];

/// A stage whose camera has so many samples, and clears to a red that nothing else has.
fn samples(msaa: Msaa) -> Stage {
    let mut stage = stage(SIZE, still());
    stage.light();
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(msaa);
    let red = ClearColorConfig::Custom(Color::linear_rgb(40.0, 0.0, 0.0));
    stage.world().get_mut::<Camera>(camera).expect("a camera").clear_color = red;
    stage
}

fn mesh(stage: &mut Stage, mesh: impl Into<Mesh>, colour: f32, at: Transform) {
    let world = stage.world();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let base_color = LinearRgba::rgb(colour, colour, colour).into();
    let plain = StandardMaterial { base_color, perceptual_roughness: 1.0, reflectance: 0.0, ..default() };
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(plain);
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material), at));
}

#[test]
fn no_edge_before_the_sea_shows_what_was_cleared() {
    for msaa in [Msaa::Off, Msaa::Sample4] {
        let mut stage = samples(msaa);
        for i in 0..5 {
            let at = Transform::from_xyz(2.0 * i as f32 - 4.0, 1.0, -1.0).with_rotation(Quat::from_rotation_z(0.3));
            mesh(&mut stage, Cuboid::new(0.5, 4.0, 0.5), 0.02, at);
        }
        // All of the picture is sea.
        Eye::new(Transform::from_xyz(0.0, 5.0, 6.0).looking_at(Vec3::ZERO, Vec3::Y), SIZE).put(&mut stage);
        settle(&mut stage);
        let colours = stage.colour();
        let reddest = colours.iter().map(|c| c[0]).fold(0.0, f32::max);
        println!("{msaa:?}: at most {reddest:.3} of red");
        assert!(finite(&colours) && reddest < 1.0, "{msaa:?}: {reddest}");
    }
}

/// From within, over a slanting bed: each pixel's samples have depths of their own, and all are under water.
#[test]
fn a_slanting_bed_is_the_same_with_four_samples() {
    let [one, four] = [Msaa::Off, Msaa::Sample4].map(|msaa| {
        let mut stage = samples(msaa);
        let bed = Plane3d::default().mesh().size(400.0, 400.0);
        let slant = Transform::from_xyz(0.0, -9.0, 0.0).with_rotation(Quat::from_rotation_x(0.35));
        mesh(&mut stage, bed, 0.6, slant);
        Eye::new(Transform::from_xyz(0.0, -2.0, 0.0).looking_to(Vec3::new(0.1, -0.8, -1.0), Vec3::Y), SIZE)
            .put(&mut stage);
        settle(&mut stage);
        let colours = stage.colour();
        assert!(finite(&colours), "{msaa:?}");
        colours
    });
    let apart = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
    let all: Vec<f32> = one.iter().zip(&four).map(apart).collect();
    let worst = all.iter().copied().fold(0.0, f32::max);
    let bright = one.iter().map(|c| c[2]).fold(0.0, f32::max);
    println!("{worst:.4} apart at most, of {bright:.3}");
    assert!(bright > 0.02, "the bed must be lit: {bright}");
    assert!(worst < 0.05 * bright, "{worst} apart, of {bright}");
}

/// From within, against the surface: a dark mesh's edge is no brighter than what is on both sides of it.
#[test]
fn edges_under_water_are_under_water() {
    let mut stage = samples(Msaa::Sample4);
    mesh(&mut stage, Cuboid::new(0.6, 6.0, 0.6), 0.6, Transform::from_xyz(0.3, -8.0, -6.0));
    let eye = Eye::new(Transform::from_xyz(0.0, -8.0, 0.0), SIZE);
    eye.put(&mut stage);
    settle(&mut stage);
    let colours = stage.colour();
    let reddest = colours.iter().map(|c| c[0]).fold(0.0, f32::max);
    println!("at most {reddest:.3} of red");
    assert!(finite(&colours) && reddest < 1.0, "{reddest}");
}
