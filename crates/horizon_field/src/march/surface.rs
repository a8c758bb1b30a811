//! What the march can be cast against: a height field that can bound itself.

use super::{Cast, Counts, Ray, Tolerance};
use crate::field::{Anchors, Bound, Compiled};
use crate::place::Place;
use crate::real::Jet;
use crate::stamp::{Stamps, StampsAt};
use crate::truth::{TruthCamera, TruthPicture};

/// A height field y = h(x, z) that can bound itself over a box.
pub trait Surface {
    /// The height in metres and its gradient at `q` = (x, z), in metres.
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2>;
    /// A Taylor model of the height over the box `centre` ± `half`, sound for every point in it.
    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2>;
    /// The lowest and the highest that the ground can be, anywhere, in metres.
    fn range(&self) -> (f64, f64);

    /// Whether there are holes in the ground. Then a ray may start under it.
    fn has_holes(&self) -> bool {
        false
    }

    /// Whether there is no ground at `q`: a ray goes through the height field there.
    fn is_hole(&self, _q: [f64; 2]) -> bool {
        false
    }

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

/// The full ground, all octaves and stamps, seen from a place of the world: x and z are metres from there, y is the height in
/// metres above the world's zero.
pub struct Anchored<'a> {
    compiled: &'a Compiled<2>,
    anchors: Anchors<2>,
    stamps: Option<StampsAt<'a>>,
}

impl<'a> Anchored<'a> {
    /// The field around `place`, without stamps.
    pub fn new(compiled: &'a Compiled<2>, place: &Place) -> Self {
        Self { compiled, anchors: compiled.anchor(place), stamps: None }
    }

    /// The field around `place`, with stamps on it.
    pub fn stamped(compiled: &'a Compiled<2>, stamps: &'a Stamps, place: &Place) -> Self {
        Self { stamps: Some(stamps.at(place)), ..Self::new(compiled, place) }
    }

    /// The height at `q`, in metres; in a hole, that of the ground that would be there.
    pub fn value(&self, q: [f64; 2]) -> f64 {
        let height = self.compiled.value_f64(&self.anchors, q, 0.0);
        match &self.stamps {
            // What is stamped needs the gradient only for its own.
            Some(stamps) => stamps.jet(q, 0.0, Jet::constant(height)).v,
            None => height,
        }
    }

    /// The heights at many points: those of [`Anchored::value`], several times as fast. Panics where `out` does not take as many.
    pub fn values(&self, q: &[[f64; 2]], out: &mut [f64]) {
        self.compiled.values_f64(&self.anchors, q, 0.0, out);
        if let Some(stamps) = &self.stamps {
            for (q, out) in q.iter().zip(out) {
                *out = stamps.jet(*q, 0.0, Jet::constant(*out)).v;
            }
        }
    }

    /// How far plants are kept away at `q`, from 0 (not at all) to 1.
    pub fn clearing(&self, q: [f64; 2]) -> f64 {
        self.stamps.as_ref().map_or(0.0, |stamps| stamps.clearing(q))
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
        let ground = self.compiled.jet(&self.anchors, q, 0.0);
        self.stamps.as_ref().map_or(ground, |stamps| stamps.jet(q, 0.0, ground))
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        let ground = self.compiled.bound(&self.anchors, centre, half);
        self.stamps.as_ref().map_or(ground, |stamps| stamps.bound(centre, half, ground))
    }

    fn range(&self) -> (f64, f64) {
        let range = self.compiled.range();
        self.stamps.as_ref().map_or(range, |stamps| stamps.stamps().range(range))
    }

    fn has_holes(&self) -> bool {
        self.stamps.as_ref().is_some_and(|stamps| stamps.stamps().has_holes())
    }

    fn is_hole(&self, q: [f64; 2]) -> bool {
        self.stamps.as_ref().is_some_and(|stamps| stamps.is_hole(q, 0.0))
    }
}
