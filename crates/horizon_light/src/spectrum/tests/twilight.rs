//! The wavelengths of [`Medium::EARTH`] against full spectra of all orders of scattering, beside the published ones.

use std::sync::LazyLock;

use super::{apply, distance, uv, uv_of_rgb};
use crate::medium::Medium;
use crate::models::air::Air;
use crate::models::moments::Moments;
use crate::models::scatter::{Scene, SkyRay};
use crate::models::transmittance::Transmittance;
use crate::reference::transmittance::transmittance_to_top;
use crate::spectrum::earth::earth;
use crate::spectrum::{Star, luminance, solar_irradiance, srgb, xyz};

/// Zenith angles of suns, in degrees.
const SUNS: [f64; 7] = [30.0, 65.0, 80.0, 88.0, 91.5, 93.0, 94.0];
/// Zenith angles of views, in degrees, and azimuths from the sun.
const VIEWS: [[f64; 2]; 8] =
    [[0.0, 0.0], [30.0, 0.0], [60.0, 0.0], [60.0, 90.0], [60.0, 180.0], [80.0, 90.0], [87.0, 0.0], [87.0, 180.0]];

const FIRST: f64 = 380.0;
const STEP: f64 = 10.0;
const COUNT: usize = 39;

/// Radiance out of every view under every sun, then the sunlight that comes through under each sun that is up.
fn lights(medium: &Medium) -> Vec<[f64; 3]> {
    let air = Air::<f64>::new(medium);
    let transmittance = Transmittance::new(&air);
    let multiple = Moments::new(&air, &transmittance);
    let scene = Scene { air: &air, transmittance: &transmittance, multiple: &multiple, sunlit: true };
    let sky = SUNS.into_iter().flat_map(|sun| VIEWS.map(|[view, azimuth]| (sun, view, azimuth)));
    let sky = sky.map(|(sun, view, azimuth)| {
        let [sun, view, azimuth] = [sun, view, azimuth].map(f64::to_radians);
        let (mu_s, mu) = (sun.cos(), view.cos());
        let nu = (mu * mu_s + sun.sin() * view.sin() * azimuth.cos()).clamp(-1.0, 1.0);
        scene.sky(&SkyRay { h: 2.0, mu, mu_s, nu }, 32).radiance(&air, nu)
    });
    let direct = SUNS.into_iter().filter(|sun| *sun < 90.0).map(|sun| {
        let through = transmittance_to_top(medium, 2.0, sun.to_radians().cos());
        core::array::from_fn(|k| through[k] * medium.irradiance[k])
    });
    sky.chain(direct).collect()
}

/// CIE XYZ of every light by its whole spectrum, of 39 wavelengths.
static TRUTH: LazyLock<Vec<[f64; 3]>> = LazyLock::new(|| {
    let wavelength = |i: usize| FIRST + STEP * i as f64;
    // Per solar irradiance, which has lines: the rest is smooth.
    let mut spectra: Vec<Vec<f64>> = Vec::new();
    for first in (0..COUNT).step_by(3) {
        let medium = earth([first, first + 1, first + 2].map(wavelength));
        let found = lights(&medium);
        spectra.resize(found.len(), Vec::new());
        for (spectrum, light) in spectra.iter_mut().zip(found) {
            spectrum.extend((0..3).map(|k| light[k] / medium.irradiance[k]));
        }
    }
    let at = |spectrum: &[f64], nm: f64| {
        let x = ((nm - FIRST) / STEP).clamp(0.0, (COUNT - 1) as f64);
        let i = (x as usize).min(COUNT - 2);
        (spectrum[i] + (spectrum[i + 1] - spectrum[i]) * (x - i as f64)) * solar_irradiance(nm)
    };
    spectra.iter().map(|spectrum| xyz(|nm| at(spectrum, nm))).collect()
});

/// Linear sRGB of every light by three wavelengths.
fn colours(medium: &Medium) -> Vec<[f64; 3]> {
    let matrix = Star::of(medium).matrix();
    lights(medium).into_iter().map(|light| apply(matrix, light)).collect()
}

/// The worst errors of some lights: in u′v′, in luminance, and in the worst channel over the brightest.
fn worst(ours: &[[f64; 3]], truth: &[[f64; 3]]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for (ours, truth) in ours.iter().zip(truth) {
        let rgb = srgb(*truth);
        let brightest = rgb.into_iter().fold(0.0, f64::max);
        let channel = (0..3).map(|k| (ours[k] - rgb[k]).abs() / brightest).fold(0.0, f64::max);
        let errors = [distance(uv_of_rgb(*ours), uv(*truth)), (luminance(*ours) / truth[1] - 1.0).abs(), channel];
        worst = core::array::from_fn(|i| worst[i].max(errors[i]));
    }
    worst
}

/// u′v′, luminance and channels that ours may be off by, and the least error in u′v′ of the published wavelengths.
const LIMITS: [([f64; 3], f64); 8] = [
    ([0.0010, 0.003, 0.01], 0.002),
    ([0.0015, 0.003, 0.01], 0.003),
    ([0.0020, 0.005, 0.02], 0.006),
    ([0.0040, 0.015, 0.03], 0.015),
    ([0.0050, 0.02, 0.04], 0.035),
    ([0.0055, 0.02, 0.04], 0.025),
    ([0.0055, 0.02, 0.04], 0.030),
    ([0.0050, 0.01, 0.03], 0.020),
];

#[test]
fn three_wavelengths_see_ozone_where_the_published_ones_do_not() {
    let (ours, published) = (colours(&Medium::EARTH), colours(&Medium::BRUNETON));
    let names = SUNS.map(|sun| format!("sun at {sun}°")).into_iter().chain(["sunlight".to_owned()]);
    for (i, (name, (limits, least))) in names.zip(LIMITS).enumerate() {
        let of = |colours: &[[f64; 3]]| {
            let end = colours.len().min((i + 1) * VIEWS.len());
            worst(&colours[i * VIEWS.len()..end], &TRUTH[i * VIEWS.len()..end])
        };
        let (ours, published) = (of(&ours), of(&published));
        println!("{name}: {ours:.4?}, published {published:.4?}");
        assert!((0..3).all(|k| ours[k] < limits[k]), "{name}: {ours:?}");
        assert!(published[0] > least && published[0] > 2.0 * ours[0], "{name}: published {published:?}");
    }
}

/// The blue hour: overhead, the sky is blue, then green, then red. By the published wavelengths it is purple.
#[test]
fn the_zenith_of_twilight_is_blue() {
    let (ours, published) = (colours(&Medium::EARTH), colours(&Medium::BRUNETON));
    for (i, sun) in SUNS.into_iter().enumerate().filter(|(_, sun)| *sun > 92.0) {
        let zenith = i * VIEWS.len();
        for [red, green, blue] in [srgb(TRUTH[zenith]), ours[zenith]] {
            println!("sun at {sun}°: {red:.3e} {green:.3e} {blue:.3e}");
            assert!(blue > 1.5 * green && green > red && red > 0.0, "sun at {sun}°: {red}, {green}, {blue}");
        }
        let [red, green, _] = published[zenith];
        assert!(red > 1.2 * green, "sun at {sun}°: {red} and {green} would be blue");
    }
}
