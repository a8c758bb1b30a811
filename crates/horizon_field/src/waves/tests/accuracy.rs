//! Tiles against the sum itself.

use super::super::resolve::over;
use super::super::transform::grid;
use super::super::{Cascade, GRID, Gerstner, PERIOD, Sea, SeaSurface, Spectrum, Waves, tick};
use super::{every_model, sea};
use crate::field::arbitrary::Random;

const TIME: f64 = 1234.5;

/// A sea of one of its tiles.
fn alone(cascade: &Cascade) -> Sea {
    Sea { cascades: vec![cascade.clone()], rest: 0.0 }
}

/// Root mean square errors of a tile: at texels and between them, as shares of the height's deviation, and of slopes at texels, as a
/// share of theirs; the worst at a texel; the least determinant.
#[derive(Debug)]
struct Errors {
    texel: f64,
    between: f64,
    slope: f64,
    worst: f64,
    least: f64,
}

fn errors(cascade: &Cascade) -> Errors {
    let sea = alone(cascade);
    let tiles = sea.tiles(TIME);
    let mut random = Random::new(5);
    let mut sum = Errors { texel: 0.0, between: 0.0, slope: 0.0, worst: 0.0, least: 1.0 };
    let count = 200;
    for _ in 0..count {
        let [x, z] = [0, 1].map(|_| random.bits() as usize % GRID);
        let at = [x, z].map(|i| (i as f64 + 0.5) * cascade.texel());
        let exact = sea.exact(at, TIME);
        let [height, sx, sz, _] = tiles.tiles[0].texel(x, z);
        sum.texel += (height - exact.height).powi(2);
        sum.slope += (sx - exact.slope[0]).powi(2) + (sz - exact.slope[1]).powi(2);
        sum.worst = sum.worst.max((height - exact.height).abs());
        sum.least = sum.least.min(exact.determinant);
        let at = at.map(|x| x + random.within(0.0, cascade.texel()));
        sum.between += (tiles.height(at) - sea.height_exact(at, TIME)).powi(2);
    }
    let [height, slope] = [cascade.height_variance(), cascade.slope_variance()].map(f64::sqrt);
    let rms = |sum: f64, of: f64| (sum / f64::from(count)).sqrt() / of;
    Errors {
        texel: rms(sum.texel, height),
        between: rms(sum.between, height),
        slope: rms(sum.slope, slope),
        worst: sum.worst / height,
        least: sum.least,
    }
}

#[test]
fn tiles_are_the_sum_of_their_waves() {
    for (name, waves) in every_model() {
        for cascade in sea(&waves).cascades.iter().filter(|cascade| !cascade.waves.is_empty()) {
            let errors = errors(cascade);
            println!("{name}, {:.1} m: {errors:.5?}", cascade.side);
            assert!(errors.texel < 0.005 && errors.worst < 0.015, "{name}: {errors:?}");
            assert!(errors.between < 0.04 && errors.slope < 0.03, "{name}: {errors:?}");
        }
    }
}

/// Waves as steep as they may be: a single train with cusps. The height holds at the very cusp; the slope, which is infinite there,
/// stays finite.
#[test]
fn cusps_are_met() {
    let waves = Waves::Gerstner(Gerstner { count: 1, steepness: 1.0, ..Gerstner::default() });
    let cascade = &sea(&waves).cascades[0];
    let errors = errors(cascade);
    println!("{errors:.5?}");
    assert!(errors.least < 0.1, "{errors:?}");
    assert!(errors.texel < 0.015 && errors.worst < 0.1, "{errors:?}");
    assert!(errors.slope.is_finite());
}

/// A grid of heights where the water is, taken for heights over the plane, is off by the displacement; and plain iteration,
/// x₀ ← x − D(x₀), by as many steps as ours, is still far off near a cusp.
#[test]
fn naive_inversions_are_far_off_where_waves_are_steep() {
    let waves = Waves::Gerstner(Gerstner { count: 2, steepness: 0.98, ..Gerstner::default() });
    let cascade = &sea(&waves).cascades[0];
    let (lagrangian, alone) = (grid(cascade, tick(TIME)), alone(cascade));
    let cell = |x: f64| x.rem_euclid(GRID as f64) as usize % GRID;
    let displaced = |k: usize, from: [f64; 2]| {
        // Nearest texels are good enough here: waves are 16 texels long.
        lagrangian[cell(from[1].round()) * GRID + cell(from[0].round())][k]
    };
    let mut worst = [0.0f64; 3];
    for i in 0..GRID {
        let (x, z) = (i, (i * 37) % GRID);
        let exact = alone.height_exact([x, z].map(|i| (i as f64 + 0.5) * cascade.texel()), TIME);
        let mut from = [x, z].map(|i| i as f64);
        for _ in 0..4 {
            let d = [1, 2].map(|k| displaced(k, from) / cascade.texel());
            from = [x as f64 - d[0], z as f64 - d[1]];
        }
        let found = [
            over(&lagrangian, cascade.texel(), f64::from(cascade.bound), x, z)[0],
            displaced(0, from),
            lagrangian[z * GRID + x][0],
        ];
        worst = core::array::from_fn(|k| worst[k].max((found[k] - exact).abs()));
    }
    let deviation = cascade.height_variance().sqrt();
    let worst = worst.map(|worst| worst / deviation);
    println!("ours {:.4}, iteration {:.4}, none {:.4}", worst[0], worst[1], worst[2]);
    assert!(worst[0] < 0.1 && worst[1] > 3.0 * worst[0] && worst[2] > 5.0 * worst[0], "{worst:?}");
}

#[test]
fn seas_come_again_in_space_and_time() {
    for (name, waves) in every_model() {
        let sea = sea(&waves);
        for cascade in &sea.cascades {
            let one = alone(cascade);
            let (now, then) = (one.tiles(17.25), one.tiles(17.25 + 3.0 * PERIOD));
            let next = |k: f64| [3.7 + k * cascade.side, -11.1 - 2.0 * k * cascade.side];
            let height = now.height(next(0.0));
            assert_eq!(height, then.height(next(0.0)), "{name}");
            assert!((height - now.height(next(1.0))).abs() <= 1e-6 * f64::from(cascade.bound), "{name}");
            let exact = one.height_exact(next(0.0), 17.25);
            let again = one.height_exact(next(5.0), 17.25 - 9.0 * PERIOD);
            assert!((exact - again).abs() <= 1e-9 * f64::from(cascade.bound).max(1e-9), "{name}: {exact} {again}");
        }
        // Half a period on it is another one.
        assert_ne!(sea.tiles(1.0).height([0.3, 0.4]), sea.tiles(1.0 + 0.5 * PERIOD).height([0.3, 0.4]), "{name}");
    }
}

/// After a year a wave still moves as in its first second. A phase of ω t, kept in single precision, would have lost all.
#[test]
fn days_cost_no_precision() {
    let year = 31_557_600.0_f64;
    let sea = sea(&Waves::breeze());
    let early = year.rem_euclid(PERIOD);
    assert_eq!(sea.tiles(year).height([5.0, 6.0]), sea.tiles(early).height([5.0, 6.0]));
    let naive = |time: f64| (2.0 * core::f32::consts::PI * time as f32).sin();
    assert!((naive(year + 0.25) - naive(0.25)).abs() > 0.1);
}

/// Values do not depend on the machine: these are all that any platform finds.
#[test]
fn values_are_the_same_everywhere() {
    let found = every_model().map(|(_, waves)| {
        let tiles = sea(&waves).tiles(77.7);
        [[0.0, 0.0], [123.4, -567.8]].map(|place| tiles.height(place).to_bits())
    });
    println!("{found:#018x?}");
    assert_eq!(found, FOUND);
}

/// Heights at two places, by model.
const FOUND: [[u64; 2]; 6] = [
    [0x3fbb_3f54_d180_0000, 0x3f78_ff5e_05d9_2c78],
    [0x3fb5_3638_7a50_0000, 0xbf95_03a0_cf70_2d1c],
    [0xbf9f_017b_2e00_0000, 0xbf34_9ff9_a3d7_02d8],
    [0xbf93_aecd_ad24_0000, 0xbf60_2aad_b2e4_fd38],
    [0xbfbe_d70f_3ca0_0000, 0x3fa8_83ed_b421_9617],
    [0xbfdb_67a4_c000_0000, 0xbff5_9d88_cab3_5bc8],
];

#[test]
fn answers_are_the_tiles() {
    let sea = std::sync::Arc::new(sea(&Waves::breeze()));
    let surface = SeaSurface::new(sea.clone());
    for time in [0.0, 4.25, 4.25, -3.0] {
        let tiles = sea.tiles(time);
        for place in [[0.0, 0.0], [1e9, -1e9], [-7.7, 3.3]] {
            assert_eq!(surface.height(place, time), tiles.height(place));
            assert_eq!(surface.normal(place, time), tiles.normal(place));
        }
    }
    assert!(std::sync::Arc::ptr_eq(&surface.tiles(9.0), &surface.tiles(9.0 + PERIOD)));
    let still = SeaSurface::new(std::sync::Arc::new(super::sea(&Waves::Still)));
    assert_eq!((still.height([1.0, 2.0], 3.0), still.normal([1.0, 2.0], 3.0)), (0.0, [0.0, 1.0, 0.0]));
}

/// Where waves fold, and where places and times are no numbers, values stay finite and within their bound.
#[test]
fn nothing_is_nan() {
    let folding = Waves::Spectrum(Spectrum { wind: 60.0, fetch: 100.0, choppiness: 2.0, ..Spectrum::default() });
    let sea = sea(&folding);
    let tiles = sea.tiles(3.0);
    let mut foam = 0.0f32;
    for (tile, cascade) in tiles.tiles.iter().zip(&sea.cascades) {
        for (texel, moments) in tile.chains().surface[0].iter().zip(&tile.chains().moments[0]) {
            assert!(texel.iter().chain(moments).all(|value| value.is_finite()));
            assert!(texel[0].abs() <= cascade.bound && (0.0..=1.0).contains(&texel[3]));
            assert!(moments.iter().all(|moment| moment.abs() <= 65_504.0));
            foam = foam.max(texel[3]);
        }
    }
    assert_eq!(foam, 1.0, "waves fold");
    for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX] {
        assert!(sea.tiles(odd).height([1.0, 1.0]).is_finite());
        assert!(tiles.height([odd, 1.0]).is_finite() && tiles.normal([1.0, odd])[1].is_finite());
    }
}
