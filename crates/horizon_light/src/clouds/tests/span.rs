//! Entry and exit: in, on, above and below a layer, level rays, and where the textbook's squares fail.

use crate::clouds::span::{FARTHEST, spans};
use proptest::prelude::*;

const R: f64 = 6_360_000.0;

#[test]
fn plane_layers_from_everywhere() {
    let of = |h: f64, mu: f64| spans(0.0, 1_000.0, 2_000.0, h, mu)[0];
    assert_eq!(of(0.0, 1.0), [1_000.0, 2_000.0]);
    assert_eq!(of(0.0, 0.5), [2_000.0, 4_000.0]);
    assert_eq!(of(1_500.0, 1.0), [0.0, 500.0]);
    assert_eq!(of(1_500.0, -0.5), [0.0, 1_000.0]);
    assert_eq!(of(3_000.0, -1.0), [1_000.0, 2_000.0]);
    for outside in [(0.0, 0.0), (0.0, -0.3), (3_000.0, 0.0), (3_000.0, 0.3)] {
        assert_eq!(of(outside.0, outside.1), [0.0; 2]);
    }
    // Level rays, in the layer and on its faces.
    for h in [1_000.0, 1_500.0, 2_000.0] {
        assert_eq!(of(h, 0.0), [0.0, FARTHEST]);
    }
    // On a face: into the layer, or out of it.
    assert_eq!(of(1_000.0, 1.0), [0.0, 1_000.0]);
    assert_eq!(of(1_000.0, -1.0), [0.0; 2]);
    assert_eq!(of(2_000.0, -1.0), [0.0, 1_000.0]);
    // The seed's formula divides by zero: on a face it is not a number.
    let (h, mu) = (1_000.0_f32, 0.0_f32);
    assert!(((1_000.0 - h) / mu).is_nan());
}

#[test]
fn shells_from_everywhere() {
    let of = |h: f64, mu: f64| spans(R, 1_000.0, 2_000.0, h, mu);
    let close = |ours: [f64; 2], truth: [f64; 2]| {
        assert!((0..2).all(|k| (ours[k] - truth[k]).abs() < 1e-6 * truth[k].max(1.0)), "{ours:?} {truth:?}")
    };
    close(of(0.0, 1.0)[0], [1_000.0, 2_000.0]);
    close(of(1_500.0, -1.0)[0], [0.0, 500.0]);
    // Straight down through the planet the layer comes again.
    close(of(1_500.0, -1.0)[1], [2_500.0 + 2.0 * R, 3_500.0 + 2.0 * R]);
    close(of(3_000.0, -1.0)[0], [1_000.0, 2_000.0]);
    assert_eq!(of(3_000.0, 0.0), [[0.0; 2]; 2]);
    // A level ray from the ground, from inside, and one from inside that dips below the base.
    close(of(0.0, 0.0)[0], [(1_000.0 * (2.0 * R + 1_000.0)).sqrt(), (2_000.0 * (2.0 * R + 2_000.0)).sqrt()]);
    close(of(1_000.0, 0.0)[0], [0.0, (1_000.0 * (2.0 * R + 3_000.0)).sqrt()]);
    let [first, second] = of(1_010.0, -0.01);
    assert!(first[0] == 0.0 && first[1] < 1_100.0 && second[0] > 1e5 && second[1] > second[0]);
}

/// r² − a² in single precision: a camera a little under the base does not find it.
#[test]
fn naive_squares_fail_where_ours_hold() {
    let (radius, base) = (R as f32, 1_000.0_f32);
    let (mut naive_worst, mut worst) = (0.0_f64, 0.0_f64);
    for k in 1..60 {
        let (h, mu) = (990.0 + 0.13 * k as f32, 0.02 * k as f32);
        let truth = spans(R, base as f64, 2_000.0, h as f64, mu as f64)[0][0];
        let r = radius + h;
        let a = radius + base;
        let naive = -r * mu + (r * r * (mu * mu - 1.0) + a * a).sqrt();
        naive_worst = naive_worst.max((f64::from(naive) - truth).abs() / truth);
        worst = worst.max((f64::from(spans(radius, base, 2_000.0, h, mu)[0][0]) - truth).abs() / truth);
    }
    assert!(naive_worst.is_nan() || naive_worst > 0.01, "{naive_worst}");
    assert!(worst < 1e-5, "{worst}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]
    #[test]
    fn spans_are_finite_and_in_order(
        planet: bool,
        base in 0.0_f32..1e5,
        log_thickness in 0.0_f32..5.0,
        place in -1_i32..=4,
        part in 0.0_f32..1.0,
        mu in prop_oneof![Just(0.0_f32), Just(-1.0), Just(1.0), -1.0_f32..1.0, -1e-6_f32..1e-6, Just(1e-40)],
    ) {
        let top = base + 10.0_f32.powf(log_thickness);
        let h = match place {
            -1 => base * part,
            0 => base,
            1 => base + (top - base) * part,
            2 => top,
            3 => top + 1e5 * part,
            _ => 1e8,
        };
        let radius = if planet { R as f32 } else { 0.0 };
        let [first, second] = spans(radius, base, top, h, mu);
        for [near, far] in [first, second] {
            prop_assert!(near >= 0.0 && far >= near && far.is_finite(), "{first:?} {second:?}");
        }
        prop_assert!(second[1] == 0.0 || second[0] >= first[1], "{first:?} {second:?}");
    }
}
