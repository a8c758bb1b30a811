use core::f64::consts::{PI, TAU};

use proptest::prelude::*;

use crate::profile::Light;
use crate::reference::quadrature::integrate;
use crate::reference::random::Random;
use crate::water::WaterOptics;
use crate::water::body::*;

const WATERS: [WaterOptics; 6] = [
    WaterOptics::PURE,
    WaterOptics::CLEAR_SEA,
    WaterOptics::COAST,
    WaterOptics::LAKE,
    WaterOptics::GLACIER_MILK,
    WaterOptics::SWAMP,
];

fn direction(cosine: f64, azimuth: f64) -> [f64; 3] {
    let sine = libm::sqrt((1.0 - cosine * cosine).max(0.0));
    [sine * libm::cos(azimuth), cosine, sine * libm::sin(azimuth)]
}

fn cast<T: Light>(light: &WaterLight<f64>) -> WaterLight<T> {
    WaterLight {
        sun: light.sun.map(T::of),
        sun_irradiance: light.sun_irradiance.map(T::of),
        sky_irradiance: light.sky_irradiance.map(T::of),
    }
}

#[test]
fn lobes_are_phase_functions() {
    for g in [-0.99, -0.7, -1e-9, 0.0, 1e-9, 0.3, 0.924, 0.99] {
        let ends = [-1.0, -0.99, -0.9, 0.0, 0.9, 0.99, 1.0];
        let [whole, mean] = integrate(|nu| [TAU * lobe(g, nu), TAU * nu * lobe(g, nu)], &ends, 1e-11);
        assert!((whole - 1.0).abs() < 1e-8 && (mean - g).abs() < 1e-8, "{g}: {whole}, {mean}");
        let [behind] = integrate(|nu| [TAU * lobe(g, nu)], &[-1.0, -0.99, -0.9, 0.0], 1e-11);
        assert!((backward_share(g) - behind).abs() < 1e-8, "{g}: {behind}");
        assert!((f64::from(backward_share(g as f32)) - behind).abs() < 1e-6, "{g}");
    }
    // The form that textbooks have loses everything near 0 in single precision.
    let g = 1e-5_f32;
    let naive = (1.0 - g) / (2.0 * g) * ((1.0 + g) / (1.0 + g * g).sqrt() - 1.0);
    assert!((naive - 0.5).abs() > 5e-4 && (backward_share(g) - 0.5).abs() < 1e-4, "naive: {naive}");
}

#[test]
fn beams_fade_by_products() {
    for optics in WATERS {
        let water = Water::<f32>::new(&optics);
        for (a, b) in [(0.1, 0.2), (3.0, 0.01), (0.5, 7.0)] {
            let (first, second, both) = (water.transmittance(a), water.transmittance(b), water.transmittance(a + b));
            for k in 0..3 {
                assert!((first[k] * second[k] - both[k]).abs() <= 1e-5 * both[k].max(1e-6), "{optics:?}");
                let exact = libm::exp(-f64::from(water.attenuation()[k]) * f64::from(a + b));
                assert!((f64::from(both[k]) - exact).abs() < 1e-5);
            }
        }
        assert_eq!(water.transmittance(0.0), [1.0; 3]);
        assert_eq!(water.blurred(0.0), [0.0; 3]);
        assert!(water.transmittance(f32::INFINITY).iter().all(|t| *t == 0.0));
        assert!(water.blurred(f32::INFINITY).iter().all(|t| *t == 0.0));
    }
}

/// The same lights, added up in small steps from what the module's text says of them.
fn added_up(water: &Water<f64>, light: &WaterLight<f64>, depth: f64, view: [f64; 3], distance: f64, k: usize) -> f64 {
    let (a, b, m) = (water.absorption[k], water.scattering[k], water.molecules[k]);
    let backward = b * backward_share(water.anisotropy) + 0.5 * m;
    let nu: f64 = (0..3).map(|i| view[i] * light.sun[i]).sum();
    let rayleigh = (1.0 + 0.835 * nu * nu) / (4.0 * PI * (1.0 + 0.835 / 3.0));
    let up = backward + (b + m - 2.0 * backward) * (1.0 - view[1]) / 2.0;
    let part = |z: f64, irradiance: f64, mu: f64, scattered: f64| {
        let diffuse = b * (1.0 - water.anisotropy) + m;
        let decay = libm::sqrt(a * a + (5.6 * mu - 2.5) * a * diffuse) / mu;
        let once = 2.0 * backward / a * (0.975 - 0.629 * mu);
        let y = once + (0.375 * diffuse / a - once).max(0.0) * diffuse / (diffuse + 5.0 * a);
        let ratio = y / (1.0 + y + libm::sqrt(1.0 + 2.0 * y));
        irradiance * libm::exp(-decay * z) * (scattered / mu + up * ratio / PI * (1.0 + 0.2 * (1.0 - ratio)))
    };
    let source = |t: f64| {
        let z = depth - t * view[1];
        let sun = part(z, light.sun_irradiance[k], light.sun[1], b * lobe(water.anisotropy, nu) + m * rayleigh);
        let sky_lobe = b * lobe(0.84 * water.anisotropy, view[1]).min(SKY_PEAK) + m / (4.0 * PI);
        (sun + part(z, light.sky_irradiance[k], 0.84, sky_lobe)) * libm::exp(-(a + b + m) * t)
    };
    // Light from far away counts only as far as any is left.
    let reach = distance.min(80.0 / (a + b + m)).min(if view[1] > 0.0 { depth / view[1] } else { f64::INFINITY });
    let ends: Vec<f64> = (0..=16).map(|i| reach * f64::from(i) / 16.0).collect();
    integrate(|t| [source(t)], &ends, 1e-10)[0]
}

#[test]
fn light_along_a_ray_is_the_integral() {
    let mut worst = [0.0_f64; 2];
    for optics in WATERS {
        let exact = Water::<f64>::new(&optics);
        let device = Water::<f32>::new(&optics);
        for sun in [direction(1.0, 0.0), direction(0.5, 1.0), direction(0.05, 2.0)] {
            let light = exact.lit(sun, [1.0, 0.9, 0.8], [0.2, 0.3, 0.5]);
            let light32 = cast::<f32>(&light);
            for (depth, distance) in [(0.0, 1.0), (0.3, 1e-3), (2.0, 20.0), (10.0, f64::INFINITY), (100.0, 40.0)] {
                for cosine in [-1.0, -0.6, -1e-4, 0.0, 1e-4, 0.3, 0.8, 1.0] {
                    let view = direction(cosine, 0.4);
                    let closed = exact.in_scatter(&light, depth, view, distance);
                    let single = device.in_scatter(&light32, depth as f32, view.map(|x| x as f32), distance as f32);
                    for k in 0..3 {
                        let truth = added_up(&exact, &light, depth, view, distance, k);
                        // What is black to any display is compared as such.
                        let scale = truth.max(1e-12);
                        let off = [(closed[k] - truth).abs() / scale, (f64::from(single[k]) - truth).abs() / scale];
                        worst = [worst[0].max(off[0]), worst[1].max(off[1])];
                        assert!(
                            off[0] < 1e-6 && off[1] < 1e-4,
                            "{optics:?} {sun:?} {depth} {distance} {cosine}: {off:?}, {truth}"
                        );
                    }
                }
            }
        }
    }
    println!("off the integral by {:.1e} in f64, {:.1e} in f32", worst[0], worst[1]);
}

/// Looking up from deep water, the usual form e^{−Kz}(1 − e^{−xt})/x multiplies nothing by infinity.
#[test]
fn the_usual_form_overflows() {
    let water = Water::<f32>::new(&WaterOptics { scattering: [1e-3; 3], ..WaterOptics::SWAMP });
    let light = water.lit([0.8, 0.6, 0.0], [1.0; 3], [0.0; 3]);
    let depth = 30.0_f32;
    let decay = (water.absorption[2] + water.backscattering()[2]) / light.sun[1];
    let x = water.attenuation()[2] - decay;
    let naive = (-decay * depth).exp() * (1.0 - (-x * depth).exp()) / x;
    assert!(naive.is_nan(), "naive: {naive}");
    let up = water.in_scatter(&light, depth, [0.0, 1.0, 0.0], depth);
    assert!(up.iter().all(|l| l.is_finite() && *l >= 0.0), "{up:?}");
}

/// E_u/E_d of infinitely deep water just below its surface, from the radiances of all rays that look down.
fn reflectance(water: &Water<f64>, light: &WaterLight<f64>, k: usize) -> f64 {
    const AZIMUTHS: u32 = 64;
    let [up] = integrate(
        |c| {
            let ring: f64 = (0..AZIMUTHS)
                .map(|i| {
                    let view = direction(-c, TAU * (f64::from(i) + 0.5) / f64::from(AZIMUTHS));
                    water.in_scatter(light, 0.0, view, f64::INFINITY)[k]
                })
                .sum();
            [ring * c * TAU / f64::from(AZIMUTHS)]
        },
        &[0.0, 0.1, 0.5, 1.0],
        1e-6,
    );
    up / water.irradiance(light, 0.0)[k]
}

#[test]
fn deep_water_reflects_as_measured() {
    for optics in [WaterOptics::PURE, WaterOptics::CLEAR_SEA, WaterOptics::COAST, WaterOptics::LAKE] {
        let water = Water::<f64>::new(&optics);
        let light = water.lit(direction(1.0, 0.0), [1.0; 3], [0.0; 3]);
        for k in 0..3 {
            let backward = water.backscattering()[k];
            let known = 0.33 * backward / water.absorption[k];
            let ours = reflectance(&water, &light, k);
            println!("{k}: {ours:.4}, known {known:.4}");
            assert!((ours / known - 1.0).abs() < 0.25, "{optics:?}: {ours}, not {known}");
        }
    }
}

/// The whole of it by Monte Carlo: photons in a half space, with every order of scattering.
fn monte_carlo(water: &Water<f64>, sun_cosine: f64, k: usize, photons: u32) -> f64 {
    let (a, b) = (water.absorption[k], water.scattering[k]);
    let g = water.anisotropy;
    let mut random = Random::new(11, k as u64);
    let mut up = 0.0;
    for _ in 0..photons {
        let (mut depth, mut mu, mut weight) = (0.0, -sun_cosine, 1.0);
        while weight > 1e-4 {
            depth -= mu * random.exponential() / (a + b);
            if depth < 0.0 {
                up += weight;
                break;
            }
            weight *= b / (a + b);
            // Henyey and Greenstein's integral, inverted.
            let inner = (1.0 - g * g) / (1.0 - g + 2.0 * g * random.uniform());
            let nu = ((1.0 + g * g - inner * inner) / (2.0 * g)).clamp(-1.0, 1.0);
            let turn = libm::cos(random.angle()) * libm::sqrt(((1.0 - mu * mu) * (1.0 - nu * nu)).max(0.0));
            mu = (mu * nu + turn).clamp(-1.0, 1.0);
        }
    }
    up / f64::from(photons)
}

#[test]
fn deep_water_reflects_as_all_orders_of_scattering_do() {
    let high = [0.5, 2.0, 8.0, 30.0, 100.0, 270.0].map(|b| (b, 1.0));
    for (b, sun_cosine) in high.into_iter().chain([2.0, 8.0, 30.0].map(|b| (b, 0.7))) {
        let optics = WaterOptics { absorption: [1.0; 3], scattering: [b; 3], molecules: [0.0; 3], ..WaterOptics::PURE };
        let water = Water::<f64>::new(&optics);
        let light = WaterLight { sun: direction(sun_cosine, 0.0), sun_irradiance: [1.0; 3], sky_irradiance: [0.0; 3] };
        let (ours, truth) = (reflectance(&water, &light, 0), monte_carlo(&water, sun_cosine, 0, 40_000));
        let known = 0.33 * water.backscattering()[0];
        println!("b/a {b}, sun {sun_cosine}: {ours:.4}, all orders {truth:.4}, 0.33 b_b/a {known:.4}");
        assert!((ours / truth - 1.0).abs() < 0.2, "b/a {b}, sun {sun_cosine}: {ours}, not {truth}");
    }
}

/// Over a white bed under milk, image and blur together keep what a beam's law alone throws away.
#[test]
fn a_bed_under_milk_is_not_black() {
    let water = Water::<f64>::new(&WaterOptics::GLACIER_MILK);
    let (image, blur) = (water.transmittance(0.5), water.blurred(0.5));
    for k in 0..3 {
        assert!(image[k] < 1e-4, "naive: {}", image[k]);
        assert!(blur[k] > 0.5 && blur[k] + image[k] < 1.0, "{blur:?}");
    }
}

#[test]
fn what_enters_is_lit_from_above() {
    let water = Water::<f64>::new(&WaterOptics::CLEAR_SEA);
    let light = water.lit(direction(1.0, 0.0), [1.0; 3], [1.0; 3]);
    assert!((light.sun_irradiance[0] - 0.97963).abs() < 1e-5 && (light.sky_irradiance[0] - 0.9336).abs() < 2e-4);
    let set = water.lit(direction(-0.1, 0.0), [1.0; 3], [0.0; 3]);
    assert_eq!(set.sun_irradiance, [0.0; 3]);
    let low = water.lit(direction(0.0, 0.0), [1.0; 3], [0.0; 3]);
    assert!((low.sun[1] - 0.66123).abs() < 1e-4, "the sun is never seen lower than the window's edge");
}

/// Mean cosine of a uniform sky's light under water.
#[test]
fn the_sky_s_cosine_is_the_integral() {
    use crate::water::surface::fresnel;
    let n = 1.333;
    let below = |c: f64| libm::sqrt(1.0 - (1.0 - c * c) / (n * n));
    let [level, scalar] =
        integrate(|c| [(1.0 - fresnel(c, n)) * c, (1.0 - fresnel(c, n)) * c / below(c)], &[0.0, 0.1, 1.0], 1e-9);
    assert!((level / scalar - SKY_COSINE).abs() < 3e-3, "{}", level / scalar);
}

proptest! {
    #[test]
    fn nothing_is_nan(
        absorption in prop::sample::select(vec![0.0_f32, 1e-6, 0.1, 10.0, 1e3]),
        scattering in prop::sample::select(vec![0.0_f32, 1e-6, 0.1, 10.0, 1e3]),
        anisotropy in -0.99_f32..=0.99,
        index in 1.0_f32..=1.6,
        sun in prop::array::uniform3(-1.0_f32..1.0),
        view in prop::array::uniform3(-1.0_f32..1.0),
        level in any::<bool>(),
        depth in prop::sample::select(vec![0.0_f32, 1e-6, 0.3, 40.0, 1e4, f32::INFINITY]),
        distance in prop::sample::select(vec![0.0_f32, 1e-6, 0.3, 40.0, 1e4, f32::INFINITY]),
    ) {
        let unit = |v: [f32; 3]| {
            let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length < 1e-3 { [0.0, 1.0, 0.0] } else { v.map(|x| x / length) }
        };
        let water = Water::<f32>::new(&WaterOptics {
            absorption: [absorption, 0.0, 1.0],
            scattering: [scattering, 1.0, 0.0],
            molecules: [0.0, 1e-3, 0.0],
            anisotropy,
            index,
            ..WaterOptics::CLEAR_SEA
        });
        let light = water.lit(unit(sun), [1e5; 3], [1e4; 3]);
        let view = unit(if level { [view[0], 0.0, view[2]] } else { view });
        let all = [
            water.in_scatter(&light, depth, view, distance),
            water.irradiance(&light, depth),
            water.upwelling(&light, depth),
            water.transmittance(distance),
            water.blurred(distance),
        ];
        prop_assert!(all.iter().flatten().all(|x| x.is_finite() && *x >= 0.0), "{all:?}");
    }
}
