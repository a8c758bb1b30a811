//! A stage for pictures: a terrain, a sun, a camera off screen; the depth that the camera's view ends with, and what a
//! frame costs. Tests, charts and the bench stand on it.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use crate::offscreen::{self, Offscreen};
use bevy::app::Plugins;
use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::schedule::Core3dSystems;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::diagnostic::{DiagnosticPath, DiagnosticsStore};
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::diagnostic::RenderDiagnosticsPlugin;
use bevy::render::extract_component::{ExtractComponent, ExtractComponentPlugin};
use bevy::render::render_resource::{
    Buffer, BufferDescriptor, BufferUsages, Extent3d, MapMode, Origin3d, PollType, TexelCopyBufferInfo,
    TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect, TextureFormat, TextureUsages,
};
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{ViewDepthTexture, ViewTarget};
use bevy_horizon::prelude::*;
use bevy_horizon::render::ready::Progress;

/// Vertical field of view of every camera on the stage, in radians.
pub const FOV: f32 = std::f32::consts::FRAC_PI_3;
/// Near plane, in metres.
pub const NEAR: f32 = 0.1;

/// A camera whose depth is kept, and the colour that its main pass ends with.
#[derive(Component, Clone, Copy, ExtractComponent)]
pub struct KeepDepth;

/// A texture's copy, its width and height, and the bytes of a row.
type Copied = Arc<Mutex<Option<(Buffer, [u32; 3])>>>;

#[derive(Resource, Clone, Default)]
struct Kept {
    depth: Copied,
    colour: Copied,
}

struct KeepDepthPlugin;

impl Plugin for KeepDepthPlugin {
    fn build(&self, app: &mut App) {
        let kept = Kept::default();
        app.insert_resource(kept.clone()).add_plugins(ExtractComponentPlugin::<KeepDepth>::default());
        app.sub_app_mut(RenderApp)
            .insert_resource(kept)
            .add_systems(Core3d, keep.after(Core3dSystems::MainPass).before(Core3dSystems::EarlyPostProcess));
    }
}

fn keep(view: ViewQuery<(&ViewDepthTexture, &ViewTarget, &KeepDepth)>, kept: Res<Kept>, mut ctx: RenderContext) {
    let (depth, target, _) = view.into_inner();
    copy(&depth.texture, TextureAspect::DepthOnly, 4, &kept.depth, &mut ctx);
    if target.main_texture_format() == TextureFormat::Rgba16Float {
        copy(target.main_texture(), TextureAspect::All, 8, &kept.colour, &mut ctx);
    }
}

fn copy(texture: &Texture, aspect: TextureAspect, bytes: u32, to: &Copied, ctx: &mut RenderContext) {
    let (width, height) = (texture.width(), texture.height());
    if !texture.usage().contains(TextureUsages::COPY_SRC) || texture.sample_count() > 1 {
        return;
    }
    let row = (width * bytes).next_multiple_of(256);
    let buffer = ctx.render_device().create_buffer(&BufferDescriptor {
        label: Some("kept"),
        size: u64::from(row * height),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    ctx.command_encoder().copy_texture_to_buffer(
        TexelCopyTextureInfo { texture, mip_level: 0, origin: Origin3d::ZERO, aspect },
        TexelCopyBufferInfo {
            buffer: &buffer,
            layout: TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
        },
        Extent3d { width, height, depth_or_array_layers: 1 },
    );
    *to.lock().unwrap() = Some((buffer, [width, height, row]));
}

/// A stage with one camera.
pub struct Stage {
    /// The app, off screen.
    pub off: Offscreen,
    /// The camera.
    pub camera: Entity,
    asked: HashMap<&'static str, Instant>,
}

impl Stage {
    /// An empty stage, with the whole plugin, and a camera that draws worlds.
    pub fn new(width: u32, height: u32) -> Self {
        Self::with_plugins(HorizonPlugins, width, height)
    }

    /// An empty stage with these plugins beside Bevy's, and a camera that draws worlds.
    pub fn with_plugins<M>(plugins: impl Plugins<M>, width: u32, height: u32) -> Self {
        let mut off =
            Offscreen::new((offscreen::plugins(), RenderDiagnosticsPlugin, KeepDepthPlugin, plugins), width, height);
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
        Self { off, camera, asked: HashMap::new() }
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

    /// One frame, until the device has done it; in milliseconds.
    pub fn frame(&mut self) -> f64 {
        let start = Instant::now();
        self.off.update();
        self.wait();
        start.elapsed().as_secs_f64() * 1e3
    }

    fn wait(&self) {
        let device = self.off.app.sub_app(RenderApp).world().resource::<RenderDevice>();
        device.poll(PollType::wait_indefinitely()).expect("the device answers");
    }

    /// What the device spent in the pass of this name, in milliseconds, for each frame whose timestamps came back since the
    /// last question: some frames later.
    pub fn spent(&mut self, name: &'static str) -> Vec<f64> {
        let path = DiagnosticPath::from_components(["render", name, "elapsed_gpu"]);
        let since = self.asked.get(name).copied();
        let Some(diagnostic) = self.off.app.world().resource::<DiagnosticsStore>().get(&path) else {
            return Vec::new();
        };
        let new = diagnostic.measurements().filter(|one| since.is_none_or(|since| one.time > since));
        let spent = new.map(|one| one.value).collect();
        if let Some(last) = diagnostic.measurement() {
            self.asked.insert(name, last.time);
        }
        spent
    }

    /// The reverse-z depth of a frame, row by row.
    pub fn depth(&mut self) -> Vec<f32> {
        self.off.update();
        let kept = self.off.app.world().resource::<Kept>().depth.clone();
        self.read(&kept, 4, |bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
    }

    /// The linear colour of a frame's main pass, row by row. The camera is HDR.
    pub fn colour(&mut self) -> Vec<[f32; 4]> {
        self.off.update();
        let kept = self.off.app.world().resource::<Kept>().colour.clone();
        self.read(&kept, 8, |bytes| {
            [0, 2, 4, 6].map(|at| half::f16::from_le_bytes([bytes[at], bytes[at + 1]]).to_f32())
        })
    }

    fn read<T>(&self, kept: &Copied, bytes: u32, of: impl Fn(&[u8]) -> T) -> Vec<T> {
        let (buffer, [width, height, row]) = kept.lock().unwrap().take().expect("a view kept its texture");
        let device = self.off.app.sub_app(RenderApp).world().resource::<RenderDevice>();
        let slice = buffer.slice(..);
        slice.map_async(MapMode::Read, |result| result.expect("the buffer can be mapped"));
        device.poll(PollType::wait_indefinitely()).expect("the device answers");
        let mapped = slice.get_mapped_range();
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (y * row + x * bytes) as usize))
            .map(|at| of(&mapped[at..at + bytes as usize]))
            .collect()
    }
}
