//! The command line.

use std::path::{Path, PathBuf};

use bevy::asset::{AssetPlugin, UnapprovedPathMode};
use bevy::utils::default;
use clap::Parser;

/// Flies through a world: in a window, or off screen into pictures where there is no display.
#[derive(Parser, Clone, Debug)]
pub struct Options {
    /// The world file: a path below assets/, or any other path.
    #[arg(long, value_name = "FILE", default_value = "worlds/alpine.ron")]
    pub world: PathBuf,
    /// Follow the scripted path. Off screen it is followed in any case; in a window, P starts and ends it.
    #[arg(long)]
    pub path: bool,
    /// Width and height, in pixels.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size)]
    pub size: [u32; 2],
    /// How many frames; off screen 120 if not given, a window stays open if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: Option<u32>,
    /// Where off-screen pictures go.
    #[arg(long, value_name = "DIR", default_value = "target/fly_through")]
    pub out: PathBuf,
    /// Frames per second of the film: off screen, time is simulated.
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u16).range(1..))]
    pub fps: u16,
    /// Speed on the scripted path, in metres per second.
    #[arg(long, value_name = "M/S", default_value_t = 120.0)]
    pub speed: f32,
}

impl Options {
    /// The world's path as Bevy's asset server wants it: from the directory of assets, or absolute.
    pub fn asset_path(&self) -> PathBuf {
        let root = assets();
        if root.join(&self.world).is_file() {
            return self.world.clone();
        }
        match self.world.canonicalize() {
            Ok(path) => path.strip_prefix(&root).map(Path::to_path_buf).unwrap_or(path),
            // It does not exist: the asset server will say so.
            Err(_) => self.world.clone(),
        }
    }

    /// Bevy's assets, but watched for changes, and with worlds from anywhere: whoever starts the program names the file.
    pub fn assets(&self) -> AssetPlugin {
        AssetPlugin {
            file_path: assets().to_string_lossy().into_owned(),
            watch_for_changes_override: Some(true),
            unapproved_path_mode: UnapprovedPathMode::Allow,
            ..default()
        }
    }
}

/// The directory of assets of this workspace, wherever the program is started from.
fn assets() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    root.canonicalize().unwrap_or(root)
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parsed {
        Some([w, h]) if (1..=8192).contains(&w) && (1..=8192).contains(&h) => Ok([w, h]),
        _ => Err("must be like 640x360, with sides from 1 to 8192".into()),
    }
}
