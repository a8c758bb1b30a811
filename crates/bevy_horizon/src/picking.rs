//! Pointer events hit the ground: a backend for Bevy's picking.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_horizon::prelude::*;
//!
//! fn main() {
//!     App::new()
//!         .add_plugins((DefaultPlugins, HorizonPlugins, HorizonPickingPlugin))
//!         .add_systems(Startup, |mut commands: Commands| {
//!             commands.spawn((Camera3d::default(), HorizonCamera::default(), Transform::from_xyz(0.0, 700.0, 0.0)));
//!             commands.spawn(Terrain::default()).observe(|click: On<Pointer<Click>>| {
//!                 info!("the ground was clicked at {:?}", click.hit.position);
//!             });
//!         })
//!         .run();
//! }
//! ```
//!
//! What is drawn is what is hit: in cameras with a [`HorizonCamera`], the first visible terrain that the camera's layers show,
//! as far as the camera draws. Position and unit normal are in Bevy's coordinates; the depth is the distance from where the
//! pointer's ray starts, on the near plane, as that of the mesh backend, so that the nearer of mesh and ground gets the
//! event. It costs one certified ray cast for each pointer over such a camera and frame. A `Pickable` on the terrain works as
//! on meshes.

use bevy::camera::visibility::{InheritedVisibility, RenderLayers};
use bevy::picking::backend::ray::RayMap;
use bevy::picking::backend::{HitData, PointerHits};
use bevy::picking::{Pickable, PickingSystems};
use bevy::prelude::*;

use crate::camera::HorizonCamera;
use crate::query::HorizonQuery;
use crate::world::CompiledTerrain;

/// The backend. Bevy's own picking plugins, which `DefaultPlugins` contain, make events of what it finds.
pub struct HorizonPickingPlugin;

impl Plugin for HorizonPickingPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(PreUpdate, hit_ground.in_set(PickingSystems::Backend).run_if(resource_exists::<RayMap>));
    }
}

type Terrains<'w, 's> = Query<
    'w,
    's,
    (Entity, &'static InheritedVisibility, Option<&'static RenderLayers>, Option<&'static Pickable>),
    With<CompiledTerrain>,
>;

fn hit_ground(
    rays: Res<RayMap>,
    cameras: Query<(&Camera, &HorizonCamera, Option<&RenderLayers>)>,
    terrains: Terrains,
    world: HorizonQuery,
    mut hits: MessageWriter<PointerHits>,
) {
    for (id, ray) in rays.iter() {
        let Ok((camera, horizon, layers)) = cameras.get(id.camera) else { continue };
        let layers = layers.cloned().unwrap_or_default();
        let drawn = terrains
            .iter()
            .find(|(_, visibility, on, _)| visibility.get() && layers.intersects(&on.cloned().unwrap_or_default()));
        let Some((terrain, _, _, pickable)) = drawn else { continue };
        if pickable.is_some_and(|pickable| *pickable == Pickable::IGNORE) {
            continue;
        }
        let ground = world.ground(Some(terrain));
        let Some(hit) = ground.and_then(|ground| ground.ray_cast(ray.origin, ray.direction, horizon.far)) else {
            continue;
        };
        let data = HitData::new(id.camera, hit.distance, Some(hit.position), Some(hit.normal));
        hits.write(PointerHits::new(id.pointer, vec![(terrain, data)], camera.order as f32));
    }
}
