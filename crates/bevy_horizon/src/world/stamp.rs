//! Stamps: local edits of the ground, as entities.

use std::sync::Arc;

use bevy::ecs::system::SystemParam;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::prelude::*;
use horizon_field::stamp::{Area, Edit, Mode, Placed, Ready, Shape, StampError, heading_of};
use horizon_field::{Place, Stamps};

use super::{CompiledTerrain, WorldOrigin};

/// A local edit of the ground: it raises, lowers or levels it, so that a house stands level and a road lies smooth, or cuts a hole into
/// it, for a cellar, in the picture and in all answers alike. Of a [`Terrain`](super::Terrain) that is this entity or stands above it, or else of every terrain.
///
/// The entity's `GlobalTransform` says where: its translation, and its rotation about y; [`Mode::Flatten`] levels the
/// ground to its y. It needs Bevy's `TransformPlugin`. When [`WorldOrigin`] moves and the game shifts the entity by as much, the
/// stamp stays where it is. Give it a [`StampPlace`], and it is there, wherever the origin is.
///
/// Through a hole ([`Mode::Hole`]) one sees what the game put there: meshes of walls and a floor; without any, the sky. The ground's
/// underside is not there, neither to the eye nor to rays. The edge is drawn in steps of a texel, which is as large as a pixel far
/// away, and 3 cm near by: a frame of meshes hides it. Holes in the ground let the sun through in Bevy's shadow maps; in a mesh's place
/// under the ground, beyond their reach, the sun shines as on the ground above.
///
/// ```no_run
/// # use bevy::prelude::*;
/// # use bevy_horizon::prelude::*;
/// use bevy_horizon::stamp::{Disc, Edit, Shape};
///
/// fn build_house(mut commands: Commands) {
///     let ground = Stamp(Edit { shape: Shape::Disc(Disc { radius: 12.0 }), falloff: 8.0, ..default() });
///     commands.spawn((ground, Transform::from_xyz(40.0, 310.0, -25.0)));
/// }
/// ```
#[derive(Component, Clone, Debug, Default, PartialEq, Deref, DerefMut, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
#[require(Transform)]
#[cfg_attr(feature = "render", require(Visibility))]
pub struct Stamp(pub Edit);

impl Stamp {
    /// A stamp of this shape and mode.
    pub fn new(shape: Shape, mode: Mode) -> Self {
        Self(Edit { shape, mode, ..default() })
    }
}

/// On a [`Stamp`]: where in the world it is, exactly, whatever its transform and the [`WorldOrigin`] are.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct StampPlace {
    /// The place; its y is above the field's zero.
    pub place: Place,
    /// The direction of the stamp's own −z, from −z (north) towards +x (east), in radians. Default: 0.
    pub heading: f64,
}

/// On a terrain: its stamps, made ready. Shared with queries and renderer; [`Stamps::placed`] is what to save, or to send to
/// other players. It is there once the terrain has had a stamp.
#[derive(Component, Clone, Debug, Default)]
pub struct CompiledStamps(pub Arc<Stamps>);

/// The stamps of a terrain are others: its ground is out of date in these areas of its field, for whoever keeps heights of it. A terrain
/// whose field changes sends none: look for `Changed<CompiledTerrain>`.
#[derive(Message, Clone, Debug)]
pub struct GroundChanged {
    /// The terrain.
    pub terrain: Entity,
    /// Where; around each stamp that came, went, or changed.
    pub areas: Vec<Area>,
}

/// A stamp was rejected; what it was before stays.
#[derive(Message, Clone, Debug)]
pub struct StampRejected {
    /// The stamp's entity.
    pub entity: Entity,
    /// Why.
    pub error: StampError,
}

/// How a stamp's entity stands, relative to its terrain.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pose {
    position: Vec3,
    /// x and z of its own +x.
    right: Vec2,
}

impl Pose {
    fn new(stamp: &GlobalTransform, terrain: &GlobalTransform) -> Self {
        let right = stamp.affine().transform_vector3(Vec3::X);
        Self { position: stamp.translation() - terrain.translation(), right: Vec2::new(right.x, right.z) }
    }

    fn place(&self, origin: &WorldOrigin) -> StampPlace {
        let [x, z] = [self.right.x, self.right.y].map(f64::from);
        StampPlace { place: origin.place(self.position), heading: heading_of(x, z) }
    }
}

/// A stamp of a terrain, as it was last seen.
struct Known {
    at: StampPlace,
    /// Of a stamp whose transform says where it is, with the origin that the pose is relative to.
    pose: Option<(Pose, Place)>,
    /// As it was last accepted.
    ready: Option<Arc<Ready>>,
    round: u64,
}

impl Known {
    /// Whether an entity that stands there has not moved in the world. Where the origin has, f32 has rounded its position anew.
    fn stays(&self, now: &Pose, origin: &WorldOrigin) -> bool {
        let Some((then, of)) = &self.pose else { return false };
        if *of == origin.0 {
            return then == now;
        }
        let rounding = 1e-3 + 1e-6 * (then.position.length() + now.position.length());
        then.right == now.right && (origin.position(&self.at.place) - now.position).length() <= rounding
    }
}

/// All stamps by entity and terrain.
#[derive(Default)]
pub(crate) struct KnownStamps {
    known: HashMap<(Entity, Entity), Known>,
    round: u64,
}

type Moved = (With<Stamp>, Or<(Changed<Stamp>, Changed<StampPlace>, Changed<GlobalTransform>, Changed<ChildOf>)>);

/// Whether anything happened that stamps depend on.
#[derive(SystemParam)]
pub(crate) struct StampChanges<'w, 's> {
    stamps: Query<'w, 's, (), Moved>,
    terrains: Query<'w, 's, (), (With<CompiledTerrain>, Or<(Changed<GlobalTransform>, Added<CompiledTerrain>)>)>,
    gone: RemovedComponents<'w, 's, Stamp>,
    unplaced: RemovedComponents<'w, 's, StampPlace>,
    orphans: RemovedComponents<'w, 's, ChildOf>,
    grounds: RemovedComponents<'w, 's, CompiledTerrain>,
}

impl StampChanges<'_, '_> {
    fn any(&mut self) -> bool {
        // Each is read to its end, so that no message is met twice.
        let removed = self.gone.read().count()
            + self.unplaced.read().count()
            + self.orphans.read().count()
            + self.grounds.read().count();
        removed > 0 || !self.stamps.is_empty() || !self.terrains.is_empty()
    }
}

type StampEntities<'w, 's> =
    Query<'w, 's, (Entity, Ref<'static, Stamp>, &'static GlobalTransform, Option<&'static StampPlace>)>;

/// Makes stamps ready that are new or changed, and gives each terrain whose stamps are not the same any more its set.
pub(crate) fn compile_stamps(
    mut commands: Commands,
    mut changes: StampChanges,
    origin: Res<WorldOrigin>,
    stamps: StampEntities,
    terrains: Query<(Entity, &GlobalTransform, Option<&CompiledStamps>), With<CompiledTerrain>>,
    parents: Query<&ChildOf>,
    mut all: Local<KnownStamps>,
    mut changed: MessageWriter<GroundChanged>,
    mut rejected: MessageWriter<StampRejected>,
) {
    // Both are asked: what was read is read.
    if !(changes.any() | origin.is_changed()) {
        return;
    }
    let KnownStamps { known, round } = &mut *all;
    *round += 1;
    let mut touched = HashSet::new();
    for (entity, stamp, transform, place) in &stamps {
        let mut above = core::iter::once(entity).chain(parents.iter_ancestors(entity));
        let owner = above.find(|above| terrains.contains(*above));
        for (terrain, ground, _) in terrains.iter().filter(|(terrain, ..)| owner.is_none_or(|owner| owner == *terrain))
        {
            let last = known.get(&(entity, terrain));
            let pose = Pose::new(transform, ground);
            let at = match (place, last) {
                (Some(place), _) => *place,
                (None, Some(last)) if last.stays(&pose, &origin) => last.at,
                _ => pose.place(&origin),
            };
            let mut ready = last.and_then(|last| last.ready.clone());
            if stamp.is_changed() || last.is_none_or(|last| last.at != at) {
                let placed = Placed { place: at.place, heading: at.heading, edit: stamp.0.clone() };
                match Ready::new(&placed, "stamp") {
                    Ok(new) => {
                        ready = Some(Arc::new(new));
                        touched.insert(terrain);
                    }
                    Err(error) => {
                        error!("stamp {entity} was rejected, what it was before stays: {error}");
                        rejected.write(StampRejected { entity, error });
                    }
                }
            }
            let pose = place.is_none().then_some((pose, origin.0));
            known.insert((entity, terrain), Known { at, pose, ready, round: *round });
        }
    }
    known.retain(|(_, terrain), last| {
        let stays = last.round == *round;
        if !stays {
            touched.insert(*terrain);
        }
        stays
    });
    for (terrain, _, old) in terrains.iter().filter(|(terrain, ..)| touched.contains(terrain)) {
        let of = known.iter().filter(|((_, of), _)| *of == terrain);
        let set = Stamps::new(of.filter_map(|(_, last)| last.ready.clone()).collect());
        let areas = old.map_or_else(|| Stamps::default().changes(&set), |old| old.0.changes(&set));
        if !areas.is_empty() {
            changed.write(GroundChanged { terrain, areas });
        }
        commands.entity(terrain).try_insert(CompiledStamps(Arc::new(set)));
    }
}
