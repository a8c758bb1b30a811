//! What the methods march: a height field whose work can be counted.

use crate::field::{Anchors, Bound, Compiled};
use crate::march::Surface;
use crate::place::Place;
use crate::real::Jet;

/// A surface that can be asked for heights alone, and that says what it costs.
pub trait Ground: Surface + Sync {
    /// The full height at `q` = (x, z), in metres.
    fn height(&self, q: [f64; 2]) -> f64;
    /// The same in single precision.
    fn height_f32(&self, q: [f32; 2]) -> f32;
    /// A Lipschitz constant: the ground is nowhere steeper.
    fn slope(&self) -> f64;
    /// The octaves of noise that one height evaluates.
    fn octaves(&self) -> u64;
    /// The octaves of noise that [`Surface::bound`] evaluates over a box of these half extents.
    fn bound_octaves(&self, half: [f64; 2]) -> u64;
}

/// A compiled field, all octaves, seen from a place of the world: x and z are metres from there.
pub struct HeightField<'a> {
    compiled: &'a Compiled<2>,
    anchors: Anchors<2>,
}

impl<'a> HeightField<'a> {
    /// The field around `place`.
    pub fn new(compiled: &'a Compiled<2>, place: &Place) -> Self {
        Self { compiled, anchors: compiled.anchor(place) }
    }
}

impl Surface for HeightField<'_> {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        self.compiled.jet_f64(&self.anchors, q, 0.0)
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        self.compiled.bound(&self.anchors, centre, half)
    }

    fn range(&self) -> (f64, f64) {
        self.compiled.range()
    }
}

impl Ground for HeightField<'_> {
    fn height(&self, q: [f64; 2]) -> f64 {
        self.compiled.value_f64(&self.anchors, q, 0.0)
    }

    fn height_f32(&self, q: [f32; 2]) -> f32 {
        self.compiled.value_f32(&self.anchors, q, 0.0)
    }

    fn slope(&self) -> f64 {
        self.compiled.slope()
    }

    fn octaves(&self) -> u64 {
        self.compiled.value_octaves()
    }

    fn bound_octaves(&self, half: [f64; 2]) -> u64 {
        self.compiled.bound_octaves(half)
    }
}

/// What all rays of a picture have in common.
pub struct Setting<'a, G> {
    /// The ground.
    pub surface: &'a G,
    /// How far rays are followed, in metres.
    pub far: f64,
    /// How wide a pixel is per metre of distance, in metres.
    pub pixel_angle: f64,
    /// No ground is higher, in metres.
    pub(super) high: f64,
    /// The ground's slope bound, and the octaves of a height: worked out once.
    pub(super) slope: f64,
    pub(super) octaves: u64,
}

impl<'a, G: Ground> Setting<'a, G> {
    /// Rays over `surface`, up to `far` metres, of pixels that are `pixel_angle` metres wide per metre of distance.
    pub fn new(surface: &'a G, far: f64, pixel_angle: f64) -> Self {
        let (_, high) = surface.range();
        Self { surface, far, pixel_angle, high, slope: surface.slope(), octaves: surface.octaves() }
    }
}
