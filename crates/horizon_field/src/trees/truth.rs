//! The truth about a ray and plants: by interval bisection, in double precision, which proves of each stretch of the ray
//! that it is clear, or halves it.
//!
//! Over a stretch, ‖p / r‖ is convex, so its least value is known exactly; and the foliage, linear along each axis between
//! texels, has its extremes at corners of the boxes into which texels cut the stretch's own box.

use super::cast::Cone;
use super::foliage::{Foliage, MIPS, TEXELS};
use super::solid::{Ellipsoid, Part, Solid, dot};

/// A stretch this short that can't be proven clear is a hit: in metres.
pub const CERTAIN: f64 = 1e-7;

/// How many corners of a box's pieces are looked at, at most; a box of more pieces is taken for all of the table.
const CORNERS: usize = 64;

/// What rounding takes from a bound.
const ROUNDING: f64 = 1e-12;

impl Foliage {
    /// The least value over a box, in periods, at a level.
    fn least(&self, low: [f64; 3], high: [f64; 3], level: f64) -> f64 {
        let level = level.clamp(0.0, MIPS as f64 - 1.0);
        let mip = level.floor() as usize;
        let mix = level - level.floor();
        let fine = self.least_of(mip, low, high);
        let value = if mix > 0.0 { fine + mix * (self.least_of(mip + 1, low, high) - fine) } else { fine };
        value - ROUNDING
    }

    fn least_of(&self, mip: usize, low: [f64; 3], high: [f64; 3]) -> f64 {
        let edge = (TEXELS >> mip) as f64;
        // From the first texel's middle, where pieces begin.
        let inside = |k: usize| {
            let [from, to] = [low[k], high[k]].map(|u| u * edge - 0.5);
            (from.floor() as i64 + 1, to.ceil() as i64)
        };
        let count: f64 = (0..3).map(|k| ((inside(k).1 - inside(k).0).max(0) + 2) as f64).product();
        if count > CORNERS as f64 {
            return 0.0;
        }
        let stops = |k: usize| {
            let (first, past) = inside(k);
            let between = (first..past).map(move |i| (i as f64 + 0.5) / edge);
            [low[k], high[k]].into_iter().chain(between)
        };
        let mut least = f64::INFINITY;
        for z in stops(2) {
            for y in stops(1) {
                for x in stops(0) {
                    least = least.min(self.value([x, y, z], mip as f64));
                }
            }
        }
        least
    }
}

impl Ellipsoid<f64> {
    /// The least ‖p / r‖ on a stretch of a ray.
    fn least(&self, o: [f64; 3], d: [f64; 3], [from, to]: [f64; 2]) -> f64 {
        let o = self.scaled(o);
        let d: [f64; 3] = core::array::from_fn(|k| d[k] / self.radii[k]);
        let t = (-dot(o, d) / dot(d, d)).clamp(from, to);
        let p = core::array::from_fn(|k| o[k] + t * d[k]);
        dot(p, p).sqrt()
    }
}

impl Solid<f64> {
    /// A lower bound of the crown's function on a stretch of a ray of its own space.
    fn least_crown(&self, o: [f64; 3], d: [f64; 3], stretch: [f64; 2], level: f64) -> f64 {
        let [a, b] = stretch.map(|t| self.periods(core::array::from_fn(|k| o[k] + t * d[k])));
        let [low, high] = [f64::min as fn(f64, f64) -> f64, f64::max].map(|f| core::array::from_fn(|k| f(a[k], b[k])));
        let eaten = 1.0 - self.foliage * Foliage::table().least(low, high, level);
        let each = self.crown.iter().map(|e| e.narrow() * (e.least(o, d, stretch) - eaten - ROUNDING));
        each.fold(f64::INFINITY, f64::min)
    }

    /// Where, within `range`, a ray first meets the plant, and what of it: proven of all that lies before, and of what is
    /// there to within [`CERTAIN`]. The foliage is at the level of a pixel `footprint` metres wide.
    pub fn truth(&self, origin: [f64; 3], direction: [f64; 3], range: [f64; 2], footprint: f64) -> Option<(f64, Part)> {
        let (o, d) = (self.own(origin), self.own_direction(direction));
        let level = self.level(footprint);
        let [start, mut end] = range;
        let mut hit = None;
        if let Some(chord) = self.trunk.and_then(|trunk| trunk.chord(o, d)) {
            let t = chord[0].max(start);
            if t <= chord[1].min(end) {
                hit = Some((t, Part::Trunk));
                end = t;
            }
        }
        let Some(chord) = self.crown_chord(o, d) else { return hit };
        let mut stack = vec![[(chord[0] - CERTAIN).max(start), (chord[1] + CERTAIN).min(end)]];
        while let Some([from, to]) = stack.pop() {
            if from > to || self.least_crown(o, d, [from, to], level) > 0.0 {
                continue;
            }
            if to - from < CERTAIN {
                return Some((from, Part::Crown));
            }
            let middle = 0.5 * (from + to);
            stack.extend([[middle, to], [from, middle]]);
        }
        hit
    }
}

/// The nearest of some plants that a ray meets within `t_max`, and where: every one is tried.
pub fn nearest_truth(
    solids: &[Solid<f64>],
    origin: [f64; 3],
    direction: [f64; 3],
    t_max: f64,
    cone: Cone,
) -> Option<(usize, f64, Part)> {
    let mut nearest = None;
    let mut end = t_max;
    for (i, solid) in solids.iter().enumerate() {
        let footprint = cone.at(solid.depth(origin, direction));
        if let Some((t, part)) = solid.truth(origin, direction, [0.0, end], footprint) {
            nearest = Some((i, t, part));
            end = t;
        }
    }
    nearest
}
