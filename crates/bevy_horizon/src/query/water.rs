//! Questions about water: where its surface stands, for what floats; what one is in, for sound and swimming.

use bevy::prelude::*;
use horizon_field::{CELL, Place};

use super::HorizonQuery;
use crate::world::{CompiledWater, WaterPlace, WorldOrigin};

/// What is at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surroundings {
    /// Air.
    Air,
    /// Water.
    Water {
        /// The body of water.
        entity: Entity,
        /// Metres under its surface, waves included.
        depth: f32,
    },
    /// The inside of the ground.
    Ground,
}

/// The surface of a body of water at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterSurface {
    /// The body of water.
    pub entity: Entity,
    /// Its height, in Bevy's coordinates, waves included.
    pub height: f32,
    /// Its unit normal.
    pub normal: Vec3,
}

/// The water that questions are asked of.
pub(super) type Waters<'w, 's> =
    Query<'w, 's, (Entity, &'static CompiledWater, Option<&'static WaterPlace>, &'static GlobalTransform)>;

/// Where the lattice of tiles is at a place: x and z from the world's origin.
fn on_tiles(place: &Place) -> [f64; 2] {
    [0, 2].map(|i| place.cell[i] as f64 * CELL + place.offset[i])
}

impl HorizonQuery<'_, '_> {
    /// The bodies of water at a position: each with its middle, and where the position is on its tiles.
    fn waters_at(&self, position: Vec3) -> impl Iterator<Item = (Entity, &CompiledWater, f64, [f64; 2])> {
        let origin = WorldOrigin(self.origin.0);
        let place = origin.place(position);
        self.waters.iter().filter_map(move |(entity, compiled, at, transform)| {
            let middle = at.map_or_else(|| origin.place(transform.translation()), |at| at.0);
            let [x, _, z] = place.minus(&middle);
            let level = middle.minus(&origin.0)[1];
            compiled.contains([x, z]).then_some((entity, compiled, level, on_tiles(&place)))
        })
    }

    /// The height of the water's surface over or under a position, in Bevy's coordinates, at a time in seconds: that of
    /// [`WaterTime`](crate::world::WaterTime) is what is drawn. Where there are several bodies, the highest. `None` where there is none; whether the
    /// ground stands higher is not asked.
    ///
    /// Within a millimetre of what is drawn near by. Thousands of questions for one time cost little more than the first.
    pub fn water_height(&self, position: Vec3, time: f64) -> Option<f32> {
        Some(self.water_surface(position, time)?.height)
    }

    /// The water's surface over or under a position, at a time in seconds, as [`HorizonQuery::water_height`] has it.
    pub fn water_surface(&self, position: Vec3, time: f64) -> Option<WaterSurface> {
        self.waters_at(position)
            .map(|(entity, compiled, level, at)| {
                let waves = compiled.surface.as_ref();
                let height = (level + waves.map_or(0.0, |waves| waves.height(at, time))) as f32;
                let normal = waves.map_or([0.0, 1.0, 0.0], |waves| waves.normal(at, time));
                WaterSurface { entity, height, normal: Vec3::from_array(normal.map(|x| x as f32)) }
            })
            .max_by(|a, b| a.height.total_cmp(&b.height))
    }

    /// What is at a position at a time in seconds: air, water and how deep in it, or the inside of the ground.
    pub fn surroundings(&self, position: Vec3, time: f64) -> Surroundings {
        if self.height(position).is_some_and(|ground| position.y < ground) {
            return Surroundings::Ground;
        }
        match self.water_surface(position, time) {
            Some(water) if position.y < water.height => {
                Surroundings::Water { entity: water.entity, depth: water.height - position.y }
            }
            _ => Surroundings::Air,
        }
    }
}
