//! The disc against its irradiance, the literature, and the naive ways.

use super::limb::NECKEL_LABS;
use super::*;
use proptest::prelude::*;

const RADIUS: f64 = 0.004_675;
const UP: [f64; 3] = [0.0, 1.0, 0.0];

fn sun() -> SunDisc<f64> {
    SunDisc::of(&Medium::BRUNETON)
}

/// At an angle from a star at [`UP`].
fn off(angle: f64) -> [f64; 3] {
    [libm::sin(angle), libm::cos(angle), 0.0]
}

/// ∫ L cos θ dω over the sky, by the midpoint rule in u, in which it is π sin²α ∫ L du.
fn irradiance(disc: &SunDisc<f64>, pixel: f64) -> [f64; 3] {
    const STEPS: u32 = 100_000;
    let end = 1.01 + pixel / disc.sine * (1.0 + pixel / (4.0 * disc.sine));
    let mut sum = [0.0; 3];
    for i in 0..STEPS {
        let sin2 = disc.sine * disc.sine * end * (f64::from(i) + 0.5) / f64::from(STEPS);
        let l = disc.luminance(off(libm::asin(libm::sqrt(sin2))), UP, pixel);
        (0..3).for_each(|c| sum[c] += l[c] * PI * disc.sine * disc.sine * end / f64::from(STEPS));
    }
    sum
}

/// The printed mean over centre follows from the printed coefficients, and these sum to 1: no digit is mistyped.
#[test]
fn the_limb_table_is_consistent() {
    for (nm, law, mean) in NECKEL_LABS {
        let ours: f64 = (0..6).map(|k| law[k] * MEAN[k]).sum();
        assert!((ours - mean).abs() < 6e-5, "{nm}: {ours} and {mean}");
        assert!((law.iter().sum::<f64>() - 1.0).abs() < 3e-5, "{nm}");
    }
    assert!(NECKEL_LABS.windows(2).all(|rows| rows[0].0 < rows[1].0));
}

/// Hestroffer & Magnan 1998, eq. 5, fitted another law to the same sun: μ^α, α = −0.023 + 0.292 / λ, λ in µm above 0.417.
/// One exponent cannot follow the limb: below μ = 0.3 it is too dark, by 0.07 at μ = 0.1.
#[test]
fn two_published_laws_agree() {
    for nm in [440.0, 550.0, 680.0] {
        let (law, alpha) = (limb_darkening(nm), -0.023 + 292.0 / nm);
        for mu in [0.4, 0.6, 0.8, 1.0] {
            let ours = law.iter().rev().fold(0.0, |sum, a| sum * mu + a);
            assert!((ours - libm::pow(mu, alpha)).abs() < 0.016, "{nm} nm, μ {mu}: {ours}");
        }
    }
    assert_eq!(limb_darkening(100.0), limb_darkening(374.086));
    assert_eq!(limb_darkening(2000.0), limb_darkening(869.6));
}

#[test]
fn the_disc_gives_its_irradiance_at_any_pixel_size() {
    for disc in [sun(), SunDisc::new([1.0, 2.0, 3.0], 0.3, [FLAT; 3])] {
        // From sharper than drawn, over 720p at 60°, to a pixel ten discs wide.
        for pixel in [0.0, 1e-4, 1.5e-3, RADIUS, 0.1] {
            let ours = irradiance(&disc, pixel);
            for c in 0..3 {
                let mean: f64 = (0..6).map(|k| disc.limb[k][c] * MEAN[k]).sum();
                let truth = disc.center[c] * PI * disc.sine * disc.sine * mean;
                assert!((ours[c] / truth - 1.0).abs() < 2e-5, "pixel {pixel}: {ours:?} and {truth}");
            }
        }
    }
}

/// A ramp over the edge alone, as commonly drawn, adds light: (p/α)²/12 of it on a flat disc, and more as pixels grow.
#[test]
fn a_ramp_over_the_edge_gains_light() {
    let (disc, pixel) = (SunDisc::new([1.0; 3], RADIUS, [FLAT; 3]), RADIUS);
    const STEPS: u32 = 20_000;
    let mut sum = 0.0;
    for i in 0..STEPS {
        let angle = 2.0 * RADIUS * (f64::from(i) + 0.5) / f64::from(STEPS);
        let ramp = ((RADIUS - angle) / pixel + 0.5).clamp(0.0, 1.0);
        sum += disc.center[0] * ramp * 2.0 * PI * angle * 2.0 * RADIUS / f64::from(STEPS);
    }
    assert!(sum > 1.08, "naive: {sum}");
    assert!((irradiance(&disc, pixel)[0] - 1.0).abs() < 2e-5);
}

/// 128 klx from 6.87e-5 sr: a mean of 1.9e9 cd/m², and blue darkens most towards the limb.
#[test]
fn luminance_is_the_suns() {
    let lux = crate::spectrum::sun_luminance_factors([1.474, 1.8504, 1.91198]);
    let disc = SunDisc::of(&Medium {
        irradiance: core::array::from_fn(|c| lux[c] * [1.474, 1.8504, 1.91198][c]),
        ..Medium::BRUNETON
    });
    let center = crate::spectrum::luminance(disc.luminance(UP, UP, 0.0));
    assert!((2.2e9..2.6e9).contains(&center), "{center}");
    let limb = disc.luminance(off(0.95 * RADIUS), UP, 0.0);
    let ratio: [f64; 3] = core::array::from_fn(|c| limb[c] / disc.center[c]);
    assert!(ratio[0] > ratio[1] && ratio[1] > ratio[2] && ratio[0] < 0.75, "{ratio:?}");
    assert_eq!(disc.luminance(off(1.02 * RADIUS), UP, 0.0), [0.0; 3]);
    assert_eq!(disc.luminance(off(PI), UP, 1e-3), [0.0; 3], "the antisolar point has the same sine");
}

/// The angle from the cosine ν in f32 is off by a third of a per cent of the radius and more: steps in the limb.
#[test]
fn the_cosine_is_too_coarse_in_f32() {
    let sun = [0.36_f32, 0.48, 0.8];
    let (mut naive, mut ours) = (0.0_f64, 0.0_f64);
    let disc = sun_f32();
    for i in 0..1000 {
        let angle = RADIUS * (0.5 + f64::from(i) / 2000.0);
        // Tilted about the axis (0.8, −0.6, 0), which is square to the sun.
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let across = [0.48, 0.64, -0.6];
        let exact: [f64; 3] = core::array::from_fn(|k| c * [0.36, 0.48, 0.8][k] + s * across[k]);
        let view = exact.map(|x| x as f32);
        let nu: f32 = (0..3).map(|k| view[k] * sun[k]).sum();
        naive = naive.max((f64::from(nu.min(1.0).acos()) - angle).abs() / RADIUS);
        let chord: f32 = (0..3).map(|k| (view[k] - sun[k]) * (view[k] - sun[k])).sum();
        ours = ours.max((f64::from((chord * (1.0 - 0.25 * chord)).sqrt()) - angle).abs() / RADIUS);
        assert!(disc.luminance(view, sun, 0.0)[0] > 0.0);
    }
    assert!(naive > 2e-3, "naive: {naive}");
    assert!(ours < 2e-4, "by the chord: {ours}");
}

fn sun_f32() -> SunDisc<f32> {
    sun().cast()
}

/// The shaders' precision draws what f64 draws, within 1e-3 of the centre, at any pixel size.
#[test]
fn f32_draws_the_same() {
    let (exact, device) = (sun(), sun_f32());
    for pixel in [0.0, 1e-4, 1.5e-3, 0.1] {
        for i in 0..2000 {
            let view = off(RADIUS * f64::from(i) / 1500.0);
            let view32 = view.map(|x| x as f32);
            let (a, b) = (exact.luminance(view, UP, pixel), device.luminance(view32, [0.0, 1.0, 0.0], pixel as f32));
            // At the sharp edge the brightness changes by half over 0.2 % of the radius.
            let allowed = if pixel == 0.0 { 1e-2 } else { 1e-3 };
            assert!((0..3).all(|c| (a[c] - f64::from(b[c])).abs() < allowed * exact.center[c]), "{i}, {pixel}");
        }
    }
}

/// The flat disc's segment, and the limb-darkened one against sums over the disc; on and off alone is half wrong.
#[test]
fn the_part_above_the_horizon_is_exact() {
    let (disc, flat) = (sun(), SunDisc::new([1.0; 3], RADIUS, [FLAT; 3]));
    for x in [-1.0_f64, -0.9, -0.5, 0.0, 0.3, 0.99, 1.0] {
        let segment = (libm::acos(-x) + x * libm::sqrt(1.0 - x * x)) / PI;
        assert!((flat.visible(x * flat.sine)[0] - segment).abs() < 1e-12);
        let (mut seen, mut all) = ([0.0; 3], [0.0; 3]);
        const STEPS: i32 = 600;
        for i in -STEPS..STEPS {
            for j in -STEPS..STEPS {
                let [px, py] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(STEPS));
                let u = px * px + py * py;
                if u < 1.0 {
                    let mu = libm::sqrt(1.0 - u);
                    for c in 0..3 {
                        let l = disc.limb.iter().rev().fold(0.0, |sum, a| sum * mu + a[c]);
                        all[c] += l;
                        seen[c] += if py > -x { l } else { 0.0 };
                    }
                }
            }
        }
        let ours = disc.visible(x * disc.sine);
        assert!((0..3).all(|c| (ours[c] - seen[c] / all[c]).abs() < 2e-3), "x {x}: {ours:?}");
    }
    assert_eq!(disc.visible(1.0), [1.0; 3]);
    assert_eq!(disc.visible(-1.0), [0.0; 3]);
    let naive = |x: f64| if x > 0.0 { 1.0 } else { 0.0 };
    let jump = |f: &dyn Fn(f64) -> f64| {
        (-100..100).map(|i| (f(f64::from(i + 1) / 80.0) - f(f64::from(i) / 80.0)).abs()).fold(0.0, f64::max)
    };
    assert_eq!(jump(&naive), 1.0);
    assert!(jump(&|x| disc.visible(x * disc.sine)[0]) < 0.01, "smooth");
}

/// Of a last sliver more is limb: less of the blue is left than of the red.
#[test]
fn the_last_sliver_is_red() {
    let sliver = sun().visible(-0.9 * sun().sine);
    assert!(sliver[0] > 1.03 * sliver[2], "{sliver:?}");
}

/// reference-values.md A: the dip from 2 m, 1 km and 400 km.
#[test]
fn the_horizon_dips_as_published() {
    for (h, dip) in [(2.0, 0.045_44_f64), (1e3, 1.015_97), (400e3, 19.808_9)] {
        let on_it = libm::sin(-dip.to_radians());
        assert!(above_horizon(on_it, h, 6.36e6).abs() < 2e-7 * dip.max(1.0), "h {h}");
        assert!((above_horizon(0.0, h, 6.36e6) - libm::sin(dip.to_radians())).abs() < 2e-7 * dip.max(1.0));
    }
    assert!(above_horizon(1.0, 6.36e9, 6.36e6) > 0.9, "overhead, a thousand radii out: 180° above the horizon");
    assert!(above_horizon(-1.0, 6.36e8, 6.36e6) < 0.0, "behind the planet");
}

#[test]
fn the_shader_is_valid_and_has_our_constants() {
    let module = naga::front::wgsl::parse_str(WGSL).unwrap_or_else(|error| panic!("{}", error.emit_to_string(WGSL)));
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).unwrap();
    for (name, ours) in [("SUN_MEAN", MEAN), ("SUN_CHORD", CHORD)] {
        let line = WGSL.lines().find(|line| line.contains(&format!("const {name}"))).unwrap();
        let list = line.rsplit_once("6>(").unwrap().1.trim_end_matches(");");
        for (theirs, ours) in list.split(',').zip(ours) {
            assert!((theirs.trim().parse::<f64>().unwrap() - ours).abs() < 1e-8, "{name}");
        }
    }
    assert!(WGSL.contains(&format!("SUN_SOFTEST: f32 = {SOFTEST};")));
}

proptest! {
    #[test]
    fn nothing_is_nan(
        view in prop::array::uniform3(-1.0_f32..1.0),
        radius in 0.0_f64..2.0,
        pixel in prop::num::f32::POSITIVE | prop::num::f32::ZERO,
        mu_s in -1.0_f32..=1.0,
        h in 0.0_f32..6.4e8,
    ) {
        let disc: SunDisc<f32> = SunDisc::of(&Medium { irradiance: [1e5; 3], sun_radius: radius, ..Medium::BRUNETON }).cast();
        let length = view.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
        let l = disc.luminance(view.map(|x| x / length), [0.0, 1.0, 0.0], pixel.min(3.0));
        let visible = disc.visible(above_horizon(mu_s, h, 6.36e6));
        prop_assert!(l.iter().all(|x| x.is_finite() && *x >= 0.0), "{l:?}");
        prop_assert!(visible.iter().all(|x| (0.0..=1.0).contains(x)), "{visible:?}");
    }
}
