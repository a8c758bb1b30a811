//! The pass that draws plants, in woods without end and in woods of 1 km² around the camera.

use bevy::math::Vec3;
use bevy::prelude::Transform;
use bevy_horizon::prelude::{Field, Terrain, Trees};
use bevy_horizon_workspace::stage::Stage;
use horizon_field::Place;
use horizon_field::field::{HeightImage, ImageField, NoImages};
use horizon_field::march::Anchored;

use super::woods::{View, forest, hills};
use crate::context::Context;
use crate::experiment::ChartsError;
use crate::measure::samples::median;

/// The share of cells that hold a plant.
const DENSITY: f64 = 0.6;
/// What the pass is called.
const PASS: &str = "horizon_trees";
/// The name of the square's image.
const IMAGE: &str = "square";
/// A texel's side in metres, how many of them the square has along its side, and how many of bare ground are around it.
const TEXEL: f64 = 10.0;
const TEXELS: u32 = 100;
const MARGIN: u32 = 4;

/// A white square of 1 km² on black.
fn square() -> HeightImage {
    let side = TEXELS + 2 * MARGIN;
    let within = |i: u32| (MARGIN..MARGIN + TEXELS).contains(&i);
    let texel = |i: u32| if within(i % side) && within(i / side) { u16::MAX } else { 0 };
    HeightImage { width: side, height: side, texels: (0..side * side).map(texel).collect() }
}

/// Woods of this density, and a camera in them.
fn stage(ctx: &Context, pose: Transform, density: Field) -> Stage {
    let [width, height] = ctx.pick([160, 90], [1280, 720]);
    let mut stage = Stage::new(width, height);
    stage.light();
    let images = [(IMAGE.to_owned(), square())].into_iter().collect();
    stage.world().spawn((Terrain { images, ..Terrain::new(hills()) }, Trees::new(forest(density))));
    stage.look(pose);
    stage.settle();
    // Tiles of plants may still be under way when the ground is there.
    for _ in 0..8 {
        stage.frame();
    }
    stage
}

/// What the pass takes, and a whole frame: in milliseconds, first in woods without end, then in those of 1 km². Frames of the two by
/// turns.
///
/// # Errors
/// A field that can't be computed.
pub fn passes(ctx: &Context, view: &View) -> Result<[[f64; 2]; 2], ChartsError> {
    let ground = hills().compile::<2>(&NoImages)?;
    let height = Anchored::new(&ground, &Place::ORIGIN).value([0.0; 2]);
    let forward = Vec3::from_array(view.forward.map(|x| x as f32));
    let pose = Transform::from_xyz(0.0, (height + view.above) as f32, 0.0).looking_to(forward, Vec3::Y);
    let extent = f64::from(TEXELS + 2 * MARGIN) * TEXEL;
    let square = ImageField { path: IMAGE.into(), size: [extent; 2], low: 0.0, high: DENSITY, ..ImageField::default() };
    let mut stages = [Field::Constant(DENSITY), square.into()].map(|density| stage(ctx, pose, density));
    for stage in &mut stages {
        // What went before is not counted.
        stage.spent(PASS);
    }
    let mut times = [const { [const { Vec::new() }; 2] }; 2];
    for _ in 0..ctx.pick(5, 20) {
        for (stage, [passes, frames]) in stages.iter_mut().zip(&mut times) {
            frames.push(stage.frame());
            passes.extend(stage.spent(PASS));
        }
    }
    Ok(times.map(|times| times.map(median)))
}
