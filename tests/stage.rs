//! A stage for pictures: a terrain, a sun, a camera off screen; and the depth that the camera's view ends with.

use std::sync::{Arc, Mutex};

use bevy::app::Plugins;
use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::schedule::Core3dSystems;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::extract_component::{ExtractComponent, ExtractComponentPlugin};
use bevy::render::render_resource::{
    Buffer, BufferDescriptor, BufferUsages, Extent3d, MapMode, Origin3d, PollType, TexelCopyBufferInfo,
    TexelCopyBufferLayout, TexelCopyTextureInfo, TextureAspect, TextureUsages,
};
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::ViewDepthTexture;
use bevy_horizon::prelude::*;
use bevy_horizon::render::ready::Progress;
use bevy_horizon_workspace::offscreen::{self, Offscreen};

/// Vertical field of view of every camera on the stage, in radians.
pub const FOV: f32 = std::f32::consts::FRAC_PI_3;
/// Near plane, in metres.
pub const NEAR: f32 = 0.1;

/// A camera whose depth is kept.
#[derive(Component, Clone, Copy, ExtractComponent)]
pub struct KeepDepth;

#[derive(Resource, Clone, Default)]
struct Kept(Arc<Mutex<Option<(Buffer, [u32; 3])>>>);

struct KeepDepthPlugin;

impl Plugin for KeepDepthPlugin {
    fn build(&self, app: &mut App) {
        let kept = Kept::default();
        app.insert_resource(kept.clone()).add_plugins(ExtractComponentPlugin::<KeepDepth>::default());
        app.sub_app_mut(RenderApp)
            .insert_resource(kept)
            .add_systems(Core3d, keep_depth.after(Core3dSystems::MainPass).before(Core3dSystems::EarlyPostProcess));
    }
}

fn keep_depth(view: ViewQuery<(&ViewDepthTexture, &KeepDepth)>, kept: Res<Kept>, mut ctx: RenderContext) {
    let (depth, _) = view.into_inner();
    let (width, height) = (depth.texture.width(), depth.texture.height());
    let row = (width * 4).next_multiple_of(256);
    let buffer = ctx.render_device().create_buffer(&BufferDescriptor {
        label: Some("kept depth"),
        size: u64::from(row * height),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    ctx.command_encoder().copy_texture_to_buffer(
        TexelCopyTextureInfo {
            texture: &depth.texture,
            mip_level: 0,
            origin: Origin3d::ZERO,
            aspect: TextureAspect::DepthOnly,
        },
        TexelCopyBufferInfo {
            buffer: &buffer,
            layout: TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
        },
        Extent3d { width, height, depth_or_array_layers: 1 },
    );
    *kept.0.lock().unwrap() = Some((buffer, [width, height, row]));
}

/// A stage with one camera.
pub struct Stage {
    pub off: Offscreen,
    pub camera: Entity,
}

impl Stage {
    /// An empty stage, with the whole plugin, and a camera that draws worlds.
    pub fn new(width: u32, height: u32) -> Self {
        Self::with_plugins(HorizonPlugins, width, height)
    }

    /// An empty stage with these plugins beside Bevy's, and a camera that draws worlds.
    pub fn with_plugins<M>(plugins: impl Plugins<M>, width: u32, height: u32) -> Self {
        let mut off = Offscreen::new((offscreen::plugins(), KeepDepthPlugin, plugins), width, height);
        let target = off.target();
        let depth_texture_usages = (TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC).into();
        let camera = off.app.world_mut().spawn((
            Camera3d { depth_texture_usages, ..default() },
            target,
            Hdr,
            Msaa::Off,
            Exposure { ev100: 13.5 },
            Tonemapping::AgX,
            Projection::Perspective(PerspectiveProjection { fov: FOV, near: NEAR, ..default() }),
            HorizonCamera::default(),
            KeepDepth,
        ));
        let camera = camera.id();
        Self { off, camera }
    }

    pub fn world(&mut self) -> &mut World {
        self.off.app.world_mut()
    }

    /// A sun in the south-east.
    pub fn light(&mut self) {
        let sun = Sun::default();
        self.world().spawn((DirectionalLight { illuminance: sun.illuminance, ..default() }, sun.transform()));
        self.world().insert_resource(GlobalAmbientLight {
            color: Color::linear_rgb(0.62, 0.78, 1.0),
            brightness: sun.ambient,
            ..default()
        });
    }

    pub fn look(&mut self, transform: Transform) {
        let camera = self.camera;
        self.world().entity_mut(camera).insert(transform);
    }

    /// Frames until every tile is up to date.
    pub fn settle(&mut self) {
        for frame in 0..200 {
            self.off.update();
            let progress = self.off.app.world().resource::<Progress>().get();
            if frame > 3 && progress.total > 0 && progress.done == progress.total {
                self.off.update();
                return;
            }
        }
        panic!("the world was not ready within 200 frames");
    }

    /// The reverse-z depth of a frame, row by row.
    pub fn depth(&mut self) -> Vec<f32> {
        self.off.update();
        let world = self.off.app.world();
        let (buffer, [width, height, row]) =
            world.resource::<Kept>().0.lock().unwrap().take().expect("a view kept its depth");
        let device = self.off.app.sub_app(RenderApp).world().resource::<RenderDevice>();
        let slice = buffer.slice(..);
        slice.map_async(MapMode::Read, |result| result.expect("the buffer can be mapped"));
        device.poll(PollType::wait_indefinitely()).expect("the device answers");
        let bytes = slice.get_mapped_range();
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (y * row + x * 4) as usize))
            .map(|at| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()))
            .collect()
    }
}
