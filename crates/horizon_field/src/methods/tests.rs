//! The methods are tested against algebra, against the certified march, and where they are known to fail.

mod certified;
mod convergence;
mod failures;
mod grounds;
mod mountains;
mod overstepping;
mod settings;
mod shader;

use super::{Ground, Method, Setting, Work};
use crate::march::{Cast, Counts, Ray, Tolerance, cast};

/// A pixel at 720 rows and a field of view of 60°.
const PIXEL: f64 = 0.0016;

/// The methods that leap through nothing, at settings for such pixels.
const CERTIFIED: [Method; 2] = [Method::Segment { pixel: 0.25 }, Method::Bisection { pixel: 0.25 }];

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray::new(origin, direction).unwrap()
}

/// Where a method says that a ray meets the ground.
fn shoot(ground: &impl Ground, method: Method, ray: &Ray, far: f64) -> Option<f64> {
    method.check().unwrap();
    method.cast(&Setting::new(ground, far, PIXEL), ray, &mut Work::default())
}

/// Where it does: 0 for a ray that starts under the ground.
fn truth(ground: &impl Ground, ray: &Ray, far: f64) -> Option<f64> {
    match cast(ground, ray, far, Tolerance::default(), &mut Counts::default()) {
        Cast::Hit(hit) => Some(hit.t),
        Cast::Miss => None,
        Cast::Inside => Some(0.0),
    }
}

/// How many of these rays a method gets wrong: other than the truth in meeting the ground, or by over two pixels where.
fn wrong(ground: &impl Ground, method: Method, rays: &[Ray], far: f64) -> usize {
    let off = |ray: &&Ray| match (shoot(ground, method, ray, far), truth(ground, ray, far)) {
        (Some(t), Some(truth)) => (t - truth).abs() > 2.0 * PIXEL * truth.max(1.0),
        (t, truth) => t.is_some() != truth.is_some(),
    };
    rays.iter().filter(off).count()
}
