//! Arcs of plates that lie flat, as falling ones do: sun dogs, and the circumzenithal arc. Elevations and azimuths in radians.

use super::halo::{Prism, leaning, least, pass, spread};
use super::index::{ice, through};
use super::table::{AngleTable, coloured, table, wavelengths};
use crate::spectrum::Star;
use core::f64::consts::FRAC_PI_2;

/// How far a sun dog's inner edge is from the sun in azimuth; none above 60.75° of elevation, where no light gets through.
pub fn dog_azimuth(n: f64, elevation: f64) -> Option<f64> {
    least(leaning(n, libm::sin(elevation)), Prism::Sides)
}

/// The same as an angle from the sun.
pub fn dog_distance(n: f64, elevation: f64) -> Option<f64> {
    dog_azimuth(n, elevation).map(|azimuth| 2.0 * libm::asin(libm::cos(elevation) * libm::sin(0.5 * azimuth)))
}

/// Steps over the crystals' azimuth.
const STEPS: usize = 4_000;

/// Light of a sun dog per radian of azimuth from the sun, in bins, at one index; all that plates send there in all is 1. Empty
/// where no light gets through.
pub fn dog_row(n: f64, elevation: f64, step: f64, count: usize) -> Vec<f64> {
    let index = leaning(n, libm::sin(elevation));
    let mut bins = vec![0.0; count];
    if least(index, Prism::Sides).is_none() {
        return bins;
    }
    let mut last: Option<[f64; 2]> = None;
    for j in 0..=STEPS {
        let incidence = FRAC_PI_2 * (2.0 * j as f64 / STEPS as f64 - 1.0) * (1.0 - 1e-9);
        let now = pass(index, Prism::Sides, incidence).map(|[turning, light]| [turning, light * libm::cos(incidence)]);
        if let (Some(a), Some(b)) = (last, now) {
            spread(&mut bins, step, [a[0], b[0]], 0.5 * (a[1] + b[1]));
        }
        last = now;
    }
    let total: f64 = bins.iter().sum();
    bins.iter().map(|bin| if total > 0.0 { bin / total / step } else { 0.0 }).collect()
}

/// A sun dog in colour over the azimuth from the sun, at the sun's elevation, from 0 to `end` in `count` ≥ 2 values. Both dogs are alike.
pub fn dog(star: &Star, elevation: f64, sun_radius: f64, end: f64, count: usize) -> AngleTable {
    let count = count.max(2);
    let step = end / count as f64;
    // Across azimuth the sun is wider, the higher it stands.
    let wide = sun_radius / libm::cos(elevation).max(0.1);
    table(star, wide, 0.5 * step, step, count, |nm| dog_row(ice(nm), elevation, step, count))
}

/// The circumzenithal arc's elevation, sin h = √(n² − cos² e): in by the upper end, out by a side. None while the sun stands above 32.2°.
pub fn arc_elevation(n: f64, elevation: f64) -> Option<f64> {
    let cosine = libm::cos(elevation);
    let sine = ((n - cosine) * (n + cosine)).max(0.0).sqrt();
    (sine < 1.0 && elevation >= 0.0).then(|| libm::asin(sine))
}

/// What of the light that meets the end is left in the arc's middle.
pub fn arc_light(n: f64, elevation: f64) -> f64 {
    let (up, level) = (libm::sin(elevation), libm::cos(elevation));
    // Inside, against the side: n cos = level.
    arc_elevation(n, elevation).map_or(0.0, |_| through(up, n) * through((level / n).min(1.0), 1.0 / n))
}

/// The arc in colour over elevation, from `start` in `count` ≥ 2 values of `step`: light per radian of elevation. The sun's disc is
/// blurred as the arc stretches it: dh/de = sin e cos e/(sin h cos h).
pub fn arc(star: &Star, elevation: f64, sun_radius: f64, start: f64, step: f64, count: usize) -> AngleTable {
    let values = coloured(star, count.max(2), |nm| {
        let mut row = vec![0.0; count.max(2)];
        let n = ice(nm);
        let Some(h) = arc_elevation(n, elevation) else { return row };
        let stretch = libm::sin(elevation) * libm::cos(elevation) / (libm::sin(h) * libm::cos(h)).max(1e-3);
        // Neighbouring wavelengths must meet: none is a line.
        let gap = wavelengths().nth(1).and_then(|b| wavelengths().next().map(|a| b - a)).unwrap_or(10.0);
        let near = arc_elevation(ice(nm + 0.5 * gap), elevation).map_or(0.0, |other| (other - h).abs());
        let half = (sun_radius * stretch).max(near).max(step);
        for (i, value) in row.iter_mut().enumerate() {
            let t = (start + step * i as f64 - h) / half;
            if t.abs() < 1.0 {
                *value = arc_light(n, elevation) * (1.0 - t * t).sqrt() / (FRAC_PI_2 * half);
            }
        }
        row
    });
    AngleTable { start, step, values: values.into_iter().map(|rgb| rgb.map(|x| x as f32)).collect() }
}
