//! Published positions, and every input.

use super::*;
use proptest::prelude::*;

fn place(latitude: f64, longitude: f64) -> Place {
    Place { latitude: latitude.to_radians(), longitude: longitude.to_radians() }
}

/// Azimuth from north and elevation, in degrees.
fn angles(direction: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = direction;
    [libm::atan2(x, -z).to_degrees().rem_euclid(360.0), libm::atan2(y, libm::hypot(x, z)).to_degrees()]
}

fn at(place: Place, year: i32, month: u32, day: u32, hours: f64) -> [f64; 2] {
    angles(sun_direction(place, Instant::utc(year, month, day, hours).unwrap()).unwrap())
}

/// The example of NREL's report (Reda & Andreas, NREL/TP-560-34302, table A5.1): 17 October 2003, 12:30:30 at UTC−7. It
/// gives the zenith angle refracted, by its eq. 42 with 820 mbar and 11 °C, which is put on here.
#[test]
fn nrels_example() {
    let [azimuth, elevation] = at(place(39.742_476, -105.178_6), 2003, 10, 17, 19.0 + 30.5 / 60.0);
    let lifted = 820.0 / 1010.0 * 283.0 / (273.0 + 11.0) * 1.02
        / (60.0 * libm::tan((elevation + 10.3 / (elevation + 5.11)).to_radians()));
    assert!((azimuth - 194.340_24).abs() < 5e-4, "{azimuth}");
    assert!((90.0 - elevation - lifted - 50.111_62).abs() < 5e-4, "{elevation}");
}

/// Meeus, Astronomical Algorithms, example 25.b: 13 October 1992, 0 h dynamical time (59 s ahead of universal time),
/// apparent declination −7°47′01.74″. At the pole that is the elevation, less the parallax of 8.8″.
#[test]
fn meeus_declination() {
    let [_, elevation] = at(place(90.0, 0.0), 1992, 10, 13, -59.0 / 3600.0);
    let declination = -(7.0 + 47.0 / 60.0 + 1.74 / 3600.0);
    assert!((elevation + 8.79 / 3600.0 - declination).abs() < 3e-4, "{elevation}");
}

/// 2024: equinox on 20 March 03:06, solstice on 20 June 20:51 UTC (US Naval Observatory); obliquity 23.436°.
#[test]
fn seasons() {
    let pole = |month, hours| at(place(90.0, 0.0), 2024, month, 20, hours)[1];
    assert!(pole(3, 3.1).abs() < 4e-3, "{}", pole(3, 3.1));
    assert!((pole(6, 20.85) - 23.436).abs() < 4e-3, "{}", pole(6, 20.85));
    assert!(at(place(80.0, 0.0), 2024, 12, 21, 12.0)[1] < 0.0, "polar night");
    assert!(at(place(80.0, 0.0), 2024, 6, 21, 0.0)[1] > 0.0, "midnight sun");
}

#[test]
fn a_day_goes_from_east_over_south_to_west() {
    let greenwich = |hours| at(place(51.48, 0.0), 2024, 3, 20, hours)[0];
    assert!(
        (greenwich(6.2) - 90.0).abs() < 3.0
            && (greenwich(12.12) - 180.0).abs() < 1.0
            && (greenwich(18.1) - 270.0).abs() < 3.0
    );
    let sydney = at(place(-33.87, 151.2), 2024, 3, 20, 2.0)[0];
    assert!(!(5.0..=355.0).contains(&sydney), "north at noon: {sydney}");
    let east = sun_direction(place(0.0, 0.0), Instant::utc(2024, 3, 20, 6.2).unwrap()).unwrap();
    assert!(east[0] > 0.99, "+x is east: {east:?}");
}

#[test]
fn hours_run_on() {
    assert_eq!(Instant::utc(2000, 1, 1, 12.0), Ok(Instant::default()));
    assert_eq!(Instant::utc(2023, 12, 31, 30.0), Instant::utc(2024, 1, 1, 6.0));
}

#[test]
fn what_is_wrong_is_named() {
    let now = Instant::default();
    assert_eq!(Instant::utc(2023, 2, 29, 0.0), Err(SolarError::Date { year: 2023, month: 2, day: 29 }));
    assert!(Instant::utc(2024, 2, 29, 0.0).is_ok());
    assert!(matches!(sun_direction(place(90.1, 0.0), now), Err(SolarError::Latitude(_))));
    assert!(matches!(sun_direction(place(0.0, f64::NAN), now), Err(SolarError::Longitude(_))));
    assert_eq!(sun_direction(Place::default(), Instant { days: 1e7 }), Err(SolarError::Instant(1e7)));
    assert!(sun_direction(Place::default(), Instant { days: f64::NAN }).is_err());
}

/// Seed 000 eq. B.10 with its θ taken for the elevation, as it is named, has the sun of the horizon overhead.
#[test]
fn by_hand_has_its_angles_named_right() {
    let named =
        |phi: f64, theta: f64| [libm::sin(theta) * libm::cos(phi), libm::cos(theta), libm::sin(theta) * libm::sin(phi)];
    assert_eq!(named(0.0, 0.0)[1], 1.0, "naive: elevation 0 is the zenith");
    assert!(by_hand(0.0, 0.0)[1].abs() < 1e-15);
    for (azimuth, elevation) in [(0.3, 0.2), (2.0, -0.4), (4.0, 1.5)] {
        let right = named(azimuth - FRAC_PI_2, FRAC_PI_2 - elevation);
        assert!((0..3).all(|k| (by_hand(azimuth, elevation)[k] - right[k]).abs() < 1e-15));
        let back = angles(by_hand(azimuth, elevation));
        assert!((back[0].to_radians() - azimuth).abs() < 1e-9 && (back[1].to_radians() - elevation).abs() < 1e-9);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_unit_vector_or_an_error(latitude in -2.0_f64..2.0, longitude in prop::num::f64::ANY, days in prop::num::f64::ANY) {
        if let Ok(direction) = sun_direction(Place { latitude, longitude }, Instant { days }) {
            prop_assert!((direction.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12, "{direction:?}");
        }
    }

    #[test]
    fn every_valid_moment_has_a_sun(latitude in -FRAC_PI_2..=FRAC_PI_2, longitude in -1e3_f64..1e3, days in -9e5_f64..3.6e5) {
        let direction = sun_direction(Place { latitude, longitude }, Instant { days }).unwrap();
        prop_assert!((direction.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12, "{direction:?}");
    }
}
