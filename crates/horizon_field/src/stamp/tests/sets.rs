//! Sets: their order, what a question touches, and what changes.

use super::*;

#[test]
fn the_order_in_which_stamps_come_is_of_no_meaning() {
    let mut random = Random::new(21);
    let mut stamps = some(&mut random, 60, &Place::ORIGIN, 30.0, 10.0);
    let one = compiled(&stamps);
    for _ in 0..5 {
        for i in 0..stamps.len() {
            let j = random.bits() as usize % stamps.len();
            stamps.swap(i, j);
        }
        let other = compiled(&stamps);
        assert!(one.placed().eq(other.placed()) && one.changes(&other).is_empty());
        for _ in 0..500 {
            let q = [random.within(-50.0, 50.0), random.within(-50.0, 50.0)];
            let [a, b] = [&one, &other].map(|set| set.at(&Place::ORIGIN).jet(q, 0.0, slope(q)));
            assert_eq!(a, b);
        }
    }
}

#[test]
fn a_higher_order_comes_later() {
    let [mut low, mut high] = [10.0, 20.0].map(|y| level(Place::from_metres([0.0, y, 0.0]), 5.0, 3.0));
    for (orders, expected) in [([0, 1], 20.0), ([1, 0], 10.0), ([-2, -1], 20.0), ([i32::MAX, i32::MIN], 10.0)] {
        [low.edit.order, high.edit.order] = orders;
        let stamps = compiled(&[low.clone(), high.clone()]);
        assert_eq!(stamps.at(&Place::ORIGIN).jet([1.0, 1.0], 0.0, slope([1.0, 1.0])).v, expected);
    }
    // Among equals, levelling comes after raising: what is level stays level.
    let mut raise = high.clone();
    (raise.edit.mode, raise.edit.order, low.edit.order) = (Mode::Raise(3.0), 0, 0);
    let stamps = compiled(&[low, raise]);
    assert_eq!(stamps.at(&Place::ORIGIN).jet([1.0, 1.0], 0.0, slope([1.0, 1.0])).v, 10.0);
}

#[test]
fn a_thousand_stamps_cost_a_question_elsewhere_nothing() {
    let mut random = Random::new(22);
    let stamps = compiled(&some(&mut random, 1000, &Place::ORIGIN, 1000.0, 8.0));
    let at = stamps.at(&Place::ORIGIN);
    for q in [[3000.0, 0.0], [0.0, -5000.0], [1e8, 1e8]] {
        assert_eq!(at.work(q), [0, 1], "the root alone");
    }
    let (mut parts, mut nodes, questions) = (0, 0, 10_000);
    for _ in 0..questions {
        let [some, looked] = at.work([random.within(-1000.0, 1000.0), random.within(-1000.0, 1000.0)]);
        parts += some;
        nodes += looked;
    }
    let (all, parts, nodes) = (stamps.ground.parts.len(), parts as f64 / 1e4, nodes as f64 / 1e4);
    println!("of {all} parts, {parts} are computed and {nodes} nodes looked at within, on average");
    assert!(parts < 0.01 * all as f64 && nodes < 120.0);
}

#[test]
fn moving_one_changes_its_own_area() {
    let mut random = Random::new(23);
    let mut stamps = some(&mut random, 300, &Place::from_metres([1e9, 0.0, 1e9]), 1000.0, 8.0);
    let before = compiled(&stamps);
    let radius = 10.0;
    let [old, new] = [[1e9 + 5.0, 1.0, 1e9], [1e9 + 90.0, 1.0, 1e9 - 7.0]].map(Place::from_metres);
    stamps.push(level(old, radius, 3.0));
    let with = compiled(&stamps);
    *stamps.last_mut().unwrap() = level(new, radius, 3.0);
    let moved = compiled(&stamps);
    assert_eq!(before.changes(&before), []);
    assert_eq!(before.changes(&with), with.changes(&before));
    let areas = with.changes(&moved);
    assert_eq!(areas.len(), 2);
    for (area, place) in areas.iter().zip([old, new]).chain(before.changes(&with).iter().zip([old])) {
        let [x, _, z] = area.place.minus(&place);
        assert!((x + 13.0).abs() < 1e-6 && (z + 13.0).abs() < 1e-6, "{area:?}");
        assert!(area.size.iter().all(|size| (size - 26.0).abs() < 1e-6) && area.narrow == 26.0);
    }
    assert!(
        areas[0].meets(&old.translated([-14.0, 50.0, 10.0]), 1.5)
            && !areas[0].meets(&old.translated([-14.0, 0.0, 0.0]), 0.5)
    );
    // Nothing outside of them is different, bit for bit.
    for _ in 0..2000 {
        let q = [random.within(-200.0, 200.0), random.within(-200.0, 200.0)];
        let point = old.translated([q[0], 0.0, q[1]]);
        let inside = areas.iter().any(|area| area.meets(&point, 0.0));
        let [a, b] = [&with, &moved].map(|set| set.at(&old).jet(q, 0.0, slope(q)));
        assert!(inside || a == b, "{q:?}");
    }
}

#[test]
fn what_keeps_trees_away_leaves_the_ground() {
    let mut stamp = level(Place::ORIGIN, 5.0, 4.0);
    stamp.edit.mode = Mode::KeepTrees;
    let stamps = compiled(&[stamp]);
    let at = stamps.at(&Place::ORIGIN);
    assert_eq!(at.jet([1.0, 1.0], 0.0, slope([1.0, 1.0])), slope([1.0, 1.0]));
    assert_eq!([at.clearing([4.0, 0.0]), at.clearing([9.5, 0.0])], [1.0, 0.0]);
    assert!((at.clearing([7.0, 0.0]) - 0.5).abs() < 1e-12);
    assert!(stamps.changes(&Stamps::default()).is_empty() && stamps.finest_wavelength().is_infinite());
}

#[test]
fn a_coarse_grid_shows_no_small_stamps() {
    let mut random = Random::new(24);
    let stamps = compiled(&some(&mut random, 100, &Place::ORIGIN, 60.0, 4.0));
    let at = stamps.at(&Place::ORIGIN);
    let count = |cutoff: f64| {
        let mut bytes = Vec::new();
        let count = at.append_bytes([0.0; 2], [100.0; 2], cutoff, &mut bytes);
        assert_eq!(bytes.len(), count[0] as usize * crate::stamp::PART_BYTES);
        count[0]
    };
    assert!(count(0.0) as usize == stamps.ground.parts.len() && count(4.0) < count(0.0) && count(500.0) == 0);
    let q = [2.0, 3.0];
    assert_eq!(at.jet(q, 500.0, slope(q)), slope(q));
}
