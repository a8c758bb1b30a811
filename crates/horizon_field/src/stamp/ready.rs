//! One stamp, made ready: checked, and taken apart into rounded boxes around its place.

use super::edit::{Edit, Mode, Placed, Shape, StampError};
use super::part::Part;
use super::path::straights;
use crate::Place;

/// A stamp that was checked and taken apart. It depends on its own parameters alone: share it between sets.
#[derive(Clone, Debug)]
pub struct Ready {
    placed: Placed,
    key: Vec<u64>,
    pub(super) parts: Vec<Part<f64>>,
    /// From the place, in plan, in metres: nothing outside of it changes.
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    /// The least extent in metres: what a grid must resolve to show the stamp.
    pub(super) narrow: f64,
}

impl Ready {
    /// Checks a stamp, and takes it apart; `path` is what messages call it.
    ///
    /// # Errors
    /// A parameter that is not finite or out of its range, or a path that can't be followed.
    pub fn new(placed: &Placed, path: &str) -> Result<Self, StampError> {
        placed.check(path)?;
        let placed = Placed { place: Place::new(placed.place.cell, placed.place.offset), ..placed.clone() };
        let parts = parts(&placed);
        let falloff = falloff(&placed.edit);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut narrow = f64::INFINITY;
        for part in &parts {
            let reach = part.reach(falloff);
            for k in 0..2 {
                low[k] = low[k].min(part.centre[k] - reach[k]);
                high[k] = high[k].max(part.centre[k] + reach[k]);
            }
            narrow = narrow.min(2.0 * (part.extent[0].min(part.extent[1]) + part.radius + falloff));
        }
        Ok(Self { key: key(&placed), placed, parts, low, high, narrow })
    }

    /// The stamp.
    pub fn placed(&self) -> &Placed {
        &self.placed
    }

    /// What stamps are sorted by: the order, then all else, the place last. Equal for equal stamps only.
    pub(super) fn key(&self) -> &[u64] {
        &self.key
    }

    /// How far outside of its shape it does something.
    pub(super) fn falloff(&self) -> f64 {
        falloff(&self.placed.edit)
    }

    /// Whether it changes the ground's height.
    pub(super) fn moves_ground(&self) -> bool {
        !self.is_hole() && !self.keeps_trees()
    }

    /// Whether it takes the ground away.
    pub(super) fn is_hole(&self) -> bool {
        self.placed.edit.mode == Mode::Hole
    }

    /// Whether it leaves the ground as it is.
    pub(super) fn keeps_trees(&self) -> bool {
        self.placed.edit.mode == Mode::KeepTrees
    }
}

fn falloff(edit: &Edit) -> f64 {
    if edit.mode == Mode::Hole { 0.0 } else { edit.falloff }
}

impl Part<f64> {
    /// How far from its centre it reaches, along x and z.
    pub(super) fn reach(&self, falloff: f64) -> [f64; 2] {
        let [cos, sin] = self.axis.map(f64::abs);
        let round = self.radius + falloff;
        [cos * self.extent[0] + sin * self.extent[1] + round, sin * self.extent[0] + cos * self.extent[1] + round]
    }

    /// The heights that its plane has where it reaches.
    pub(super) fn heights(&self, falloff: f64) -> [f64; 2] {
        let reach = self.reach(falloff);
        let by = self.slope[0].abs() * reach[0] + self.slope[1].abs() * reach[1];
        [self.height - by, self.height + by]
    }
}

fn parts(Placed { heading, edit, place, .. }: &Placed) -> Vec<Part<f64>> {
    let (cos, sin) = (libm::cos(*heading), libm::sin(*heading));
    let height = place.cell[1] as f64 * crate::CELL + place.offset[1];
    let (height, levels) = match edit.mode {
        Mode::Raise(by) => (by, 0.0),
        Mode::Lower(by) => (-by, 0.0),
        Mode::Flatten => (height, 1.0),
        Mode::KeepTrees | Mode::Hole => (0.0, 0.0),
    };
    let whole = Part {
        centre: [0.0; 2],
        axis: [cos, sin],
        extent: [0.0; 2],
        radius: 0.0,
        per_falloff: 1.0 / edit.falloff,
        height,
        presence: 1.0,
        slope: [0.0; 2],
        levels,
        last: true,
    };
    match &edit.shape {
        Shape::Disc(disc) => vec![Part { radius: disc.radius, ..whole }],
        Shape::Rectangle(rectangle) => {
            let half = rectangle.size.map(|size| 0.5 * size);
            let radius = rectangle.corner.min(half[0]).min(half[1]);
            vec![Part { extent: half.map(|half| half - radius), radius, ..whole }]
        }
        Shape::Path(path) => {
            let radius = 0.5 * path.width;
            let turned = |[x, y, z]: [f64; 3]| [x * cos - z * sin, y, x * sin + z * cos];
            let points: Vec<_> = path.points.iter().map(|point| turned(*point)).collect();
            let mut parts: Vec<_> = straights(&points, 0.01 + 0.005 * (radius + falloff(edit)))
                .into_iter()
                .map(|[from, to]| {
                    let (x, z) = (to[0] - from[0], to[2] - from[2]);
                    let length = (x * x + z * z).sqrt();
                    let axis = [x / length, z / length];
                    let climb = if levels > 0.0 { (to[1] - from[1]) / length } else { 0.0 };
                    Part {
                        centre: [0.5 * (from[0] + to[0]), 0.5 * (from[2] + to[2])],
                        axis,
                        extent: [0.5 * length, 0.0],
                        radius,
                        height: height + levels * 0.5 * (from[1] + to[1]),
                        slope: axis.map(|axis| climb * axis),
                        last: false,
                        ..whole
                    }
                })
                .collect();
            if let Some(last) = parts.last_mut() {
                last.last = true;
            }
            parts
        }
    }
}

fn key(Placed { place, heading, edit }: &Placed) -> Vec<u64> {
    // Exhaustive, so that no parameter is forgotten.
    let Edit { shape, mode, falloff, order } = edit;
    let mut key = vec![(i64::from(*order) as u64) ^ (1 << 63)];
    let mut push = |tag: u64, numbers: &[f64]| {
        key.push(tag);
        key.extend(numbers.iter().map(|x| x.to_bits()));
    };
    match mode {
        Mode::Raise(by) => push(0, &[*by]),
        Mode::Lower(by) => push(1, &[*by]),
        Mode::Flatten => push(2, &[]),
        Mode::KeepTrees => push(3, &[]),
        Mode::Hole => push(4, &[]),
    }
    match shape {
        Shape::Disc(disc) => push(0, &[disc.radius]),
        Shape::Rectangle(rectangle) => push(1, &[rectangle.size[0], rectangle.size[1], rectangle.corner]),
        Shape::Path(path) => push(2, &[&[path.width], path.points.as_flattened()].concat()),
    }
    push(0, &[*falloff, *heading]);
    push(0, &place.offset);
    key.extend(place.cell.map(|cell| cell as u64));
    key
}
