//! The march is itself tested: no dense sample lies under ground before its hit.

use super::fixtures::{Pillars, Plane, Waves};
use super::{Cast, Counts, Ray, RayError, Surface, Tolerance, cast};
use proptest::prelude::*;

const FAR: f64 = 30_000.0;

fn shoot(surface: &impl Surface, origin: [f64; 3], direction: [f64; 3]) -> Cast {
    let ray = Ray::new(origin, direction).unwrap();
    cast(surface, &ray, FAR, Tolerance::default(), &mut Counts::default())
}

fn above(surface: &impl Surface, p: [f64; 3]) -> f64 {
    p[1] - surface.jet([p[0], p[2]]).v
}

/// Casts a ray and checks the answer against dense samples along it.
pub(super) fn verify(surface: &impl Surface, origin: [f64; 3], direction: [f64; 3]) -> Cast {
    const SAMPLES: usize = 4000;
    let ray = Ray::new(origin, direction).unwrap();
    let answer = cast(surface, &ray, FAR, Tolerance::default(), &mut Counts::default());
    let end = match answer {
        Cast::Hit(hit) => {
            assert!(above(surface, hit.position).abs() < 1e-8, "{answer:?} is not on the ground");
            assert!(hit.t <= FAR);
            hit.t
        }
        Cast::Miss => FAR,
        Cast::Inside => {
            assert!(above(surface, origin) <= 0.0);
            return answer;
        }
    };
    for i in 0..SAMPLES {
        let t = end * i as f64 / SAMPLES as f64;
        assert!(above(surface, ray.at(t)) > -1e-9, "{answer:?}, but {ray:?} is under ground at {t}");
    }
    answer
}

/// The textbook march that the certified one replaces.
pub(super) fn fixed_step(surface: &impl Surface, origin: [f64; 3], direction: [f64; 3], step: f64, far: f64) -> bool {
    let ray = Ray::new(origin, direction).unwrap();
    (0..(far / step) as usize).any(|i| above(surface, ray.at(i as f64 * step)) <= 0.0)
}

#[test]
fn a_plane_is_hit_where_algebra_says() {
    let plane = Plane { height: 10.0, slope: [0.25, -0.5] };
    let Cast::Hit(hit) = shoot(&plane, [0.0, 100.0, 0.0], [1.0, -1.0, 2.0]) else { panic!("missed") };
    // y = 100 − s = 10 + s/4 − s, so s = 360.
    assert!((hit.t - 360.0 * 6.0f64.sqrt()).abs() < 1e-9, "{hit:?}");
    let length = (1.0f64 + 0.25 * 0.25 + 0.5 * 0.5).sqrt();
    for (n, expected) in hit.normal.into_iter().zip([-0.25, 1.0, 0.5]) {
        assert!((n - expected / length).abs() < 1e-12);
    }
}

#[test]
fn level_and_vertical_rays() {
    let flat = Plane { height: 5.0, slope: [0.0; 2] };
    assert_eq!(shoot(&flat, [0.0, 6.0, 0.0], [1.0, 0.0, 0.0]), Cast::Miss);
    assert_eq!(shoot(&flat, [0.0, 6.0, 0.0], [0.0, 1.0, 0.0]), Cast::Miss);
    assert_eq!(shoot(&flat, [0.0, 4.0, 0.0], [1.0, 0.0, 0.0]), Cast::Inside);
    assert_eq!(shoot(&flat, [0.0, 5.0, 0.0], [1.0, 0.0, 0.0]), Cast::Inside);
    let hit = shoot(&flat, [0.0, 6.0, 0.0], [0.0, -1.0, 0.0]).hit().unwrap();
    assert!((hit.t - 1.0).abs() < 1e-12);
    // Nearer than the bound's own rounding: it counts as touching, and ends.
    assert!(!matches!(shoot(&flat, [0.0, 5.0 + 1e-14, 0.0], [1.0, 0.0, 0.0]), Cast::Miss));

    let hills = Waves::hills();
    for x in [0.0, 500.0, 777.0] {
        verify(&hills, [x, 900.0, 123.0], [0.0, -1.0, 0.0]).hit().expect("straight down hits");
        for height in [50.0, 150.0, 400.0] {
            verify(&hills, [x, height, 123.0], [1.0, 0.0, 0.0]);
            verify(&hills, [x, height, 123.0], [0.0, 0.0, -1.0]);
        }
    }
}

#[test]
fn rays_along_lattice_lines_and_at_grazing_angles() {
    let hills = Waves::hills();
    // Along z = 0 and x = 1000 every octave is zero, and the curvature across is not.
    assert_eq!(verify(&hills, [0.0, 0.5, 0.0], [1.0, 0.0, 0.0]), Cast::Miss);
    assert_eq!(verify(&hills, [1000.0, 0.5, 0.0], [0.0, 0.0, 1.0]), Cast::Miss);
    assert!(matches!(verify(&hills, [0.0, 0.5, 0.0], [1.0, -1e-4, 0.0]), Cast::Hit(_)));

    // The top of a wave, seen level: over it by a little, into it by a little.
    let wave = Waves(vec![(100.0, core::f64::consts::TAU / 1000.0)]);
    for gap in [1e-3, 1e-6, 1e-8] {
        assert_eq!(verify(&wave, [0.0, 100.0 + gap, 250.0], [1.0, 0.0, 0.0]), Cast::Miss, "by {gap} m");
        assert!(matches!(verify(&wave, [0.0, 100.0 - gap, 250.0], [1.0, 0.0, 0.0]), Cast::Hit(_)), "by {gap} m");
    }
}

#[test]
fn thin_pillars_that_a_fixed_step_leaps_through() {
    let pillars = Pillars { height: 80.0, radius: 0.05, spacing: 500.0 };
    let (origin, mut leapt) = ([250.0, 40.0, 3.0], 0);
    for x in 1..9 {
        // Toward the pillar at (500 x, 500), 40 m up: the ray goes through its middle.
        let direction = [500.0 * f64::from(x) - origin[0], 0.0, 500.0 - origin[2]];
        let hit = verify(&pillars, origin, direction).hit().expect("certified");
        let distance = direction[0].hypot(direction[2]);
        assert!((hit.t - distance).abs() < 0.05, "{hit:?} at {distance}");
        leapt += u32::from(!fixed_step(&pillars, origin, direction, 1.0, FAR));
    }
    assert!(leapt >= 4, "a step of 1 m was to leap through most, and leapt through {leapt}");
}

#[test]
fn under_ground_and_out_of_reach() {
    let hills = Waves::hills();
    assert_eq!(shoot(&hills, [500.0, -700.0, 500.0], [0.0, 1.0, 0.0]), Cast::Inside);
    assert_eq!(shoot(&hills, [0.0, 1e6, 0.0], [0.0, -1.0, 0.0]), Cast::Miss);
    assert_eq!(shoot(&hills, [0.0, 700.0, 0.0], [1.0, 1e-300, 0.0]), Cast::Miss);
}

#[test]
fn odd_input_is_refused_or_ends() {
    assert!(matches!(Ray::new([f64::NAN, 0.0, 0.0], [1.0, 0.0, 0.0]), Err(RayError::Origin(_))));
    assert!(matches!(Ray::new([0.0; 3], [0.0; 3]), Err(RayError::Direction(_))));
    assert!(matches!(Ray::new([0.0; 3], [0.0, f64::INFINITY, 0.0]), Err(RayError::Direction(_))));
    let tiny = Ray::new([0.0; 3], [3e-320, 4e-320, 0.0]).unwrap().direction();
    assert!((tiny[0].hypot(tiny[1]) - 1.0).abs() < 1e-12);

    let hills = Waves::hills();
    for origin in [[1e300, 0.5, -1e300], [1e15, 100.0, 1e15], [0.0, f64::MAX, 0.0], [0.0, f64::MIN, 0.0]] {
        for direction in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [1.0, -1e-200, 1.0], [1e300, 1e300, -1e300]] {
            for (t_max, relative) in [(f64::INFINITY, 1e-3), (f64::NAN, 1e-3), (-1.0, 0.0), (1e3, f64::NAN)] {
                let ray = Ray::new(origin, direction).unwrap();
                let tolerance = Tolerance { relative, ..Tolerance::default() };
                if let Cast::Hit(hit) = cast(&hills, &ray, t_max, tolerance, &mut Counts::default()) {
                    assert!(hit.t.is_finite() && hit.normal.iter().all(|n| n.is_finite()));
                }
            }
        }
    }
}

#[test]
fn the_far_distance_cuts_nothing_before_it() {
    let hills = Waves::hills();
    let mut hits = 0;
    for i in 0..200 {
        let turn = f64::from(i) * 0.1;
        let ray = Ray::new([40.0 * f64::from(i), 420.0, 77.0], [turn.cos(), -0.03, turn.sin()]).unwrap();
        let to = |far: f64| cast(&hills, &ray, far, Tolerance::default(), &mut Counts::default()).hit();
        let Some(hit) = to(FAR) else { continue };
        hits += 1;
        for more in [1e-3, 0.3, 7.0, 60.0] {
            let again = to(hit.t + more).expect("what is hit stays hit");
            assert!((again.t - hit.t).abs() < 1e-6, "{again:?} and {hit:?}");
        }
        assert_eq!(to(hit.t - 1e-3), None);
    }
    assert!(hits > 100, "{hits}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_dense_sample_lies_under_ground_before_the_hit(
        x in -1e4..1e4f64, height in -100.0..900.0f64, z in -1e4..1e4f64,
        dx in -1.0..1.0f64, dy in -0.3..0.1f64, dz in -1.0..1.0f64,
    ) {
        verify(&Waves::hills(), [x, height, z], [dx, dy, dz]);
    }
}
