//! What models make.

use core::f64::consts::TAU;

use super::super::spectrum::Jonswap;
use super::super::{CASCADES, FbmWaves, Gerstner, REACH, Sines, Spectrum, Waves, towards};
use super::{every_model, sea};

/// Tiles hold what they promise, and bands do not overlap.
#[test]
fn tiles_hold_each_wave_once() {
    for (name, waves) in every_model() {
        let sea = sea(&waves);
        assert_eq!(sea.cascades.len(), CASCADES, "{name}");
        for (cascade, shorter) in sea.cascades.iter().zip(&sea.cascades[1..]) {
            let ratio = cascade.side / shorter.side;
            assert!((6.0..7.0).contains(&ratio), "{name}: {ratio}");
        }
        for cascade in &sea.cascades {
            let mut n: Vec<_> = cascade.waves.iter().map(|wave| wave.n).collect();
            n.sort_unstable();
            n.dedup();
            assert_eq!(n.len(), cascade.waves.len(), "{name}");
            assert!(cascade.waves.iter().all(|wave| (1.0..=REACH as f64).contains(&wave.length())), "{name}");
            let modes = cascade.modes();
            assert_eq!(modes.len(), (2 * REACH + 1).pow(2));
            let held = modes.iter().filter(|mode| mode[0] != 0.0 || mode[1] != 0.0).count();
            assert!(held <= n.len() && held + 2 >= n.len(), "{name}: {held} of {}", n.len());
        }
    }
}

/// The significant wave height, 4 √m₀, of the tiles together: that of the integral, and about what JONSWAP's authors measured,
/// 0.0016 √χ U²/g.
#[test]
fn waves_are_as_high_as_jonswap_has_them() {
    for (wind, fetch) in [(4.0, 1e3), (7.0, 2e4), (10.0, 1e5), (20.0, 3e5), (30.0, 1e9)] {
        for seed in 0..4 {
            let model = Spectrum { wind, fetch, seed, ..Spectrum::default() };
            let sea = sea(&Waves::Spectrum(model));
            let found = 4.0 * sea.cascades.iter().map(|cascade| cascade.height_variance()).sum::<f64>().sqrt();
            let jonswap = Jonswap::new(wind, fetch).expect("there is wind");
            let whole = 4.0 * jonswap.integral(1e-6, 1e6, |_| 1.0).sqrt();
            let measured = 0.0016 * (9.81 * fetch / (wind * wind)).min(17_036.5).sqrt() * wind * wind / 9.81;
            println!("{wind} m/s, {fetch} m: {found:.4}, {whole:.4}, {measured:.4} m");
            assert!((found / whole - 1.0).abs() < 0.01, "{found} {whole}");
            assert!((0.8..1.5).contains(&(found / measured)), "{found} {measured}");
        }
    }
}

/// JONSWAP's integral of the pure f⁻⁵ spectrum, γ = 1, is known: α g² / (5 ωp⁴); γ = 3.3 adds half of it.
#[test]
fn the_integral_is_that_of_theory() {
    let jonswap = Jonswap::new(10.0, 1e5).expect("there is wind");
    let chi: f64 = 9.81 * 1e5 / 100.0;
    let alpha = 0.076 * chi.powf(-0.22);
    let plain = alpha * 9.81f64.powi(2) / (5.0 * jonswap.peak.powi(4));
    let share = jonswap.integral(1e-6, 1e6, |_| 1.0) / plain;
    assert!((1.50..1.55).contains(&share), "{share}");
    // No spectrum is higher than at its peak.
    let at = |share: f64| jonswap.density(share * jonswap.peak);
    assert!(at(1.0) > at(0.95) && at(1.0) > at(1.05) && at(0.3) < 1e-9 * at(1.0));
}

/// A calm sea is flat, and a little fetch is enough to move it.
#[test]
fn without_wind_nothing_moves() {
    for wind in [0.0, 0.05, 1e-300] {
        let still = sea(&Waves::Spectrum(Spectrum { wind, ..Spectrum::default() }));
        assert!(still.is_still() && still.bound() == 0.0 && still.rest == 0.0);
        assert_eq!(still.tiles(3.0).height([1.0, 2.0]), 0.0);
    }
    assert!(sea(&Waves::Still).is_still());
    assert!(sea(&Waves::Sines(Sines { amplitude: 0.0, ..Sines::default() })).is_still());
    assert!(sea(&Waves::Gerstner(Gerstner { amplitude: 0.0, ..Gerstner::default() })).is_still());
    for fetch in [1.0, 1e9] {
        let sea = sea(&Waves::Spectrum(Spectrum { fetch, ..Spectrum::default() }));
        assert!(!sea.is_still() && sea.bound().is_finite() && sea.rest.is_finite());
    }
}

/// The energy of a wind sea goes with the wind; and with the exponent, more so.
#[test]
fn waves_go_with_the_wind() {
    let mean = |focus: f64| {
        let sea = sea(&Waves::Spectrum(Spectrum { focus, heading: 2.0, ..Spectrum::default() }));
        let wind = towards(2.0);
        let (mut along, mut all) = (0.0, 0.0);
        for wave in sea.cascades.iter().flat_map(|cascade| &cascade.waves) {
            let energy = wave.amplitude * wave.amplitude;
            all += energy;
            along += energy * (wind[0] * f64::from(wave.n[0]) + wind[1] * f64::from(wave.n[1])) / wave.length();
        }
        along / all
    };
    let [none, some, much] = [mean(0.0), mean(6.0), mean(40.0)];
    println!("{none:.3} {some:.3} {much:.3}");
    assert!(none.abs() < 0.25 && some > 0.7 && much > 0.95);
}

/// By construction no loops: Σ c k a is the steepness, and the determinant stays above 0.
#[test]
fn gerstner_s_waves_never_loop() {
    for steepness in [0.0, 0.5, 1.0] {
        for count in [1, 3, 20] {
            let model = Gerstner { steepness, count, amplitude: 3.0, ..Gerstner::default() };
            let sea = sea(&Waves::Gerstner(model));
            let sum: f64 = sea
                .cascades
                .iter()
                .flat_map(|tile| tile.waves.iter().map(move |wave| (tile, wave)))
                .map(|(tile, wave)| tile.choppiness * TAU / tile.side * wave.length() * wave.amplitude)
                .sum();
            assert!((sum - steepness).abs() < 1e-12, "{sum}");
            for i in 0..50 {
                let at = [f64::from(i) * 1.7, f64::from(i) * -2.3];
                assert!(sea.exact(at, 5.0).determinant >= -1e-9, "{steepness} {count}");
            }
        }
    }
}

/// Noise that drifts is the same noise elsewhere: no wave outruns another.
#[test]
fn noise_drifts_as_a_whole() {
    let model = FbmWaves { octaves: 2, ..FbmWaves::default() };
    let sea = sea(&Waves::Fbm(model.clone()));
    let cascade = &sea.cascades[0];
    let wind = towards(model.heading);
    let whole = wind.map(|along| (along * model.speed * 256.0 / cascade.side).round() * cascade.side / 256.0);
    let place = [3.0, 4.0];
    let (now, then) = (
        sea.height_exact(place, 0.0),
        sea.height_exact([place[0] + whole[0] * 10.0, place[1] + whole[1] * 10.0], 10.0),
    );
    assert!((now - then).abs() < 1e-9, "{now} {then}");
    let [vx, vz] = whole;
    assert!((vx.hypot(vz) / model.speed - 1.0).abs() < 0.15, "{vx} {vz}");
}

/// Presets are what their names say.
#[test]
fn presets_are_as_high_as_they_sound() {
    let height =
        |waves: &Waves| 4.0 * sea(waves).cascades.iter().map(|cascade| cascade.height_variance()).sum::<f64>().sqrt();
    assert!((0.03..0.15).contains(&height(&Waves::lake())));
    assert!((0.4..0.8).contains(&height(&Waves::breeze())));
    assert!((4.0..9.0).contains(&height(&Waves::gale())));
    assert_eq!(Waves::default(), Waves::breeze());
}
