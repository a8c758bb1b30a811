use crate::water::presets::Contents;
use crate::water::{WaterError, WaterOptics};

const PRESETS: [(WaterOptics, Contents); 5] = [
    (WaterOptics::CLEAR_SEA, Contents::CLEAR_SEA),
    (WaterOptics::COAST, Contents::COAST),
    (WaterOptics::LAKE, Contents::LAKE),
    (WaterOptics::GLACIER_MILK, Contents::GLACIER_MILK),
    (WaterOptics::SWAMP, Contents::SWAMP),
];

#[test]
fn presets_are_what_their_laws_give() {
    for (preset, contents) in PRESETS {
        assert_eq!(preset.check(), Ok(()));
        let law = contents.optics();
        for (ours, law) in [
            (preset.absorption, law.absorption),
            (preset.scattering, law.scattering),
            (preset.molecules, law.molecules),
        ] {
            assert!((0..3).all(|k| (ours[k] / law[k] - 1.0).abs() < 5e-3), "{contents:?}: {ours:?}, {law:?}");
        }
    }
    let pure = Contents { chlorophyll: 0.0, yellow: 0.0, mineral: 0.0, salt: false }.optics();
    assert_eq!((WaterOptics::PURE.check(), pure.absorption), (Ok(()), WaterOptics::PURE.absorption));
}

/// Pure water is blue by its absorption alone, and peat turns that round.
#[test]
fn colours_are_in_the_order_that_they_are_known_for() {
    let [red, green, blue] = WaterOptics::PURE.absorption;
    assert!(red > 5.0 * green && green > 5.0 * blue);
    let [red, green, blue] = WaterOptics::SWAMP.absorption;
    assert!(blue > 3.0 * green && green > 2.0 * red);
    let [red, green, blue] = WaterOptics::COAST.absorption;
    assert!(green < red && green < blue);
}

#[test]
fn every_wrong_number_is_named() {
    let sea = WaterOptics::CLEAR_SEA;
    for value in [f32::NAN, f32::INFINITY, -1.0, 2e3] {
        let one = [0.1, value, 0.1];
        for (name, water) in [
            ("absorption", WaterOptics { absorption: one, ..sea }),
            ("scattering", WaterOptics { scattering: one, ..sea }),
            ("molecules", WaterOptics { molecules: one, ..sea }),
            ("anisotropy", WaterOptics { anisotropy: value, ..sea }),
            ("index", WaterOptics { index: value, ..sea }),
            ("foam", WaterOptics { foam: value, ..sea }),
        ] {
            let error = water.check().expect_err(name);
            assert!(error.to_string().contains(&format!("`{name}`")), "{name}: {error}");
            assert_eq!(matches!(error, WaterError::NotFinite { .. }), !value.is_finite(), "{name}: {error}");
        }
    }
    for water in [WaterOptics { index: 1.6, ..sea }, WaterOptics { anisotropy: 0.99, foam: 1.0, ..sea }] {
        assert_eq!(water.check(), Ok(()), "ends of the ranges are in them");
    }
}
