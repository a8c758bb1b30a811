//! Where in the world Bevy's origin lies.

use bevy::prelude::*;
use horizon_field::Place;

/// The place of the world that Bevy's (0, 0, 0) stands for: a 64-bit cell and an f64 offset. A game that lets its
/// players walk far moves the origin along, and shifts its entities by the same amount: not a pixel changes.
///
/// Default: the world's own origin.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldOrigin(pub Place);

impl WorldOrigin {
    /// The origin at these metres from the world's origin.
    pub fn from_metres(metres: [f64; 3]) -> Self {
        Self(Place::from_metres(metres))
    }

    /// The place of the world at a position in Bevy's coordinates, in metres.
    pub fn place(&self, position: Vec3) -> Place {
        self.0.translated(position.to_array().map(f64::from))
    }

    /// The position in Bevy's coordinates, in metres, of a place of the world.
    pub fn position(&self, place: &Place) -> Vec3 {
        Vec3::from_array(place.minus(&self.0).map(|x| x as f32))
    }
}
