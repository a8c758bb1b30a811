//! The conversion against published factors, against sums of the standards, and against full spectra.

mod sky;
mod twilight;

use super::tables::CIE_1931;
use super::*;
use sky::Scene;

fn sun() -> [f64; 3] {
    WAVELENGTHS.map(solar_irradiance)
}

fn apply(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// CIE 1976 u′, v′: 0.004 apart is about what an eye can tell.
fn uv(xyz: [f64; 3]) -> [f64; 2] {
    let d = xyz[0] + 15.0 * xyz[1] + 3.0 * xyz[2];
    [4.0 * xyz[0] / d, 9.0 * xyz[1] / d]
}

/// u′v′ of linear sRGB, by the inverse matrix of IEC 61966-2-1.
fn uv_of_rgb(rgb: [f64; 3]) -> [f64; 2] {
    uv(apply([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]], rgb))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The CIE gives the sums of its 1 nm tables: 106.865, 106.857 and 106.892.
#[test]
fn matching_functions_have_the_published_sums() {
    for (k, sum) in [106.865, 106.857, 106.892].into_iter().enumerate() {
        let ours: f64 = CIE_1931.iter().map(|row| 5.0 * row[k]).sum();
        assert!((ours - sum).abs() < 0.005, "{k}: {ours}");
        assert!((xyz(|_| 1.0)[k] / MAX_LUMINOUS_EFFICACY - sum).abs() < 0.005);
    }
}

#[test]
fn interpolation_meets_the_rows() {
    assert_eq!(color_matching(555.0), [0.512_050_1, 1.0, 0.005_749_999]);
    assert_eq!(solar_irradiance(680.0), 1.474);
    assert_eq!(solar_irradiance(445.0), (1.91198 + 2.03474) / 2.0);
    assert_eq!((solar_irradiance(100.0), solar_irradiance(2000.0)), (1.11776, 1.04992));
    assert_eq!((color_matching(360.0), color_matching(2000.0)), ([0.0; 3], [0.0; 3]));
}

/// Published with the code of Bruneton 2017, which prints six decimals of them.
#[test]
fn factors_are_brunetons() {
    let sky = [114_974.916_437, 71_305.954_816, 65_310.548_555];
    let star = [98_242.786_222, 69_954.398_112, 66_475.012_354];
    for k in 0..3 {
        assert!((sky_luminance_factors(sun())[k] - sky[k]).abs() < 1e-5);
        assert!((sun_luminance_factors(sun())[k] - star[k]).abs() < 1e-5);
    }
}

/// 128 klx (IES 1984) to 133.1 klx (Darula, Kittler & Gueymard 2005).
#[test]
fn the_sun_has_its_illuminance() {
    let lux = xyz(solar_irradiance)[1];
    assert!((128e3..133.5e3).contains(&lux), "{lux}");
    let rgb: [f64; 3] = core::array::from_fn(|k| sun_luminance_factors(sun())[k] * sun()[k]);
    assert!((luminance(rgb) / lux - 1.0).abs() < 1e-3);
    assert!((luminance(apply(Star::published(sun()).matrix(), sun())) / lux - 1.0).abs() < 1e-3);
}

/// Equal energy is x = y = 1/3, and so linear sRGB (1.205, 0.948, 0.909), a pale pink beside the white of D65.
#[test]
fn equal_energy_is_nearly_white() {
    let rgb = srgb(xyz(|_| 1.0 / (MAX_LUMINOUS_EFFICACY * 106.857)));
    for (ours, known) in rgb.into_iter().zip([1.2048, 0.9483, 0.9088]) {
        assert!((ours - known).abs() < 5e-4, "{rgb:?}");
    }
}

/// One matrix is right for white ground and for a λ⁻⁴ glow; Bruneton's two sets of factors are each right for one.
#[test]
fn one_matrix_serves_star_and_sky() {
    let star = Star::published(sun());
    for power in [0.0, -1.0, -2.0, -4.0] {
        let light = |nm: f64| solar_irradiance(nm) * libm::pow(nm / 550.0, power);
        let (truth, three) = (xyz(light), WAVELENGTHS.map(light));
        let error = |rgb: [f64; 3]| (distance(uv_of_rgb(rgb), uv(truth)), (luminance(rgb) / truth[1] - 1.0).abs());
        let (color, lum) = error(apply(star.matrix(), three));
        assert!(color < 1.2e-3 && lum < 2e-3, "power {power}: {color}, {lum}");
        if power == 0.0 {
            let factors = star.factors(SKY_POWER);
            assert!(error(core::array::from_fn(|k| factors[k] * three[k])).1 > 0.02);
        }
    }
}

/// Errors over scenes of one sun: the worst of colour (u′v′) and of luminance (relative), for the three radiances taken as
/// RGB (seed 000 eq. 3.18), Bruneton's factors, and the matrix.
fn worst(zenith: f64, ozone: bool, haze: bool, views: &[(f64, f64)]) -> [[f64; 2]; 3] {
    let (factors, matrix) = (sky_luminance_factors(sun()), Star::published(sun()).matrix());
    let mut worst = [[0.0_f64; 2]; 3];
    for &(view, azimuth) in views {
        let scene = Scene::new(zenith, view, azimuth, ozone, haze);
        let (truth, three) = (xyz(|nm| scene.radiance(nm)), WAVELENGTHS.map(|nm| scene.radiance(nm)));
        // The naive way has no unit: give it the right luminance at once for white light.
        let naive = three.map(|l| l * luminance(sun_luminance_factors([1.0; 3])));
        let ours = [naive, core::array::from_fn(|k| factors[k] * three[k]), apply(matrix, three)];
        for (worst, rgb) in worst.iter_mut().zip(ours) {
            worst[0] = worst[0].max(distance(uv_of_rgb(rgb), uv(truth)));
            worst[1] = worst[1].max((luminance(rgb) / truth[1] - 1.0).abs());
        }
        println!("sun {zenith} view {view}/{azimuth} ozone {ozone} haze {haze}: {worst:.4?}");
    }
    worst
}

/// Rayleigh's single scattering at the zenith, where one may ask no less of a conversion.
#[test]
fn radiances_taken_as_rgb_are_visibly_wrong() {
    for zenith in [30.0, 80.0] {
        let [naive, factors, matrix] = worst(zenith, false, false, &[(0.0, 0.0)]);
        assert!(naive[0] > 0.015, "seed 000 eq. 3.18: {naive:?}");
        assert!(factors[0] < 0.0015 && matrix[0] < 0.0025, "{factors:?}, {matrix:?}");
        assert!(matrix[1] < 0.002, "{matrix:?}");
    }
}

/// The whole sky with haze and ozone.
#[test]
fn the_matrix_beats_the_factors() {
    let views = [(0.0, 0.0), (60.0, 90.0), (85.0, 0.0), (85.0, 180.0)];
    for (zenith, color, lum, factors_lum) in
        [(30.0, 0.0035, 0.004, 0.005), (80.0, 0.008, 0.015, 0.09), (88.0, 0.018, 0.055, 0.3)]
    {
        let [_, factors, matrix] = worst(zenith, true, true, &views);
        assert!(matrix[0] < color && matrix[1] < lum, "sun {zenith}: {matrix:?}");
        assert!(factors[1] > factors_lum, "sun {zenith}: {factors:?}");
        assert!(zenith < 80.0 || matrix[0] < 0.6 * factors[0], "sun {zenith}: {matrix:?}, {factors:?}");
    }
}

#[test]
fn a_star_keeps_what_is_known_of_it() {
    let red = Star { wavelengths: [440.0, 680.0, 550.0], irradiance: [0.2, 3.0, 1.0] };
    for (nm, known) in red.wavelengths.into_iter().zip(red.irradiance) {
        assert!((red.at(nm) - known).abs() < 1e-12);
    }
    assert!(red.at(360.0) > 0.0 && red.at(830.0) > 0.0);
    let sun = Star::published(sun());
    assert!(
        (0..470).all(|i| (sun.at(360.0 + f64::from(i)) / solar_irradiance(360.0 + f64::from(i)) - 1.0).abs() < 1e-12)
    );
}

/// Mars' sun is Earth's, fainter: the same factors.
#[test]
fn factors_do_not_change_with_distance() {
    let (near, far) = (sky_luminance_factors(sun()), sky_luminance_factors(sun().map(|e| 0.43 * e)));
    assert!((0..3).all(|k| (near[k] / far[k] - 1.0).abs() < 1e-12));
}

#[test]
fn a_star_without_blue_has_no_nan() {
    let star = Star::published([1.0, 0.5, 0.0]);
    assert!(star.factors(SKY_POWER).into_iter().chain(star.matrix().into_iter().flatten()).all(f64::is_finite));
    assert_eq!(star.factors(0.0)[2], 0.0);
    assert_eq!(Star::published([0.0; 3]).matrix(), [[0.0; 3]; 3]);
}
