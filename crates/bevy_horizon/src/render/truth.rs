//! The truth for the debug view of errors: a certified cast for each pixel, on the CPU, while a camera stands still.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use bevy::math::{DMat4, DVec3, DVec4};
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::render_resource::{BufferInitDescriptor, BufferUsages};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::RenderEntity;
use bevy::tasks::AsyncComputeTaskPool;
use horizon_field::march::{Anchored, Cast, Ray};
use horizon_field::{CELL, Place, Stamps};

use super::passes::ViewTruths;
use crate::camera::{DebugView, HorizonCamera};
use crate::world::{CompiledStamps, CompiledTerrain, TerrainFields, WorldOrigin};

/// What a truth is the truth of.
#[derive(Clone)]
struct Scene {
    pose: GlobalTransform,
    clip_from_view: Mat4,
    size: UVec2,
    far: f32,
    origin: Place,
    terrain: Vec3,
    fields: Arc<TerrainFields>,
    stamps: Option<Arc<Stamps>>,
}

/// A camera's truth, as far as it is known.
#[derive(Component)]
pub struct Truths {
    scene: Scene,
    /// Frames since the scene last changed.
    still: u32,
    cast: Option<Arc<Casting>>,
}

/// What the casting task fills in, row by row.
struct Casting {
    /// Distances: 0 where not yet known, infinite where there is no ground.
    known: Mutex<Vec<f32>>,
    /// Nobody waits for it any more.
    dropped: AtomicBool,
}

impl Drop for Truths {
    fn drop(&mut self) {
        if let Some(cast) = &self.cast {
            cast.dropped.store(true, Ordering::Relaxed);
        }
    }
}

/// Frames without a change after which a camera stands still.
const STILL: u32 = 3;

type Cameras<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static HorizonCamera,
        &'static Camera,
        &'static Projection,
        &'static GlobalTransform,
        Option<&'static mut Truths>,
    ),
>;

/// Starts a truth where a camera with [`DebugView::Error`] came to rest, and drops it where one moved on.
pub fn seek_truths(
    mut commands: Commands,
    cameras: Cameras,
    terrains: Query<(&CompiledTerrain, Option<&CompiledStamps>, &GlobalTransform), Without<HorizonCamera>>,
    origin: Res<WorldOrigin>,
) {
    for (entity, horizon, camera, projection, pose, truths) in cameras {
        let size = camera.physical_viewport_size().filter(|_| horizon.debug == DebugView::Error);
        let (Some(size), Some((terrain, stamps, at))) = (size, terrains.iter().next()) else {
            if truths.is_some() {
                commands.entity(entity).remove::<Truths>();
            }
            continue;
        };
        let scene = Scene {
            pose: *pose,
            clip_from_view: projection.get_clip_from_view(),
            size,
            far: horizon.far,
            origin: origin.0,
            terrain: at.translation(),
            fields: terrain.0.clone(),
            stamps: stamps.map(|stamps| stamps.0.clone()),
        };
        match truths {
            Some(mut truths) if truths.scene.is(&scene) => {
                truths.still += 1;
                if truths.still >= STILL && truths.cast.is_none() {
                    truths.cast = Some(start(scene));
                }
            }
            _ => {
                commands.entity(entity).insert(Truths { scene, still: 0, cast: None });
            }
        }
    }
}

fn start(scene: Scene) -> Arc<Casting> {
    let known = vec![0.0; (scene.size.x * scene.size.y) as usize];
    let casting = Arc::new(Casting { known: Mutex::new(known), dropped: AtomicBool::new(false) });
    let shared = casting.clone();
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let surface = match &scene.stamps {
            Some(stamps) => Anchored::stamped(&scene.fields.height, stamps, &scene.origin),
            None => Anchored::new(&scene.fields.height, &scene.origin),
        };
        for y in 0..scene.size.y {
            if shared.dropped.load(Ordering::Relaxed) {
                return;
            }
            let row: Vec<f32> = (0..scene.size.x).map(|x| scene.distance(&surface, UVec2::new(x, y))).collect();
            let first = (y * scene.size.x) as usize;
            let mut known = shared.known.lock().expect("no holder panics");
            known[first..first + row.len()].copy_from_slice(&row);
        }
    });
    task.detach();
    casting
}

impl Scene {
    fn is(&self, other: &Self) -> bool {
        let view = |s: &Self| (s.pose, s.clip_from_view, s.size, s.far, s.origin, s.terrain);
        let stamps = |s: &Self| s.stamps.as_ref().map(Arc::as_ptr);
        view(self) == view(other) && Arc::ptr_eq(&self.fields, &other.fields) && stamps(self) == stamps(other)
    }

    /// The distance to the ground along a pixel's ray.
    fn distance(&self, surface: &Anchored, pixel: UVec2) -> f32 {
        let uv = (pixel.as_dvec2() + 0.5) / self.size.as_dvec2();
        let ndc = DVec4::new(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 1.0, 1.0);
        let p = self.clip_from_view.as_dmat4().inverse() * ndc;
        let near = p.truncate() / p.w;
        let orthographic = self.clip_from_view.w_axis.w == 1.0;
        let (start, local) = if orthographic { (near, DVec3::NEG_Z) } else { (DVec3::ZERO, near) };
        let world: DMat4 = self.pose.to_matrix().as_dmat4();
        let datum = self.origin.cell[1] as f64 * CELL + self.origin.offset[1];
        let origin = world.transform_point3(start) - self.terrain.as_dvec3() + DVec3::Y * datum;
        let Ok(ray) = Ray::new(origin.to_array(), world.transform_vector3(local).to_array()) else {
            return f32::INFINITY;
        };
        match surface.cast(&ray, f64::from(self.far)) {
            Cast::Hit(hit) => hit.t as f32,
            // Known, and at the camera: 0 would say that it is not known.
            Cast::Inside => 1e-6,
            Cast::Miss => f32::INFINITY,
        }
    }
}

/// Takes what is known over to the device, for cameras that show errors.
pub fn extract_truths(
    mut commands: Commands,
    truths: Extract<Query<(RenderEntity, &Truths)>>,
    old: Query<Entity, With<ViewTruths>>,
    device: Res<RenderDevice>,
) {
    for entity in &old {
        commands.entity(entity).remove::<ViewTruths>();
    }
    for (entity, truths) in &truths {
        let Some(cast) = &truths.cast else { continue };
        let known = cast.known.lock().expect("no holder panics");
        let buffer = device.create_buffer_with_data(&BufferInitDescriptor {
            label: Some("horizon_truths"),
            contents: bytemuck::cast_slice(&known),
            usage: BufferUsages::STORAGE,
        });
        commands.entity(entity).insert(ViewTruths(buffer));
    }
}
