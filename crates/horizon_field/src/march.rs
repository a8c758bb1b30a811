//! The certified march: the first crossing of a ray with a height field, in f64, over the full field.
//!
//! Fixed steps, and steps in proportion to the height above the ground, leap through thin ridges; here a stretch of the
//! ray is passed over only when a bound *proves* it clear. With f(t) = y(t) − h(x(t), z(t)) and the surface's Taylor
//! model |h(c + d) − v − g·d| ≤ r over the stretch's box, f(t) ≥ y(t) − v − g·(q(t) − c) − r. The right side is linear
//! in t, so its two ends decide. What can't be decided is shortened, as in interval ray tracing (Mitchell, "Robust ray
//! intersection with interval arithmetic", Graphics Interface 1990); where the bound of f' has one sign the crossing is
//! unique, and Newton's method finds it.
//!
//! Where a hole takes the ground away, the same march goes on under it, upside down, until the ray comes out.

mod beam;
mod holes;
mod ray;
mod stretch;
mod surface;

#[cfg(test)]
mod field_tests;
#[cfg(test)]
pub(crate) mod fixtures;
#[cfg(test)]
mod hole_tests;
#[cfg(test)]
mod stamp_tests;
#[cfg(test)]
mod tests;

pub use ray::{Ray, RayError};
pub use surface::{Anchored, Surface};

pub(crate) use beam::{Line, clear_beam};

use ray::Clearance;
use stretch::Stretch;

/// Where a ray meets the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The distance along the ray, in metres.
    pub t: f64,
    /// The point, in the ray's coordinates.
    pub position: [f64; 3],
    /// The ground's unit normal there, pointing up.
    pub normal: [f64; 3],
}

/// What became of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cast {
    /// The first point at which the ray meets the ground from above.
    Hit(Hit),
    /// The ray stays above the ground.
    Miss,
    /// The ray starts on or under the ground. Where that has holes, such a ray goes on, and may come out.
    Inside,
}

impl Cast {
    /// The hit, if it is one.
    pub fn hit(self) -> Option<Hit> {
        match self {
            Self::Hit(hit) => Some(hit),
            Self::Miss | Self::Inside => None,
        }
    }
}

/// How short a stretch may get before two samples decide it instead of a proof: `absolute + relative · t` metres.
///
/// A ray that dips under the ground and comes out again within one such stretch may be taken as a graze, and goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Metres. Default 1e-6, at least 1e-9.
    pub absolute: f64,
    /// Share of the distance. Default 1e-7, a ten-thousandth of a usual pixel's footprint; at least 1e-12.
    pub relative: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { absolute: 1e-6, relative: 1e-7 }
    }
}

impl Tolerance {
    /// In metres, at distance `t`.
    fn at(&self, t: f64) -> f64 {
        // `max` also takes the floor where the setting is NaN.
        self.absolute.max(1e-9) + self.relative.max(1e-12) * t
    }
}

/// What casts cost, summed over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Boxes bounded.
    pub bounds: u64,
    /// Points evaluated.
    pub jets: u64,
    /// Stretches of the tolerance's length that no bound could decide.
    pub grazes: u64,
}

impl core::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.bounds += other.bounds;
        self.jets += other.jets;
        self.grazes += other.grazes;
    }
}

/// The farthest that a ray is followed, in metres: beyond it f64 no longer tells tenths of a millimetre apart.
const FARTHEST: f64 = 1e12;

/// Bounds per ray, and grazes per ray, after which it counts as touching. Ordinary rays need tens of bounds and no
/// graze; only one that runs along the ground, nearer than bounds can tell, comes here.
const MOST_BOUNDS: u64 = 1 << 18;
const MOST_GRAZES: u64 = 1 << 12;

/// Casts a ray up to the distance `t_max`, in metres.
///
/// No crossing is passed over, but for one whose way under the ground is shorter than the tolerance. A ray that runs
/// along the ground, nearer to it than bounds can tell, is a hit where that begins to last. Any input ends.
///
/// Through a hole a ray goes on under the ground, whose underside it does not meet: only once it has come out, through a hole or
/// not, may it meet the ground again, from above.
pub fn cast(surface: &impl Surface, ray: &Ray, t_max: f64, tolerance: Tolerance, counts: &mut Counts) -> Cast {
    cast_from(surface, ray, [0.0, t_max], tolerance, counts)
}

/// The same for a ray that is known to be clear of the ground up to `start`, by a [`beam`].
pub(crate) fn cast_from(
    surface: &impl Surface,
    ray: &Ray,
    [start, t_max]: [f64; 2],
    tolerance: Tolerance,
    counts: &mut Counts,
) -> Cast {
    let budget = Budget::new(counts);
    let reach = [start, t_max];
    let inside = start == 0.0 && starts_inside(surface, ray, counts);
    let hit = if surface.has_holes() {
        holes::meet_through(surface, ray, reach, !inside, tolerance, &budget, counts)
    } else if inside {
        return Cast::Inside;
    } else {
        meet(surface, ray, reach, tolerance, &budget, counts)
    };
    hit.map_or(Cast::Miss, Cast::Hit)
}

/// Whether a ray starts on or under the ground.
fn starts_inside(surface: &impl Surface, ray: &Ray, counts: &mut Counts) -> bool {
    if ray.origin()[1] > surface.range().1 {
        return false;
    }
    counts.jets += 1;
    ray.clearance(surface, 0.0).f <= 0.0
}

/// When a cast has used up its bounds or grazes.
struct Budget {
    bounds: u64,
    grazes: u64,
}

impl Budget {
    fn new(counts: &Counts) -> Self {
        Self { bounds: counts.bounds + MOST_BOUNDS, grazes: counts.grazes + MOST_GRAZES }
    }

    fn is_spent(&self, counts: &Counts) -> bool {
        counts.bounds >= self.bounds || counts.grazes >= self.grazes
    }
}

/// Where a ray that is above the ground at `start` first meets it, holes or not.
fn meet(
    surface: &impl Surface,
    ray: &Ray,
    [start, t_max]: [f64; 2],
    tolerance: Tolerance,
    budget: &Budget,
    counts: &mut Counts,
) -> Option<Hit> {
    let (_, high) = surface.range();
    // `min` also takes the farthest where `t_max` is NaN.
    let [first, end] = ray.below(high, t_max.min(FARTHEST))?;
    let mut t = first.max(start);
    // A beam ends near the ground, where long stretches are tried in vain.
    let mut step = if t == start && t > 0.0 { 0.03 * t } else { end - t };
    // Invariant: f > 0 on [start, t], up to grazes.
    while t < end {
        let shortest = tolerance.at(t);
        step = step.max(shortest).min(end - t);
        let next = t + step;
        if budget.is_spent(counts) {
            return Some(hit(ray, t, &ray.clearance(surface, t)));
        }
        counts.bounds += 1;
        let Stretch { clear, shrink, slope } = Stretch::bound(surface, &[ray.at(t)], &[ray.at(next)]);
        let slope = ray.slope(slope);
        if clear >= 1.0 || slope[0] > 0.0 {
            t = next;
            step *= GROWTH;
        } else if slope[1] < 0.0 || step <= shortest {
            // f falls all the way, so its sign at the end tells: a crossing, the only one, or none. In a stretch of
            // the tolerance's length it is taken to tell.
            counts.jets += 1;
            let there = ray.clearance(surface, next);
            if there.f <= 0.0 {
                return Some(refine(surface, ray, [t, next], there, counts));
            }
            counts.grazes += u64::from(slope[1] >= 0.0);
            t = next;
            step *= GROWTH;
        } else if clear >= PROGRESS {
            t += 0.999 * clear * step;
            step *= 0.5;
        } else {
            step *= shrink;
        }
    }
    None
}

/// How much longer the next stretch is tried after one that was clear.
const GROWTH: f64 = 2.0;

/// The least share of a stretch that is worth stepping over, when not all of it is clear.
const PROGRESS: f64 = 0.25;

/// The crossing between `low`, where f > 0, and `high`, where f ≤ 0 as `here` says: Newton's method, kept in the
/// bracket by bisection.
fn refine(
    surface: &impl Surface,
    ray: &Ray,
    [mut low, mut high]: [f64; 2],
    mut here: Clearance,
    counts: &mut Counts,
) -> Hit {
    // Newton needs about four turns, bisection alone at most the bits of an f64.
    const TURNS: usize = 64;
    let mut t = high;
    for _ in 0..TURNS {
        if here.f.abs() <= 1e-13 * (1.0 + ray.at(t)[1].abs()) || high - low <= 4.0 * f64::EPSILON * high {
            break;
        }
        let newton = t - here.f / here.slope;
        t = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        here = ray.clearance(surface, t);
        counts.jets += 1;
        if here.f > 0.0 {
            low = t;
        } else {
            high = t;
        }
    }
    hit(ray, t, &here)
}

fn hit(ray: &Ray, t: f64, here: &Clearance) -> Hit {
    Hit { t, position: ray.at(t), normal: surface::normal(here.ground.g) }
}
