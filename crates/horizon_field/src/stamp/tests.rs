//! Tests of stamps, over random ones.

mod bounds;
mod files;
mod holes;
mod paths;
mod sets;
mod values;

use super::{Disc, Edit, Mode, Placed, Shape, Stamps};
use crate::field::arbitrary::Random;
use crate::{Jet, Place};

/// Places of the world, the last ones beyond what f32 tells apart, and across a cell's edge.
const PLACES: [[f64; 3]; 4] = [[0.0; 3], [4095.0, 0.0, -3.0], [1e6, 0.0, -1e6], [-1e9, 0.0, 1e9]];

/// Ground without stamps: a slope.
fn slope(q: [f64; 2]) -> Jet<f64, 2> {
    Jet { v: 3.0 + 0.2 * q[0] - 0.1 * q[1], g: [0.2, -0.1] }
}

/// Stamps of any kind around a place.
fn some(random: &mut Random, count: usize, place: &Place, reach: f64, size: f64) -> Vec<Placed> {
    (0..count).map(|_| super::arbitrary::stamp(random, place, reach, size)).collect()
}

/// A disc that levels.
fn level(place: Place, radius: f64, falloff: f64) -> Placed {
    let edit = Edit { shape: Shape::Disc(Disc { radius }), mode: Mode::Flatten, falloff, order: 0 };
    Placed { place, heading: 0.0, edit }
}

fn compiled(stamps: &[Placed]) -> Stamps {
    Stamps::compile(stamps).expect("valid stamps")
}
