use super::*;
use crate::spectrum::earth::earth;

/// Name, and a medium whose one number is replaced.
fn fields(value: f64) -> Vec<(&'static str, Medium)> {
    let m = Medium::BRUNETON;
    let one = [1e-6, value, 1e-6];
    vec![
        ("wavelengths", Medium { wavelengths: [680.0, value, 440.0], ..m }),
        ("radius", Medium { radius: value, ..m }),
        ("height", Medium { height: value, ..m }),
        ("rayleigh", Medium { rayleigh: one, ..m }),
        ("rayleigh_height", Medium { rayleigh_height: value, ..m }),
        ("mie_scattering", Medium { mie_scattering: one, ..m }),
        ("mie_absorption", Medium { mie_absorption: one, ..m }),
        ("mie_height", Medium { mie_height: value, ..m }),
        ("mie_asymmetry", Medium { mie_asymmetry: value, ..m }),
        ("absorption", Medium { absorption: one, ..m }),
        ("absorption_peak", Medium { absorption_peak: value, ..m }),
        ("absorption_width", Medium { absorption_width: value, ..m }),
        ("albedo", Medium { albedo: one, ..m }),
        ("irradiance", Medium { irradiance: one, ..m }),
        ("sun_radius", Medium { sun_radius: value, ..m }),
    ]
}

#[test]
fn every_preset_passes() {
    for medium in [Medium::EARTH, Medium::BRUNETON, Medium::LEEDS, Medium::MARS, Medium::ALIEN, Medium::SMALL_PLANET] {
        assert_eq!(medium.check(), Ok(()));
        assert_eq!(medium.without_mie().check(), Ok(()));
        assert_eq!(medium.lossless().check(), Ok(()));
    }
}

#[test]
fn every_wrong_number_is_named() {
    for value in [f64::NAN, f64::INFINITY, -1.0, 1e16] {
        for (name, medium) in fields(value) {
            let error = medium.check().expect_err(name);
            assert!(error.to_string().contains(&format!("`{name}`")), "{name}: {error}");
            assert_eq!(matches!(error, MediumError::NotFinite { .. }), !value.is_finite(), "{name}: {error}");
        }
    }
}

/// Two alike, or in another order, and no curve can be drawn through them.
#[test]
fn wavelengths_that_do_not_fall_are_refused() {
    for wavelengths in [[680.0, 680.0, 440.0], [440.0, 550.0, 680.0], [550.0, 545.0, 440.0], [680.0, 550.0, 541.0]] {
        let error = Medium { wavelengths, ..Medium::EARTH }.check().expect_err("they do not fall");
        assert!(error.to_string().contains("`wavelengths[1]`"), "{error}");
    }
}

#[test]
fn earth_is_its_laws_at_its_wavelengths() {
    for medium in [Medium::EARTH, Medium::BRUNETON] {
        let laws = earth(medium.wavelengths);
        let pairs = [(medium.rayleigh, laws.rayleigh), (medium.absorption, laws.absorption)];
        for (ours, law) in pairs.into_iter().chain([(medium.irradiance, laws.irradiance)]) {
            assert!((0..3).all(|k| (ours[k] / law[k] - 1.0).abs() < 1e-4), "{ours:?}, {law:?}");
        }
        let rest =
            Medium { rayleigh: laws.rayleigh, absorption: laws.absorption, irradiance: laws.irradiance, ..medium };
        assert_eq!(rest, laws);
    }
}

#[test]
fn rayleigh_follows_the_fourth_power() {
    // reference-values.md A: 1.24062e-6 λ⁻⁴, λ in µm.
    for (beta, nanometres) in Medium::BRUNETON.rayleigh.into_iter().zip(WAVELENGTHS) {
        assert!((beta / (1.24062e-6 * (nanometres * 1e-3).powi(-4)) - 1.0).abs() < 1e-4);
    }
}

#[test]
fn bruneton_is_the_published_set() {
    // reference-values.md A.
    let m = Medium::BRUNETON;
    assert_eq!((m.radius, m.radius + m.height, m.wavelengths), (6_360_000.0, 6_420_000.0, [680.0, 550.0, 440.0]));
    assert_eq!((m.irradiance, m.sun_radius), ([1.474, 1.8504, 1.91198], 0.004675));
    assert_eq!((m.rayleigh_height, m.mie_height, m.mie_asymmetry), (8_000.0, 1_200.0, 0.8));
    assert!(m.mie_extinction().iter().all(|e| (e - 4.44e-6).abs() < 1e-18));
    assert!((m.mie_scattering[0] / m.mie_extinction()[0] - 0.9).abs() < 1e-12);
    assert_eq!((m.absorption, m.albedo), ([6.497e-7, 1.8809e-6, 8.502e-8], [0.1; 3]));
    assert_eq!([10e3, 25e3, 40e3].map(|h| m.densities(h)[2]), [0.0, 1.0, 0.0]);
}

#[test]
fn lossless_air_keeps_all_light() {
    let m = Medium::BRUNETON.lossless();
    assert_eq!(m.mie_extinction(), m.mie_scattering);
    assert_eq!((m.absorption, m.albedo), ([0.0; 3], [1.0; 3]));
}
