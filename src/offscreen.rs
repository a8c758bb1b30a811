//! Rendering without a window, frame by frame: for tests, and for examples where there is no display.

use std::collections::HashMap;

use bevy::app::{PluginGroupBuilder, Plugins};
use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use image::RgbaImage;

/// Bevy's default plugins without a window, with pipelines compiled in the frame that asks for them.
pub fn plugins() -> PluginGroupBuilder {
    DefaultPlugins
        .build()
        .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
        .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
        .disable::<WinitPlugin>()
        .disable::<PipelinedRenderingPlugin>()
}

/// A new image that cameras can draw into.
pub fn target_image(app: &mut App, width: u32, height: u32) -> Handle<Image> {
    let mut image = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
    image.texture_descriptor.usage |= TextureUsages::COPY_SRC;
    image.asset_usage = RenderAssetUsages::default();
    app.world_mut().resource_mut::<Assets<Image>>().add(image)
}

/// From now on, all cameras that appear draw into this image: programs that spawn theirs for a window need no change.
pub fn redirect_cameras(app: &mut App, target: Handle<Image>) {
    app.add_observer(move |added: On<Add, Camera>, mut commands: Commands| {
        commands.entity(added.entity).insert(RenderTarget::from(target.clone()));
    });
}

/// An app that draws into an image, and gives it out.
pub struct Offscreen {
    /// The app. Drive it with [`Offscreen::update`].
    pub app: App,
    target: Handle<Image>,
}

/// A picture that was asked for: [`Offscreen::taken`] gives it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shot(Entity);

#[derive(Resource, Default)]
struct Captured(HashMap<Entity, Image>);

impl Offscreen {
    /// An app with these plugins and a target of this size.
    pub fn new<M>(plugins: impl Plugins<M>, width: u32, height: u32) -> Self {
        let mut app = App::new();
        app.add_plugins(plugins).init_resource::<Captured>();
        app.add_observer(|event: On<ScreenshotCaptured>, mut captured: ResMut<Captured>| {
            captured.0.insert(event.entity, event.image.clone());
        });
        let target = target_image(&mut app, width, height);
        app.finish();
        app.cleanup();
        Self { app, target }
    }

    /// The target, for a camera.
    pub fn target(&self) -> RenderTarget {
        RenderTarget::from(self.target.clone())
    }

    /// The target's image.
    pub fn image(&self) -> Handle<Image> {
        self.target.clone()
    }

    /// One frame.
    pub fn update(&mut self) {
        self.app.update();
    }

    /// Asks for the picture of the next frame. It arrives some frames later, so that films need not wait for each.
    pub fn shoot(&mut self) -> Shot {
        Shot(self.app.world_mut().spawn(Screenshot::image(self.target.clone())).id())
    }

    /// The picture, once it is there.
    pub fn taken(&mut self, shot: Shot) -> Option<RgbaImage> {
        let image = self.app.world_mut().resource_mut::<Captured>().0.remove(&shot.0)?;
        Some(image.try_into_dynamic().expect("the target is 8-bit RGBA").to_rgba8())
    }

    /// Draws one more frame, and gives out the picture.
    pub fn screenshot(&mut self) -> RgbaImage {
        let shot = self.shoot();
        for _ in 0..64 {
            self.app.update();
            if let Some(image) = self.taken(shot) {
                return image;
            }
        }
        panic!("no screenshot came back within 64 frames");
    }
}
