//! Tiles stay where they are in the world when Bevy's origin moves, and bodies too where that is asked for.

use avian3d::prelude::*;
use bevy::prelude::*;
use horizon_field::Place;

use super::settings::TileSettings;
use super::tiles::{GroundTile, position};
use crate::world::{CompiledTerrain, WorldOrigin};

/// The origin that bodies were last placed by.
#[derive(Resource, Default)]
pub(super) struct BodiesOrigin(Option<Place>);

/// Shifts all bodies without a parent by as much as the origin moved.
pub(super) fn carry_bodies(
    settings: Res<TileSettings>,
    origin: Res<WorldOrigin>,
    mut last: ResMut<BodiesOrigin>,
    mut bodies: Query<(&mut Position, &mut Transform), (With<RigidBody>, Without<GroundTile>, Without<ChildOf>)>,
) {
    if last.0 == Some(origin.0) {
        return;
    }
    let Some(before) = last.0.replace(origin.0).filter(|_| settings.carry_bodies) else { return };
    let by = Vec3::from_array(before.minus(&origin.0).map(|metres| metres as f32));
    for (mut position, mut transform) in &mut bodies {
        position.0 += by;
        transform.translation += by;
    }
}

/// Places tiles by the origin and their terrain's transform, without asking the field again.
pub(super) fn place_tiles(
    origin: Res<WorldOrigin>,
    terrains: Query<&GlobalTransform, With<CompiledTerrain>>,
    mut tiles: Query<(&GroundTile, &mut Position, &mut Transform)>,
) {
    for (tile, mut at, mut transform) in &mut tiles {
        let Ok(terrain) = terrains.get(tile.terrain) else { continue };
        let now = position(&tile.centre, &origin, terrain.translation());
        if at.0 != now {
            at.0 = now;
            transform.translation = now;
        }
    }
}
