//! What waves must not be, and what all others are.

use proptest::prelude::*;

use super::super::{FbmWaves, Gerstner, Sea, Sines, Spectrum, Waves};

#[test]
fn bad_parameters_are_refused_by_name() {
    let wind = |wind| Waves::Spectrum(Spectrum { wind, ..Spectrum::default() });
    let cases = [
        (wind(f64::NAN), "waves.Spectrum.wind is NaN, not a finite number"),
        (wind(-1.0), "waves.Spectrum.wind is -1, outside 0 to 60 m/s"),
        (wind(f64::INFINITY), "waves.Spectrum.wind is inf, not a finite number"),
        (
            Waves::Gerstner(Gerstner { steepness: 1.5, ..Gerstner::default() }),
            "waves.Gerstner.steepness is 1.5, outside 0 to 1 ",
        ),
        (Waves::Sines(Sines { count: 0, ..Sines::default() }), "waves.Sines.count is 0, outside 1 to 20 "),
        (
            Waves::Fbm(FbmWaves { lacunarity: 1.0, ..FbmWaves::default() }),
            "waves.Fbm.lacunarity is 1, outside 1.25 to 4 ",
        ),
    ];
    for (waves, message) in cases {
        assert_eq!(Sea::new(&waves).expect_err(message).to_string(), message);
    }
}

#[test]
fn waves_survive_files() {
    for (_, waves) in super::every_model() {
        let text = ron::to_string(&waves).expect("waves can be written");
        assert_eq!(ron::from_str::<Waves>(&text).expect(&text), waves);
    }
    assert_eq!(ron::from_str::<Waves>("Spectrum((wind: 3.0))").unwrap(), {
        Waves::Spectrum(Spectrum { wind: 3.0, ..Spectrum::default() })
    });
    let unknown = ron::from_str::<Waves>("Spectrum((wnd: 3.0))").unwrap_err();
    assert!(unknown.to_string().contains("wnd"), "{unknown}");
}

fn any_waves() -> impl Strategy<Value = Waves> {
    let scale = |low: f64, high: f64| (low.ln()..=high.ln()).prop_map(f64::exp);
    let common = (scale(0.0501, 9999.0), 0.0..=50.0, -1000.0..=1000.0, any::<u32>());
    prop_oneof![
        (common.clone(), 1u32..=20, 0.0..=3.15).prop_map(|((wavelength, amplitude, heading, seed), count, spread)| {
            Waves::Sines(Sines { count, wavelength, amplitude, heading, spread, seed })
        }),
        (common.clone(), 1u32..=20, 0.0..=1.0, 0.0..=3.15).prop_map(
            |((wavelength, amplitude, heading, seed), count, steepness, spread)| {
                Waves::Gerstner(Gerstner { count, wavelength, amplitude, steepness, heading, spread, seed })
            }
        ),
        (common, 1u32..=8, 1.25..=4.0, 1e-3..=0.999, 0.0..=100.0).prop_map(
            |((wavelength, amplitude, heading, seed), octaves, lacunarity, gain, speed)| {
                Waves::Fbm(FbmWaves { wavelength, amplitude, octaves, lacunarity, gain, heading, speed, seed })
            }
        ),
        (0.0..=60.0, scale(1.0, 9.9e8), -1000.0..=1000.0, 0.0..=100.0, 0.0..=2.0, any::<u32>()).prop_map(
            |(wind, fetch, heading, focus, choppiness, seed)| {
                Waves::Spectrum(Spectrum { wind, fetch, heading, focus, choppiness, seed })
            }
        ),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the parameters, all that comes out is finite, within its bound, and fits into half floats.
    #[test]
    fn all_seas_are_finite(waves in any_waves(), time in -1e7..1e7, x in -1e9..1e9, z in -1e9..1e9) {
        let sea = Sea::new(&waves).expect("the parameters are in range");
        prop_assert!(sea.rest.is_finite() && sea.rest >= 0.0);
        prop_assert!(sea.bound() < 250.0, "{}", sea.bound());
        for cascade in &sea.cascades {
            prop_assert!(cascade.side.is_finite() && cascade.side > 0.0);
            for wave in &cascade.waves {
                prop_assert!(wave.amplitude.is_finite() && wave.phase.is_finite());
                // Exact in single precision.
                prop_assert!(wave.beats.unsigned_abs() < 1 << 24, "{wave:?}");
            }
        }
        let tiles = sea.tiles(time);
        let height = tiles.height([x, z]);
        prop_assert!(height.abs() <= f64::from(sea.bound()) * 1.000_001);
        let [nx, ny, nz] = tiles.normal([x, z]);
        prop_assert!((nx * nx + ny * ny + nz * nz - 1.0).abs() < 1e-9 && ny > 0.0);
        let seen = tiles.moments([x, z], sea.cascades.first().map_or(1.0, |cascade| cascade.side / 20.0));
        let [xx, zz, xz] = seen.variance;
        prop_assert!(xx >= 0.0 && zz >= 0.0 && xz.is_finite() && (0.0..=1.0).contains(&seen.foam));
    }
}
