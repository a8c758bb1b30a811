//! The stamps around a place of the world: what they make of the ground there.

use super::bound;
use super::index::Box2;
use super::part::{Part, stamped};
use super::set::{Entry, Layer, Stamps};
use crate::Place;
use crate::field::Bound;
use crate::fractal::fade;
use crate::real::{Jet, Real};

/// Stamps, seen from a place of the world: x and z are metres from there, heights metres above the world's zero.
#[derive(Clone, Copy, Debug)]
pub struct StampsAt<'a> {
    stamps: &'a Stamps,
    anchor: Place,
    /// The place, from the index' origin.
    shift: [f64; 2],
}

impl<'a> StampsAt<'a> {
    pub(super) fn new(stamps: &'a Stamps, place: &Place) -> Self {
        let [x, _, z] = place.minus(stamps.origin());
        Self { stamps, anchor: *place, shift: [x, z] }
    }

    /// All of the stamps.
    pub fn stamps(&self) -> &'a Stamps {
        self.stamps
    }

    /// A box, as the index counts.
    fn area(&self, centre: [f64; 2], half: [f64; 2]) -> Box2 {
        // However the sum is rounded, the box is within.
        let pad = |k: usize| 1e-15 * (self.shift[k].abs() + centre[k].abs() + half[k]);
        Box2::around([0, 1].map(|k| self.shift[k] + centre[k]), [0, 1].map(|k| half[k] + pad(k)))
    }

    /// Parts by their numbers, in metres from the anchor, as a grid of spacing `cutoff` shows them.
    fn parts<T: Real>(&self, layer: &'a Layer, found: &'a [u32], cutoff: f64) -> impl Iterator<Item = Part<T>> {
        let anchor = self.anchor;
        let stamp = |i: &u32| layer.parts[*i as usize].stamp;
        found.iter().enumerate().filter_map(move |(at, i)| {
            let Entry { part, place, narrow, .. } = &layer.parts[*i as usize];
            let presence = fade(*narrow, cutoff);
            let [x, _, z] = place.minus(&anchor);
            let two = |of: [f64; 2]| of.map(T::of);
            (presence > 0.0).then(|| Part {
                centre: two([x + part.centre[0], z + part.centre[1]]),
                axis: two(part.axis),
                extent: two(part.extent),
                radius: T::of(part.radius),
                per_falloff: T::of(part.per_falloff),
                height: T::of(part.height),
                presence: T::of(presence),
                slope: two(part.slope),
                levels: T::of(part.levels),
                last: found.get(at + 1).is_none_or(|next| stamp(next) != stamp(i)),
            })
        })
    }

    /// The ground with the stamps on it: height and gradient at `q`, of what they are without. Of stamps, a grid of spacing
    /// `cutoff` metres shows what is at least twice as wide.
    pub fn jet<T: Real>(&self, q: [T; 2], cutoff: T, ground: Jet<T, 2>) -> Jet<T, 2> {
        let layer = &self.stamps.ground;
        let (found, _) = layer.index.touching(&self.area(q.map(T::f64), [0.0; 2]), |_| false);
        if found.is_empty() { ground } else { stamped(self.parts(layer, &found, cutoff.f64()), q, ground) }
    }

    /// How many parts of stamps [`StampsAt::jet`] computes at a point, and how many nodes of the index it looks at.
    pub fn work(&self, q: [f64; 2]) -> [usize; 2] {
        let (found, looked) = self.stamps.ground.index.touching(&self.area(q, [0.0; 2]), |_| false);
        [found.len(), looked]
    }

    /// Whether there is no ground at `q`, by a [`Mode::Hole`](super::Mode::Hole). Of holes, a grid of spacing `cutoff` metres shows
    /// what is wider.
    pub fn is_hole<T: Real>(&self, q: [T; 2], cutoff: T) -> bool {
        let layer = &self.stamps.holes;
        let (found, _) = layer.index.touching(&self.area(q.map(T::f64), [0.0; 2]), |_| false);
        self.parts(layer, &found, cutoff.f64()).any(|part| part.holds(q))
    }

    /// How far plants are kept away, from 0 (not at all) to 1: by [`Mode::KeepTrees`](super::Mode::KeepTrees), and where there is no
    /// ground.
    pub fn clearing(&self, q: [f64; 2]) -> f64 {
        if self.is_hole(q, 0.0) {
            return 1.0;
        }
        let layer = &self.stamps.clearing;
        let (found, _) = layer.index.touching(&self.area(q, [0.0; 2]), |_| false);
        self.parts(layer, &found, 0.0).map(|part: Part<f64>| part.weight(q).v).fold(0.0, f64::max)
    }

    /// What is proven of the ground with the stamps on it, for all points that differ from `centre` by at most `half`
    /// along each axis, from what is proven of it without.
    pub fn bound(&self, centre: [f64; 2], half: [f64; 2], ground: Bound<2>) -> Bound<2> {
        let layer = &self.stamps.ground;
        let mut within = None;
        // Of stamps that lie within the box as a whole, what they can do anywhere says enough.
        let (found, _) = layer.index.touching(&self.area(centre, half), |node| {
            let effect = layer.effects[node];
            within = Some(within.map_or(effect, |within| effect.or(&within)));
            true
        });
        if found.is_empty() && within.is_none() {
            return ground;
        }
        let model = bound::stamped(self.parts(layer, &found, 0.0), centre, half, ground);
        within.map_or(model, |effect| bound::anywhere(model, effect.range((ground.low, ground.high))))
    }

    /// Appends the parts that reach into a box, little-endian, in the layout of `StampPart` in `stamp.wgsl`, relative to the
    /// anchor and as a grid of spacing `cutoff` metres shows them: first those that move the ground, then holes. Returns how
    /// many of each.
    pub fn append_bytes(&self, centre: [f64; 2], half: [f64; 2], cutoff: f64, bytes: &mut Vec<u8>) -> [u32; 2] {
        [&self.stamps.ground, &self.stamps.holes].map(|layer| self.append_layer(layer, centre, half, cutoff, bytes))
    }

    fn append_layer(
        &self,
        layer: &'a Layer,
        centre: [f64; 2],
        half: [f64; 2],
        cutoff: f64,
        bytes: &mut Vec<u8>,
    ) -> u32 {
        let (found, _) = layer.index.touching(&self.area(centre, half), |_| false);
        let before = bytes.len();
        for part in self.parts::<f32>(layer, &found, cutoff) {
            let Part { centre, axis, extent, radius, per_falloff, height, presence, slope, levels, last } = part;
            let numbers =
                [[centre, axis, extent, [radius, per_falloff], [height, presence], slope].concat(), vec![levels]];
            numbers.iter().flatten().for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes.extend(u32::from(last).to_le_bytes());
        }
        ((bytes.len() - before) / super::PART_BYTES) as u32
    }
}
