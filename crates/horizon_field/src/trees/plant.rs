//! One plant, and its record for the device.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
use serde::{Deserialize, Serialize};

use crate::Place;

/// Words of a record.
pub const RECORD_WORDS: usize = 8;

/// The bit of a record's flags that says that a plant stands there.
const STANDS: u32 = 1;

/// A plant's name, which stays: the cell in which it grows, along x and z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq, Hash))]
#[serde(transparent)]
pub struct PlantId(pub [i64; 2]);

/// A plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plant {
    /// Its name.
    pub id: PlantId,
    /// The foot of its trunk, on the ground.
    pub place: Place,
    /// Where it stands in its cell, along x and z: 65535 is the far side.
    pub offset: [u16; 2],
    /// From the foot to the top, in metres.
    pub height: f32,
    /// The crown's radius, in metres.
    pub radius: f32,
    /// Which of the forest's species it is.
    pub species: u8,
    /// Its turn about the trunk, in 256ths.
    pub turn: u8,
    /// From the youngest, 0, to the oldest, 255: for colours.
    pub tint: u8,
    /// Random bits, its own.
    pub hash: u32,
    /// The ground's normal at its foot, along x and z; the normal's y is positive.
    pub normal: [f32; 2],
}

impl Plant {
    /// The foot's height in metres above the world's zero.
    pub fn foot(&self) -> f64 {
        self.place.cell[1] as f64 * crate::CELL + self.place.offset[1]
    }

    /// The record that the device reads, `Plant` in `solids.wgsl`: heights are metres above `datum`, itself metres above the
    /// world's zero. A cell without a plant has a record of zeros.
    pub fn to_words(&self, datum: f64) -> [u32; RECORD_WORDS] {
        let pair = |[low, high]: [u32; 2]| low | high << 16;
        let snorm = |x: f32| u32::from((x.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16);
        let kind = [u32::from(self.species) & 15, STANDS << 4, u32::from(self.turn) << 8, u32::from(self.tint) << 16];
        [
            pair(self.offset.map(u32::from)),
            ((self.foot() - datum) as f32).to_bits(),
            self.height.to_bits(),
            self.radius.to_bits(),
            kind.iter().sum(),
            self.hash,
            pair(self.normal.map(snorm)),
            0,
        ]
    }
}
