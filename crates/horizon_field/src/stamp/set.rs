//! All stamps of a terrain: in a stable order, with an index, and what is proven of them wherever they are.

use core::cmp::Ordering;
use std::sync::Arc;

use super::edit::{Placed, StampError};
use super::index::{Box2, Index};
use super::part::Part;
use super::ready::Ready;
use super::view::StampsAt;
use crate::Place;

/// Stamps, ready for questions. What comes out does not depend on the order in which they were given.
#[derive(Clone, Debug, Default)]
pub struct Stamps {
    ready: Vec<Arc<Ready>>,
    origin: Place,
    /// What moves the ground, what keeps plants away, and what takes the ground away.
    pub(super) ground: Layer,
    pub(super) clearing: Layer,
    pub(super) holes: Layer,
}

/// What a hole's edge counts as, in metres of wavelength: a grid shows waves by eight texels each, and the edge by steps of a
/// texel, which are then 3 cm.
const EDGE: f64 = 0.25;

/// The parts of stamps of a kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    pub parts: Vec<Entry>,
    pub index: Index,
    /// What stamps can do to the ground wherever boxes of a node of the index are.
    pub effects: Vec<Effect>,
}

/// A part of a stamp of the set.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub part: Part<f64>,
    pub place: Place,
    pub narrow: f64,
    /// The stamp's number in the set.
    pub stamp: u32,
}

/// What stamps can make of a height: it comes to lie within `fall` to `rise` metres of where it was, or within `low` to
/// `high`, or between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Effect {
    fall: f64,
    rise: f64,
    low: f64,
    high: f64,
}

impl Effect {
    const NONE: Self = Self { fall: 0.0, rise: 0.0, low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// Then a stamp that raises by `by`.
    fn raised(self, by: f64) -> Self {
        let (down, up) = (by.min(0.0), by.max(0.0));
        Self { fall: self.fall + down, rise: self.rise + up, low: self.low + down, high: self.high + up }
    }

    /// Then a stamp that levels to somewhere between `low` and `high`.
    fn levelled(self, [low, high]: [f64; 2]) -> Self {
        Self { low: self.low.min(low), high: self.high.max(high), ..self }
    }

    /// One or the other.
    pub fn or(&self, other: &Self) -> Self {
        Self {
            fall: self.fall.min(other.fall),
            rise: self.rise.max(other.rise),
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Of heights between `low` and `high`.
    pub fn range(&self, (low, high): (f64, f64)) -> (f64, f64) {
        let range = [(low + self.fall).min(self.low), (high + self.rise).max(self.high)];
        let pad = 1e-14 * (range[0].abs() + range[1].abs() + self.rise - self.fall);
        (range[0] - pad, range[1] + pad)
    }
}

/// A rectangle of the plane, with sides along x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// The corner of the least x and z; its height is of no meaning.
    pub place: Place,
    /// The extents along x and z, in metres.
    pub size: [f64; 2],
    /// The least extent of what changed, in metres: a grid whose spacing is over 4/3 of it does not show it.
    pub narrow: f64,
}

impl Area {
    /// Whether a square around a place meets it: `half` is half of the square's side, in metres.
    pub fn meets(&self, centre: &Place, half: f64) -> bool {
        let [x, _, z] = centre.minus(&self.place);
        [x, z].iter().zip(self.size).all(|(from, size)| *from >= -half && *from <= size + half)
    }
}

impl Layer {
    fn new(stamps: &[Arc<Ready>], origin: &Place, belongs: impl Fn(&Ready) -> bool) -> Self {
        let mut parts = Vec::new();
        let mut boxes = Vec::new();
        for (stamp, ready) in stamps.iter().enumerate().filter(|(_, ready)| belongs(ready)) {
            let [x, _, z] = ready.placed().place.minus(origin);
            for part in &ready.parts {
                let reach = part.reach(ready.falloff());
                let centre = [x + part.centre[0], z + part.centre[1]];
                // However its coordinates are rounded, the part is within.
                boxes.push(Box2::around(centre, [0, 1].map(|k| reach[k] + 1e-6 + 1e-9 * (centre[k].abs() + reach[k]))));
                let (place, narrow) = (ready.placed().place, ready.narrow);
                parts.push(Entry { part: *part, place, narrow, stamp: stamp as u32 });
            }
        }
        let index = Index::new(boxes.clone());
        // A point that a part reaches is reached by no part that does not touch that one.
        let effect = |i: u32| {
            let (touching, _) = index.touching(&boxes[i as usize], |_| false);
            let mut last = None;
            touching.into_iter().fold(Effect::NONE, |effect, j| {
                let Entry { part, stamp, .. } = &parts[j as usize];
                if part.levels > 0.0 {
                    effect.levelled(part.heights(1.0 / part.per_falloff))
                } else if last.replace(*stamp) == Some(*stamp) {
                    effect
                } else {
                    effect.raised(part.height)
                }
            })
        };
        let effects = index.gather(effect, Effect::or);
        Self { parts, index, effects }
    }
}

impl Stamps {
    /// The set of these stamps.
    pub fn new(mut ready: Vec<Arc<Ready>>) -> Self {
        ready.sort_by(|a, b| a.key().cmp(b.key()));
        let origin = ready.first().map_or(Place::ORIGIN, |first| first.placed().place);
        let ground = Layer::new(&ready, &origin, Ready::moves_ground);
        let clearing = Layer::new(&ready, &origin, Ready::keeps_trees);
        let holes = Layer::new(&ready, &origin, Ready::is_hole);
        Self { ready, origin, ground, clearing, holes }
    }

    /// Checks stamps, and makes a set of them.
    ///
    /// # Errors
    /// The first stamp that can't be computed, as `stamps[i]`.
    pub fn compile(stamps: &[Placed]) -> Result<Self, StampError> {
        let ready = |(i, placed): (usize, &Placed)| Ready::new(placed, &format!("stamps[{i}]")).map(Arc::new);
        Ok(Self::new(stamps.iter().enumerate().map(ready).collect::<Result<_, _>>()?))
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ready.is_empty()
    }

    /// The stamps, in the order in which they are applied.
    pub fn placed(&self) -> impl Iterator<Item = &Placed> {
        self.ready.iter().map(|ready| ready.placed())
    }

    /// Whether any of them takes ground away.
    pub fn has_holes(&self) -> bool {
        !self.holes.parts.is_empty()
    }

    /// The stamps around a place.
    pub fn at(&self, place: &Place) -> StampsAt<'_> {
        StampsAt::new(self, place)
    }

    pub(super) fn origin(&self) -> &Place {
        &self.origin
    }

    /// The lowest and the highest that ground can be anywhere, which without stamps is within `base`.
    pub fn range(&self, base: (f64, f64)) -> (f64, f64) {
        let Some(everywhere) = self.ground.effects.first() else { return base };
        let (low, high) = everywhere.range(base);
        (low.min(base.0), high.max(base.1))
    }

    /// The length of the finest wave in the ground that the stamps make, in metres; infinite without any. The edge of a hole
    /// counts as one of 0.25 m.
    pub fn finest_wavelength(&self) -> f64 {
        let ground = self.ready.iter().filter(|ready| ready.moves_ground());
        let edge = if self.has_holes() { EDGE } else { f64::INFINITY };
        ground.map(|ready| 2.0 * ready.falloff()).fold(edge, f64::min)
    }

    /// Where the ground of another set is not this one's: around each stamp that is in one of them only.
    pub fn changes(&self, other: &Self) -> Vec<Area> {
        let mut areas = Vec::new();
        let (mut old, mut new) = (self.ready.iter().peekable(), other.ready.iter().peekable());
        loop {
            let order = match (old.peek(), new.peek()) {
                (Some(a), Some(b)) => a.key().cmp(b.key()),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return areas,
            };
            let changed = match order {
                Ordering::Less => old.next(),
                Ordering::Greater => new.next(),
                Ordering::Equal => {
                    old.next();
                    new.next();
                    None
                }
            };
            areas.extend(changed.filter(|ready| !ready.keeps_trees()).map(|ready| ready.area()));
        }
    }
}

impl Ready {
    fn area(&self) -> Area {
        let [x, z] = self.low;
        Area {
            place: self.placed().place.translated([x, 0.0, z]),
            size: [0, 1].map(|k| self.high[k] - self.low[k]),
            narrow: self.narrow,
        }
    }
}
