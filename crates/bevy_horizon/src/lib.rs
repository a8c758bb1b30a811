//! Ray-marched implicit landscapes for Bevy.
//!
//! Spawn a [`Terrain`](world::Terrain), put a [`HorizonCamera`](camera::HorizonCamera) on a `Camera3d`, and endless
//! ground appears in the main view, with depth: meshes and ground hide each other. The same function answers on the CPU
//! at once, through [`HorizonQuery`](query::HorizonQuery).
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_horizon::prelude::*;
//!
//! fn setup(mut commands: Commands) {
//!     commands.spawn(Terrain::default());
//!     commands.spawn(Atmosphere::default());
//! #   #[cfg(feature = "render")]
//!     commands.spawn((Camera3d::default(), HorizonCamera::default(), Transform::from_xyz(0.0, 500.0, 0.0)));
//! }
//! ```
//!
//! Data flows one way: components ([`world`], [`camera`]) → compiled fields → extraction → caches on the device → passes
//! of the view. Nothing is read back. Without the default feature `render`, worlds load ([`scene`]) and queries answer.
//!
//! Features for other crates: `picking` (pointer events hit the ground), `avian` (colliders of the ground for avian3d) and
//! `big_space` (the world's origin follows a floating origin).
#![deny(missing_docs)]

#[cfg(feature = "avian")]
pub mod avian;
#[cfg(feature = "big_space")]
pub mod big_space;
#[cfg(feature = "render")]
pub mod camera;
#[cfg(feature = "picking")]
pub mod picking;
pub mod query;
#[cfg(feature = "render")]
pub mod render;
pub mod scene;
pub mod world;

pub use horizon_field::stamp;
pub use horizon_field::trees;

use bevy::app::PluginGroupBuilder;
use bevy::prelude::*;

/// What a game needs.
pub mod prelude {
    #[cfg(feature = "avian")]
    pub use crate::avian::{GroundTile, HorizonAvianPlugin, TileSettings};
    #[cfg(feature = "big_space")]
    pub use crate::big_space::HorizonBigSpacePlugin;
    #[cfg(feature = "render")]
    pub use crate::camera::{DebugView, HorizonCamera};
    #[cfg(feature = "picking")]
    pub use crate::picking::HorizonPickingPlugin;
    pub use crate::query::{GroundHit, HorizonQuery, StandingPlant, Surroundings, WaterSurface};
    #[cfg(feature = "render")]
    pub use crate::render::ready::{WorldProgress, WorldReady};
    pub use crate::scene::{HorizonWorld, WorldFile};
    pub use crate::world::{
        Atmosphere, Felled, SkyGradient, SkyModel, Stamp, StampPlace, Sun, Sunlight, Terrain, TerrainMaterial,
        TimeOfDay, Trees, Water, WaterDisc, WaterMask, WaterOutline, WaterRectangle, WaterTime, WorldOrigin,
    };
    pub use crate::{HorizonPlugins, HorizonSystems};
    pub use horizon_field::waves::Waves;
    pub use horizon_field::{Field, Place};
    pub use horizon_light::water::WaterOptics;
}

/// Everything. Parts can be disabled: `HorizonPlugins.build().disable::<HorizonSkyPlugin>()`.
pub struct HorizonPlugins;

impl PluginGroup for HorizonPlugins {
    fn build(self) -> PluginGroupBuilder {
        let group = PluginGroupBuilder::start::<Self>().add(HorizonWorldPlugin).add(scene::HorizonScenePlugin);
        #[cfg(feature = "render")]
        let group = group.add(render::HorizonRenderPlugin).add(render::HorizonSkyPlugin);
        group
    }
}

/// The order of this crate's systems in the main world.
#[derive(SystemSet, Clone, Debug, PartialEq, Eq, Hash)]
pub enum HorizonSystems {
    /// World files are put into components. In `PreUpdate`.
    Load,
    /// The world's origin follows a floating origin, where there is one. In `PostUpdate`.
    Origin,
    /// Changed terrain, stamps and air are checked and compiled. In `PostUpdate`; stamps after transforms were propagated.
    Compile,
}

/// What the world is, and the questions that it answers. Needs no renderer.
pub struct HorizonWorldPlugin;

impl Plugin for HorizonWorldPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<world::WorldOrigin>()
            .init_resource::<world::WaterTime>()
            .register_type::<world::WaterTime>()
            .register_type::<world::Terrain>()
            .register_type::<world::Stamp>()
            .register_type::<world::Atmosphere>()
            .register_type::<world::Water>()
            .add_message::<world::WaterRejected>()
            .add_message::<world::TerrainRejected>()
            .add_message::<world::StampRejected>()
            .add_message::<world::GroundChanged>()
            .register_type::<world::Trees>()
            .add_message::<world::TreesRejected>()
            .register_type::<world::TimeOfDay>()
            .add_message::<world::AtmosphereRejected>()
            .add_systems(
                PostUpdate,
                (
                    (
                        world::compile_terrain,
                        world::compile_stamps.after(TransformSystems::Propagate),
                        world::compile_trees,
                    )
                        .chain(),
                    (world::brighten, world::compile_atmospheres).chain(),
                    world::compile_waters,
                )
                    .in_set(HorizonSystems::Compile),
            )
            .add_systems(PreUpdate, world::advance_water.run_if(resource_exists::<Time<Virtual>>))
            .add_systems(Update, world::turn_suns.run_if(resource_exists::<Time>))
            .add_observer(world::forget_terrain)
            .add_observer(world::forget_water)
            .add_observer(world::forget_trees)
            .add_observer(world::forget_grown)
            .add_observer(world::forget_atmosphere);
    }
}
