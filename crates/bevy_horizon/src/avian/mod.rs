//! Physics on the ground, for avian3d: collider tiles that follow the bodies, from the same field as the picture.
//!
//! ```no_run
//! use avian3d::prelude::*;
//! use bevy::prelude::*;
//! use bevy_horizon::prelude::*;
//!
//! fn main() {
//!     App::new()
//!         .add_plugins((DefaultPlugins, PhysicsPlugins::default(), HorizonPlugins, HorizonAvianPlugin::default()))
//!         .add_systems(Startup, setup)
//!         .run();
//! }
//!
//! fn setup(mut commands: Commands) {
//!     commands.spawn((Terrain::default(), Friction::new(0.8)));
//!     commands.spawn((RigidBody::Dynamic, Collider::sphere(0.5), Transform::from_xyz(0.0, 900.0, 0.0)));
//! }
//! ```
//!
//! Under and around every dynamic and kinematic body lie [`GroundTile`]s: static bodies with a height field, on a grid that is
//! fixed to the terrain's field. What a body may touch in a step is there before the step; what lies within
//! [`TileSettings::reach`] is made ahead, some in each step. When the [`WorldOrigin`](crate::world::WorldOrigin) or the terrain's
//! transform moves, tiles move along and are not made again; when its field changes, they are. `Friction`, `Restitution` and
//! `CollisionLayers` of the terrain's entity are those of its tiles. A body's colliders must be avian's own `Collider`.
//!
//! A height field is a surface without thickness. avian's speculative contacts, which are on by default, hold what travels no
//! more than some of its own size in a step: a ball with a radius of 0.1 m up to 60 m/s at 64 steps a second. Give what is
//! faster or smaller a `SweptCcd`. Under all that lies a net: a dynamic body whose centre of mass is under the ground after a
//! step is put back onto it, and a [`BodyLifted`] says so. [`Underground`] bodies are left alone.
//!
//! Where a [`Stamp`](crate::world::Stamp) cuts a hole, tiles have none of the cells whose middle lies in it, and the net leaves alone
//! what falls in, until it comes out again. What starts out in a cellar is to be [`Underground`].
//!
//! Tiles are made for bodies high above the ground too.

mod heights;
mod net;
mod settings;
mod shift;
mod tiles;

use avian3d::prelude::PhysicsSystems;
use bevy::ecs::intern::Interned;
use bevy::ecs::schedule::ScheduleLabel;
use bevy::prelude::*;
use bevy::transform::systems::{mark_dirty_trees, propagate_parent_transforms, sync_simple_transforms};

pub use heights::{ground_collider, tile_heights};
pub use net::{BodyLifted, Underground};
pub use settings::{TileError, TileSettings};
pub use tiles::GroundTile;

use crate::HorizonSystems;

/// Colliders of the ground. Add it beside avian's `PhysicsPlugins`.
pub struct HorizonAvianPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

impl HorizonAvianPlugin {
    /// For physics in this schedule: the one that `PhysicsPlugins` was given.
    pub fn new(schedule: impl ScheduleLabel) -> Self {
        Self { schedule: schedule.intern() }
    }
}

impl Default for HorizonAvianPlugin {
    /// For avian's own default, `FixedPostUpdate`.
    fn default() -> Self {
        Self::new(FixedPostUpdate)
    }
}

impl Plugin for HorizonAvianPlugin {
    fn build(&self, app: &mut App) {
        let before_propagation = || {
            let carry = shift::carry_bodies.after(HorizonSystems::Origin);
            #[cfg(feature = "big_space")]
            let carry = carry.before(::big_space::bevy_compat::propagate_parent_transforms);
            carry.before(mark_dirty_trees).before(propagate_parent_transforms).before(sync_simple_transforms)
        };
        app.init_resource::<TileSettings>()
            .init_resource::<shift::BodiesOrigin>()
            .register_type::<TileSettings>()
            .register_type::<Underground>()
            .add_message::<BodyLifted>()
            .add_systems(PostUpdate, before_propagation())
            .add_systems(
                self.schedule,
                (
                    (shift::carry_bodies, shift::place_tiles, tiles::make_tiles)
                        .chain()
                        .after(PhysicsSystems::Prepare)
                        .before(PhysicsSystems::StepSimulation),
                    net::lift_bodies.after(PhysicsSystems::StepSimulation).before(PhysicsSystems::Writeback),
                ),
            );
    }
}
