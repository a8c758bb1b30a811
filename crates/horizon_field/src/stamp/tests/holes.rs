//! Holes: where they are, what they leave as it is, and that they win.

use super::*;
use crate::field::Bound;
use crate::stamp::{Path, Rectangle, arbitrary};

fn hole(shape: Shape, place: Place, heading: f64) -> Placed {
    let edit = Edit { shape, mode: Mode::Hole, falloff: 50.0, order: -5 };
    Placed { place, heading, edit }
}

#[test]
fn a_hole_has_its_shape_and_no_more() {
    let (heading, mut random) = (0.7_f64, Random::new(71));
    let points = vec![[-9.0, 4.0, 0.0], [0.0, 0.0, 0.0], [9.0, -4.0, 0.0]];
    let (mut inside, mut outside) = (0, 0);
    for metres in PLACES {
        let place = Place::from_metres(metres);
        for shape in [
            Shape::Disc(Disc { radius: 3.0 }),
            Shape::Rectangle(Rectangle { size: [8.0, 4.0], corner: 1.5 }),
            Shape::Rectangle(Rectangle { size: [6.0, 2.0], corner: 0.0 }),
            Shape::Path(Path { points: points.clone(), width: 2.0 }),
        ] {
            let stamps = compiled(&[hole(shape.clone(), place, heading)]);
            let at = stamps.at(&place);
            assert!(stamps.has_holes());
            for _ in 0..2000 {
                let p = [random.within(-12.0, 12.0), random.within(-5.0, 5.0)];
                // How far outside of it p is, in the shape's own axes.
                let beyond = |half: [f64; 2], radius: f64| {
                    let over = [0, 1].map(|k| (p[k].abs() - (half[k] - radius)).max(0.0));
                    over[0].hypot(over[1]) - radius
                };
                let out = match &shape {
                    Shape::Disc(disc) => beyond([disc.radius; 2], disc.radius),
                    Shape::Rectangle(Rectangle { size, corner }) => beyond(size.map(|size| 0.5 * size), *corner),
                    Shape::Path(path) => beyond([9.0 + 0.5 * path.width, 0.5 * path.width], 0.5 * path.width),
                };
                let (sin, cos) = heading.sin_cos();
                let q = [p[0] * cos - p[1] * sin, p[0] * sin + p[1] * cos];
                if out.abs() > 1e-6 {
                    assert_eq!(at.is_hole(q, 0.0), out < 0.0, "{p:?} is {out} m outside of {shape:?}");
                    assert_eq!(at.is_hole(q.map(|x| x as f32), 0.0), out < 0.0 || (out < 1e-5 && at.is_hole(q, 0.0)));
                    *(if out < 0.0 { &mut inside } else { &mut outside }) += 1;
                }
            }
            assert!(!at.is_hole([1e8, 0.0], 0.0) && !at.is_hole([0.0, -60.0], 0.0));
        }
    }
    println!("{inside} points inside, {outside} outside");
    assert!(inside > 3000 && outside > 3000);
}

#[test]
fn heights_and_bounds_are_those_without_it() {
    let mut random = Random::new(72);
    for metres in PLACES {
        let place = Place::from_metres(metres);
        let stamps = some(&mut random, 12, &place, 30.0, 10.0);
        let holes: Vec<_> = (0..12).map(|_| arbitrary::hole(&mut random, &place, 30.0, 10.0)).collect();
        let (without, with) = (compiled(&stamps), compiled(&[stamps, holes].concat()));
        assert!(!without.has_holes() && with.has_holes());
        assert_eq!(without.range((-9.0, 9.0)), with.range((-9.0, 9.0)));
        for _ in 0..500 {
            let q = [random.within(-50.0, 50.0), random.within(-50.0, 50.0)];
            let half = [random.magnitude(1e-3, 30.0); 2];
            let Jet { v, g } = slope(q);
            let spread = 0.3 * half[0];
            let ground = Bound { v, g, rest: 0.0, low: v - spread, high: v + spread, slope: g.map(|g| [g, g]) };
            let [a, b] = [&without, &with].map(|set| set.at(&place));
            assert_eq!(a.jet(q, 0.0, slope(q)), b.jet(q, 0.0, slope(q)));
            assert_eq!(format!("{:?}", a.bound(q, half, ground)), format!("{:?}", b.bound(q, half, ground)));
            // Nothing grows where there is no ground.
            assert_eq!(b.clearing(q), if b.is_hole(q, 0.0) { 1.0 } else { 0.0 });
            assert!(!a.is_hole(q, 0.0));
        }
    }
}

#[test]
fn a_hole_wins_in_any_order() {
    let cellar = hole(Shape::Disc(Disc { radius: 2.0 }), Place::ORIGIN, 0.0);
    for (order, plate_order) in [(0, 9), (9, 0), (i32::MIN, i32::MAX), (0, 0)] {
        let mut plate = level(Place::from_metres([0.0, 40.0, 0.0]), 8.0, 3.0);
        let mut cellar = cellar.clone();
        (cellar.edit.order, plate.edit.order) = (order, plate_order);
        for stamps in [[cellar.clone(), plate.clone()], [plate, cellar]] {
            let stamps = compiled(&stamps);
            let at = stamps.at(&Place::ORIGIN);
            assert!(at.is_hole([1.0, 1.0], 0.0) && !at.is_hole([5.0, 0.0], 0.0));
            assert_eq!([[1.0, 1.0], [5.0, 0.0]].map(|q| at.jet(q, 0.0, slope(q)).v), [40.0; 2]);
        }
    }
}

#[test]
fn what_changes_is_its_own_outline() {
    let place = Place::from_metres([1e9, 0.0, -3.0]);
    let [one, other] = [2.0, 3.0].map(|radius| compiled(&[hole(Shape::Disc(Disc { radius }), place, 0.0)]));
    assert_eq!(one.changes(&one), []);
    let areas = one.changes(&other);
    // The falloff of 50 m has no part in it.
    assert_eq!(
        areas.iter().map(|area| (area.size, area.narrow)).collect::<Vec<_>>(),
        [([4.0; 2], 4.0), ([6.0; 2], 6.0)]
    );
    assert_eq!(one.changes(&Stamps::default()).len(), 1);
    // Grids are made fine enough for an edge, and those that are too coarse for it show none.
    assert_eq!(one.finest_wavelength(), 0.25);
    let at = one.at(&place);
    assert!(at.is_hole([0.0_f64; 2], 3.9) && !at.is_hole([0.0_f64; 2], 4.0));
    let count = |half: f64, cutoff: f64| at.append_bytes([0.0; 2], [half; 2], cutoff, &mut Vec::new());
    assert_eq!([count(1.0, 0.0), count(1.0, 3.9), count(1.0, 4.0)], [[0, 1], [0, 1], [0, 0]]);
    assert_eq!(at.append_bytes([60.0, 0.0], [50.0; 2], 0.0, &mut Vec::new()), [0, 0]);
}

#[test]
fn files_hold_holes() {
    let mut random = Random::new(73);
    let holes: Vec<_> = (0..20).map(|_| arbitrary::hole(&mut random, &Place::ORIGIN, 100.0, 20.0)).collect();
    let text = ron::to_string(&holes).unwrap();
    assert_eq!(ron::from_str::<Vec<Placed>>(&text).unwrap(), holes);
    let short: Placed = ron::from_str("(edit: (shape: Disc((radius: 2.5)), mode: Hole))").unwrap();
    assert!(compiled(&[short]).at(&Place::ORIGIN).is_hole([2.4, 0.0], 0.0));
    // Another stamp's number, and another stamp.
    let mut random = Random::new(74);
    let stamp = arbitrary::hole(&mut random, &Place::ORIGIN, 10.0, 20.0);
    for mode in [Mode::Flatten, Mode::KeepTrees, Mode::Raise(0.0)] {
        let other = Placed { edit: Edit { mode, ..stamp.edit.clone() }, ..stamp.clone() };
        assert!(!compiled(std::slice::from_ref(&stamp)).changes(&compiled(&[other])).is_empty());
    }
}
