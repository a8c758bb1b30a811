//! What the march can be cast against: a height field that can bound itself.

use super::{Cast, Counts, Ray, Tolerance};
use crate::field::{Anchors, Bound, Compiled};
use crate::place::Place;
use crate::real::Jet;
use crate::truth::{TruthCamera, TruthPicture};

/// A height field y = h(x, z) that can bound itself over a box.
pub trait Surface {
    /// The height in metres and its gradient at `q` = (x, z), in metres.
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2>;
    /// A Taylor model of the height over the box `centre` ± `half`, sound for every point in it.
    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2>;
    /// The lowest and the highest that the ground can be, anywhere, in metres.
    fn range(&self) -> (f64, f64);

    /// The unit normal at `q`, pointing up.
    fn normal(&self, q: [f64; 2]) -> [f64; 3] {
        normal(self.jet(q).g)
    }
}

/// The upward unit normal of a height field with gradient `g`.
pub(super) fn normal(g: [f64; 2]) -> [f64; 3] {
    let length = (g[0] * g[0] + g[1] * g[1] + 1.0).sqrt();
    [-g[0] / length, 1.0 / length, -g[1] / length]
}

/// The full field, all octaves, seen from a place of the world: x and z are metres from there, y is the height in
/// metres above the world's zero.
pub struct Anchored<'a> {
    compiled: &'a Compiled<2>,
    anchors: Anchors<2>,
}

impl<'a> Anchored<'a> {
    /// The field around `place`.
    pub fn new(compiled: &'a Compiled<2>, place: &Place) -> Self {
        Self { compiled, anchors: compiled.anchor(place) }
    }

    /// [`cast`](super::cast) with the usual tolerance, compiled in this crate.
    pub fn cast(&self, ray: &Ray, t_max: f64) -> Cast {
        super::cast(self, ray, t_max, Tolerance::default(), &mut Counts::default())
    }

    /// [`TruthPicture::compute`], compiled in this crate.
    pub fn picture(&self, camera: TruthCamera, far: f64, threads: usize) -> TruthPicture {
        TruthPicture::compute(self, camera, far, threads)
    }
}

impl Surface for Anchored<'_> {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        self.compiled.jet(&self.anchors, q, 0.0)
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        self.compiled.bound(&self.anchors, centre, half)
    }

    fn range(&self) -> (f64, f64) {
        self.compiled.range()
    }
}
