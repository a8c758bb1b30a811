//! The parameters of stamps: meaning, unit, range and default, once each.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use crate::field::check::{check_number, check_numbers};
use crate::field::param::{Numbers, Param, Params, node};
use crate::{CELL, FieldError, Place};

/// The parameter of [`Mode::Raise`] and [`Mode::Lower`].
pub const BY: Param = Param { min: -1e5, max: 1e5, unit: "m", help: "By how much." };

/// The height of a stamp's place.
pub const HEIGHT: Param = Param { min: -1e6, max: 1e6, unit: "m", help: "The height of the stamp." };

/// The heading of a stamp.
pub const HEADING: Param = Param { min: -1e3, max: 1e3, unit: "rad", help: "The heading, from −z towards +x." };

/// How many points a path may have.
pub const MAX_POINTS: usize = 256;

/// How near, in metres, two successive points of a path may be in plan.
const NEAREST: f64 = 1e-3;

node! {
    /// A round stamp.
    Disc {
        radius: f64 = 10.0, "The radius within which the stamp is whole.", in 0.0 .. 1e5 "m";
    }
}

node! {
    /// A rectangle with round corners, which may be.
    Rectangle {
        size: [f64; 2] = [10.0; 2], "The extent within which the stamp is whole, along its own x and z.", in 0.0 .. 1e5 "m";
        corner: f64 = 0.0, "The radius of the corners; at most half of the shorter extent counts.", in 0.0 .. 1e5 "m";
    }
}

node! {
    /// A strip along a smooth curve through points.
    Path {
        points: Vec<[f64; 3]> = vec![[0.0, 0.0, -10.0], [0.0, 0.0, 10.0]], "The points, from the stamp's place, in its own axes; 2 to 256 of them.", in -1e6 .. 1e6 "m";
        width: f64 = 6.0, "The width within which the stamp is whole.", in 0.0 .. 1e5 "m";
    }
}

/// Where a stamp is whole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
#[serde(deny_unknown_fields)]
pub enum Shape {
    /// A disc around the stamp's place.
    Disc(Disc),
    /// A rectangle around the stamp's place.
    Rectangle(Rectangle),
    /// A strip along a curve.
    Path(Path),
}

impl Default for Shape {
    fn default() -> Self {
        Self::Disc(Disc::default())
    }
}

/// What a stamp does to the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
#[serde(deny_unknown_fields)]
pub enum Mode {
    /// Raises it by so much, in metres; from −10⁵ to 10⁵.
    Raise(#[cfg_attr(feature = "reflect", reflect(@BY))] f64),
    /// Lowers it by so much, in metres; from −10⁵ to 10⁵.
    Lower(#[cfg_attr(feature = "reflect", reflect(@BY))] f64),
    /// Levels it to the height of the stamp's place; along a path, to the height of the path.
    #[default]
    Flatten,
    /// Leaves it as it is, and keeps plants away: see [`StampsAt::clearing`](super::StampsAt::clearing).
    KeepTrees,
    /// Takes it away: within the shape there is no ground, up to a crisp edge. A hole wins over whatever else is done to the
    /// ground there, and a falloff has no part in it. See [`StampsAt::is_hole`](super::StampsAt::is_hole).
    Hole,
}

node! {
    /// A local edit of the ground, apart from where it is.
    Edit {
        shape: Shape = Shape::default(), "Where it is whole.";
        mode: Mode = Mode::Flatten, "What it does.";
        falloff: f64 = 10.0, "How far outside of its shape it fades out.", in 0.1 .. 1e5 "m";
        order: i32 = 0, "When it comes: of two stamps that level the same ground, the one of the higher order counts. Any value. Among equals those that raise come first, and then the parameters decide, never who was spawned first.";
    }
}

/// An edit at a place of the world: what files hold, and what is sent to other players.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Placed {
    /// Where; [`Mode::Flatten`] levels the ground to its y, from −10⁶ to 10⁶ metres. Default: the world's origin.
    pub place: Place,
    /// The direction of the stamp's own −z, from −z (north) towards +x (east), from −1000 to 1000 radians. Default: 0.
    pub heading: f64,
    /// What is done there.
    pub edit: Edit,
}

/// Why a stamp is refused. `path` names the parameter, such as `stamps[2].edit.falloff`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each message says what its fields are")]
pub enum StampError {
    /// A parameter is not finite, or outside its range.
    #[error(transparent)]
    Param(#[from] FieldError),
    /// A path of too few or too many points.
    #[error("{path} holds {points} points, outside 2 to {MAX_POINTS}")]
    Points { path: String, points: usize },
    /// Two successive points of a path are the same in plan: what lies between them has no direction.
    #[error("{path}[{index}] lies above or below the point before it: nearer than 1 mm in plan")]
    Coincident { path: String, index: usize },
}

impl Edit {
    /// Refuses what can't be computed; `path` is what messages call the edit.
    pub fn check(&self, path: &str) -> Result<(), StampError> {
        check_numbers(self, &|| path.into())?;
        match self.mode {
            Mode::Raise(by) => check_number("", &BY, by, &|| format!("{path}.mode.Raise"))?,
            Mode::Lower(by) => check_number("", &BY, by, &|| format!("{path}.mode.Lower"))?,
            Mode::Flatten | Mode::KeepTrees | Mode::Hole => {}
        }
        let inner = |name: &str| format!("{path}.shape.{name}");
        match &self.shape {
            Shape::Disc(disc) => check_numbers(disc, &|| inner("Disc"))?,
            Shape::Rectangle(rectangle) => check_numbers(rectangle, &|| inner("Rectangle"))?,
            Shape::Path(Path { points, .. }) if !(2..=MAX_POINTS).contains(&points.len()) => {
                return Err(StampError::Points { path: inner("Path.points"), points: points.len() });
            }
            Shape::Path(path) => {
                check_numbers(path, &|| inner("Path"))?;
                let near = |pair: &[[f64; 3]]| (pair[1][0] - pair[0][0]).hypot(pair[1][2] - pair[0][2]) < NEAREST;
                if let Some(at) = path.points.windows(2).position(near) {
                    return Err(StampError::Coincident { path: inner("Path.points"), index: at + 1 });
                }
            }
        }
        Ok(())
    }
}

impl Placed {
    /// Refuses what can't be computed; `path` is what messages call the stamp.
    pub fn check(&self, path: &str) -> Result<(), StampError> {
        for (axis, offset) in self.place.offset.into_iter().enumerate() {
            if !offset.is_finite() {
                return Err(
                    FieldError::NotFinite { path: format!("{path}.place.offset[{axis}]"), value: offset }.into()
                );
            }
        }
        check_number("place", &HEIGHT, self.height(), &|| path.into())?;
        check_number("heading", &HEADING, self.heading, &|| path.into())?;
        self.edit.check(&format!("{path}.edit"))
    }

    /// The height of the place, in metres above the world's zero.
    pub(super) fn height(&self) -> f64 {
        self.place.cell[1] as f64 * CELL + self.place.offset[1]
    }
}

/// The heading of a stamp whose own +x points along this x and z; 0 where that is upright.
pub fn heading_of(x: f64, z: f64) -> f64 {
    libm::atan2(z, x)
}
