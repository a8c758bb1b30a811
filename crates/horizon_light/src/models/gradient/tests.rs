//! The gradient against published illuminances.

use super::*;
use crate::spectrum::luminance;
use core::f64::consts::PI;
use proptest::prelude::*;

const SKY: GradientSky<f64> = GradientSky::EARTH;

/// Illuminance on level ground from the sky alone, in lux, under a sun so many degrees high.
fn lux(elevation: f64) -> f64 {
    let (mu_s, sin_s) = (libm::sin(elevation.to_radians()), libm::cos(elevation.to_radians()));
    const STEPS: u32 = 64;
    let mut sum = 0.0;
    for i in 0..STEPS {
        for j in 0..STEPS {
            let mu = (f64::from(i) + 0.5) / f64::from(STEPS);
            let azimuth = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(STEPS);
            let nu = mu * mu_s + libm::sqrt(1.0 - mu * mu) * sin_s * libm::cos(azimuth);
            sum += luminance(SKY.luminance(mu, mu_s, nu)) * mu;
        }
    }
    sum * 2.0 * PI / f64::from(STEPS * STEPS)
}

/// IES 1984: a clear sky gives 16.3 klx under the highest sun, 0.8 + 15.5 √(sin 30°) = 11.8 klx at 30°.
#[test]
fn by_day_it_gives_the_published_illuminance() {
    for (elevation, published) in [(90.0, 16.3e3), (60.0, 15.2e3), (30.0, 11.8e3), (10.0, 7.3e3)] {
        assert!((lux(elevation) / published - 1.0).abs() < 0.1, "{elevation}: {}", lux(elevation));
    }
}

/// The American Meteorological Society's ranges, which we meet within a factor of two down to where the night's own light
/// takes over; seed 000's gradient, which knows no sun, gives midnight 16 klx.
#[test]
fn night_goes_dark() {
    for (elevation, low, high) in [(0.0, 410.0, 585.0), (-6.0, 2.0, 3.5), (-12.0, 0.008, 0.008)] {
        assert!((0.5 * low..2.0 * high).contains(&lux(elevation)), "{elevation}: {}", lux(elevation));
    }
    assert!((lux(-18.0) / (PI * MOONLESS_NIGHT) - 1.0).abs() < 0.1, "starlight: {}", lux(-18.0));
    assert!((lux(-90.0) / (PI * MOONLESS_NIGHT) - 1.0).abs() < 1e-3);
    assert!((-90..90).all(|e| lux(f64::from(e)) <= lux(f64::from(e + 1)) * 1.0001), "brighter as the sun rises");
}

#[test]
fn colors_are_a_skys() {
    let zenith = SKY.luminance(1.0, 0.7, 0.7);
    assert!(zenith[2] > 1.5 * zenith[1] && zenith[1] > zenith[0], "blue: {zenith:?}");
    let (under, away) = (SKY.luminance(0.0, 0.0, 1.0), SKY.luminance(0.0, 0.0, -1.0));
    assert!(under[0] > 3.0 * under[2], "the sunset is red: {under:?}");
    assert!(away[2] > away[0], "and behind us it is not: {away:?}");
    let dusk = SKY.luminance(1.0, -0.05, 0.0);
    assert!(dusk[2] > dusk[0], "twilight is blue: {dusk:?}");
}

#[test]
fn haze_takes_as_the_distance() {
    assert_eq!(SKY.transmittance(0.0), 1.0);
    assert!((SKY.transmittance(5e4) - libm::exp(-1.0)).abs() < 1e-12);
}

#[test]
fn the_shader_is_valid_and_has_our_constants() {
    let module = naga::front::wgsl::parse_str(WGSL).unwrap_or_else(|error| panic!("{}", error.emit_to_string(WGSL)));
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).unwrap();
    for (name, ours) in [("SUNSET", SUNSET), ("FADE", FADE), ("LOW", LOW)] {
        assert!(WGSL.contains(&format!("const GRADIENT_{name}: f32 = {ours:?};")), "{name} is {ours:?}");
    }
}

proptest! {
    #[test]
    fn nothing_is_nan(mu in -1.0001_f32..1.0001, mu_s in -1.0001_f32..1.0001, nu in -1.0001_f32..1.0001) {
        let l = SKY.cast::<f32>().luminance(mu, mu_s, nu);
        prop_assert!(l.iter().all(|x| x.is_finite() && *x > 0.0), "{l:?}");
        let exact = SKY.luminance(f64::from(mu), f64::from(mu_s), f64::from(nu));
        prop_assert!((0..3).all(|c| (f64::from(l[c]) / exact[c] - 1.0).abs() < 1e-4), "f32 is as good: {l:?}, {exact:?}");
    }
}
