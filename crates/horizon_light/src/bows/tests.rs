//! Against reference-values.md C and D, sources, and integrals made another way.

use super::airy::airy;
use super::halo::{Prism, halo, least, ring};
use super::index::{ice, water};
use super::plates::{arc, arc_elevation, dog, dog_azimuth, dog_distance, dog_row};
use super::rainbow::{curvature, phase, rainbow, ray_angle};
use super::{drop, table};
use crate::medium::Medium;
use crate::reference::quadrature::integrate;
use crate::reference::random::Random;
use crate::spectrum::{Star, luminance};
use core::f64::consts::{FRAC_PI_2, PI, TAU};

const SUN: f64 = 0.004_675;

fn star() -> Star {
    Star::of(&Medium::EARTH)
}

#[test]
fn bows_lie_where_rays_say() {
    // reference-values.md C.
    for (n, primary, secondary) in
        [(1.331, 42.370, 50.365), (1.333, 42.078, 50.891), (1.343, 40.646, 53.478), (1.3435, 40.575, 53.605)]
    {
        for (k, degrees) in [(1, primary), (2, secondary)] {
            let ours = drop::bow_angle(n, k).to_degrees();
            assert!((ours - degrees).abs() < 2e-3, "{n} {k}: {ours}");
            // And no ray is turned less.
            let least = (0..=10_000).map(|i| drop::turned(n, k, f64::from(i) * 1e-4)).fold(f64::INFINITY, f64::min);
            assert!((drop::from_antisolar(least).to_degrees() - degrees).abs() < 2e-3);
        }
    }
}

#[test]
fn indices_are_as_measured() {
    assert!((water(589.3) - 1.3330).abs() < 1e-4 && (water(656.3) - 1.3312).abs() < 3e-4, "{}", water(656.3));
    assert!((water(404.7) - 1.3428).abs() < 3e-4, "{}", water(404.7));
    assert!((ice(589.3) - 1.3095).abs() < 5e-4, "{}", ice(589.3));
    // Published: the primary spans 40.7° to 42.4°, the secondary 50.4° to 53.4°.
    let [red, violet] = [680.0, 410.0].map(|nm| [1, 2].map(|k| ray_angle(k, nm).to_degrees()));
    assert!((red[0] - 42.4).abs() < 0.15 && (violet[0] - 40.7).abs() < 0.15, "{red:?} {violet:?}");
    assert!((red[1] - 50.4).abs() < 0.25 && (violet[1] - 53.4).abs() < 0.25, "{red:?} {violet:?}");
}

#[test]
fn no_bow_above_its_limit() {
    for (k, limit) in [(1, 42.37), (2, 53.48)] {
        let n = if k == 1 { 1.331 } else { 1.343 };
        let bow = drop::bow_angle(n, k);
        assert!(drop::top(bow, (limit - 0.05_f64).to_radians()).is_some());
        assert_eq!(drop::top(bow, (limit + 0.05_f64).to_radians()), None);
    }
}

#[test]
fn airy_s_function() {
    // Abramowitz and Stegun, table 10.11.
    for (x, truth) in [
        (0.0, 0.355_028_05),
        (1.0, 0.135_292_42),
        (-1.0, 0.535_560_88),
        (-5.0, 0.350_761_01),
        (-10.0, 0.040_241_24),
        (2.0, 0.034_924_13),
    ] {
        assert!((airy(x) - truth).abs() < 1e-8, "{x}: {}", airy(x));
    }
    // Ai'' = x Ai, through the seams.
    for i in -100..80 {
        let (x, h) = (0.1 * f64::from(i) + 0.013, 1e-3);
        let second = (airy(x + h) - 2.0 * airy(x) + airy(x - h)) / (h * h);
        assert!((second - x * airy(x)).abs() < 1e-5 * (1.0 + x * x), "{x}: {second} {}", x * airy(x));
    }
    assert!((airy(6.0) - airy(6.000_000_001)).abs() < 1e-12 && (airy(-6.0) - airy(-6.000_000_001)).abs() < 1e-8);
}

#[test]
fn the_caustic_s_curvature_is_that_of_the_turning() {
    for (n, k) in [(1.333, 1), (1.333, 2), (1.343, 1)] {
        let (b, e) = (drop::caustic(n, k), 1e-4);
        let second = (drop::turned(n, k, b + e) - 2.0 * drop::turned(n, k, b) + drop::turned(n, k, b - e)) / (e * e);
        assert!((0.5 * second / curvature(n, k) - 1.0).abs() < 1e-4, "{n} {k}: {second}");
    }
}

/// Light scattered at each angle from the antisolar point by a sphere of size `x`: Mie's series (Bohren and Huffman 1983, chapter 4), of
/// which Airy's theory and rays are both limits.
fn mie(n: f64, x: f64, angles: &[f64]) -> Vec<f64> {
    let terms = (x + 4.05 * x.cbrt() + 2.0) as usize;
    // The logarithmic derivative downward, the rest upward.
    let mut slope = vec![0.0; terms + 20];
    for k in (1..slope.len()).rev() {
        let over = k as f64 / (n * x);
        slope[k - 1] = over - 1.0 / (slope[k] + over);
    }
    let (mut psi, mut chi) = ([x.cos(), x.sin()], [-x.sin(), x.cos()]);
    let cosines: Vec<f64> = angles.iter().map(|a| -a.cos()).collect();
    let mut polar = vec![[0.0_f64, 1.0]; angles.len()];
    let mut sums = vec![[0.0_f64; 4]; angles.len()];
    for (k, slope) in slope.iter().enumerate().take(terms + 1).skip(1) {
        let f = k as f64;
        let next = |[a, b]: [f64; 2]| [b, (2.0 * f - 1.0) / x * b - a];
        (psi, chi) = (next(psi), next(chi));
        // A coefficient p/(p − i q), of real p and q.
        let part = |factor: f64| {
            let by = factor + f / x;
            let (p, q) = (by * psi[1] - psi[0], by * chi[1] - chi[0]);
            let square = p * p + q * q;
            [p * p / square, p * q / square]
        };
        let (a, b) = (part(slope / n), part(slope * n));
        let weight = (2.0 * f + 1.0) / (f * (f + 1.0));
        for ((cosine, polar), sum) in cosines.iter().zip(&mut polar).zip(&mut sums) {
            let [before, pi] = *polar;
            let tau = f * cosine * pi - (f + 1.0) * before;
            for c in 0..2 {
                sum[c] += weight * (a[c] * pi + b[c] * tau);
                sum[2 + c] += weight * (a[c] * tau + b[c] * pi);
            }
            *polar = [pi, ((2.0 * f + 1.0) * cosine * pi - (f + 1.0) * before) / f];
        }
    }
    // Of all that is scattered, which is twice the cross-section.
    sums.iter().map(|s| s.iter().map(|x| x * x).sum::<f64>() / (2.0 * TAU * x * x)).collect()
}

/// The same, of drops a few percent larger and smaller, under the sun's disc.
fn mie_mean(radius: f64, nm: f64, from: f64, step: f64, count: usize) -> Vec<f64> {
    const SIZES: u32 = 24;
    let angles: Vec<f64> = (0..count).map(|i| from + step * i as f64).collect();
    let mut mean = vec![[0.0; 3]; count];
    for i in 0..SIZES {
        let size = TAU * radius / (nm * 1e-9) * (0.97 + 0.06 * (f64::from(i) + 0.5) / f64::from(SIZES));
        for (mean, light) in mean.iter_mut().zip(mie(water(nm), size, &angles)) {
            (0..3).for_each(|k| mean[k] += light / f64::from(SIZES));
        }
    }
    table::blurred(&mean, step, SUN).iter().map(|v| v[0]).collect()
}

#[test]
fn peaks_lie_where_mie_s_series_has_them() {
    let (step, count) = (0.02_f64.to_radians(), 350);
    for (k, from) in [(1, 38.0_f64), (2, 49.0)] {
        for radius in [1e-4, 2.5e-4, 5e-4] {
            let from = from.to_radians();
            let truth = mie_mean(radius, 550.0, from, step, count);
            let airy: Vec<[f64; 3]> = (0..count).map(|i| [phase(radius, 550.0, from + step * i as f64); 3]).collect();
            let ours: Vec<f64> = table::blurred(&airy, step, SUN).iter().map(|v| v[0]).collect();
            let peak = |row: &[f64]| {
                let at = row.iter().enumerate().skip(20).take(count - 40).max_by(|a, b| a.1.total_cmp(b.1));
                at.map_or((0.0, 0.0), |(i, value)| ((from + step * i as f64).to_degrees(), *value))
            };
            let ((a, high), (b, truly)) = (peak(&ours), peak(&truth));
            // Waves draw the bow from where rays have it.
            let rays = ray_angle(k, 550.0).to_degrees();
            println!(
                "bow {k}, drops of {radius} m: {a:.2}° by Airy, {b:.2}° by Mie, {rays:.2}° by rays; {high:.4} and {truly:.4}"
            );
            assert!((a - b).abs() < 0.1, "{k} {radius}: {a} {b}");
            assert!((high / truly - 1.0).abs() < 0.15, "{k} {radius}: {high} {truly}");
        }
    }
}

#[test]
fn most_light_is_accounted_for() {
    // Half is diffraction; of the other half rays of the orders 0 to 3 have all but a few percent (van de Hulst 1957, section 12.22).
    let ends: Vec<f64> = (0..=60).map(|i| 1e-3 + (PI - 2e-3) * f64::from(i) / 60.0).collect();
    let [whole] = integrate(|a| [TAU * a.sin() * phase(3e-5, 550.0, a)], &ends, 1e-3);
    assert!((0.47..0.51).contains(&whole), "{whole}");
}

#[test]
fn a_rainbow_has_its_colours_in_order() {
    let bow = rainbow(&star(), 4e-4, SUN, 60_f64.to_radians(), 1_201);
    let at = |degrees: f64| bow.at(degrees.to_radians());
    let brightest = |channel: usize, from: f64, to: f64| {
        let steps = ((to - from) / 0.02) as usize;
        (0..steps)
            .map(|i| from + 0.02 * i as f64)
            .max_by(|a, b| at(*a)[channel].total_cmp(&at(*b)[channel]))
            .unwrap_or(0.0)
    };
    let primary = [0, 1, 2].map(|k| brightest(k, 38.0, 44.0));
    let secondary = [0, 1, 2].map(|k| brightest(k, 49.0, 56.0));
    println!("primary {primary:.2?}, secondary {secondary:.2?}");
    assert!(primary[0] > primary[1] + 0.1 && primary[1] > primary[2] + 0.1, "{primary:?}");
    assert!(secondary[0] < secondary[1] && secondary[1] < secondary[2], "{secondary:?}");
    assert!((primary[0] - 42.0).abs() < 0.5 && (secondary[0] - 51.2).abs() < 0.5);
    // Alexander's band is darker than both sides, the secondary fainter than the primary, the inside brighter than the outside.
    let bright = |degrees: f64| luminance(at(degrees).map(f64::from));
    assert!(bright(46.0) < 0.5 * bright(30.0) && bright(46.0) < 0.5 * bright(51.5));
    assert!(bright(secondary[1]) < 0.6 * bright(primary[1]));
    assert!(bow.values.iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn a_mist_s_bow_is_white_and_wide() {
    let [rain, mist] = [5e-4, 1e-5].map(|radius| rainbow(&star(), radius, SUN, 60_f64.to_radians(), 601));
    let colour = |bow: &table::AngleTable| {
        let spread = |v: &[f32; 3]| v[0].max(v[1]).max(v[2]) / v[0].min(v[1]).min(v[2]).max(1e-6);
        bow.values[350..450].iter().map(spread).fold(0.0, f32::max)
    };
    assert!(colour(&rain) > 2.5 && colour(&mist) < 2.5, "{} {}", colour(&rain), colour(&mist));
}

#[test]
fn halos_begin_at_least_turning() {
    // reference-values.md D.
    for (n, sides, end) in [(1.306, 21.536, 44.881), (1.31, 21.839, 45.733), (1.317, 22.371, 47.264)] {
        for (prism, degrees) in [(Prism::Sides, sides), (Prism::End, end)] {
            let ours = least(n, prism).map(f64::to_degrees);
            assert!(ours.is_some_and(|ours| (ours - degrees).abs() < 1e-3), "{n}: {ours:?}");
            // The ring's edge: nothing inside.
            let step = 0.05_f64.to_radians();
            let ring = ring(n, prism, step, 3_600);
            let first = ring.iter().position(|x| *x > 1e-3).unwrap_or(0) as f64 * 0.05;
            assert!((first - degrees).abs() < 0.1, "{n}: {first}, not {degrees}");
        }
    }
}

/// Crystals turned by lot, rays refracted as vectors by two planes: no Bravais, no lean.
fn by_lot(n: f64, prism: Prism, step: f64, count: usize) -> Vec<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // A direction through a face with a normal against it; none, if reflection is total.
    let refract = |d: [f64; 3], normal: [f64; 3], eta: f64| {
        let along = dot(d, normal);
        let square = (eta - 1.0) * (eta + 1.0) + along * along;
        (square > 0.0).then(|| {
            let root = -square.sqrt() - along;
            [0, 1, 2].map(|k| (d[k] + root * normal[k]) / eta)
        })
    };
    let fresnel = |cosine: f64, eta: f64| super::index::through(cosine, eta);
    let angle = prism.angle();
    // The faces' normals outward: the first is met against it, light leaves by the second.
    let (one, two) = ([0.0, -1.0, 0.0], [angle.sin(), angle.cos(), 0.0]);
    let mut random = Random::new(12, 0);
    let mut bins = vec![0.0; count];
    let mut total = 0.0;
    for _ in 0..3_000_000 {
        let (y, turn) = (random.uniform(), random.angle());
        let flat = (1.0 - y * y).sqrt();
        let d = [flat * turn.cos(), y, flat * turn.sin()];
        let Some(inside) = refract(d, one, n) else { continue };
        if dot(inside, two) <= 0.0 {
            continue;
        }
        let Some(out) = refract(inside, two.map(|x| -x), 1.0 / n) else { continue };
        let reached = prism.reached(libm::atan2(inside[0], inside[1]));
        let light = y * reached * fresnel(y, n) * fresnel(dot(inside, two), 1.0 / n);
        let bin = libm::acos(dot(d, out).clamp(-1.0, 1.0)) / step;
        total += light;
        if (bin as usize) < count {
            bins[bin as usize] += light;
        }
    }
    bins.iter().enumerate().map(|(i, bin)| bin / total / (TAU * step * (step * (i as f64 + 0.5)).sin())).collect()
}

#[test]
fn halos_are_those_of_crystals_turned_by_lot() {
    for prism in [Prism::Sides, Prism::End] {
        let step = 0.1_f64.to_radians();
        let count = 800;
        let blur = |row: &[f64]| -> Vec<f64> {
            let wide: Vec<[f64; 3]> = row.iter().map(|x| [*x; 3]).collect();
            table::blurred(&wide, step, SUN).iter().map(|x| x[0]).collect()
        };
        let full = ring(1.31, prism, step, 1_800);
        let (ours, lots) = (blur(&full[..count]), blur(&by_lot(1.31, prism, step, count)));
        let peak = |row: &[f64]| row.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |at| at.0);
        let (a, b) = (peak(&ours), peak(&lots));
        println!("{prism:?}: peaks at {:.1}° and {:.1}°", 0.1 * a as f64, 0.1 * b as f64);
        assert!(a.abs_diff(b) <= 1, "{a} {b}");
        let (mut off, mut sum) = (0.0, 0.0);
        for i in 0..count {
            off += (ours[i] - lots[i]).abs();
            sum += lots[i];
        }
        assert!(off < 0.03 * sum, "{prism:?}: {}", off / sum);
    }
}

#[test]
fn a_halo_is_red_inside() {
    let ring = halo(&star(), Prism::Sides, SUN, 40_f64.to_radians(), 800);
    let at = |degrees: f64| ring.at(degrees.to_radians());
    let [r, _, b] = at(21.8);
    assert!(r > 1.5 * b, "{r} {b}");
    assert!(luminance(at(15.0).map(f64::from)) < 0.01 * luminance(at(22.3).map(f64::from)));
    assert!(luminance(at(30.0).map(f64::from)) < luminance(at(22.3).map(f64::from)));
}

#[test]
fn sun_dogs_leave_the_halo_as_the_sun_climbs() {
    // reference-values.md D.
    for (elevation, degrees) in
        [(0.0, 21.84), (10.0, 22.14), (20.0, 23.07), (30.0, 24.79), (40.0, 27.63), (50.0, 32.43), (60.0, 44.62)]
    {
        let ours = dog_distance(1.31, f64::to_radians(elevation)).map(f64::to_degrees);
        assert!(ours.is_some_and(|ours| (ours - degrees).abs() < 0.01), "{elevation}: {ours:?}");
    }
    assert!(dog_distance(1.31, 60.74_f64.to_radians()).is_some());
    assert_eq!(dog_distance(1.31, 60.76_f64.to_radians()), None);
    assert!(dog_row(1.31, 61_f64.to_radians(), 0.01, 300).iter().all(|x| *x == 0.0));
    assert!(dog(&star(), 80_f64.to_radians(), SUN, PI, 400).values.iter().flatten().all(|x| *x == 0.0));
    // The row's edge is where the formula has it.
    let step = 0.05_f64.to_radians();
    for elevation in [0.0_f64, 25.0, 45.0] {
        let row = dog_row(1.31, elevation.to_radians(), step, 3_600);
        let first = row.iter().position(|x| *x > 1e-3).unwrap_or(0) as f64 * 0.05;
        let edge = dog_azimuth(1.31, elevation.to_radians()).unwrap_or(0.0).to_degrees();
        assert!((first - edge).abs() < 0.1, "{elevation}: {first}, not {edge}");
        let peak = row.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |at| at.0) as f64 * 0.05;
        assert!((peak - edge).abs() < 0.1, "{elevation}: {peak}, not {edge}");
    }
}

#[test]
fn the_arc_is_seen_while_the_sun_is_low() {
    let at = |degrees: f64| arc_elevation(1.31, degrees.to_radians()).map(f64::to_degrees);
    assert!(at(20.0).is_some_and(|h| (h - 65.89).abs() < 0.01), "{:?}", at(20.0));
    assert!(at(32.1).is_some() && at(32.3).is_none() && at(-1.0).is_none());
    // Red lies lowest, farthest from the zenith; the colours are far apart.
    let row = arc(&star(), 20_f64.to_radians(), SUN, 60_f64.to_radians(), 0.05_f64.to_radians(), 300);
    let peak = |k: usize| {
        let brightest = row.values.iter().enumerate().max_by(|a, b| a.1[k].total_cmp(&b.1[k]));
        60.0 + 0.05 * brightest.map_or(0, |at| at.0) as f64
    };
    assert!(peak(0) + 0.3 < peak(2), "{} {}", peak(0), peak(2));
    assert!((peak(0) - 65.9).abs() < 0.6 && peak(2) < 68.0, "{} {}", peak(0), peak(2));
    assert!(arc(&star(), FRAC_PI_2 * 0.5, SUN, 1.0, 0.01, 50).values.iter().flatten().all(|x| *x == 0.0));
}

#[test]
fn grey_stays_grey_and_blur_keeps_light() {
    let grey = table::coloured(&star(), 3, |_| vec![1.0, 0.5, 0.0]);
    assert!((0..3).all(|k| (grey[0][k] - 1.0).abs() < 1e-12 && (grey[1][k] - 0.5).abs() < 1e-12));
    let mut line = vec![[0.0; 3]; 101];
    line[50] = [1.0; 3];
    let wide = table::blurred(&line, 0.001, SUN);
    assert!((wide.iter().map(|v| v[0]).sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(wide[45][0] > 0.0 && wide[44][0] == 0.0 && wide[50][0] > wide[47][0]);
    assert_eq!(table::blurred(&line, 0.001, 0.0)[50], [1.0; 3]);
}
