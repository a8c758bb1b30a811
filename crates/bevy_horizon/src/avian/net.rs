//! The safety net under the ground.

use avian3d::prelude::*;
use bevy::prelude::*;

use super::settings::TileSettings;
use crate::query::{Ground, HorizonQuery};
use crate::world::CompiledTerrain;

/// A body that may be under the ground, in a mine or a tunnel: the safety net leaves it alone. What went into the ground through a hole
/// needs none, until it comes out.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct Underground;

/// A body went into the ground through a hole, and has not come out.
#[derive(Component)]
pub(super) struct ThroughHole;

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
        Has<ThroughHole>,
    ),
    Falling,
>;

/// A dynamic body, as the net sees it.
struct Dynamic<'a> {
    body: Entity,
    centre: Vec3,
    colliders: &'a RigidBodyColliders,
    through_hole: bool,
}

/// Where a body goes that is under the ground.
struct Lift {
    body: Entity,
    depth: f32,
    by: f32,
    normal: Vec3,
}

/// Puts dynamic bodies whose centre of mass is under the ground back onto it, and takes from them the velocity into it.
/// Where grounds lie over each other, the lowest counts. In a hole there is nothing to be put back onto.
pub(super) fn lift_bodies(
    mut commands: Commands,
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
    let half_cell = 0.5 * settings.side / settings.cells.max(1) as f32;
    let lifts = sunk(&mut commands, &world, &terrains, &poses, &colliders, half_cell);
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
    commands: &mut Commands,
    world: &HorizonQuery,
    terrains: &Query<Entity, With<CompiledTerrain>>,
    poses: &Poses,
    colliders: &Query<(&Collider, &Position, &Rotation)>,
    half_cell: f32,
) -> Vec<Lift> {
    let dynamic = poses.iter().filter(|(_, body, ..)| body.is_dynamic());
    let bodies: Vec<Dynamic> = dynamic
        .map(|(body, _, position, rotation, centre, colliders, through_hole)| {
            let centre = position.0 + rotation.0 * centre.0;
            Dynamic { body, centre, colliders, through_hole }
        })
        .filter(|dynamic| dynamic.centre.is_finite())
        .collect();
    let positions: Vec<Vec3> = bodies.iter().map(|dynamic| dynamic.centre).collect();
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
    for (dynamic, (height, terrain)) in bodies.into_iter().zip(lowest) {
        let Dynamic { body, centre, colliders: of_body, through_hole } = dynamic;
        let Some(ground) = terrain.and_then(|terrain| world.ground(Some(terrain))) else { continue };
        let depth = height - centre.y;
        let beneath_hole = depth > 0.0 && ground.has_holes() && (through_hole || over_hole(&ground, centre, half_cell));
        if through_hole && !beneath_hole {
            commands.entity(body).try_remove::<ThroughHole>();
        } else if beneath_hole && !through_hole {
            commands.entity(body).try_insert(ThroughHole);
        }
        if depth > 0.0 && !beneath_hole {
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

/// Whether a position may lie in a cell that tiles lack for a hole.
fn over_hole(ground: &Ground, position: Vec3, half_cell: f32) -> bool {
    let sides = [-half_cell, half_cell];
    ground.is_hole(position)
        || sides.iter().any(|x| sides.iter().any(|z| ground.is_hole(position + Vec3::new(*x, 0.0, *z))))
}
