//! Caustics and foam.

use proptest::prelude::*;

use crate::water::caustics::*;
use crate::water::foam::*;

const N: f64 = 1.333;

/// Height, slope and curvature of a wave along x, of unit length and this amplitude.
fn wave(x: f64, amplitude: f64) -> [f64; 3] {
    let k = core::f64::consts::TAU;
    [amplitude * libm::cos(k * x), -amplitude * k * libm::sin(k * x), -amplitude * k * k * libm::cos(k * x)]
}

/// Where light from straight above meets the bed: Snell's law itself.
fn lands(x: f64, amplitude: f64, depth: f64) -> f64 {
    let [height, slope, _] = wave(x, amplitude);
    let above = libm::atan(slope);
    let below = libm::asin(libm::sin(above) / N);
    x + (depth + height) * libm::tan(above - below)
}

#[test]
fn light_is_gathered_as_traced() {
    let (amplitude, depth) = (0.002, 1.0);
    for i in 0..200 {
        let x = f64::from(i) / 200.0;
        let width = 1e-5;
        let traced = 2.0 * width / (lands(x + width, amplitude, depth) - lands(x - width, amplitude, depth));
        let ours = focus([wave(x, amplitude)[2], 0.0, 0.0], depth, N, 1e6);
        assert!((ours / traced - 1.0).abs() < 2e-3, "{x}: {ours}, traced {traced}");
    }
    assert!(focus([wave(0.0, amplitude)[2], 0.0, 0.0], depth, N, 1e6) > 1.01, "crests gather");
}

/// Near the surface waves move light about, and make none; nor does a pattern's mean stray far as it sharpens.
#[test]
fn the_mean_is_one_in_shallow_water() {
    let mean = |depth: f64| {
        (0..1000).map(|i| focus([wave(f64::from(i) / 1000.0, 0.01)[2], 0.0, 0.0], depth, N, BRIGHTEST)).sum::<f64>()
            / 1000.0
    };
    for depth in [0.0, 0.05, 0.1, 0.5] {
        // k·d·|H| squared, over 2.
        let order = 0.2498 * depth * 0.3948;
        assert!((mean(depth) - 1.0).abs() < 1e-3 + 0.6 * order * order, "{depth}: {}", mean(depth));
    }
}

#[test]
fn a_focus_is_bounded() {
    let [k, depth] = [1.0 - 1.0 / N, 4.0];
    let h = -1.0 / (k * depth);
    assert!(1.0 / (1.0 + k * depth * h).abs() > 1e12, "naive");
    let brightest = focus([h, 0.0, 0.0], depth, N, BRIGHTEST);
    assert!((brightest / BRIGHTEST - 1.0).abs() < 6e-3, "{brightest}");
    assert_eq!(focus([0.0; 3], 7.0, N, BRIGHTEST), 1.0);
}

#[test]
fn foam_is_white_where_it_covers() {
    assert_eq!(covered([0.1, 0.2, 0.3], [1.0; 3], 0.55, 0.0), [0.1, 0.2, 0.3]);
    let white = covered([0.1_f64, 0.2, 0.3], [2.0; 3], 0.55, 1.0);
    assert!(white.iter().all(|l| (l * core::f64::consts::PI - 1.1).abs() < 1e-12));
    // Monahan and O'Muircheartaigh 1980: 1 % at 10 m/s, 4 % at 15.
    assert!((whitecaps(10.0) - 0.0099).abs() < 2e-4 && (whitecaps(15.0) - 0.0393).abs() < 2e-3);
    assert_eq!((whitecaps(-1.0), whitecaps(1e3)), (0.0, 1.0));
}

proptest! {
    #[test]
    fn nothing_is_nan(
        hessian in prop::array::uniform3(prop::num::f32::NORMAL),
        depth in prop::sample::select(vec![-1.0_f32, 0.0, 0.1, 10.0, 1e4, f32::MAX]),
        index in 1.0_f32..1.6,
        bound in 1.0_f32..1e3,
        coverage in -1.0_f32..2.0,
    ) {
        let factor = focus(hessian, depth, index, bound);
        prop_assert!(factor >= 0.0 && factor <= 1.5 * bound, "{factor}");
        let foam = covered([1.0; 3], [3.0; 3], 0.55, coverage);
        prop_assert!(foam.iter().all(|l| (0.5..1.01).contains(l)), "{foam:?}");
    }
}
