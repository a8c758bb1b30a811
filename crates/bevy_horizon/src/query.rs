//! Questions that the world answers on the CPU, in the same frame, without asking the device.

mod water;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use horizon_field::CELL;
use horizon_field::march::{Anchored, Cast, Ray, Surface};
use horizon_field::trees::{ForestError, Plant, PlantId};

pub use self::water::{Surroundings, WaterSurface};
use crate::world::{CompiledStamps, CompiledTerrain, CompiledTrees, WorldOrigin};

/// Asks the ground: height, normal, slope, ray cast. Positions are Bevy's, in metres; the answer is that of the full
/// field with all its octaves and [`Stamp`](crate::world::Stamp)s, exact to f64 wherever in the world [`WorldOrigin`] stands.
///
/// ```
/// # use bevy::prelude::*;
/// # use bevy_horizon::prelude::*;
/// fn stand_on_ground(world: HorizonQuery, mut walkers: Query<&mut Transform>) {
///     for mut walker in &mut walkers {
///         if let Some(height) = world.height(walker.translation) {
///             walker.translation.y = height;
///         }
///     }
/// }
/// ```
///
/// A terrain answers from the frame after it was spawned. Where there are several, the first one answers: ask
/// [`HorizonQuery::ground`] for one of them.
///
/// In a hole, which [`Mode::Hole`](horizon_field::stamp::Mode::Hole) cuts, there is no ground: height, normal and slope are `None` there, and
/// rays go through. Under the ground a ray does not meet its underside: only once it has come out, it may meet ground again, from above.
#[derive(SystemParam)]
pub struct HorizonQuery<'w, 's> {
    terrains:
        Query<'w, 's, (Entity, &'static CompiledTerrain, Option<&'static CompiledStamps>, &'static GlobalTransform)>,
    waters: water::Waters<'w, 's>,
    trees: Query<'w, 's, (&'static CompiledTrees, &'static GlobalTransform)>,
    origin: Res<'w, WorldOrigin>,
}

/// Where a ray meets the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundHit {
    /// The terrain.
    pub entity: Entity,
    /// Distance along the ray, in metres; 0 where the ray starts under the ground. (Under ground that has holes it goes on.)
    pub distance: f32,
    /// The point, in Bevy's coordinates.
    pub position: Vec3,
    /// The ground's unit normal.
    pub normal: Vec3,
}

/// A plant, as it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingPlant {
    /// Its name, which stays: put it into [`Felled`](crate::world::Felled), and it stands no more.
    pub id: PlantId,
    /// The foot of its trunk, in Bevy's coordinates.
    pub position: Vec3,
    /// From the foot to the top, in metres.
    pub height: f32,
    /// The crown's radius, in metres.
    pub radius: f32,
    /// Which of the forest's species it is.
    pub species: usize,
}

/// One terrain, anchored at the [`WorldOrigin`]: for questions by the thousand.
pub struct Ground<'a> {
    entity: Entity,
    surface: Anchored<'a>,
    /// Of the terrain, in Bevy's coordinates.
    translation: [f64; 3],
    /// Height of Bevy's y = 0 over the field's.
    datum: f64,
}

impl HorizonQuery<'_, '_> {
    /// The terrain of an entity, or the first one.
    pub fn ground(&self, entity: Option<Entity>) -> Option<Ground<'_>> {
        let (entity, compiled, stamps, transform) = match entity {
            Some(entity) => self.terrains.get(entity).ok()?,
            None => self.terrains.iter().next()?,
        };
        let translation = transform.translation().to_array().map(f64::from);
        let anchor = self.origin.0;
        let surface = match stamps {
            Some(stamps) => Anchored::stamped(compiled.height(), &stamps.0, &anchor),
            None => Anchored::new(compiled.height(), &anchor),
        };
        let datum = anchor.cell[1] as f64 * CELL + anchor.offset[1] - translation[1];
        Some(Ground { entity, surface, translation, datum })
    }

    /// The first terrain, where it has ground.
    fn solid(&self, position: Vec3) -> Option<Ground<'_>> {
        self.ground(None).filter(|ground| !ground.is_hole(position))
    }

    /// The ground's height under or over a position, in Bevy's coordinates; `None` in a hole, or without a terrain.
    pub fn height(&self, position: Vec3) -> Option<f32> {
        Some(self.solid(position)?.height(position))
    }

    /// The ground's heights at many positions; empty without a terrain. In holes they are those of the ground that would be
    /// there: see [`Ground::is_hole`].
    pub fn heights(&self, positions: &[Vec3]) -> Vec<f32> {
        self.ground(None).map_or_else(Vec::new, |ground| ground.heights(positions))
    }

    /// The ground's unit normal at a position; `None` in a hole, or without a terrain.
    pub fn normal(&self, position: Vec3) -> Option<Vec3> {
        Some(self.solid(position)?.normal(position))
    }

    /// The ground's slope at a position, as the tangent of its angle; `None` in a hole, or without a terrain.
    pub fn slope(&self, position: Vec3) -> Option<f32> {
        Some(self.solid(position)?.slope(position))
    }

    /// Where a ray first meets the ground, certified: no ridge is stepped over. `None` where it does not within
    /// `max_distance` metres, where a number is not finite, or without a terrain.
    pub fn ray_cast(&self, origin: Vec3, direction: Dir3, max_distance: f32) -> Option<GroundHit> {
        self.ground(None)?.ray_cast(origin, direction, max_distance)
    }

    /// The plants whose trunks stand in a rectangle of the plane, x and z in Bevy's coordinates: exactly those of the picture, as far as
    /// that shows any. None without [`Trees`](crate::world::Trees); where there are several, of the first.
    ///
    /// # Errors
    /// A rectangle of more than 2²⁴ cells of the forest, or one that is not a number.
    pub fn trees_in(&self, area: Rect) -> Result<Vec<StandingPlant>, ForestError> {
        let Some((trees, transform)) = self.trees.iter().next() else { return Ok(Vec::new()) };
        let terrain = transform.translation();
        let low = (area.min - terrain.xz()).as_dvec2();
        let corner = self.origin.0.translated([low.x, 0.0, low.y]);
        let plants = trees.woods.plants_in(&corner, area.size().as_dvec2().to_array())?;
        let standing = |plant: &Plant| StandingPlant {
            id: plant.id,
            position: self.origin.position(&plant.place) + terrain,
            height: plant.height,
            radius: plant.radius,
            species: plant.species.into(),
        };
        Ok(plants.iter().map(standing).collect())
    }

    /// Many ray casts; the answers are in the rays' order.
    pub fn ray_casts(&self, rays: &[(Vec3, Dir3)], max_distance: f32) -> Vec<Option<GroundHit>> {
        let Some(ground) = self.ground(None) else { return vec![None; rays.len()] };
        rays.iter().map(|(origin, direction)| ground.ray_cast(*origin, *direction, max_distance)).collect()
    }
}

impl Ground<'_> {
    fn local(&self, position: Vec3) -> [f64; 2] {
        [f64::from(position.x) - self.translation[0], f64::from(position.z) - self.translation[2]]
    }

    /// Whether there are holes anywhere in it.
    pub fn has_holes(&self) -> bool {
        self.surface.has_holes()
    }

    /// Whether there is no ground at a position, by a [`Mode::Hole`](horizon_field::stamp::Mode::Hole). Heights, normals and slopes are there
    /// those of the ground that would be.
    pub fn is_hole(&self, position: Vec3) -> bool {
        self.surface.is_hole(self.local(position))
    }

    /// The ground's height at a position, in Bevy's coordinates.
    pub fn height(&self, position: Vec3) -> f32 {
        (self.surface.value(self.local(position)) - self.datum) as f32
    }

    /// The ground's heights at many positions, in Bevy's coordinates: those of [`Ground::height`], several times as fast.
    pub fn heights(&self, positions: &[Vec3]) -> Vec<f32> {
        let q: Vec<_> = positions.iter().map(|p| self.local(*p)).collect();
        let mut values = vec![0.0; q.len()];
        self.surface.values(&q, &mut values);
        values.into_iter().map(|v| (v - self.datum) as f32).collect()
    }

    /// The ground's unit normal at a position.
    pub fn normal(&self, position: Vec3) -> Vec3 {
        let [x, z] = self.surface.jet(self.local(position)).g;
        Vec3::new(-x as f32, 1.0, -z as f32).normalize()
    }

    /// The ground's slope at a position, as the tangent of its angle.
    pub fn slope(&self, position: Vec3) -> f32 {
        let [x, z] = self.surface.jet(self.local(position)).g;
        x.hypot(z) as f32
    }

    /// How far plants are kept away from a position, from 0 (not at all) to 1, by stamps of [`Mode::KeepTrees`](horizon_field::stamp::Mode),
    /// and in holes.
    pub fn clearing(&self, position: Vec3) -> f32 {
        self.surface.clearing(self.local(position)) as f32
    }

    /// As [`HorizonQuery::ray_cast`].
    pub fn ray_cast(&self, origin: Vec3, direction: Dir3, max_distance: f32) -> Option<GroundHit> {
        let [x, z] = self.local(origin);
        let ray = Ray::new([x, f64::from(origin.y) + self.datum, z], direction.to_array().map(f64::from)).ok()?;
        let max_distance = f64::from(max_distance);
        match self.surface.cast(&ray, max_distance) {
            Cast::Hit(hit) => Some(GroundHit {
                entity: self.entity,
                distance: hit.t as f32,
                position: origin + direction * hit.t as f32,
                normal: Vec3::from_array(hit.normal.map(|x| x as f32)),
            }),
            Cast::Inside => {
                Some(GroundHit { entity: self.entity, distance: 0.0, position: origin, normal: self.normal(origin) })
            }
            Cast::Miss => None,
        }
    }
}
