//! Where marching a height field fails: the plain way beside the certified methods.

use core::f64::consts::TAU;

use super::grounds::Ridges;
use super::{CERTIFIED, PIXEL, ray, shoot, truth, wrong};
use crate::march::fixtures::{Pillars, Plane, Waves};
use crate::march::{Ray, Surface};
use crate::methods::{Ground, Method};

/// Seed 000's march, coarse and fine; and seed 002's.
const COARSE: Method = Method::FixedStep { a: 10.0, b: 0.01, c: 0.5, k: 6 };
const FINE: Method = Method::FixedStep { a: 1.0, b: 0.004, c: 0.5, k: 6 };
const LINEAR: Method = Method::Linear { delta: 0.01 };
const SPHERE: Method = Method::SphereTracing { omega: 1.0, pixel: 0.05 };

/// The certified methods get no ray wrong.
fn assert_certified(ground: &impl Ground, rays: &[Ray], far: f64) {
    for method in CERTIFIED {
        assert_eq!(wrong(ground, method, rays, far), 0, "{method}");
    }
}

#[test]
fn grazing_rays() {
    // Level, a centimetre under the crests of waves: some four metres of each ray are under the ground.
    let waves = Waves(vec![(100.0, TAU / 1000.0)]);
    let rays: Vec<_> = (0..40).map(|i| ray([f64::from(i) * 7.3, 99.99, 250.0], [1.0, 0.0, 0.0])).collect();
    let leapt = wrong(&waves, COARSE, &rays, 5000.0);
    assert!(leapt > 15, "{leapt} of 40");
    assert_certified(&waves, &rays, 5000.0);
}

#[test]
fn thin_ridges_and_pillars_between_two_samples() {
    // A ridge 8 m thick where the rays meet it, a few hundred metres off; a pillar of 4 m, up to 5 km off.
    let ridges = Ridges { height: 80.0, slope: 10.0, spacing: 500.0 };
    let rays: Vec<_> = (0..40).map(|i| ray([250.0, 78.0 - f64::from(i), 0.0], [1.0, 0.0, 0.3])).collect();
    for method in [COARSE, FINE] {
        let leapt = wrong(&ridges, method, &rays, 5000.0);
        assert!(leapt > 5, "{method} leapt through {leapt} of 40");
    }
    assert_certified(&ridges, &rays, 5000.0);

    let pillars = Pillars { height: 80.0, radius: 5.0, spacing: 500.0 };
    let rays: Vec<_> = (1..10).map(|x| ray([250.0, 40.0, 3.0], [500.0 * f64::from(x) - 250.0, 0.0, 497.0])).collect();
    for method in [COARSE, FINE, LINEAR] {
        let leapt = wrong(&pillars, method, &rays, 6000.0);
        assert!(leapt >= 2, "{method} leapt through {leapt} of 9");
    }
    assert_certified(&pillars, &rays, 6000.0);
}

#[test]
fn a_camera_under_the_ground() {
    // Seed 002 as it is printed: the first step interpolates with heights of 0.
    fn printed(ground: &impl Surface, ray: &Ray) -> f64 {
        let (mut dt, mut t, mut last) = (0.01, 0.001, [0.0; 2]);
        loop {
            let [x, y, z] = ray.at(t);
            let h = ground.jet([x, z]).v;
            if y < h {
                return t - dt + dt * (last[0] - last[1]) / (y - last[1] - h + last[0]);
            }
            last = [h, y];
            t += dt;
            dt = 0.01 * t;
        }
    }
    let hills = Waves::hills();
    for direction in [[1.0, 0.0, 0.0], [0.3, 0.5, -1.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]] {
        let down = ray([500.0, -700.0, 500.0], direction);
        assert!(printed(&hills, &down) < 0.0, "behind the camera");
        for method in [COARSE, LINEAR, SPHERE].into_iter().chain(CERTIFIED) {
            assert_eq!(shoot(&hills, method, &down, 5000.0), Some(0.0), "{method}");
        }
    }
}

#[test]
fn straight_down_and_exactly_level() {
    // Where a ray comes down to the highest ground, or rises from it, has no answer for a level one.
    let hills = Waves::hills();
    let (_, high) = hills.range();
    let naive = |origin: f64, fall: f64| (high - origin) / fall;
    assert!(naive(high, 0.0).is_nan() && naive(high + 1.0, 0.0).is_infinite());
    for method in [COARSE, FINE, LINEAR, SPHERE].into_iter().chain(CERTIFIED) {
        for above in [0.0, 1e-9, 1.0] {
            for fall in [0.0, -0.0] {
                let level = ray([3.0, high + above, 4.0], [1.0, fall, 0.0]);
                assert_eq!(shoot(&hills, method, &level, 5000.0), None, "{method}");
            }
        }
        // Down from above: the march starts at the highest ground.
        for x in [0.0, 500.0, 777.0] {
            let down = ray([x, 3000.0, 123.0], [0.0, -1.0, 0.0]);
            let (t, expected) = (shoot(&hills, method, &down, 1e4).unwrap(), truth(&hills, &down, 1e4).unwrap());
            assert!((t - expected).abs() < PIXEL * expected, "{method}: {t} for {expected}");
        }
    }
    // Else small steps run out on the way.
    let small = Method::FixedStep { a: 1.0, b: 0.0, c: 0.0, k: 0 };
    let down = [ray([3.0, 8000.0, 123.0], [0.0, -1.0, 0.0])];
    assert_eq!(wrong(&hills, small, &down, 1e4), 0);
}

#[test]
fn a_ray_along_a_lattice_line() {
    // Steps of a wavelength along the lattice meet the same height over and over: here zero, between hills of 100 m.
    let waves = Waves(vec![(100.0, TAU / 1000.0), (50.0, TAU / 500.0), (25.0, TAU / 250.0)]);
    let along = [ray([0.0, 10.0, 250.0], [1.0, 0.0, 0.0]), ray([250.0, 10.0, 0.0], [0.0, 0.0, 1.0])];
    let lattice = Method::FixedStep { a: 1000.0, b: 0.0, c: 0.0, k: 6 };
    assert_eq!(wrong(&waves, lattice, &along, 30_000.0), 2);
    assert_certified(&waves, &along, 30_000.0);
    // And where every octave is zero all along, and no slope across is.
    let zero = [ray([0.0, 0.5, 0.0], [1.0, 0.0, 0.0]), ray([0.0, 0.5, 0.0], [1.0, -1e-3, 0.0])];
    assert_certified(&waves, &zero, 30_000.0);
}

#[test]
fn a_far_plane_cut() {
    // A plane 990 m down the ray, and the far plane at 1000 m, between two samples of a plain loop.
    // Its slope makes it as high as can be somewhere, so that no march starts at the highest ground.
    let plane = Plane { height: 0.0, slope: [0.0, 1e-3] };
    let down = ray([0.0, 990.0, 0.0], [0.0, -1.0, 0.0]);
    let naive = (0..).map(|i| 40.0 * f64::from(i)).take_while(|t| *t < 1000.0).any(|t| down.at(t)[1] <= 0.0);
    assert!(!naive, "the last sample is at 960 m");
    let fixed = Method::FixedStep { a: 40.0, b: 0.0, c: 0.0, k: 0 };
    for method in [fixed, COARSE, FINE, LINEAR, SPHERE].into_iter().chain(CERTIFIED) {
        let t = shoot(&plane, method, &down, 1000.0).expect("the ground is before the far plane");
        assert!((t - 990.0).abs() < 1.0, "{method}: {t}");
        // No ground beyond it is reported either.
        assert_eq!(shoot(&plane, method, &down, 980.0), None, "{method}");
    }
}
