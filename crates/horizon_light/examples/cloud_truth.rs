//! Writes the truth that models of clouds are measured against: light scattered once, by quadrature, and all light, by paths, along
//! the rays of `reference::cloud::scenes`. Some fifteen minutes of one core, over three threads.
//!
//! `cargo run -p horizon_light --example cloud_truth -- assets/truth/clouds.csv`

use std::fmt::Write;
use std::process::ExitCode;

use horizon_light::reference::cloud::scenes::{SUNS, Scene, Scenes};

/// The standard error asked for, relative to the mean.
const RELATIVE: f64 = 0.015;

/// Paths after which a ray is taken as it is.
const MOST: u64 = 300_000;

/// Cells of the quadrature along a ray, and towards the sun.
const CELLS: usize = 600;

fn main() -> ExitCode {
    let Some(file) = std::env::args().nth(1) else {
        eprintln!("say which file to write");
        return ExitCode::FAILURE;
    };
    let scenes = Scenes::new();
    let mut table = "scene,sun_zenith_deg,ray,once,all,standard_error\n".to_owned();
    for scene in Scene::ALL {
        let matter = scenes.matter(scene);
        let rows = |zenith: f64| {
            let lit = scenes.lit(&matter, zenith);
            let mut rows = String::new();
            for (ray, [from, toward]) in scene.rays().into_iter().enumerate() {
                let once = lit.once(from, toward, CELLS);
                let all = lit.radiance_within(from, toward, RELATIVE, MOST, ray as u64);
                let (name, mean, error) = (scene.name(), all.mean, all.standard_error);
                // Writing to a string does not fail.
                let _ = writeln!(rows, "{name},{zenith},{ray},{once:.5e},{mean:.5e},{error:.2e}");
            }
            eprintln!("{}, sun at {zenith} degrees: done", scene.name());
            rows
        };
        std::thread::scope(|scope| {
            let suns = SUNS.map(|zenith| {
                scope.spawn({
                    let rows = &rows;
                    move || rows(zenith)
                })
            });
            for sun in suns {
                table += &sun.join().unwrap_or_default();
            }
        });
    }
    if let Err(error) = std::fs::write(&file, table) {
        eprintln!("cannot write {file}: {error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
