//! Water that makes no sense is refused by name, by component and file; what was there before stays.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::scene::WorldFileError;
use bevy_horizon::world::WaterRejected;
use horizon_field::waves::{FbmWaves, Gerstner, Sines, Spectrum};

use super::{answers, settle, stage};

/// A bad edit, and the field that it is refused by.
type Bad = (&'static str, fn(&mut Water));

const BAD: [Bad; 13] = [
    ("water.foam", |water| water.foam = -1.0),
    ("water.foam", |water| water.foam = f32::NAN),
    ("water.ripples", |water| water.ripples = f32::INFINITY),
    ("water.optics.index", |water| water.optics.index = 3.0),
    ("water.optics.absorption[1]", |water| water.optics.absorption[1] = f32::NAN),
    ("water.optics.anisotropy", |water| water.optics.anisotropy = 1.0),
    ("water.outline.Disc.radius", |water| water.outline = WaterOutline::Disc(WaterDisc { radius: 0.0 })),
    ("water.outline.Rectangle.half[1]", |water| {
        water.outline = WaterOutline::Rectangle(WaterRectangle { half: [1.0, f32::NAN] });
    }),
    ("water.waves.Spectrum.wind", |water| water.waves = Waves::Spectrum(Spectrum { wind: 99.0, ..default() })),
    ("water.waves.Spectrum.fetch", |water| water.waves = Waves::Spectrum(Spectrum { fetch: f64::NAN, ..default() })),
    ("water.waves.Gerstner.steepness", |water| {
        water.waves = Waves::Gerstner(Gerstner { steepness: 1.5, ..default() });
    }),
    ("water.waves.Sines.count", |water| water.waves = Waves::Sines(Sines { count: 21, ..default() })),
    ("water.waves.Fbm.gain", |water| water.waves = Waves::Fbm(FbmWaves { gain: 1.0, ..default() })),
];

#[test]
fn bad_water_is_refused_by_name_and_what_was_there_stays() {
    let mut stage = stage([80, 45], Water::default());
    stage.light();
    stage.look(Transform::from_xyz(0.0, 3.0, 0.0).looking_to(Vec3::new(0.0, -0.4, -1.0), Vec3::Y));
    settle(&mut stage);
    let water = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
    let places = vec![Vec3::ZERO, Vec3::new(700.0, 0.0, -30.0)];
    let before = (stage.colour(), stage.depth(), answers(&mut stage, places.clone(), 0.0));
    for (field, spoil) in BAD {
        let mut bad = Water::default();
        spoil(&mut bad);
        stage.world().entity_mut(water).insert(bad);
        stage.off.update();
        let rejected: Vec<WaterRejected> = stage.world().resource_mut::<Messages<WaterRejected>>().drain().collect();
        assert_eq!(rejected.len(), 1, "{field}: {rejected:?}");
        let message = rejected[0].error.to_string();
        println!("{message}");
        assert!(message.starts_with(field) && rejected[0].entity == water, "{field}: {message}");
        let after = (stage.colour(), stage.depth(), answers(&mut stage, places.clone(), 0.0));
        assert!(after == before, "{field} changed something");
    }
    // Good water is taken again.
    stage.world().entity_mut(water).insert(Water { waves: Waves::Still, ..default() });
    settle(&mut stage);
    assert_eq!(answers(&mut stage, places, 0.0), [Some(0.0); 2]);
    assert!(stage.depth() != before.1);
}

const GOOD: &str = "(
    version: 1,
    waters: [
        (
            level: 12.0,
            middle: (30.0, -40.0),
            water: (
                outline: Disc(radius: 80.0),
                waves: Spectrum(wind: 6.0),
                optics: (index: 1.33),
                foam: 0.5,
            ),
        ),
        (water: (waves: Still)),
    ],
)
";

#[test]
fn a_file_s_water_is_read_and_bad_water_refused_with_its_line() {
    let good = WorldFile::from_ron(GOOD).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(good.waters.len(), 2);
    assert_eq!((good.waters[0].level, good.waters[0].middle), (12.0, [30.0, -40.0]));
    assert_eq!(good.waters[0].water.outline, WaterOutline::Disc(WaterDisc { radius: 80.0 }));
    assert_eq!(good.waters[1].water.waves, Waves::Still);
    let again = WorldFile::from_ron(&good.to_ron().expect("it can be written")).expect("and read");
    assert!(again == good);

    let cases = [
        ("level: 12.0", "level: NaN", "line 5", "waters[0].level"),
        ("(30.0, -40.0)", "(30.0, inf)", "line 6", "waters[0].middle[1]"),
        ("radius: 80.0", "radius: -3.0", "line 8", "waters[0].water.outline.Disc.radius"),
        ("wind: 6.0", "wind: 99.0", "line 9", "waters[0].water.waves.Spectrum.wind"),
        ("wind: 6.0", "wnid: 6.0", "line 9", "wnid"),
        ("Spectrum(", "Spectre(", "line 9", "Spectre"),
        ("index: 1.33", "index: 9.0", "line 10", "waters[0].water.optics.index"),
        ("foam: 0.5", "foam: NaN", "line 11", "waters[0].water.foam"),
    ];
    for (from, to, line, field) in cases {
        let error = WorldFile::from_ron(&GOOD.replace(from, to)).err().unwrap_or_else(|| panic!("{to} was taken"));
        println!("{to}: {error}");
        let is_value = matches!(error, WorldFileError::Value { .. });
        assert!(is_value || matches!(error, WorldFileError::Syntax { .. }), "{to}: {error:?}");
        let message = error.to_string();
        assert!(message.contains(line) && message.contains(field), "{to}: {message}");
    }
}
