use super::*;

fn filled(side: u32, centre: &Place, finest: i32, coarsest: i32) -> Clipmap {
    let mut clipmap = Clipmap::new(side, 12);
    clipmap.recentre(centre, finest, coarsest);
    while clipmap.progress().0 < clipmap.progress().1 {
        assert!(!clipmap.work(16, true).fill.is_empty(), "it must get on");
    }
    clipmap
}

#[test]
fn every_level_reaches_its_target_and_nests_in_the_next() {
    let clipmap = filled(8, &Place::from_metres([12.3, 50.0, -777.7]), -2, 6);
    let drawn = clipmap.drawn();
    assert_eq!(drawn.len(), 9);
    for pair in drawn.windows(2) {
        assert!(pair[0].outer < 2.0 * pair[1].outer);
        assert!(pair[0].outer >= 8.0 / 2.0 * 64.0 - 34.0);
    }
}

#[test]
fn a_step_of_one_tile_fills_one_strip() {
    let mut clipmap = filled(8, &Place::from_metres([1.0, 0.0, 1.0]), 0, 0);
    clipmap.recentre(&Place::from_metres([65.0, 0.0, 1.0]), 0, 0);
    assert_eq!(clipmap.work(1000, true).fill.len(), 8);
    clipmap.recentre(&Place::from_metres([65.001, 0.0, 1.0]), 0, 0);
    assert!(clipmap.work(1000, true).fill.is_empty());
}

#[test]
fn an_edit_refills_coarse_to_fine_without_a_hole() {
    let mut clipmap = filled(4, &Place::ORIGIN, 0, 3);
    clipmap.work(1000, true);
    let before = clipmap.drawn();
    clipmap.invalidate();
    let work = clipmap.work(20, true);
    assert!(work.fill[..16].iter().all(|tile| tile.exponent == 3));
    assert_eq!(clipmap.drawn(), before);
}

#[test]
fn the_far_side_of_the_world_is_as_exact_as_the_origin() {
    let near = filled(4, &Place::new([0; 3], [100.25, 0.0, 7.0]), -4, 2).drawn();
    let far = filled(4, &Place::new([1 << 40, 0, -(1 << 40)], [100.25, 0.0, 7.0]), -4, 2).drawn();
    for (near, far) in near.iter().zip(&far) {
        assert_eq!(near.fraction, far.fraction);
    }
    let tile = Tile { exponent: -4, index: [(1 << 46) + 3, -5] };
    let place = place_of(tile);
    assert_eq!(texel_of(&place, -4).0, [tile.index[0] * TILE, tile.index[1] * TILE]);
}

#[test]
fn a_pyramid_is_remade_where_a_neighbour_came() {
    let mut clipmap = filled(4, &Place::ORIGIN, 0, 0);
    clipmap.recentre(&Place::from_metres([64.0, 0.0, 0.0]), 0, 0);
    let work = clipmap.work(1000, true);
    assert_eq!(work.fill.len(), 4);
    assert_eq!(work.pyramid.len(), 8);
}
