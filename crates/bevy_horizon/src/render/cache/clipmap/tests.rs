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

/// An area of 20 m, as a stamp has it.
fn area(x: f64, z: f64) -> Area {
    Area { place: Place::from_metres([x, 5.0, z]), size: [20.0; 2], narrow: 20.0 }
}

/// A clipmap that is filled and lit.
fn lit(side: u32, centre: &Place, finest: i32, coarsest: i32) -> Clipmap {
    let mut clipmap = filled(side, centre, finest, coarsest);
    while !clipmap.is_lit() {
        clipmap.work(1000, true);
    }
    clipmap
}

#[test]
fn a_stamp_refills_its_tiles_alone() {
    for centre in [Place::ORIGIN, Place::new([1 << 40, 0, -(1 << 40)], [100.25, 0.0, 7.0])] {
        let mut clipmap = lit(8, &centre, -2, 6);
        let place = centre.translated([3.0, 0.0, -41.0]);
        clipmap.invalidate_area(&Area { place, ..area(0.0, 0.0) }, [0.0; 2]);
        let work = clipmap.work(1000, true);
        for exponent in -2..=6 {
            let tiles: Vec<_> = work.fill.iter().filter(|tile| tile.exponent == exponent).collect();
            // Texels of 32 m show nothing of it; its 20 m reach over at most two tiles of 16 m more than one.
            let most = if exponent > 4 {
                0
            } else {
                ((20.0 / (64.0 * f64::from(exponent).exp2())).ceil() as usize + 1).pow(2)
            };
            assert!(tiles.len() <= most && (exponent > 4 || !tiles.is_empty()), "{exponent}: {tiles:?}");
            for tile in tiles {
                let [from_x, _, from_z] = place.minus(&place_of(*tile));
                let side = 64.0 * f64::from(exponent).exp2();
                assert!([from_x, from_z].iter().all(|from| (-20.0..side).contains(from)), "{tile:?}");
            }
        }
        assert!(work.light.iter().all(|tile| work.fill.contains(tile)), "no shadow was to change elsewhere");
        assert!(clipmap.work(1000, true).fill.is_empty() && clipmap.is_lit());
    }
}

#[test]
fn a_stamps_shadow_is_lit_again_once_its_ground_is_there() {
    let mut clipmap = lit(8, &Place::ORIGIN, 0, 0);
    clipmap.invalidate_area(&area(2.0, 2.0), [-150.0, 0.0]);
    let work = clipmap.work(1000, true);
    assert_eq!(work.fill, [Tile { exponent: 0, index: [0, 0] }]);
    let mut lit: Vec<_> = work.light.iter().map(|tile| tile.index).collect();
    lit.sort_unstable();
    assert_eq!(lit, [[-3, 0], [-2, 0], [-1, 0], [0, 0]]);
    // Of ground that is not filled yet, no light is made anew.
    clipmap.invalidate_area(&Area { size: [200.0; 2], narrow: 200.0, ..area(2.0, 2.0) }, [-150.0, 0.0]);
    let work = clipmap.work(1, true);
    assert!(work.fill.len() < 16 && work.light.iter().all(|tile| work.fill.contains(tile)), "{work:?}");
}

#[test]
fn a_stamp_beyond_the_clipmap_is_no_work() {
    let mut clipmap = lit(4, &Place::ORIGIN, 0, 3);
    clipmap.invalidate_area(&area(1e9, -1e9), [100.0, 100.0]);
    let work = clipmap.work(1000, true);
    assert!(work.fill.is_empty() && work.light.is_empty() && work.pyramid.is_empty());
}
