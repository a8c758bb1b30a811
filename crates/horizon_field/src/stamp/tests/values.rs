//! Heights and gradients.

use super::*;
use crate::stamp::part::{Part, stamped};
use crate::stamp::{Path, Rectangle};

#[test]
fn a_house_stands_level_and_far_away_nothing_changes() {
    let place = Place::from_metres([1e9 + 3.0, 57.25, -1e9]);
    for shape in [
        Shape::Disc(Disc { radius: 12.0 }),
        Shape::Rectangle(Rectangle { size: [30.0, 18.0], corner: 4.0 }),
        Shape::Path(Path { points: vec![[-20.0, 0.0, 0.0], [0.0, 0.0, 3.0], [20.0, 0.0, 0.0]], width: 20.0 }),
    ] {
        let mut stamp = level(place, 0.0, 6.0);
        stamp.edit.shape = shape;
        let stamps = compiled(&[stamp]);
        let at = stamps.at(&place);
        for i in 0..20 {
            let q = [0.35 * f64::from(i) - 3.0, 3.0 - 0.2 * f64::from(i)];
            let jet = at.jet(q, 0.0, slope(q));
            assert!((jet.v - 57.25).abs() < 1e-12 && jet.g.iter().all(|g| g.abs() < 1e-12), "{jet:?} at {q:?}");
        }
        for q in [[60.0, 0.0], [0.0, -40.0], [1e7, 1e7]] {
            assert_eq!(at.jet(q, 0.0, slope(q)), slope(q));
        }
    }
}

#[test]
fn raising_and_lowering() {
    let mut stamp = level(Place::ORIGIN, 5.0, 4.0);
    for (mode, by) in [(Mode::Raise(2.5), 2.5), (Mode::Lower(7.0), -7.0), (Mode::Raise(-1.0), -1.0)] {
        stamp.edit.mode = mode;
        let stamps = compiled(&[stamp.clone()]);
        let at = |q: [f64; 2]| stamps.at(&Place::ORIGIN).jet(q, 0.0, slope(q)).v - slope(q).v;
        assert!((at([3.0, 3.0]) - by).abs() < 1e-12);
        // Halfway down the smoothstep.
        assert!((at([7.0, 0.0]) - 0.5 * by).abs() < 1e-12);
        assert_eq!(at([9.0, 0.0]), 0.0);
    }
}

#[test]
fn gradients_are_those_of_the_values() {
    let mut random = Random::new(3);
    let (mut worst, mut steep) = (0.0_f64, 0);
    for place in PLACES.map(Place::from_metres) {
        for _ in 0..400 {
            let stamps = compiled(&some(&mut random, 6, &place, 30.0, 12.0));
            let at = stamps.at(&place);
            let value = |q: [f64; 2]| at.jet(q, 0.0, slope(q)).v;
            for _ in 0..20 {
                let q = [random.within(-40.0, 40.0), random.within(-40.0, 40.0)];
                let jet = at.jet(q, 0.0, slope(q));
                let h = 1e-5;
                let one = |s: f64| [(value([q[0] + s, q[1]]) - jet.v) / s, (value([q[0], q[1] + s]) - jet.v) / s];
                let (before, after) = (one(-h), one(h));
                for k in 0..2 {
                    // In a crease, where the nearest part of a path changes, it is the slope of one side.
                    let off = (jet.g[k] - 0.5 * (before[k] + after[k])).abs();
                    let off = off.min((jet.g[k] - before[k]).abs()).min((jet.g[k] - after[k]).abs());
                    worst = worst.max(off / (1.0 + jet.g[k].abs()));
                    steep += usize::from((jet.g[k] - slope(q).g[k]).abs() > 0.1);
                }
            }
        }
    }
    println!("gradients are off the differences by {worst:e} at most; {steep} of them are not the slope's");
    assert!(worst < 2e-4 && steep > 10_000);
}

#[test]
fn what_is_indexed_is_what_all_stamps_make() {
    let mut random = Random::new(4);
    for place in PLACES.map(Place::from_metres) {
        let stamps = compiled(&some(&mut random, 200, &place, 500.0, 15.0));
        let at = stamps.at(&place);
        let all = |q: [f64; 2]| {
            let entries = &stamps.ground.parts;
            let near = entries.iter().enumerate().map(|(i, entry)| {
                let [x, _, z] = entry.place.minus(&place);
                Part {
                    centre: [x + entry.part.centre[0], z + entry.part.centre[1]],
                    last: entries.get(i + 1).is_none_or(|next| next.stamp != entry.stamp),
                    ..entry.part
                }
            });
            stamped(near, q, slope(q))
        };
        for _ in 0..3000 {
            let q = [random.within(-600.0, 600.0), random.within(-600.0, 600.0)];
            assert_eq!(at.jet(q, 0.0, slope(q)), all(q), "at {q:?} of {place:?}");
        }
    }
}

#[test]
fn a_billion_metres_away_it_is_the_same_and_absolute_f32_is_not() {
    let mut random = Random::new(5);
    let near = some(&mut random, 40, &Place::ORIGIN, 100.0, 10.0);
    // 10⁹ m, and a cell's edge between the stamps.
    let away = Place { cell: [244_140, 0, -244_141], offset: [4090.0, 0.0, 3.0] };
    let moved = |placed: &Placed| {
        let [x, y, z] = placed.place.minus(&Place::ORIGIN);
        Placed { place: away.translated([x, y, z]), ..placed.clone() }
    };
    let (here, there) = (compiled(&near), compiled(&near.iter().map(moved).collect::<Vec<_>>()));
    let (mut apart, mut naive) = (0.0_f64, 0.0_f64);
    for _ in 0..2000 {
        let q = [random.within(-120.0, 120.0), random.within(-120.0, 120.0)];
        let height = here.at(&Place::ORIGIN).jet(q, 0.0, slope(q)).v;
        // The same places, anchored somewhere else nearby.
        let other = away.translated([-9.0, 0.0, 4.0]);
        apart = apart.max((there.at(&away).jet(q, 0.0, slope(q)).v - height).abs());
        apart = apart.max((there.at(&other).jet([q[0] + 9.0, q[1] - 4.0], 0.0, slope(q)).v - height).abs());
        let rounded = q.map(|x| f64::from((1e9 + x) as f32) - 1e9);
        naive = naive.max((here.at(&Place::ORIGIN).jet(rounded, 0.0, slope(q)).v - height).abs());
    }
    println!("apart by {apart:e} m; with coordinates in f32 by {naive} m");
    assert!(apart < 1e-9 && naive > 1.0);
}

#[test]
fn single_precision_follows() {
    let mut random = Random::new(6);
    let mut worst = 0.0_f64;
    for place in PLACES.map(Place::from_metres) {
        let stamps = compiled(&some(&mut random, 100, &place, 60.0, 8.0));
        let at = stamps.at(&place);
        for _ in 0..2000 {
            let q = [random.within(0.0, 64.0) as f32, random.within(0.0, 64.0) as f32];
            let exact = at.jet(q.map(f64::from), 0.0, slope(q.map(f64::from)));
            let base = slope(q.map(f64::from));
            let single = at.jet(q, 0.0_f32, Jet { v: base.v as f32, g: base.g.map(|g| g as f32) });
            worst = worst.max((f64::from(single.v) - exact.v).abs());
        }
    }
    println!("f32 is off by {worst:e} m at most");
    assert!(worst < 1e-3);
}
