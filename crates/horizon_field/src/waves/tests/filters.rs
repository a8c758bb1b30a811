//! Moments through filters.

use super::super::{GRID, Sea, Waves};
use super::sea;

/// The slope's variance that a square hides, along x and z together, from moments of tiles and by brute force: 40 × 40 points of the
/// sum itself. And what a filter of slopes alone would say: none.
#[test]
fn hidden_variance_is_that_of_supersampling() {
    for (name, waves) in [("breeze", Waves::breeze()), ("lake", Waves::lake())] {
        let sea = sea(&waves);
        for (cascade, levels) in sea.cascades.iter().zip([[3, 5], [4, 6], [5, 7]]) {
            let one = Sea { cascades: vec![cascade.clone()], rest: 0.0 };
            let tiles = one.tiles(8.0);
            for level in levels {
                let side = cascade.texel() * f64::from(1 << level);
                let corner = [side, 0.0];
                let points = 40;
                let (mut sum, mut squares) = ([0.0; 2], 0.0);
                for i in 0..points * points {
                    let at = [i % points, i / points].map(|i| (f64::from(i) + 0.5) / f64::from(points) * side);
                    let [x, z] = one.exact([corner[0] + at[0], corner[1] + at[1]], 8.0).slope;
                    sum = [sum[0] + x, sum[1] + z];
                    squares += x * x + z * z;
                }
                let [x, z] = sum.map(|sum| sum / f64::from(points * points));
                let brute = squares / f64::from(points * points) - x * x - z * z;
                let found = tiles.moments([corner[0] + 0.5 * side, corner[1] + 0.5 * side], side);
                let variance = found.variance[0] + found.variance[1];
                println!("{name}, {:.1} m, {side:.2} m: {variance:.6} {brute:.6}", cascade.side);
                assert!((variance / brute - 1.0).abs() < 0.08, "{name} {level}: {variance} {brute}");
                assert!((found.slope[0] - x).abs() + (found.slope[1] - z).abs() < 0.05 * brute.sqrt());
            }
        }
    }
}

/// The whole tile: nothing of the mean is left, and the variance is that of all waves.
#[test]
fn the_last_mean_hides_all() {
    let sea = sea(&Waves::breeze());
    let tiles = sea.tiles(8.0);
    for (tile, cascade) in tiles.tiles.iter().zip(&sea.cascades) {
        let chains = tile.chains();
        assert_eq!((chains.surface.len(), chains.moments.len()), (8, 8));
        let [[_, sx, sz, _], [xx, zz, _, hh]] = [chains.surface[7][0], chains.moments[7][0]].map(|t| t.map(f64::from));
        assert!(sx.abs() + sz.abs() < 1e-4);
        // Over the plane, crests are narrower than in the water's own frame, and steeper.
        let share = (xx + zz) / cascade.slope_variance();
        println!("{:.2} m: slopes {share:.3}, heights {:.3}", cascade.side, hh / cascade.height_variance());
        assert!((0.95..1.25).contains(&share), "{share}");
        assert!((hh / cascade.height_variance() - 1.0).abs() < 0.1);
    }
    let all = tiles.moments([0.0, 0.0], 1e9);
    let none = tiles.moments([0.0, 0.0], 0.0);
    assert!(none.variance.iter().all(|variance| variance.abs() < 0.3 * all.variance[0]), "{none:?}");
    assert_eq!(tiles.tiles[0].chains().surface[0].len(), GRID * GRID);
}
