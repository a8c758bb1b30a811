//! The safety net under the ground.

use avian3d::prelude::*;
use bevy::prelude::*;

use super::settings::TileSettings;
use crate::query::HorizonQuery;
use crate::world::CompiledTerrain;

/// A body that may be under the ground, in a mine or a tunnel: the safety net leaves it alone.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct Underground;

/// A body's centre of mass was under the ground, and the body was put back onto it.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct BodyLifted {
    /// The body.
    pub body: Entity,
    /// How deep its centre of mass was, in metres.
    pub depth: f32,
}

/// What may fall into the net.
type Falling = (Without<RigidBodyDisabled>, Without<Sleeping>, Without<Underground>);

type Poses<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static RigidBody,
        &'static Position,
        &'static Rotation,
        &'static ComputedCenterOfMass,
        &'static RigidBodyColliders,
    ),
    Falling,
>;

/// Where a body goes that is under the ground.
struct Lift {
    body: Entity,
    depth: f32,
    by: f32,
    normal: Vec3,
}

/// Puts dynamic bodies whose centre of mass is under the ground back onto it, and takes from them the velocity into it.
/// Where grounds lie over each other, the lowest counts.
pub(super) fn lift_bodies(
    settings: Res<TileSettings>,
    world: HorizonQuery,
    terrains: Query<Entity, With<CompiledTerrain>>,
    mut bodies: ParamSet<(
        (Poses, Query<(&Collider, &Position, &Rotation)>),
        Query<(&mut Position, &mut LinearVelocity), Falling>,
    )>,
    mut lifted: MessageWriter<BodyLifted>,
) {
    if !settings.net {
        return;
    }
    let (poses, colliders) = bodies.p0();
    let lifts = sunk(&world, &terrains, &poses, &colliders);
    let mut bodies = bodies.p1();
    for Lift { body, depth, by, normal } in lifts {
        let Ok((mut position, mut velocity)) = bodies.get_mut(body) else { continue };
        position.0.y += by;
        let into = velocity.0.dot(normal).min(0.0);
        velocity.0 -= into * normal;
        lifted.write(BodyLifted { body, depth });
    }
}

fn sunk(
    world: &HorizonQuery,
    terrains: &Query<Entity, With<CompiledTerrain>>,
    poses: &Poses,
    colliders: &Query<(&Collider, &Position, &Rotation)>,
) -> Vec<Lift> {
    let dynamic = poses.iter().filter(|(_, body, ..)| body.is_dynamic());
    let centres: Vec<_> = dynamic
        .map(|(body, _, position, rotation, centre, of_body)| (body, position.0 + rotation.0 * centre.0, of_body))
        .filter(|(_, centre, _)| centre.is_finite())
        .collect();
    let positions: Vec<Vec3> = centres.iter().map(|(_, centre, _)| *centre).collect();
    let mut lowest: Vec<(f32, Option<Entity>)> = vec![(f32::INFINITY, None); positions.len()];
    for terrain in terrains {
        let Some(ground) = world.ground(Some(terrain)) else { continue };
        for (lowest, height) in lowest.iter_mut().zip(ground.heights(&positions)) {
            if height < lowest.0 {
                *lowest = (height, Some(terrain));
            }
        }
    }
    let mut lifts = Vec::new();
    for ((body, centre, of_body), (height, terrain)) in centres.into_iter().zip(lowest) {
        let Some(ground) = terrain.and_then(|terrain| world.ground(Some(terrain))) else { continue };
        let depth = height - centre.y;
        if depth > 0.0 {
            let bottoms = of_body
                .into_iter()
                .filter_map(|collider| colliders.get(collider).ok())
                .map(|(collider, position, rotation)| collider.aabb(position.0, *rotation).min.y);
            let bottom = bottoms.fold(centre.y, f32::min);
            lifts.push(Lift { body, depth, by: height - bottom, normal: ground.normal(centre) });
        }
    }
    lifts
}
