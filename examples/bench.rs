//! What a world costs on this machine: adapter, time in each pass, frame time, tiles filled. Runs unattended.
//!
//! `cargo run --example bench -- --world assets/worlds/alpine.ron --size 1280x720 --speed 10`
use std::path::PathBuf;

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::renderer::RenderAdapterInfo;
use bevy_horizon::prelude::*;
use bevy_horizon::render::cache::Caches;
use bevy_horizon::scene::PlacedWater;
use bevy_horizon_workspace::stage::Stage;
use clap::Parser;

/// Measures a world: frame time and passes, still and on the move.
#[derive(Parser)]
struct Options {
    /// The world file.
    #[arg(long, default_value = "assets/worlds/alpine.ron")]
    world: PathBuf,
    /// The picture's size, WIDTHxHEIGHT.
    #[arg(long, default_value = "1280x720", value_parser = size)]
    size: [u32; 2],
    /// Frames that are measured, after the world has filled in.
    #[arg(long, default_value_t = 20)]
    frames: u32,
    /// Metres per second, at 60 frames a second.
    #[arg(long, default_value_t = 10.0)]
    speed: f32,
    /// Metres above the ground.
    #[arg(long, default_value_t = 1.7)]
    above: f32,
    /// How well the camera draws.
    #[arg(long, value_enum, default_value_t = Quality::High)]
    quality: Quality,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Quality {
    Low,
    Medium,
    High,
    Ultra,
}

impl Quality {
    fn camera(self) -> HorizonCamera {
        match self {
            Self::Low => HorizonCamera::LOW,
            Self::Medium => HorizonCamera::MEDIUM,
            Self::High => HorizonCamera::HIGH,
            Self::Ultra => HorizonCamera::ULTRA,
        }
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    sides.filter(|sides| sides.iter().all(|side| (1..=8192).contains(side))).ok_or("a size is WIDTHxHEIGHT".into())
}

/// The passes, by the names of their spans.
const PASSES: [&str; 15] = [
    "horizon_fill",
    "horizon_pyramid",
    "horizon_light",
    "horizon_clearance",
    "horizon_ground",
    "horizon_ground_scaled",
    "horizon_shade",
    "horizon_cast",
    "horizon_cast_trees",
    "horizon_trees",
    "horizon_sea",
    "horizon_water",
    "horizon_veil",
    "horizon_haze",
    "horizon_sky",
];

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse();
    let world = WorldFile::from_ron(&std::fs::read_to_string(&options.world)?)?;
    let mut stage = Stage::new(options.size[0], options.size[1]);
    stage.light();
    let mut suns = stage.world().query::<&mut DirectionalLight>();
    for mut sun in suns.iter_mut(stage.world()) {
        sun.shadow_maps_enabled = true;
    }
    let terrain = world.terrain.unwrap_or_default();
    let ground = terrain.field.compile::<2>(&horizon_field::field::NoImages)?;
    let origin = ground.anchor(&Place::ORIGIN);
    let mut ground_entity = stage.world().spawn(terrain);
    if let Some(trees) = world.trees {
        ground_entity.insert(trees);
    }
    for PlacedWater { level, middle: [x, z], water } in world.waters {
        stage.world().spawn((water, Transform::from_xyz(x, level, z)));
    }
    let sky = stage.world().spawn(Atmosphere::default()).id();
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(options.quality.camera());
    let mut at = 0.0f32;
    let mut measure = |stage: &mut Stage, speed: f32| {
        let mut frames = Vec::new();
        let mut passes = PASSES.map(|_| Vec::new());
        let before = tiles(stage);
        for _ in 0..options.frames {
            at -= speed / 60.0;
            let y = ground.value_f64(&origin, [0.0, f64::from(at)], 0.0) as f32 + options.above;
            stage.look(Transform::from_xyz(0.0, y, at).looking_to(Vec3::new(0.2, -0.02, -1.0), Vec3::Y));
            if frames.is_empty() && speed == 0.0 {
                stage.settle();
                for name in PASSES {
                    stage.spent(name);
                }
            }
            frames.push(stage.frame());
            for (list, name) in passes.iter_mut().zip(PASSES) {
                list.extend(stage.spent(name));
            }
        }
        println!(
            "{speed} m/s: frame {:.1} ms, {} tiles a frame",
            median(frames),
            (tiles(stage) - before) / u64::from(options.frames)
        );
        for (name, list) in PASSES.iter().zip(passes) {
            let mean = list.iter().sum::<f64>() / f64::from(options.frames);
            println!("  {name:18} {mean:7.2} ms");
        }
    };
    measure(&mut stage, 0.0);
    measure(&mut stage, options.speed);
    // What rays cost, counted; without air over it.
    stage.world().despawn(sky);
    stage.world().get_mut::<HorizonCamera>(camera).unwrap().debug = DebugView::Work;
    stage.frame();
    let picture = stage.colour();
    let mean =
        |channel: usize| picture.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / picture.len() as f64;
    println!("{:.1} turns and {:.1} loads a ray", mean(0), mean(1));
    let info = stage.off.app.sub_app(RenderApp).world().resource::<RenderAdapterInfo>();
    println!("{} ({:?}, {})", info.name, info.backend, info.driver_info);
    Ok(())
}

fn tiles(stage: &Stage) -> u64 {
    stage.off.app.sub_app(RenderApp).world().resource::<Caches>().tiles_filled()
}
