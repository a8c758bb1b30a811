//! Random stamps, for tests.

use super::{Disc, Edit, Mode, Path, Placed, Rectangle, Shape};
use crate::Place;
use crate::field::arbitrary::Random;

/// A stamp of any kind that moves the ground, of some `size` metres, within `reach` metres of a place.
pub fn stamp(random: &mut Random, place: &Place, reach: f64, size: f64) -> Placed {
    let mut metres = || size * random.magnitude(0.1, 2.0);
    let shape = [
        Shape::Disc(Disc { radius: metres() }),
        Shape::Rectangle(Rectangle { size: [metres(), metres()], corner: 0.2 * metres() }),
        Shape::Path(Path { points: Vec::new(), width: metres() }),
    ];
    let mut shape = shape[random.pick(&[0, 1, 2])].clone();
    if let Shape::Path(path) = &mut shape {
        let mut at = [0.0; 3];
        for _ in 0..random.pick(&[2, 3, 7]) {
            path.points.push(at);
            let step = [random.within(0.2, 3.0), random.within(-0.5, 0.5), random.within(-2.0, 2.0)];
            at = [0, 1, 2].map(|k| at[k] + size * step[k]);
        }
    }
    let by = random.within(0.0, size);
    let edit = Edit {
        shape,
        mode: random.pick(&[Mode::Raise(by), Mode::Lower(by), Mode::Flatten, Mode::Flatten]),
        falloff: 0.1 + size * random.magnitude(0.01, 2.0),
        order: random.pick(&[-1, 0, 0, 7]),
    };
    let offset = [random.within(-reach, reach), random.within(-size, size), random.within(-reach, reach)];
    Placed { place: place.translated(offset), heading: random.within(-4.0, 4.0), edit }
}

/// A hole of any shape, as [`stamp`] has them.
pub fn hole(random: &mut Random, place: &Place, reach: f64, size: f64) -> Placed {
    let stamp = stamp(random, place, reach, size);
    Placed { edit: Edit { mode: Mode::Hole, ..stamp.edit }, ..stamp }
}
