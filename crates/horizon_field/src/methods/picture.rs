//! All rays of a camera.

use std::sync::Mutex;

use super::Method;
use super::ground::{Ground, Setting};
use super::work::Work;
use crate::truth::{Projection, TruthCamera};

/// Casts the rays through the centres of a camera's pixels, up to `far` metres, on `threads` threads: distances in metres
/// row by row from the top left, and what they cost.
///
/// # Panics
/// If the camera's rays are parallel: the methods' pixels grow with the distance.
pub fn picture<G: Ground>(
    method: &Method,
    surface: &G,
    camera: &TruthCamera,
    far: f64,
    threads: usize,
) -> (Vec<Option<f64>>, Work) {
    assert!(matches!(camera.projection, Projection::Perspective { .. }), "parallel rays have no pixel angle");
    let setting = Setting::new(surface, far, camera.footprint(1.0));
    let mut depth = vec![None; camera.width * camera.height];
    let rows = Mutex::new(depth.chunks_mut(camera.width.max(1)).enumerate());
    let total = Mutex::new(Work::default());
    let march = || {
        let mut work = Work::default();
        loop {
            // Its own statement, so that the lock is let go before the row's rays are cast.
            let row = rows.lock().expect("no worker panics").next();
            let Some((y, row)) = row else { break };
            for (x, t) in row.iter_mut().enumerate() {
                *t = method.cast(&setting, &camera.pixel_ray(y * camera.width + x), &mut work);
            }
        }
        *total.lock().expect("no worker panics") += work;
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(march);
        }
    });
    (depth, total.into_inner().expect("no worker panics"))
}
