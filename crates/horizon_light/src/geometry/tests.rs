use super::*;
use crate::medium::Medium;
use proptest::prelude::*;

const R: f64 = Medium::BRUNETON.radius;
const TOP: f64 = Medium::BRUNETON.height;

/// What a textbook writes: distance to the sphere of radius `a` by r² − a².
fn naive_distance_to_ground(a: f32, h: f32, mu: f32) -> f32 {
    let r = a + h;
    let square = r * r * (mu * mu - 1.0) + a * a;
    -r * mu - square.sqrt()
}

#[test]
fn horizons_of_earth() {
    // reference-values.md A, derived: dip in degrees and distance in km.
    for (h, dip, distance) in [(2.0, 0.04544, 5.0438), (1e3, 1.01597, 112.787), (4e5, 19.8089, 2290.85)] {
        assert!((-horizon_cosine(R, h).asin().to_degrees() / dip - 1.0).abs() < 1e-4);
        assert!((horizon_distance(R, h) / 1e3 / distance - 1.0).abs() < 1e-5);
        // Single precision keeps six digits, even from 2 m.
        assert!((-horizon_cosine(R as f32, h as f32).asin().to_degrees() / dip as f32 - 1.0).abs() < 1e-4);
        assert!((horizon_distance(R as f32, h as f32) / 1e3 / distance as f32 - 1.0).abs() < 1e-5);
    }
}

#[test]
fn distances_on_the_small_planet() {
    // reference-values.md B: from r = 1400 km to the top, 100 km and 538.51648 km, ± 1 m.
    assert!((distance_to_top(1e6, 5e5, 4e5, 1.0_f64) - 100_000.0).abs() < 1.0);
    assert!((distance_to_top(1e6, 5e5, 4e5, 0.0_f64) - 538_516.48).abs() < 1.0);
    assert!((distance_to_top(1e6, 5e5, 4e5, 0.0_f32) - 538_516.5).abs() < 1.0);
}

#[test]
fn naive_squares_fail_where_ours_hold() {
    // From a footstep's height the naive horizon is lost, from a person's it is off by 70 m in 4 650.
    let r = R as f32;
    for (h, lost) in [(0.2_f32, 0.99), (1.7, 0.01)] {
        let naive = ((r + h) * (r + h) - r * r).sqrt();
        let truth = (h as f64 * (2.0 * R + h as f64)).sqrt();
        assert!((naive as f64 / truth - 1.0).abs() > lost, "the naive horizon should fail: {naive} of {truth}");
        assert!((horizon_distance(r, h) as f64 / truth - 1.0).abs() < 1e-6);
    }
    let h = 1.7_f32;
    // Looking down by some degrees: ground some metres away.
    let (mut naive_worst, mut worst) = (0.0_f64, 0.0_f64);
    for k in 1..90 {
        let mu = -((k as f64) * 0.01).sin() as f32;
        let truth = distance_to_ground(R, h as f64, mu as f64);
        naive_worst = naive_worst.max((naive_distance_to_ground(r, h, mu) as f64 / truth - 1.0).abs());
        worst = worst.max((distance_to_ground(r, h, mu) as f64 / truth - 1.0).abs());
    }
    assert!(naive_worst > 0.1, "{naive_worst}");
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn the_horizon_to_the_last_ulp() {
    for h in [0.1_f32, 2.0, 1e3, 6e4, 4e5, 6e6, 6e8] {
        let r = R as f32;
        let (horizon, reach) = (horizon_cosine(r, h), horizon_distance(r, h));
        let mut mu = horizon;
        for _ in 0..40 {
            mu = mu.next_down();
        }
        let mut hits = Vec::new();
        for _ in 0..80 {
            hits.push(hits_ground(r, h, mu));
            let d = distance_to_ground(r, h, mu);
            // An ulp of the cosine moves the discriminant by some 1e-7 of itself: its root by 1e-3 of the distance, at
            // 40 ulps.
            assert!((d / reach - 1.0).abs() < 6e-3, "{h} {mu}: {d} of {reach}");
            if h as f64 <= TOP {
                assert!(distance_to_top(r, TOP as f32, h, mu) >= d);
            }
            mu = mu.next_up();
        }
        // Far out the cosine is near −1 and its ulps are large against the planet: what holds is that there is one
        // edge.
        assert!(hits[0] && !hits[79], "{h}");
        assert!(hits.windows(2).filter(|pair| pair[0] != pair[1]).count() <= 3, "{h}: {hits:?}");
    }
}

#[test]
fn level_and_vertical_rays_at_the_ground() {
    assert!(!hits_ground(R as f32, 0.0, 0.0));
    assert!(hits_ground(R as f32, 0.0, -1e-7) && distance_to_ground(R as f32, 0.0, -1e-7) == 0.0);
    assert!((distance_to_top(R as f32, TOP as f32, 0.0, 1.0) - TOP as f32).abs() < 0.01);
    assert_eq!(distance_to_top(R as f32, TOP as f32, TOP as f32, 1.0), 0.0);
    assert_eq!(distance_to_ground(R as f32, 1e4, -1.0), 1e4);
}

#[test]
fn cameras_outside() {
    let (r, top) = (R as f32, TOP as f32);
    assert_eq!(air_interval(r, top, 1e6, 0.1), [0.0; 2]);
    assert_eq!(air_interval(r, top, 1e6, -0.1), [0.0; 2]);
    let [near, far] = air_interval(r, top, 1e6, -1.0);
    assert!((near - 9.4e5).abs() < 1.0 && far > 1.2e7);
    // From 100 radii the planet is a degree wide: the naive discriminant has two terms of 4e17 for a difference of
    // 4e13.
    for part in [0.0, 0.3, 0.9, 0.99] {
        let mu = -(1.0 - (part / 101.0_f64).powi(2)).sqrt() as f32;
        let truth = air_interval(R, TOP, 100.0 * R, mu as f64);
        let ours = air_interval(r, top, 100.0 * r, mu);
        assert!((ours[0] as f64 - truth[0]).abs() < 4e-7 * truth[0], "{part}: {ours:?} {truth:?}");
        assert!(((ours[1] - ours[0]) as f64 / (truth[1] - truth[0]) - 1.0).abs() < 1e-4, "{part}: {ours:?} {truth:?}");
    }
}

#[test]
fn advancing_far_and_back() {
    // To the top along a level ray, where altitude and both cosines are known.
    let d = distance_to_top(R, TOP, 0.0, 0.0);
    let (h, mu) = advance(R, 0.0, 0.0, d);
    assert!((h - TOP).abs() < 1e-6 && (mu - d / (R + TOP)).abs() < 1e-14);
    let (h, _) = advance(R as f32, 0.0, 0.0, d as f32);
    assert!((h - TOP as f32).abs() < 0.05, "{h}");
    // Towards the sun the sun's cosine is the ray's own.
    assert!((advance_sun(R, 0.0, 0.0, 1.0, d, TOP) - mu).abs() < 1e-14);
    assert!(lowest_altitude(R, TOP, horizon_cosine(R, TOP)).abs() < 1e-6);
    assert_eq!(lowest_altitude(R, 5.0, 0.2), 5.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]
    #[test]
    fn single_precision_stays_finite(
        log_h in -1.0_f32..8.8,
        x in -1.0_f32..=1.0,
        ulps in -4_i32..=4,
        at_horizon: bool,
        part in 0.0_f32..=1.0,
    ) {
        let (r, top, h) = (R as f32, TOP as f32, 10.0_f32.powf(log_h));
        let mut mu = if at_horizon { horizon_cosine(r, h) } else { x };
        for _ in 0..ulps.unsigned_abs() {
            mu = if ulps > 0 { mu.next_up() } else { mu.next_down() }.clamp(-1.0, 1.0);
        }
        let [near, far] = air_interval(r, top, h, mu);
        prop_assert!(near.is_finite() && far.is_finite() && 0.0 <= near && near <= far);
        let ground = distance_to_ground(r, h, mu);
        prop_assert!(ground.is_finite() && (!hits_ground(r, h, mu) || ground >= 0.0));
        let (above, cosine) = advance(r, h, mu, near + part * (far - near));
        prop_assert!(above >= 0.0 && above.is_finite() && cosine.abs() <= 1.0);
        prop_assert!(advance_sun(r, h, x, x * mu, part * far, above).abs() <= 1.0);
        prop_assert!(lowest_altitude(r, h, mu) >= 0.0);
    }
}

#[test]
fn shaders_are_valid() {
    let shaders = [include_str!("../geometry.wgsl"), include_str!("../phase.wgsl"), include_str!("../profile.wgsl")];
    for wgsl in shaders {
        let module =
            naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
        let flags = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).unwrap();
    }
}
