//! No value and no slope of stamped ground escapes its bound.

use super::*;
use crate::field::{Bound, Fractal};
use crate::march::{Anchored, Surface};
use crate::{Compiled, Field};

fn ground() -> Compiled<2> {
    let hills = Fractal { wavelength: 900.0, amplitude: 60.0, octaves: 6.0, ..Fractal::default() };
    Field::Fractal(hills).compile(&crate::field::NoImages).expect("a valid field")
}

/// Points in a box: its corners, and some at random.
fn points(random: &mut Random, half: [f64; 2]) -> Vec<[f64; 2]> {
    let mut at = |i: u32| {
        let corner = |k: u32| f64::from(i >> k & 1) * 2.0 - 1.0;
        if i < 4 { [corner(0), corner(1)] } else { [random.within(-1.0, 1.0), random.within(-1.0, 1.0)] }
    };
    (0..24).map(|i| [0, 1].map(|k| half[k] * at(i)[k])).collect()
}

#[test]
fn nothing_escapes() {
    let (field, mut random) = (ground(), Random::new(11));
    let mut checked = 0;
    for round in 0..3000 {
        let place = Place::from_metres(PLACES[round % 4]);
        let size = random.magnitude(0.5, 60.0);
        let stamps = compiled(&some(&mut random, round % 12, &place, 3.0 * size, size));
        let surface = Anchored::stamped(&field, &stamps, &place);
        let (lowest, highest) = surface.range();
        for _ in 0..8 {
            let centre = [random.within(-5.0, 5.0) * size, random.within(-5.0, 5.0) * size];
            let extent = size * random.magnitude(1e-4, 10.0);
            let half = [extent * random.pick(&[0.0, 0.1, 1.0]), extent];
            let bound = surface.bound(centre, half);
            let Bound { v, g, rest, low, high, slope } = bound;
            let context =
                || format!("{bound:?} about {centre:?} ± {half:?} of {:?}", stamps.placed().collect::<Vec<_>>());
            assert!(rest.is_finite() && rest >= 0.0 && low <= high, "{}", context());
            for d in points(&mut random, half) {
                let q = [centre[0] + d[0], centre[1] + d[1]];
                let jet = surface.jet(q);
                let model = v + g[0] * d[0] + g[1] * d[1];
                assert!((jet.v - model).abs() <= rest, "{} is not {model}: {}", jet.v, context());
                assert!(low <= jet.v && jet.v <= high, "{}: {}", jet.v, context());
                assert!(lowest <= jet.v && jet.v <= highest, "{} in {lowest} to {highest}: {}", jet.v, context());
                for (g, [low, high]) in jet.g.into_iter().zip(slope) {
                    let pad = 1e-11 * (1.0 + low.abs() + high.abs());
                    assert!(low - pad <= g && g <= high + pad, "{g}: {}", context());
                }
                checked += 1;
            }
        }
    }
    println!("{checked} points");
}

#[test]
fn small_boxes_are_bounded_tightly() {
    // What the march lives on: the rest falls with the box, linearly in a crease, and else with the square.
    let (field, mut random) = (ground(), Random::new(12));
    let (mut linear, mut total) = (0, 0);
    for _ in 0..400 {
        let stamps = compiled(&some(&mut random, 6, &Place::ORIGIN, 30.0, 12.0));
        let surface = Anchored::stamped(&field, &stamps, &Place::ORIGIN);
        let centre = [random.within(-40.0, 40.0), random.within(-40.0, 40.0)];
        let rest = [1e-2, 1e-3, 1e-4].map(|half| surface.bound(centre, [half; 2]).rest);
        assert!(rest[0] < 2.0 && rest[2] < 0.02, "{rest:?}");
        linear += usize::from(rest[2] > 0.05 * rest[1]);
        total += 1;
    }
    println!("{linear} of {total} fall by less than 20 for 10");
    assert!(linear < total / 10);
}

#[test]
fn the_whole_world_has_one_bound() {
    let field = ground();
    let (low, high) = field.range();
    // A thousand apart from each other: they do not add up.
    let raise = |i: i32| {
        let mut stamp = level(Place::from_metres([f64::from(i) * 50.0, 0.0, 0.0]), 10.0, 5.0);
        stamp.edit.mode = Mode::Raise(f64::from(i % 9));
        stamp
    };
    let (lowest, highest) = compiled(&(0..1000).map(raise).collect::<Vec<_>>()).range((low, high));
    assert!(lowest <= low && lowest > low - 1e-3 && highest >= high + 8.0 && highest < high + 8.001, "{highest}");
}
