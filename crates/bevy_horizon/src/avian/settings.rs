//! How tiles are laid.

use bevy::prelude::*;
use horizon_field::field::Param;
use thiserror::Error;

use crate::world::{ParamError, check_params};

/// How the ground's collider tiles are laid. A resource; after a bad edit the last good one stays in use.
///
/// Tiles are triangles between samples of the field: with cells of Δ metres they are off by up to Δ²/8 · |f″|, and so are
/// bodies. On ground with waves down to 2.5 m and slopes up to 35° the default is off by 8 mm at most and by 2 mm on
/// average; doubling the cells quarters that.
#[derive(Resource, Clone, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Clone, PartialEq)]
pub struct TileSettings {
    /// The side of a tile: a power of two, from 4 to 256 m. Default: 16.
    #[reflect(@Param { min: 4.0, max: 256.0, unit: "m", help: "The side of a tile, a power of two" })]
    pub side: f32,
    /// How many cells a tile has along each side; 1 to 256. Default: 64, so that a cell measures 0.25 m.
    #[reflect(@Param { min: 1.0, max: 256.0, unit: "", help: "Cells along a tile's side" })]
    pub cells: u32,
    /// How far around each body tiles are made ahead; 0 to 256 m. Default: 8.
    #[reflect(@Param { min: 0.0, max: 256.0, unit: "m", help: "How far around bodies tiles are made ahead" })]
    pub reach: f32,
    /// How much farther than [`TileSettings::reach`] a body must be before a tile goes, so that one that turns back finds it;
    /// 0 to 256 m. Default: 16.
    #[reflect(@Param { min: 0.0, max: 256.0, unit: "m", help: "How much farther tiles are kept" })]
    pub keep: f32,
    /// How many tiles a step makes ahead; 0 to 256. Those that a body may touch in this step are made besides, however many
    /// they are. Default: 4.
    #[reflect(@Param { min: 0.0, max: 256.0, unit: "", help: "Tiles made ahead in a step" })]
    pub ahead: u32,
    /// Whether a dynamic body whose centre of mass got under the ground is put back onto it. Default: yes.
    pub net: bool,
    /// Whether all bodies that have no parent are shifted when the [`WorldOrigin`](crate::world::WorldOrigin) moves, so that
    /// they stay where they are in the world. Default: no, the game shifts its entities.
    pub carry_bodies: bool,
}

impl Default for TileSettings {
    fn default() -> Self {
        Self { side: 16.0, cells: 64, reach: 8.0, keep: 16.0, ahead: 4, net: true, carry_bodies: false }
    }
}

/// Why tile settings were rejected.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TileError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Param(#[from] ParamError),
    /// Tiles would not fit the cells of places.
    #[error("tiles.side is {0}, but must be a power of two")]
    Side(f32),
}

impl TileSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn check(&self) -> Result<(), TileError> {
        check_params("tiles", self)?;
        // Exact: in this range every power of two is a whole number.
        if self.side.fract() != 0.0 || !(self.side as u32).is_power_of_two() {
            return Err(TileError::Side(self.side));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_settings_name_their_field() {
        assert_eq!(TileSettings::default().check(), Ok(()));
        assert_eq!(TileSettings { side: 20.0, ..default() }.check(), Err(TileError::Side(20.0)));
        assert_eq!(TileSettings { side: 4.5, ..default() }.check(), Err(TileError::Side(4.5)));
        for (bad, name) in [
            (TileSettings { side: f32::NAN, ..default() }, "tiles.side"),
            (TileSettings { cells: 0, ..default() }, "tiles.cells"),
            (TileSettings { reach: f32::INFINITY, ..default() }, "tiles.reach"),
            (TileSettings { keep: -1.0, ..default() }, "tiles.keep"),
            (TileSettings { ahead: 1000, ..default() }, "tiles.ahead"),
        ] {
            let Err(TileError::Param(error)) = bad.check() else { panic!("{bad:?} passed") };
            assert_eq!(error.field, name);
        }
    }
}
