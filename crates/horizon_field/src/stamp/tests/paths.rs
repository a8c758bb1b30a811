//! Paths: a road lies smooth.

use super::*;
use crate::stamp::Path;
use crate::stamp::path::straights;

/// A road that winds uphill.
fn road() -> (Vec<[f64; 3]>, Stamps) {
    let points: Vec<_> = (0..12)
        .map(|i| {
            let s = f64::from(i);
            [30.0 * s, 2.0 * s + 1.5 * (1.3 * s).sin(), 25.0 * (0.8 * s).sin()]
        })
        .collect();
    let mut stamp = level(Place::ORIGIN, 0.0, 9.0);
    stamp.edit.shape = Shape::Path(Path { points: points.clone(), width: 7.0 });
    (points.clone(), compiled(&[stamp]))
}

/// Points along the road, 1 m apart or less, and the direction across.
fn along(points: &[[f64; 3]]) -> Vec<([f64; 3], [f64; 2])> {
    let mut all = Vec::new();
    for [from, to] in straights(points, 1e-4) {
        let (x, z) = (to[0] - from[0], to[2] - from[2]);
        let length = x.hypot(z);
        all.push((from, [-z / length, x / length]));
    }
    all
}

/// Y by the plane of the nearest part alone, as a march along a polyline would have it.
fn nearest(stamps: &Stamps, q: [f64; 2]) -> f64 {
    let distance = |part: &crate::stamp::part::Part<f64>| {
        let over = part.beyond(q).1.map(|x| x.max(0.0));
        over[0].hypot(over[1])
    };
    let parts = stamps.ground.parts.iter().map(|entry| &entry.part);
    let part = parts.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
    let (at, _) = part.beyond(q);
    // The foot of the perpendicular, which does not leave the part.
    part.height
        + part.slope[0].hypot(part.slope[1])
            * at[0].clamp(-part.extent[0], part.extent[0])
            * (part.slope[0] * part.axis[0] + part.slope[1] * part.axis[1]).signum()
}

#[test]
fn it_goes_through_its_points_at_their_heights() {
    let (points, stamps) = road();
    let at = stamps.at(&Place::ORIGIN);
    let mut worst = 0.0_f64;
    for ([x, y, z], _) in along(&points) {
        let q = [x, z];
        worst = worst.max((at.jet(q, 0.0, slope(q)).v - y).abs());
    }
    println!("the road is off its curve by {worst} m at most");
    assert!(worst < 0.25);
}

#[test]
fn it_is_level_across_and_without_a_step() {
    let (points, stamps) = road();
    let at = stamps.at(&Place::ORIGIN);
    let ground = |q: [f64; 2]| at.jet(q, 0.0, Jet::constant(12.0));
    // How far the middle of a decimetre along the road is off the mean of its ends: all but nothing, unless there is a step.
    let step = |q: [f64; 2], [ax, az]: [f64; 2], value: &dyn Fn([f64; 2]) -> f64| {
        let [before, after] = [-0.05, 0.05].map(|s| value([q[0] + s * az, q[1] - s * ax]));
        (value(q) - 0.5 * (before + after)).abs()
    };
    let (mut tilt, mut ours, mut naive) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ([x, _, z], across) in along(&points) {
        for lateral in [-12.0, -8.0, -3.0, 0.0, 3.0, 8.0, 12.0] {
            let q = [x + lateral * across[0], z + lateral * across[1]];
            ours = ours.max(step(q, across, &|q| ground(q).v));
            naive = naive.max(step(q, across, &|q| nearest(&stamps, q)));
            if lateral.abs() <= 3.0 {
                let jet = ground(q);
                tilt = tilt.max((jet.g[0] * across[0] + jet.g[1] * across[1]).abs());
            }
        }
    }
    println!("across the road a slope of {tilt} at most; steps of {ours} m, of the nearest part's plane {naive} m");
    assert!(tilt < 0.05 && ours < 5e-3 && naive > 2e-2);
}

#[test]
fn a_straight_road_is_its_plane() {
    let mut stamp = level(Place::ORIGIN, 0.0, 5.0);
    let points = (0..5).map(|i| [10.0 * f64::from(i), 3.0 + f64::from(i), 5.0 * f64::from(i)]).collect();
    stamp.edit.shape = Shape::Path(Path { points, width: 6.0 });
    let stamps = compiled(&[stamp]);
    assert_eq!(stamps.ground.parts.len(), 4, "what is straight is cut nowhere else");
    for i in 0..100 {
        let s = 0.4 * f64::from(i);
        let q = [s + 1.0, 0.5 * s - 2.0];
        // Height by how far along (2, 1) / √5: a metre for √125 of it.
        let expected = 3.0 + (2.0 * q[0] + q[1]) / 5.0_f64.sqrt() / 125.0_f64.sqrt();
        assert!((stamps.at(&Place::ORIGIN).jet(q, 0.0, slope(q)).v - expected).abs() < 1e-9);
    }
}

#[test]
fn a_raised_path_is_as_high_everywhere() {
    let mut stamp = level(Place::ORIGIN, 0.0, 5.0);
    let points = (0..9).map(|i| [6.0 * f64::from(i), 50.0, 4.0 * f64::from(i).sin()]).collect();
    (stamp.edit.shape, stamp.edit.mode) = (Shape::Path(Path { points, width: 6.0 }), Mode::Raise(2.0));
    let Shape::Path(Path { points, .. }) = stamp.edit.shape.clone() else { unreachable!() };
    let stamps = compiled(&[stamp]);
    for ([x, _, z], _) in along(&points) {
        let raised = stamps.at(&Place::ORIGIN).jet([x, z], 0.0, slope([x, z])).v - slope([x, z]).v;
        assert!((raised - 2.0).abs() < 1e-12, "parts that meet do not add up: {raised}");
    }
}
