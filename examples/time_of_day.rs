//! A day in the mountains, from before dawn to night: the sun by place, date and hour; the air lights sky, ground and meshes. Writes
//! pictures and an animated PNG, off screen and unattended.
//!
//! `cargo run --example time_of_day -- --frames 96 --out target/time_of_day`
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::PathBuf;

use bevy::camera::Exposure;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::Stage;
use clap::Parser;
use indicatif::ProgressBar;

/// Films a day.
#[derive(Parser)]
struct Options {
    /// The world file, for its terrain and its air.
    #[arg(long, default_value = "assets/worlds/alpine.ron")]
    world: PathBuf,
    /// The picture's size, WIDTHxHEIGHT.
    #[arg(long, default_value = "480x270", value_parser = size)]
    size: [u32; 2],
    /// How many pictures, spread over the day.
    #[arg(long, default_value_t = 96, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Where they go.
    #[arg(long, default_value = "target/time_of_day")]
    out: PathBuf,
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.filter(|sides| sides.iter().all(|side| (1..=8192).contains(side))).ok_or("a size is WIDTHxHEIGHT".into())
}

/// The first and the last picture's hour, universal time.
const HOURS: [f64; 2] = [3.0, 21.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse();
    let world = WorldFile::from_ron(&fs::read_to_string(&options.world)?)?;
    let terrain = world.terrain.unwrap_or_default();
    let ground = terrain.field.compile::<2>(&horizon_field::field::NoImages)?;
    let [width, height] = options.size;
    let mut stage = Stage::new(width, height);
    stage.world().spawn((terrain, world.atmosphere.unwrap_or_default()));
    stage.world().init_resource::<GlobalAmbientLight>();
    let sun = stage.world().spawn((DirectionalLight::default(), Sunlight, TimeOfDay::default())).id();
    let camera = stage.camera;
    // To the west, where the sun sets.
    let [x, z] = world.view.position;
    let y = ground.value_f64(&ground.anchor(&Place::ORIGIN), [x.into(), z.into()], 0.0) as f32;
    let eye = Vec3::new(x, y + world.view.above_ground, z);
    stage.look(Transform::from_translation(eye).looking_to(Vec3::new(-1.0, 0.04, -0.45), Vec3::Y));

    fs::create_dir_all(&options.out)?;
    let film = options.out.join("day.png");
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(&film)?), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_animated(options.frames, 0)?;
    encoder.set_frame_delay(1, 12)?;
    let mut writer = encoder.write_header()?;
    let bar = ProgressBar::new(options.frames.into());
    for frame in 0..options.frames {
        let part = f64::from(frame) / f64::from((options.frames - 1).max(1));
        let hours = HOURS[0] + (HOURS[1] - HOURS[0]) * part;
        stage.world().get_mut::<TimeOfDay>(sun).ok_or("the sun is there")?.hours = hours;
        // Once to turn the sun and to light the scene, and once more for the exposure that this asks for.
        stage.frame();
        let ev100 = meter(stage.world(), sun);
        stage.world().entity_mut(camera).insert(Exposure { ev100 });
        stage.settle();
        let picture = image::DynamicImage::from(stage.off.screenshot()).into_rgb8();
        picture.save(options.out.join(format!("day_{frame:03}.png")))?;
        writer.write_image_data(picture.as_raw())?;
        bar.inc(1);
    }
    writer.finish()?;
    println!("A day in {} pictures, for a browser: {}", options.frames, film.display());
    Ok(())
}

/// Exposes for the light that there is, as an eye does: nights stay darker than days.
fn meter(world: &mut World, sun: Entity) -> f32 {
    let ambient = world.resource::<GlobalAmbientLight>();
    let sky = std::f32::consts::PI * ambient.brightness * ambient.color.luminance();
    let light = world.get::<DirectionalLight>(sun).map_or(0.0, |light| {
        let up = world.get::<Transform>(sun).map_or(0.0, |at| at.back().y.max(0.2));
        light.illuminance * light.color.luminance() * up
    });
    let day = ((sky + light) / 2.5).max(1e-4).log2() - 1.75;
    day.max(0.75 * day - 1.0).max(-1.0)
}
