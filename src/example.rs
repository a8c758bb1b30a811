//! What lets every example run anywhere, unattended too: in a window, or off screen where there is no display.

use std::time::Duration;

use bevy::app::{PluginGroupBuilder, ScheduleRunnerPlugin};
use bevy::prelude::*;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured, save_to_disk};

use crate::offscreen;

/// Frames off screen, without `--frames`: enough for a world to fill in.
const FRAMES: u32 = 60;

/// The picture's size off screen.
const SIZE: [u32; 2] = [640, 360];

/// Whether a window could be opened.
pub fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// `DefaultPlugins` in a window. Off screen where there is no display: then the last frame is saved as
/// `target/NAME.png`. With `--frames N` on the command line the app ends after so many frames.
pub fn plugins() -> PluginGroupBuilder {
    let frames = frames(std::env::args());
    if has_display() {
        DefaultPlugins.build().add(Unattended { frames, off_screen: false })
    } else {
        let frames = frames.or(Some(FRAMES));
        offscreen::plugins()
            .add(ScheduleRunnerPlugin::run_loop(Duration::ZERO))
            .add(Unattended { frames, off_screen: true })
    }
}

/// The value of `--frames`.
fn frames(args: impl IntoIterator<Item = String>) -> Option<u32> {
    args.into_iter().skip_while(|arg| arg != "--frames").nth(1)?.parse().ok()
}

/// Ends the app after some frames.
struct Unattended {
    frames: Option<u32>,
    off_screen: bool,
}

/// Where off-screen cameras draw.
#[derive(Resource)]
struct Target(Handle<Image>);

#[derive(Resource)]
struct FramesLeft(u32);

impl Plugin for Unattended {
    fn build(&self, app: &mut App) {
        if let Some(frames) = self.frames {
            app.insert_resource(FramesLeft(frames)).add_systems(Last, end);
        }
    }

    // The image needs all plugins; the cameras come later, in `Startup`.
    fn finish(&self, app: &mut App) {
        if self.off_screen {
            let target = offscreen::target_image(app, SIZE[0], SIZE[1]);
            offscreen::redirect_cameras(app, target.clone());
            app.insert_resource(Target(target));
        }
    }
}

fn end(
    mut commands: Commands,
    mut left: ResMut<FramesLeft>,
    target: Option<Res<Target>>,
    mut exit: MessageWriter<AppExit>,
) {
    if left.0 == 0 {
        return;
    }
    left.0 -= 1;
    if left.0 > 0 {
        return;
    }
    let Some(target) = target else {
        exit.write(AppExit::Success);
        return;
    };
    let program = std::env::args().next().unwrap_or_default();
    let name = std::path::Path::new(&program).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let path = std::path::absolute(format!("target/{name}.png")).expect("there is a current directory");
    if let Err(error) = std::fs::create_dir_all("target") {
        error!("target: {error}");
    }
    commands.spawn(Screenshot::image(target.0.clone())).observe(save_to_disk(path.clone())).observe(
        move |_: On<ScreenshotCaptured>, mut exit: MessageWriter<AppExit>| {
            if path.is_file() {
                println!("There is no display. The picture is in {}", path.display());
            }
            exit.write(AppExit::Success);
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_read_from_the_command_line() {
        let of = |line: &str| frames(line.split(' ').map(str::to_owned));
        assert_eq!(of("minimal --frames 3"), Some(3));
        assert_eq!([of("minimal"), of("minimal --frames"), of("minimal --frames x")], [None; 3]);
    }
}
