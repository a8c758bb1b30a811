//! World files: those that ship, those that are bad, and those that change while they are in use.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bevy::asset::AssetPlugin;
use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy_horizon::HorizonWorldPlugin;
use bevy_horizon::prelude::*;
use bevy_horizon::scene::{HorizonScenePlugin, WorldFileError, WorldLoaded, WorldRejected};

const GOOD: &str = "(
    version: 1,
    terrain: (
        field: Fractal(
            wavelength: 1000.0,
            gain: 0.5,
        ),
    ),
    sun: (elevation: 0.5),
)
";

/// An app without a renderer, that reads its assets from a directory.
fn app(assets: &Path) -> App {
    let mut app = App::new();
    let assets = AssetPlugin {
        file_path: assets.to_string_lossy().into_owned(),
        watch_for_changes_override: Some(false),
        ..default()
    };
    app.add_plugins((MinimalPlugins, assets, HorizonWorldPlugin, HorizonScenePlugin));
    app.init_resource::<Heard>().add_systems(Update, listen);
    app.finish();
    app.cleanup();
    app
}

/// What was sent since the start.
#[derive(Resource, Default)]
struct Heard {
    loaded: usize,
    rejected: Vec<WorldRejected>,
}

fn listen(
    mut heard: ResMut<Heard>,
    mut loaded: MessageReader<WorldLoaded>,
    mut rejected: MessageReader<WorldRejected>,
) {
    heard.loaded += loaded.read().count();
    heard.rejected.extend(rejected.read().cloned());
}

/// Frames, until it holds.
fn pump(app: &mut App, what: &str, holds: impl Fn(&Heard) -> bool) {
    let start = Instant::now();
    while !holds(app.world().resource()) {
        assert!(start.elapsed() < Duration::from_secs(20), "{what} did not come");
        app.update();
        std::thread::sleep(Duration::from_millis(1));
    }
    app.update();
}

fn load(app: &mut App, path: &str) -> Entity {
    let handle = app.world().resource::<AssetServer>().load(path.to_owned());
    app.world_mut().spawn(HorizonWorld(handle)).id()
}

/// A directory of a test's own, for its assets.
fn directory(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("bevy_horizon_{name}_{}", std::process::id()));
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn shipped() -> Vec<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/worlds");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn shipped_worlds_survive_being_written() {
    let paths = shipped();
    assert!(paths.len() >= 4, "{paths:?}");
    for path in paths {
        let text = std::fs::read_to_string(&path).unwrap();
        let world = WorldFile::from_ron(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let written = world.to_ron().unwrap();
        let again = WorldFile::from_ron(&written).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(written, again.to_ron().unwrap(), "{}", path.display());
        assert!(world == again, "{}", path.display());
    }
}

#[test]
fn shipped_worlds_load_and_answer_without_a_renderer() {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    for path in shipped() {
        let mut app = app(&assets);
        let name = path.strip_prefix(&assets).unwrap().to_string_lossy().into_owned();
        let entity = load(&mut app, &name);
        pump(&mut app, &name, |heard| heard.loaded > 0 || !heard.rejected.is_empty());
        assert!(app.world().resource::<Heard>().rejected.is_empty(), "{:?}", app.world().resource::<Heard>().rejected);
        assert!(app.world().get::<Atmosphere>(entity).is_some(), "{name} has no air");
        let heights = app
            .world_mut()
            .run_system_once(|world: HorizonQuery| {
                let positions = (0..100).map(|i| Vec3::new(i as f32 * 137.0, 0.0, i as f32 * -89.0));
                world.heights(&positions.collect::<Vec<_>>())
            })
            .unwrap();
        let (low, high) = heights.iter().fold((f32::MAX, f32::MIN), |(low, high), h| (low.min(*h), high.max(*h)));
        println!("{name}: {low:.0} to {high:.0} m");
        assert_eq!(heights.len(), 100, "{name} has no ground");
        assert!(heights.iter().all(|h| h.is_finite()) && high - low > 5.0 && high - low < 1e4, "{name}: {heights:?}");
    }
}

/// A bad file, and what its error must be and say.
type Bad = (&'static str, String, fn(&WorldFileError) -> bool, &'static [&'static str]);

fn bad_files() -> Vec<Bad> {
    let syntax = |error: &WorldFileError| matches!(error, WorldFileError::Syntax { .. });
    let value = |error: &WorldFileError| matches!(error, WorldFileError::Value { .. });
    let field = |field: &str| GOOD.replace("gain: 0.5", field);
    let material =
        |parts: &str| GOOD.replace("    ),\n    sun", &format!("        material: ({parts}),\n    ),\n    sun"));
    let trees = |parts: &str| GOOD.replace("    sun", &format!("    trees: ({parts}),\n    sun"));
    let nested = |depth: usize| {
        let field = format!("field: {}Constant(0.0){}", "Add([\n".repeat(depth), "])".repeat(depth));
        format!("(version: 1, terrain: ({field}))")
    };
    vec![
        ("empty", String::new(), syntax, &["line 1"]),
        ("truncated", GOOD[..GOOD.find("0.5").unwrap()].into(), syntax, &["line 6"]),
        ("not RON", "{\"version\": 1}".into(), syntax, &["line 1"]),
        (
            "version 2",
            GOOD.replace("version: 1", "version: 2").replace("gain", "of_tomorrow"),
            |error| matches!(error, WorldFileError::Version { found: 2 }),
            &["version 2"],
        ),
        ("no version", GOOD.replace("version: 1,", ""), syntax, &["line ", "version"]),
        ("unknown field", field("gian: 0.5"), syntax, &["line 6", "gian"]),
        ("unknown node", GOOD.replace("Fractal", "Fractle"), syntax, &["line 4", "Fractle"]),
        ("wrong type", field("gain: \"half\""), syntax, &["line 6"]),
        ("gain 1.5", field("gain: 1.5"), value, &["line 6", "Fractal.gain", "1.5"]),
        ("gain 1", field("gain: 1.0"), value, &["line 6", "Fractal.gain"]),
        ("NaN", field("gain: NaN"), value, &["line 6", "Fractal.gain", "NaN"]),
        ("infinite", GOOD.replace("1000.0", "inf"), value, &["line 5", "Fractal.wavelength", "inf"]),
        ("lacunarity 1", field("lacunarity: 1.0"), value, &["line 6", "Fractal.lacunarity"]),
        ("negative octaves", field("octaves: -3.0"), value, &["line 6", "Fractal.octaves", "-3"]),
        ("cells of -1 m", trees("forest: (spacing: -1.0)"), value, &["line 9", "trees.forest.spacing", "-1"]),
        ("crowns too wide", trees("forest: (species: [(radius: 2.0)])"), value, &["line 9", "species[0].radius"]),
        ("wind of NaN", trees("wind: (0.1, NaN)"), value, &["line 9", "trees.wind[1]", "NaN"]),
        ("sun of NaN", GOOD.replace("elevation: 0.5", "elevation: NaN"), value, &["line 9", "sun.elevation", "NaN"]),
        ("unknown rule", material("layers: [(hight: ())]"), syntax, &["line 8", "hight"]),
        ("colour 1.5", material("base: (colour: (0.1, 1.5, 0.1))"), value, &["line 8", "material.base.colour", "1.5"]),
        (
            "falling heights",
            material("layers: [(), (height: (low: 5.0, high: 1.0))]"),
            value,
            &["line 8", "material.layers[1].height", "5 to 1"],
        ),
        (
            "a mask of NaN",
            material("layers: [(mask: (field: Fractal(octaves: NaN)))]"),
            value,
            &["line 8", "material.layers[0].mask", "Fractal.octaves", "NaN"],
        ),
        ("17 layers", material(&format!("layers: [{}]", "(),".repeat(17))), value, &["line 8", "17 layers"]),
        ("nested 70 deep", nested(70), |_| true, &[]),
        ("nested 10 000 deep", nested(10_000), syntax, &["line "]),
    ]
}

#[test]
fn bad_files_are_refused_with_field_and_line() {
    assert!(WorldFile::from_ron(GOOD).is_ok());
    for (name, text, is_expected, parts) in bad_files() {
        let error = WorldFile::from_ron(&text).err().unwrap_or_else(|| panic!("{name} was taken"));
        println!("{name}: {error}");
        assert!(is_expected(&error), "{name}: {error:?}");
        for part in parts {
            assert!(error.to_string().contains(part), "{name}: \"{error}\" does not say {part:?}");
        }
    }
}

#[test]
fn what_only_the_loader_sees_is_refused_too() {
    let directory = directory("loader");
    let image = |path: &str| {
        GOOD.replace("Fractal", "Image")
            .replace("gain: 0.5,", "")
            .replace("wavelength: 1000.0", &format!("path: \"{path}\""))
    };
    std::fs::write(directory.join("not_an_image.png"), b"a text").unwrap();
    let cases: [(&str, Vec<u8>, &[&str]); 5] = [
        ("missing_image.ron", image("nowhere.png").into(), &["nowhere.png"]),
        ("bad_image.ron", image("not_an_image.png").into(), &["not_an_image.png"]),
        ("garbage.ron", (0..=255).rev().cycle().take(9999).collect(), &["line 1"]),
        ("cut_letter.ron", [GOOD.as_bytes(), b"// \xc3"].concat(), &["line 11"]),
        (
            "missing_mask.ron",
            GOOD.replace(
                "    ),\n    sun",
                "        material: (layers: [(mask: (field: Image(path: \"paint.png\")))]),\n    ),\n    sun",
            )
            .into(),
            &["line 8", "paint.png"],
        ),
    ];
    for (name, bytes, parts) in cases {
        std::fs::write(directory.join(name), bytes).unwrap();
        let mut app = app(&directory);
        let entity = load(&mut app, name);
        pump(&mut app, name, |heard| !heard.rejected.is_empty() || heard.loaded > 0);
        let rejected = app.world().resource::<Heard>().rejected.first().unwrap_or_else(|| panic!("{name} was taken"));
        println!("{name}: {}", rejected.error);
        assert_eq!(rejected.path, name);
        assert!(parts.iter().all(|part| rejected.error.contains(part)), "{name}: {}", rejected.error);
        assert!(app.world().get::<Terrain>(entity).is_none());
    }
    std::fs::remove_dir_all(directory).unwrap();
}

#[test]
fn a_world_stays_when_its_file_turns_bad() {
    let directory = directory("reload");
    let file = directory.join("world.ron");
    let reload = |app: &mut App, text: &str| {
        std::fs::write(&file, text).unwrap();
        app.world().resource::<AssetServer>().reload("world.ron");
    };
    let height = |app: &mut App| {
        app.world_mut().run_system_once(|world: HorizonQuery| world.height(Vec3::new(123.0, 0.0, 456.0))).unwrap()
    };
    std::fs::write(&file, GOOD).unwrap();
    let mut app = app(&directory);
    let entity = load(&mut app, "world.ron");
    pump(&mut app, "the world", |heard| heard.loaded == 1);
    let (before, ground) = (app.world().get::<Terrain>(entity).unwrap().clone(), height(&mut app));

    for (rejected, (name, text, ..)) in bad_files().into_iter().enumerate() {
        reload(&mut app, &text);
        pump(&mut app, name, |heard| heard.rejected.len() > rejected);
        assert!(*app.world().get::<Terrain>(entity).unwrap() == before, "{name} changed the terrain");
        assert_eq!(height(&mut app), ground, "{name} changed the ground");
        assert_eq!(app.world().resource::<Heard>().loaded, 1, "{name}");
    }

    reload(&mut app, &GOOD.replace("1000.0", "1500.0"));
    pump(&mut app, "the mended world", |heard| heard.loaded == 2);
    let after = app.world().get::<Terrain>(entity).unwrap();
    assert!(matches!(&after.field, Field::Fractal(fractal) if fractal.wavelength == 1500.0));
    assert_ne!(height(&mut app), ground);
    std::fs::remove_dir_all(directory).unwrap();
}
