//! A plant's solids: ellipsoids, in the plant's own space; the twin of `solids.wgsl`, which states the notation.

use super::foliage::{Foliage, MIPS, TEXELS};
use super::plant::Plant;
use super::species::{Row, Species};
use super::uniform::Wind;
use crate::real::Real;

/// An ellipsoid with upright axes, in the plant's own space, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid<T> {
    /// Its centre.
    pub centre: [T; 3],
    /// Its radii.
    pub radii: [T; 3],
}

impl<T: Real> Ellipsoid<T> {
    fn new([high, across, up, out]: Row, [height, radius]: [f64; 2], [cos, sin]: [f64; 2]) -> Self {
        let across = across * radius;
        Self {
            centre: [out * radius * cos, high * height, out * radius * sin].map(T::of),
            radii: [across, up * height, across].map(T::of),
        }
    }

    /// A point, in radii from the centre.
    #[inline(always)]
    pub(super) fn scaled(&self, q: [T; 3]) -> [T; 3] {
        core::array::from_fn(|k| (q[k] - self.centre[k]) / self.radii[k])
    }

    /// The smallest radius.
    #[inline(always)]
    pub(super) fn narrow(&self) -> T {
        self.radii[0].min(self.radii[1])
    }

    /// Where a ray of the plant's own space is inside.
    #[inline(always)]
    pub fn chord(&self, origin: [T; 3], direction: [T; 3]) -> Option<[T; 2]> {
        let o = self.scaled(origin);
        let d: [T; 3] = core::array::from_fn(|k| direction[k] / self.radii[k]);
        // From the nearest point, not from the origin: no square of a distance is subtracted from another.
        let dd = dot(d, d);
        let middle = -dot(o, d) / dd;
        let nearest: [T; 3] = core::array::from_fn(|k| o[k] + middle * d[k]);
        let room = T::ONE - dot(nearest, nearest);
        if room > T::ZERO {
            let half = (room / dd).sqrt();
            Some([middle - half, middle + half])
        } else {
            None
        }
    }
}

#[inline(always)]
pub(super) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What of a plant was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The crown.
    Crown,
    /// The trunk.
    Trunk,
}

/// A plant in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid<T> {
    /// The foot.
    pub foot: [T; 3],
    /// How far x and z move for each metre of height.
    pub shear: [T; 2],
    pub(super) crown: Vec<Ellipsoid<T>>,
    pub(super) trunk: Option<Ellipsoid<T>>,
    /// How much of an ellipsoid the foliage eats.
    pub(super) foliage: T,
    /// Foliage periods per metre.
    pub(super) per_metre: T,
    /// The foliage's own offset, in periods.
    pub(super) shift: [T; 3],
    /// The plant's middle, in the frame.
    middle: [T; 3],
}

/// The turn of an ellipsoid against the one before it: the golden angle.
const GOLDEN: f64 = 2.399_963_229_728_653;

impl<T: Real> Solid<T> {
    /// The solid of a plant whose foot is at `foot`.
    pub fn new(plant: &Plant, species: &Species, foot: [f64; 3], wind: &Wind) -> Self {
        let size = [plant.height, plant.radius].map(f64::from);
        let turn = f64::from(plant.turn) * (core::f64::consts::TAU / 256.0);
        let heading = |angle: f64| [libm::cos(angle), libm::sin(angle)];
        let lean = species.lean * f64::from(plant.hash >> 24) / 255.0;
        let phase = f64::from(plant.hash & 0xffff) * (core::f64::consts::TAU / 65536.0);
        let gust = 0.75 + 0.25 * libm::sin(wind.gust + phase);
        let shear = [0, 1].map(|k| lean * heading(turn)[k] + gust * wind.sway[k] / size[0]);
        let rows = species.shape.crown().iter().enumerate();
        let crown = rows.map(|(i, row)| Ellipsoid::new(*row, size, heading(turn + i as f64 * GOLDEN))).collect();
        let half = 0.5 * size[0];
        Self {
            foot: foot.map(T::of),
            shear: shear.map(T::of),
            crown,
            trunk: species.trunk_row().map(|row| Ellipsoid::new(row, size, [1.0, 0.0])),
            foliage: T::of(species.foliage),
            per_metre: T::of(1.0 / species.period()),
            shift: [0, 10, 20].map(|bits| T::of_u32(plant.hash >> bits & 1023) * T::of(1.0 / 1024.0)),
            middle: [foot[0] + half * shear[0], foot[1] + half, foot[2] + half * shear[1]].map(T::of),
        }
    }

    /// A direction of the frame, in the plant's own space.
    #[inline(always)]
    pub fn own_direction(&self, d: [T; 3]) -> [T; 3] {
        [d[0] - self.shear[0] * d[1], d[1], d[2] - self.shear[1] * d[1]]
    }

    /// A point of the frame, in the plant's own space.
    #[inline(always)]
    pub fn own(&self, p: [T; 3]) -> [T; 3] {
        self.own_direction(core::array::from_fn(|k| p[k] - self.foot[k]))
    }

    /// How far along a ray of unit direction the plant's middle lies: where a pixel's width is taken, so that the plant is one
    /// and the same wherever the ray comes near it.
    pub fn depth(&self, origin: [T; 3], direction: [T; 3]) -> T {
        dot(core::array::from_fn(|k| self.middle[k] - origin[k]), direction)
    }

    /// Which mip of the foliage a pixel of this many metres shows.
    pub fn level(&self, footprint: T) -> T {
        let texels = footprint.f64() * self.per_metre.f64() * TEXELS as f64;
        T::of(libm::log2(texels.max(1e-9)).clamp(0.0, MIPS as f64 - 1.0))
    }

    /// A point of its own space, in periods of the foliage.
    #[inline(always)]
    pub(super) fn periods(&self, q: [T; 3]) -> [T; 3] {
        core::array::from_fn(|k| q[k] * self.per_metre + self.shift[k])
    }

    /// The crown's function at a point of its own space: below 0 inside.
    pub fn crown(&self, q: [T; 3], level: T) -> T {
        let leaves = Foliage::table().value(self.periods(q), level);
        let eaten = T::ONE - self.foliage * leaves;
        let mut f = T::of(1e30);
        for ellipsoid in &self.crown {
            let scaled = ellipsoid.scaled(q);
            f = f.min(ellipsoid.narrow() * (dot(scaled, scaled).sqrt() - eaten));
        }
        f
    }

    /// How fast the crown's function may change, for each metre of its own space.
    pub fn slope(&self, level: T) -> T {
        let bound = T::of(Foliage::table().slope(level.to_i64().max(0) as usize)) * self.per_metre;
        let widest = self.crown.iter().fold(T::ZERO, |widest, ellipsoid| widest.max(ellipsoid.narrow()));
        T::ONE + self.foliage * widest * bound
    }

    /// The outward normal of a part at a point of the frame, of unit length: of the crown a difference over `width` metres.
    pub fn normal(&self, part: Part, p: [T; 3], width: T, level: T) -> [T; 3] {
        let q = self.own(p);
        let g: [T; 3] = match (part, &self.trunk) {
            (Part::Trunk, Some(trunk)) => {
                let scaled = trunk.scaled(q);
                core::array::from_fn(|k| scaled[k] / trunk.radii[k])
            }
            _ => core::array::from_fn(|k| {
                let beside = |by: T| core::array::from_fn(|j| if j == k { q[j] + by } else { q[j] });
                self.crown(beside(width), level) - self.crown(beside(-width), level)
            }),
        };
        let out = [g[0], g[1] - self.shear[0] * g[0] - self.shear[1] * g[2], g[2]];
        let length = dot(out, out).sqrt();
        if length > T::ZERO { out.map(|x| x / length) } else { [T::ZERO, T::ONE, T::ZERO] }
    }

    /// The chord of a ray through the ellipsoids of the crown: from where it enters the first to where it leaves the last.
    #[inline(always)]
    pub(super) fn crown_chord(&self, o: [T; 3], d: [T; 3]) -> Option<[T; 2]> {
        let chords = self.crown.iter().filter_map(|ellipsoid| ellipsoid.chord(o, d));
        chords.reduce(|all, chord| [all[0].min(chord[0]), all[1].max(chord[1])])
    }
}
