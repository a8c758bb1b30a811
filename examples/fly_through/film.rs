//! Without a display: loads the world, flies the path in simulated time, and writes pictures.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_horizon::HorizonPlugins;
use bevy_horizon_workspace::offscreen::{self, Offscreen};
use indicatif::{ProgressBar, ProgressStyle};

use crate::options::Options;
use crate::pictures::{Failure, Pictures};
use crate::scene::{Flight, Loading, ScenePlugin};

/// Frames of a film, without `--frames`.
const FRAMES: u32 = 120;
/// The path goes on after the film's end, and so do the meshes along it, for so many metres.
const VISTA: f32 = 1000.0;
/// A world that has not come together after this time never will.
const PATIENCE: Duration = Duration::from_secs(600);

/// Makes the film.
pub fn run(options: &Options) -> Result<(), Failure> {
    let frames = options.frames.unwrap_or(FRAMES);
    let second = f32::from(options.fps);
    let [width, height] = options.size;
    let scene = ScenePlugin {
        world: options.asset_path(),
        length: frames as f32 / second * options.speed + VISTA,
        speed: options.speed,
        playing: false,
    };
    // Only what went wrong: progress bars and a log don't share a terminal well.
    let log = LogPlugin { filter: "error".into(), ..default() };
    let plugins = offscreen::plugins().set(options.assets()).set(log);
    let mut film = Offscreen::new((plugins, HorizonPlugins, scene), width, height);
    let target = film.image();
    offscreen::redirect_cameras(&mut film.app, target);
    film.app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f32(1.0 / second)));

    load(&mut film)?;
    let pictures = Pictures::start(&options.out, options.size, frames, options.fps)?;
    let started = Instant::now();
    shoot(&mut film, &pictures, frames);
    let took = started.elapsed().as_secs_f32();
    let (directory, animation) = pictures.finish()?;
    let rate = frames as f32 / took;
    println!("{frames} frames of {width}×{height} in {took:.1} s, {rate:.1} a second: {}", directory.display());
    println!("The film, for a browser: {}", animation.display());
    Ok(())
}

/// Draws until the world around the path's start is complete.
fn load(film: &mut Offscreen) -> Result<(), Failure> {
    let bar = progress_bar("Loading ", "{pos}/{len} tiles");
    let started = Instant::now();
    loop {
        film.update();
        let loading = film.app.world().resource::<Loading>();
        if let Some(reason) = &loading.refused {
            return Err(format!("the world was refused: {reason}").into());
        }
        if let Some(progress) = loading.progress {
            bar.set_length(u64::from(progress.total));
            bar.set_position(u64::from(progress.done));
        }
        if loading.ready {
            bar.finish();
            return Ok(());
        }
        if started.elapsed() > PATIENCE {
            return Err(format!("the world was not complete after {} s", PATIENCE.as_secs()).into());
        }
    }
}

/// Draws the frames. Each picture comes back from the device a few frames after it was drawn.
fn shoot(film: &mut Offscreen, pictures: &Pictures, frames: u32) {
    let bar = progress_bar("Flying  ", "{pos}/{len} frames, {per_sec}");
    bar.set_length(u64::from(frames));
    film.app.world_mut().resource_mut::<Flight>().playing = true;
    let mut shots = VecDeque::new();
    let mut drawn = 0;
    while drawn < frames || !shots.is_empty() {
        if drawn < frames {
            shots.push_back(film.shoot());
            drawn += 1;
        }
        film.update();
        while let Some(picture) = shots.front().and_then(|shot| film.taken(*shot)) {
            shots.pop_front();
            pictures.push(picture);
            bar.inc(1);
        }
    }
    bar.finish();
}

fn progress_bar(what: &'static str, counts: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!("{{msg}} {{elapsed_precise}} {{bar:40}} {counts}"));
    ProgressBar::new(0).with_style(style.expect("the template is right")).with_message(what)
}
