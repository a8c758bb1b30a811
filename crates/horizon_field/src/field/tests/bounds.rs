//! No value and no slope escapes its bound.

use crate::field::arbitrary::{Pictures, Random, every_kind, field};
use crate::field::{Bound, Compiled, Field, NoImages};
use crate::place::Place;

/// Boxes of every size, each with points inside: its corners, and some at random. Gives the number of points.
fn check<const D: usize>(field: &Field, random: &mut Random, boxes: u32) -> u32 {
    let compiled: Compiled<D> = field.compile(&Pictures).unwrap();
    let place = Place::new([random.pick(&[0, 9, 1 << 30]), 1, -3], [5.0, 6.0, 7.0]);
    let at = compiled.anchor(&place);
    let (lowest, highest) = compiled.range();
    let mut points = 0;
    for _ in 0..boxes {
        let size = random.magnitude(1e-4, 1e4);
        let centre: [f64; D] = core::array::from_fn(|_| random.within(-5e3, 5e3));
        let half: [f64; D] = core::array::from_fn(|_| size * random.pick(&[0.0, 0.1, 1.0, 1.0]));
        let bound = compiled.bound(&at, centre, half);
        let Bound { v, g, rest, low, high, slope } = bound;
        let context = || format!("{bound:?} about {centre:?} ± {half:?} of {field:?}");
        assert!(rest.is_finite() && rest >= 0.0 && low <= high, "{}", context());
        let rounding = 1e-9 * (1.0 + lowest.abs() + highest.abs());
        assert!(low >= lowest - rounding && high <= highest + rounding, "{lowest} to {highest}: {}", context());
        for point in 0..8 + (1 << D) {
            let d: [f64; D] = core::array::from_fn(|k| {
                half[k] * if point < 1 << D { f64::from(point >> k & 1) * 2.0 - 1.0 } else { random.within(-1.0, 1.0) }
            });
            let q: [f64; D] = core::array::from_fn(|k| centre[k] + d[k]);
            let jet = compiled.jet_f64(&at, q, 0.0);
            let model = v + (0..D).map(|k| g[k] * d[k]).sum::<f64>();
            assert!((jet.v - model).abs() <= rest, "{} is not {model}: {}", jet.v, context());
            assert!(jet.v >= low && jet.v <= high, "{}: {}", jet.v, context());
            for (g, [low, high]) in jet.g.into_iter().zip(slope) {
                // The slopes' own sums are rounded, too.
                let pad = 1e-11 * (1.0 + low.abs() + high.abs());
                assert!(g >= low - pad && g <= high + pad, "{g}: {}", context());
            }
            points += 1;
        }
    }
    points
}

#[test]
fn nothing_escapes_a_bound() {
    let mut random = Random::new(1);
    let mut points = 0;
    for seed in 0..6 {
        for (_, field) in every_kind(seed) {
            points += check::<2>(&field, &mut random, 12) + check::<3>(&field, &mut random, 4);
        }
    }
    // And a hundred thousand trees, each with a box of its own; a tenth of them in space, too.
    for i in 0..100_000 {
        let field = field(&mut random, 4);
        points += check::<2>(&field, &mut random, 1);
        if i % 10 == 0 {
            points += check::<3>(&field, &mut random, 1);
        }
    }
    assert!(points >= 1_000_000, "{points}");
}

#[test]
fn bounds_close_in_on_the_field() {
    for (name, field) in every_kind(2) {
        let compiled = field.compile::<2>(&NoImages).or_else(|_| field.compile::<2>(&Pictures)).unwrap();
        let at = compiled.anchor(&Place::ORIGIN);
        let mut random = Random::new(4);
        let mut widths = [0.0; 3];
        for _ in 0..50 {
            let centre = [random.within(-3e3, 3e3), random.within(-3e3, 3e3)];
            for (width, size) in widths.iter_mut().zip([1e-1, 1e-2, 1e-3]) {
                let bound = compiled.bound(&at, centre, [size; 2]);
                *width += (bound.high - bound.low) / 50.0;
            }
        }
        let (low, high) = compiled.range();
        let rounding = 1e-10 * (low.abs() + high.abs());
        assert!(
            widths[1] <= 0.15 * widths[0] + rounding && widths[2] <= 0.15 * widths[1] + rounding,
            "{name}: {widths:?}"
        );
    }
}

/// Over a box much smaller than a wavelength, the model of a smooth field is of second order.
#[test]
fn smooth_fields_have_second_order_rests() {
    let compiled = Field::default().compile::<2>(&NoImages).unwrap();
    let at = compiled.anchor(&Place::ORIGIN);
    let rest = |size: f64| {
        let mut random = Random::new(8);
        (0..100).map(|_| compiled.bound(&at, [random.within(0.0, 9e3), 3.0], [size; 2]).rest).sum::<f64>()
    };
    let ratio = rest(1e-2) / rest(1e-3);
    assert!((90.0..110.0).contains(&ratio), "{ratio}");
}
