//! How far a depth picture is from the truth: seed 000's HDE and IDE (§4.2.2, eq. 4.1), and the same in pixels.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::march::Surface;
use crate::truth::TruthPicture;

/// How an error is spread over pixels; zeros where there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// How many pixels count.
    pub count: usize,
    /// The mean.
    pub mean: f64,
    /// The median.
    pub p50: f64,
    /// The 99th percentile, by nearest rank.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
}

impl Spread {
    /// The spread of a list of errors.
    pub fn of(mut errors: Vec<f64>) -> Self {
        errors.sort_by(f64::total_cmp);
        let count = errors.len();
        let rank = |share: f64| errors[((share * count as f64).ceil() as usize).clamp(1, count) - 1];
        if count == 0 {
            return Self::default();
        }
        let mean = errors.iter().sum::<f64>() / count as f64;
        Self { count, mean, p50: rank(0.5), p99: rank(0.99), max: rank(1.0) }
    }
}

/// A depth picture against the truth.
///
/// A footprint is a pixel's width at the depth in question. An error of Δt along the ray moves nothing on the screen of
/// the camera that sees it; divided by the footprint it says by how many pixels the point is off in the world, and so
/// bounds how far it swims as the camera moves sideways by as much as it is away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Pixels of the picture.
    pub pixels: usize,
    /// Silhouettes among them, as [`TruthPicture`] has it.
    pub silhouettes: usize,
    /// Outside silhouettes: pixels without ground where the truth has some.
    pub missed: usize,
    /// Outside silhouettes: pixels with ground where the truth has none.
    pub false_hits: usize,
    /// Silhouettes whose depth lies outside what the truth sees within half a pixel, by more than a footprint.
    pub stray: usize,
    /// Height difference error |y − H| in metres, over all pixels that show ground.
    pub hde: Spread,
    /// The same in footprints.
    pub hde_pixels: Spread,
    /// Distance to the surface along its normal, |y − H| / √(1 + |∇H|²), in footprints, over the same pixels.
    pub surface: Spread,
    /// Intersection distance error |t − t_truth| in metres, over pixels outside silhouettes that are ground in both.
    pub ide: Spread,
    /// The same in footprints of the truth's depth.
    pub ide_pixels: Spread,
}

impl Report {
    /// Compares a picture of distances along the rays through the pixels' centres, in metres, row by row from the top
    /// left and `None` where there is no ground, with the truth about the same camera and surface.
    ///
    /// # Panics
    /// If the two pictures differ in size.
    pub fn new(surface: &impl Surface, truth: &TruthPicture, depth: &[Option<f64>]) -> Self {
        assert_eq!(depth.len(), truth.pixels.len(), "the pictures differ in size");
        let camera = &truth.camera;
        let mut report = Self { pixels: depth.len(), ..Self::default() };
        let [mut hde, mut hde_pixels, mut normal, mut ide, mut ide_pixels] = [const { Vec::new() }; 5];
        for (i, (pixel, &depth)) in truth.pixels.iter().zip(depth).enumerate() {
            if let Some(t) = depth {
                let [x, y, z] = camera.pixel_ray(i).at(t);
                let ground = surface.jet([x, z]);
                let off = (y - ground.v).abs();
                hde.push(off);
                hde_pixels.push(off / camera.footprint(t));
                let slope = ground.g[0] * ground.g[0] + ground.g[1] * ground.g[1];
                normal.push(off / (1.0 + slope).sqrt() / camera.footprint(t));
            }
            if pixel.silhouette {
                report.silhouettes += 1;
                let t = depth.unwrap_or(f64::INFINITY);
                let [nearest, farthest] = pixel.range;
                // A footprint of room, as errors of that size are no false depth elsewhere either.
                let inside = nearest - camera.footprint(nearest.min(t)) <= t
                    && t <= farthest + camera.footprint(t.min(farthest));
                report.stray += usize::from(!inside);
                continue;
            }
            match (pixel.is_hit(), depth) {
                (true, Some(t)) => {
                    let error = (t - pixel.t).abs();
                    ide.push(error);
                    // A ray that starts under the ground has no footprint there, and must agree that it does.
                    ide_pixels.push(if error == 0.0 { 0.0 } else { error / camera.footprint(pixel.t) });
                }
                (true, None) => report.missed += 1,
                (false, Some(_)) => report.false_hits += 1,
                (false, None) => {}
            }
        }
        report.hde = Spread::of(hde);
        report.hde_pixels = Spread::of(hde_pixels);
        report.surface = Spread::of(normal);
        report.ide = Spread::of(ide);
        report.ide_pixels = Spread::of(ide_pixels);
        report
    }

    /// The share of silhouettes in the picture.
    pub fn silhouette_share(&self) -> f64 {
        self.silhouettes as f64 / self.pixels.max(1) as f64
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, mean, p50, p99, max } = self;
        write!(f, "mean {mean:9.3e}  p50 {p50:9.3e}  p99 {p99:9.3e}  max {max:9.3e}  over {count} pixels")
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "missed {}, false {}, of {} pixels", self.missed, self.false_hits, self.pixels)?;
        let share = 100.0 * self.silhouette_share();
        writeln!(f, "silhouettes {} ({share:.2} %), stray {}", self.silhouettes, self.stray)?;
        writeln!(f, "HDE in m            {}", self.hde)?;
        writeln!(f, "surface in px       {}", self.surface)?;
        writeln!(f, "IDE in m            {}", self.ide)?;
        write!(f, "IDE in px           {}", self.ide_pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::{Report, Spread};
    use crate::march::fixtures::{Pillars, Plane, Waves};
    use crate::truth::{Projection, TruthCamera, TruthPicture};

    fn depth(truth: &TruthPicture) -> Vec<Option<f64>> {
        truth.pixels.iter().map(|pixel| pixel.is_hit().then_some(pixel.t)).collect()
    }

    #[test]
    fn the_truth_agrees_with_itself() {
        let hills = Waves::hills();
        let wide = Projection::Perspective { fov: 0.8 };
        let camera = TruthCamera::looking_at([0.0, 600.0, 0.0], [3000.0, 0.0, 0.0], wide, [32, 18]);
        let truth = TruthPicture::compute(&hills, camera, 30_000.0, 2);
        let report = Report::new(&hills, &truth, &depth(&truth));
        assert_eq!((report.missed, report.false_hits, report.stray), (0, 0, 0));
        assert!(report.ide.count > 100);
        assert_eq!((report.ide.max, report.ide_pixels.max), (0.0, 0.0));
        assert!(report.hde.max < 1e-8 && report.surface.max < 1e-6, "{report}");
    }

    #[test]
    fn errors_are_what_they_were_made() {
        // Parallel rays straight down a slope of 3/4: 0.5 m along them are 0.5 m of height, and 0.4 m of distance.
        let plane = Plane { height: 0.0, slope: [0.75, 0.0] };
        let window = Projection::Orthographic { height: 100.0 };
        let camera = TruthCamera::looking_at([0.0, 500.0, 0.0], [0.0, 0.0, 0.0], window, [20, 10]);
        let truth = TruthPicture::compute(&plane, camera, 1000.0, 1);
        let off: Vec<_> = depth(&truth).into_iter().map(|t| t.map(|t| t - 0.5)).collect();
        let report = Report::new(&plane, &truth, &off);
        for (spread, expected) in
            [(report.hde, 0.5), (report.ide, 0.5), (report.surface, 0.04), (report.ide_pixels, 0.05)]
        {
            assert_eq!(spread.count, 200);
            assert!((spread.mean - expected).abs() < 1e-9 && (spread.p99 - expected).abs() < 1e-9, "{report}");
        }
    }

    #[test]
    fn missed_false_and_stray_pixels_are_counted() {
        let pillars = Pillars { height: 80.0, radius: 6.0, spacing: 500.0 };
        let wide = Projection::Perspective { fov: 0.8 };
        let camera = TruthCamera::looking_at([250.0, 30.0, 250.0], [1000.0, 30.0, 1000.0], wide, [64, 36]);
        let truth = TruthPicture::compute(&pillars, camera, 5000.0, 2);
        let turned = |wanted: &dyn Fn(usize) -> bool, to: Option<f64>| {
            let mut depth = depth(&truth);
            for i in (0..depth.len()).filter(|i| wanted(*i)) {
                depth[i] = to;
            }
            Report::new(&pillars, &truth, &depth)
        };
        let plain = |i: usize, hit: bool| truth.pixels[i].is_hit() == hit && !truth.pixels[i].silhouette;
        let report = turned(&|i| plain(i, true), None);
        assert_eq!((report.missed, report.false_hits, report.stray), (report_count(&truth, true), 0, 0));
        let report = turned(&|i| plain(i, false), Some(10.0));
        assert_eq!((report.missed, report.false_hits, report.stray), (0, report_count(&truth, false), 0));
        let report = turned(&|i| truth.pixels[i].silhouette, Some(1.0));
        assert_eq!((report.missed, report.false_hits, report.stray), (0, 0, report.silhouettes));
        assert!(report.silhouettes > 10);
    }

    fn report_count(truth: &TruthPicture, hit: bool) -> usize {
        truth.pixels.iter().filter(|pixel| !pixel.silhouette && pixel.is_hit() == hit).count()
    }

    #[test]
    fn spreads() {
        assert_eq!(Spread::of(vec![]), Spread::default());
        let spread = Spread::of((1..=200).rev().map(f64::from).collect());
        assert_eq!(spread, Spread { count: 200, mean: 100.5, p50: 100.0, p99: 198.0, max: 200.0 });
    }
}
