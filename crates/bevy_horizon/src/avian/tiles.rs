//! Which tiles there are: under every body at once, around it ahead of time, and none where no body is near.

use avian3d::prelude::*;
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use horizon_field::stamp::Area;
use horizon_field::{CELL, Place};

use super::heights::ground_collider;
use super::settings::TileSettings;
use crate::query::HorizonQuery;
use crate::world::{CompiledTerrain, GroundChanged, WorldOrigin};

/// A piece of ground as a static body. Who despawns one that is still needed gets a new one, with the heights of then.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct GroundTile {
    /// The terrain that it is of.
    pub terrain: Entity,
    /// Which one it is: from `index · side` to `(index + 1) · side` along the field's x and z.
    pub index: [i64; 2],
    /// Its centre, as a place of the field; the height is that of the ground in the middle.
    pub centre: Place,
}

/// How many tiles away from its middle one the tiles of a single body go, whatever its size and speed.
const WIDEST: i64 = 8;

/// A tile that no body asks for, but that stays if it is there.
const KEPT: i64 = i64::MAX;

/// Where a body may be within a step: x and z, in Bevy's coordinates.
#[derive(Clone, Copy, Debug)]
struct Footprint {
    low: Vec2,
    high: Vec2,
}

impl Footprint {
    fn grown(&self, by: f32) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }
}

/// A grid of tiles, fixed to a terrain's field.
struct Lattice {
    origin: Place,
    /// Of the terrain.
    translation: Vec3,
    /// Of a tile; a power of two, so that no index is rounded.
    side: f64,
}

impl Lattice {
    /// The tile at x and z.
    fn index(&self, at: Vec2) -> [i64; 2] {
        let [x, z] = [at.x - self.translation.x, at.y - self.translation.z].map(f64::from);
        let place = self.origin.translated([x, 0.0, z]);
        [0, 2].map(|axis| {
            let first = place.cell[axis].wrapping_mul((CELL / self.side) as i64);
            first.wrapping_add((place.offset[axis] / self.side).floor() as i64)
        })
    }

    /// A tile's centre at height 0 of the field.
    fn centre(&self, [x, z]: [i64; 2]) -> Place {
        Place::of_cell([x, 0, z], self.side).translated([0.5 * self.side, 0.0, 0.5 * self.side])
    }

    /// The tiles that bodies ask for, each with how many tiles it is away from the nearest body: 0 where one may touch it.
    fn needs(&self, footprints: &[Footprint], settings: &TileSettings) -> HashMap<[i64; 2], i64> {
        let mut needs = HashMap::default();
        for touched in footprints {
            let middle = self.index(0.5 * (touched.low + touched.high));
            let within = |footprint: Footprint| {
                let (low, high) = (self.index(footprint.low), self.index(footprint.high));
                [0, 1].map(|axis| {
                    let steps = [low, high].map(|end| end[axis].wrapping_sub(middle[axis]));
                    [steps[0].clamp(-WIDEST, 0), steps[1].clamp(0, WIDEST)]
                })
            };
            let touch = within(*touched);
            let reach = within(touched.grown(settings.reach));
            let keep = within(touched.grown(settings.reach + settings.keep));
            for x in keep[0][0]..=keep[0][1] {
                for z in keep[1][0]..=keep[1][1] {
                    let away = |range: [[i64; 2]; 2]| {
                        let [x, z] = [(x, range[0]), (z, range[1])].map(|(at, [low, high])| (low - at).max(at - high));
                        x.max(z).max(0)
                    };
                    let need = if away(reach) == 0 { away(touch) } else { KEPT };
                    let index = [middle[0].wrapping_add(x), middle[1].wrapping_add(z)];
                    needs.entry(index).and_modify(|known: &mut i64| *known = need.min(*known)).or_insert(need);
                }
            }
        }
        needs
    }
}

/// Where a place of a terrain's field lies in Bevy's coordinates.
pub(super) fn position(place: &Place, origin: &WorldOrigin, translation: Vec3) -> Vec3 {
    let [x, y, z] = place.minus(&origin.0);
    let [tx, ty, tz] = translation.to_array().map(f64::from);
    Vec3::new((x + tx) as f32, (y + ty) as f32, (z + tz) as f32)
}

type Terrains<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        Ref<'static, CompiledTerrain>,
        &'static GlobalTransform,
        Option<&'static Friction>,
        Option<&'static Restitution>,
        Option<&'static CollisionLayers>,
    ),
>;

type Bodies<'w, 's> = Query<
    'w,
    's,
    (Entity, &'static RigidBody, &'static LinearVelocity, &'static RigidBodyColliders, Has<Sleeping>),
    Without<RigidBodyDisabled>,
>;

type Colliders<'w, 's> = Query<
    'w,
    's,
    (&'static Collider, &'static Position, &'static Rotation),
    (Without<Sensor>, Without<ColliderDisabled>),
>;

/// Makes the tiles that are needed, and removes those that are not.
pub(super) fn make_tiles(
    mut commands: Commands,
    settings: Res<TileSettings>,
    mut good: Local<TileSettings>,
    terrains: Terrains,
    world: HorizonQuery,
    mut changed: MessageReader<GroundChanged>,
    origin: Res<WorldOrigin>,
    tiles: Query<(Entity, &GroundTile)>,
    bodies: Bodies,
    colliders: Colliders,
    time: Res<Time>,
) {
    let relaid = settings.is_changed() && adopt(&settings, &mut good);
    let footprints = footprints(&bodies, &colliders, time.delta_secs());
    let mut of_terrain: HashMap<Entity, HashMap<[i64; 2], Entity>> = HashMap::default();
    for (entity, tile) in &tiles {
        of_terrain.entry(tile.terrain).or_default().insert(tile.index, entity);
    }
    let mut stamped: HashMap<Entity, Vec<Area>> = HashMap::default();
    for change in changed.read() {
        stamped.entry(change.terrain).or_default().extend(&change.areas);
    }
    for (terrain, compiled, transform, friction, restitution, layers) in &terrains {
        let mut there = of_terrain.remove(&terrain).unwrap_or_default();
        if relaid || compiled.is_changed() {
            if !there.is_empty() {
                wake(&bodies, &mut commands);
            }
            there.drain().for_each(|(_, tile)| commands.entity(tile).despawn());
        }
        if let Some(areas) = stamped.get(&terrain) {
            let half = 0.5 * f64::from(good.side);
            let meets = |entity: Entity| {
                let centre = tiles.get(entity).map(|(_, tile)| tile.centre);
                centre.is_ok_and(|centre| areas.iter().any(|area| area.meets(&centre, half)))
            };
            let before = there.len();
            there.retain(|_, tile| {
                let stays = !meets(*tile);
                if !stays {
                    commands.entity(*tile).despawn();
                }
                stays
            });
            if there.len() < before {
                wake(&bodies, &mut commands);
            }
        }
        let Some(ground) = world.ground(Some(terrain)) else { continue };
        let translation = transform.translation();
        let lattice = Lattice { origin: origin.0, translation, side: good.side.into() };
        let needs = lattice.needs(&footprints, &good);
        for (index, tile) in &there {
            if !needs.contains_key(index) {
                commands.entity(*tile).despawn();
            }
        }
        let asked = needs.into_iter().filter(|(index, away)| *away != KEPT && !there.contains_key(index));
        let mut missing: Vec<_> = asked.map(|(index, away)| (away, index)).collect();
        missing.sort_unstable();
        let at_once = missing.partition_point(|(away, _)| *away == 0);
        missing.truncate(at_once + good.ahead as usize);
        for (_, index) in missing {
            let mut centre = lattice.centre(index);
            let mut at = position(&centre, &origin, translation);
            at.y = ground.height(at);
            let level = origin.0.translated([0.0, f64::from(at.y) - f64::from(translation.y), 0.0]);
            (centre.cell[1], centre.offset[1]) = (level.cell[1], level.offset[1]);
            let Some(collider) = ground_collider(&ground, at, good.side, good.cells) else { continue };
            let tile = GroundTile { terrain, index, centre };
            let pose = (Transform::from_translation(at), Position(at), Rotation::default());
            let mut tile = commands.spawn((tile, pose, RigidBody::Static, collider));
            if let Some(friction) = friction {
                tile.insert(*friction);
            }
            if let Some(restitution) = restitution {
                tile.insert(*restitution);
            }
            if let Some(layers) = layers {
                tile.insert(*layers);
            }
        }
    }
    // Those of terrains that are no more.
    if !of_terrain.is_empty() {
        wake(&bodies, &mut commands);
    }
    for tile in of_terrain.into_values().flat_map(HashMap::into_values) {
        commands.entity(tile).despawn();
    }
}

/// Wakes all bodies that sleep: without their ground they would hang in the air.
fn wake(bodies: &Bodies, commands: &mut Commands) {
    for (body, ..) in bodies.iter().filter(|(.., asleep)| *asleep) {
        commands.queue(WakeBody(body));
    }
}

/// Takes settings over, and says whether tiles have another shape now.
fn adopt(settings: &TileSettings, good: &mut TileSettings) -> bool {
    if let Err(error) = settings.check() {
        error!("tile settings were rejected, what was there before stays: {error}");
        return false;
    }
    let relaid = (settings.side, settings.cells) != (good.side, good.cells);
    *good = settings.clone();
    relaid
}

/// Where the colliders of all bodies that move may be within a step.
fn footprints(bodies: &Bodies, colliders: &Colliders, seconds: f32) -> Vec<Footprint> {
    let mut footprints = Vec::new();
    for (_, _, velocity, of_body, _) in bodies.iter().filter(|(_, body, ..)| !body.is_static()) {
        // Gravity, and what contacts make of the velocity, are small against a tenth of a metre a step.
        let travel = velocity.0.length() * seconds + 0.1;
        for (collider, position, rotation) in of_body.into_iter().filter_map(|collider| colliders.get(collider).ok()) {
            let aabb = collider.aabb(position.0, *rotation);
            let footprint = Footprint { low: aabb.min.xz(), high: aabb.max.xz() }.grown(travel);
            if footprint.low.is_finite() && footprint.high.is_finite() {
                footprints.push(footprint);
            }
        }
    }
    footprints
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(origin: Place) -> Lattice {
        Lattice { origin, translation: Vec3::ZERO, side: 16.0 }
    }

    #[test]
    fn tiles_are_where_their_index_says_wherever_the_origin_is() {
        for metres in [[0.0; 3], [1e9, 0.0, -1e9], [-1e9 - 0.125, 0.0, 1e9 + 7.5]] {
            let origin = Place::from_metres(metres);
            let lattice = lattice(origin);
            for (x, z) in [(0.0, 0.0), (-0.5, 15.5), (4000.25, -3999.75), (16.0, -16.0)] {
                let index = lattice.index(Vec2::new(x, z));
                let [dx, _, dz] = lattice.centre(index).minus(&origin.translated([x.into(), 0.0, z.into()]));
                // From the point to the centre: half a side at most, and the lower border belongs to the tile.
                assert!(-8.0 < dx && dx <= 8.0 && -8.0 < dz && dz <= 8.0, "{x} {z} at {metres:?}: {dx} {dz}");
            }
        }
    }

    #[test]
    fn what_is_touched_comes_first_and_what_is_far_is_kept() {
        let settings = TileSettings { reach: 8.0, keep: 16.0, ..default() };
        let small = Footprint { low: Vec2::splat(7.0), high: Vec2::splat(9.0) };
        let needs = lattice(Place::ORIGIN).needs(&[small], &settings);
        let of = |needs: &HashMap<[i64; 2], i64>, x: i64, z: i64| needs.get(&[x, z]).copied();
        assert_eq!(of(&needs, 0, 0), Some(0));
        assert_eq!([of(&needs, 1, 0), of(&needs, -1, -1)], [Some(1); 2]);
        assert_eq!([of(&needs, 2, 0), of(&needs, -2, 1)], [Some(KEPT); 2]);
        assert_eq!((of(&needs, 3, 0), needs.len()), (None, 25));
        // A second body touches what the first only keeps.
        let other = Footprint { low: Vec2::splat(33.0), high: Vec2::splat(34.0) };
        let needs = lattice(Place::ORIGIN).needs(&[small, other], &settings);
        assert_eq!([of(&needs, 0, 0), of(&needs, 2, 2)], [Some(0); 2]);
    }

    #[test]
    fn a_body_without_bounds_asks_for_a_bounded_number() {
        let vast = Footprint { low: Vec2::splat(-1e9), high: Vec2::splat(1e9) };
        let needs = lattice(Place::ORIGIN).needs(&[vast], &TileSettings::default());
        assert_eq!(needs.len() as i64, (2 * WIDEST + 1) * (2 * WIDEST + 1));
    }
}
