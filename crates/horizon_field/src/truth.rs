//! Truth pictures: what a camera sees of a surface, by the certified march, and where that is a silhouette.

mod camera;

#[cfg(test)]
mod tests;

pub use camera::{Projection, TruthCamera};

use std::sync::Mutex;

use crate::march::{Cast, Counts, Surface, Tolerance, cast_from, clear_beam};

/// The truth about one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    /// The hit's distance in metres; infinite for a miss, 0 for a ray that starts under the ground.
    t: f64,
    /// The ground's normal at the hit; of no meaning elsewhere.
    normal: [f64; 3],
}

/// The truth about one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthPixel {
    /// The distance along the ray through the pixel's centre, in metres: infinite where it misses, 0 where it starts
    /// under the ground.
    pub t: f64,
    /// The least and the greatest distance among the centre's ray and the eight half a pixel around it.
    pub range: [f64; 2],
    /// Whether the eight tell of a discontinuity; see [`TruthPicture`].
    pub silhouette: bool,
}

impl TruthPixel {
    /// Whether the pixel's centre shows ground.
    pub fn is_hit(&self) -> bool {
        self.t.is_finite()
    }
}

/// What a camera sees of a surface.
///
/// A pixel is a *silhouette* if, among the eight rays half a pixel around its centre, the truth flips between hit and
/// miss, or one's distance differs by over three footprints from where that ray meets the tangent plane of the
/// centre's hit. There, which of two depths is right hangs on less than half a pixel.
pub struct TruthPicture {
    /// The camera.
    pub camera: TruthCamera,
    /// The pixels, row by row from the top left.
    pub pixels: Vec<TruthPixel>,
    /// What it cost.
    pub counts: Counts,
}

/// How many footprints a neighbour may lie off the tangent plane before the pixel counts as a silhouette.
const SILHOUETTE: f64 = 3.0;

impl TruthPicture {
    /// Casts the half-pixel grid's (2 w + 1)(2 h + 1) rays, each once, up to `far` metres, on `threads` threads.
    pub fn compute(surface: &(impl Surface + Sync), camera: TruthCamera, far: f64, threads: usize) -> Self {
        let width = 2 * camera.width + 1;
        let mut grid = vec![Sample { t: f64::INFINITY, normal: [0.0; 3] }; width * (2 * camera.height + 1)];
        let bands = Mutex::new(grid.chunks_mut(width * TILE).enumerate());
        let total = Mutex::new(Counts::default());
        let work = || {
            let mut counts = Counts::default();
            loop {
                // Its own statement, so that the lock is let go before the band's rays are cast.
                let band = bands.lock().expect("no worker panics").next();
                let Some((i, band)) = band else { break };
                for x in (0..width).step_by(TILE) {
                    look(surface, &camera, [x, i * TILE], band, far, &mut counts);
                }
            }
            *total.lock().expect("no worker panics") += counts;
        };
        std::thread::scope(|scope| {
            for _ in 0..threads.max(1) {
                scope.spawn(work);
            }
        });
        let pixels = (0..camera.height)
            .flat_map(|y| (0..camera.width).map(move |x| [x, y]))
            .map(|pixel| judge(&camera, &grid, pixel))
            .collect();
        Self { camera, pixels, counts: total.into_inner().expect("no worker panics") }
    }

    /// The share of the picture's pixels that are silhouettes.
    pub fn silhouette_share(&self) -> f64 {
        let silhouettes = self.pixels.iter().filter(|pixel| pixel.silhouette).count();
        silhouettes as f64 / self.pixels.len().max(1) as f64
    }
}

/// Rays per edge of a tile, which start together where their beam comes near the ground.
const TILE: usize = 8;

/// Casts the rays of one tile, whose first one is at the grid's `[left, top]`, of a band of the grid's rows.
fn look(
    surface: &impl Surface,
    camera: &TruthCamera,
    [left, top]: [usize; 2],
    band: &mut [Sample],
    far: f64,
    counts: &mut Counts,
) {
    let width = 2 * camera.width + 1;
    let (right, bottom) = (width.min(left + TILE), top + band.len() / width);
    let corners = [[left, top], [right - 1, top], [left, bottom - 1], [right - 1, bottom - 1]];
    let depth = clear_beam(surface, &corners.map(|grid| camera.line(grid)), far, counts);
    for (y, row) in band.chunks_mut(width).enumerate() {
        for (x, sample) in (left..).zip(&mut row[left..right]) {
            let ray = camera.ray([x, top + y]);
            // Less a hair, as `line` and `ray` are rounded apart.
            let start = (1.0 - 1e-9) * depth / camera.cosine(&ray);
            *sample = match cast_from(surface, &ray, [start, far], Tolerance::default(), counts) {
                Cast::Hit(hit) => Sample { t: hit.t, normal: hit.normal },
                Cast::Miss => Sample { t: f64::INFINITY, normal: [0.0; 3] },
                Cast::Inside => Sample { t: 0.0, normal: [0.0; 3] },
            };
        }
    }
}

/// Compares a pixel's centre with the eight samples around it.
fn judge(camera: &TruthCamera, grid: &[Sample], [x, y]: [usize; 2]) -> TruthPixel {
    let width = 2 * camera.width + 1;
    let middle = [2 * x + 1, 2 * y + 1];
    let centre = grid[middle[1] * width + middle[0]];
    let seen = centre.t.is_finite() && centre.t > 0.0;
    let at = camera.ray(middle).at(if seen { centre.t } else { 0.0 });
    let mut pixel = TruthPixel { t: centre.t, range: [centre.t; 2], silhouette: false };
    for grid_y in 2 * y..=2 * y + 2 {
        for grid_x in 2 * x..=2 * x + 2 {
            let sample = grid[grid_y * width + grid_x];
            pixel.range = [pixel.range[0].min(sample.t), pixel.range[1].max(sample.t)];
            pixel.silhouette |= if seen && sample.t.is_finite() {
                // Where the neighbour's ray meets the centre's tangent plane: far off, or behind, where it is parallel.
                let ray = camera.ray([grid_x, grid_y]);
                let toward = |v: [f64; 3]| v.iter().zip(centre.normal).map(|(v, n)| v * n).sum::<f64>();
                let origin = ray.origin();
                let plane = toward([0, 1, 2].map(|axis| at[axis] - origin[axis])) / toward(ray.direction());
                let off = (sample.t - plane).abs();
                off.is_nan() || off > SILHOUETTE * camera.footprint(centre.t)
            } else {
                sample.t.is_finite() != centre.t.is_finite() || (sample.t == 0.0) != (centre.t == 0.0)
            };
        }
    }
    pixel
}
