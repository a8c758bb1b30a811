//! Rays through ground with holes: above it down to where they meet it, in a hole on under it up to where they come out, and so
//! on. Under the ground a ray is marched upside down, over the ground's own mirror image: what is proven of the one is proven of
//! the other.

use super::surface::Surface;
use super::{Budget, Counts, Hit, Ray, Tolerance, meet};
use crate::field::Bound;
use crate::real::Jet;

/// Crossings of a ray, after which it is lost. Only one that runs along a hole's missing ground, nearer than bounds can tell, comes
/// here.
const MOST_CROSSINGS: u32 = 1 << 12;

/// The ground upside down.
struct Mirrored<'a, S>(&'a S);

impl<S: Surface> Surface for Mirrored<'_, S> {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        let Jet { v, g } = self.0.jet(q);
        Jet { v: -v, g: g.map(|g| -g) }
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        let Bound { v, g, rest, low, high, slope } = self.0.bound(centre, half);
        Bound { v: -v, g: g.map(|g| -g), rest, low: -high, high: -low, slope: slope.map(|[low, high]| [-high, -low]) }
    }

    fn range(&self) -> (f64, f64) {
        let (low, high) = self.0.range();
        (-high, -low)
    }
}

/// Where a ray that is `above` the ground at `start`, or else under it, first meets ground from above.
///
/// A ray that comes out of the ground and goes in again within the tolerance, or the other way round, may be taken not to.
pub(super) fn meet_through(
    surface: &impl Surface,
    ray: &Ray,
    [start, t_max]: [f64; 2],
    mut above: bool,
    tolerance: Tolerance,
    budget: &Budget,
    counts: &mut Counts,
) -> Option<Hit> {
    let (underside, mirrored) = (Mirrored(surface), ray.mirrored());
    let mut from = start;
    for _ in 0..MOST_CROSSINGS {
        let reach = [from, t_max];
        let crossing = if above {
            meet(surface, ray, reach, tolerance, budget, counts)?
        } else {
            meet(&underside, &mirrored, reach, tolerance, budget, counts)?
        };
        let [x, _, z] = crossing.position;
        if above && !surface.is_hole([x, z]) {
            return Some(crossing);
        }
        // On the other side by then, or back again.
        from = crossing.t + tolerance.at(crossing.t);
        counts.jets += 1;
        above = ray.clearance(surface, from).f > 0.0;
    }
    None
}
