//! Range, bounds, and what a layer looks like.

use crate::clouds::volume::{MIPS, SPREAD, TEXELS, raw};
use crate::clouds::{Cloud, CloudLayer, CloudModel, CloudPoint, CloudVolume, Weather};
use crate::reference::random::Random;
use horizon_field::{CELL, Place};
use std::sync::LazyLock;

pub static VOLUME: LazyLock<CloudVolume> = LazyLock::new(CloudVolume::new);

pub const MODELS: [CloudModel; 3] = [CloudModel::Sheet, CloudModel::Slab, CloudModel::Billow];

fn place(random: &mut Random) -> [f64; 3] {
    [(); 3].map(|()| random.uniform())
}

#[test]
fn the_noise_is_spread_by_its_statistics() {
    let mut random = Random::new(7, 0);
    let n = 40_000;
    let mut sums = [[0.0; 2]; 3];
    let mut naive = [f64::INFINITY, f64::NEG_INFINITY];
    for _ in 0..n {
        let raw = raw(place(&mut random));
        for k in 0..3 {
            assert!((0.0..=1.0).contains(&raw[k]), "{raw:?}");
            sums[k][0] += raw[k];
            sums[k][1] += raw[k] * raw[k];
        }
        // Schneider's remap as printed, of the same two noises.
        let printed = (raw[1] - raw[2]) / (1.0 - raw[2]);
        naive = [naive[0].min(printed), naive[1].max(printed)];
    }
    assert!(naive[0] < -5.0, "the printed remap should leave its range: {naive:?}");
    for k in 0..3 {
        let mean = sums[k][0] / f64::from(n);
        let deviation = (sums[k][1] / f64::from(n) - mean * mean).sqrt();
        for (sign, ours) in [-1.0, 1.0].into_iter().zip(SPREAD[k]) {
            let end = mean + sign * 5.0_f64.sqrt() * deviation;
            assert!((end - ours).abs() < 0.01, "channel {k}: {end:.3}, not {ours}");
        }
    }
}

#[test]
fn thresholds_leave_their_part() {
    for channel in 0..3 {
        for coverage in [0.1, 0.25, 0.5, 0.75, 0.9] {
            let above =
                VOLUME.mips[0].iter().filter(|texel| f64::from(texel[channel]) > 255.0 * (1.0 - coverage)).count();
            let part = above as f64 / (TEXELS * TEXELS * TEXELS) as f64;
            assert!((part - coverage).abs() < 0.06, "channel {channel}: {part} for {coverage}");
        }
    }
}

#[test]
fn the_volume_repeats_without_a_seam() {
    // Across the seam neighbours differ no more than anywhere else.
    let step = |x: usize, channel: usize| {
        let mut most = 0;
        for i in 0..TEXELS * TEXELS {
            let row = i * TEXELS;
            let [a, b] = [row + x, row + (x + 1) % TEXELS].map(|i| VOLUME.mips[0][i][channel]);
            most = most.max(a.abs_diff(b));
        }
        most
    };
    for channel in 0..3 {
        let inside = (0..TEXELS - 1).map(|x| step(x, channel)).max();
        assert!(Some(step(TEXELS - 1, channel)) <= inside, "channel {channel}");
    }
    let (a, b) = (VOLUME.sample([0.25_f64, 0.5, 0.999]), VOLUME.sample([-4.75, 2.5, -0.001]));
    assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-12), "{a:?} {b:?}");
}

fn anywhere(random: &mut Random, layer: &CloudLayer) -> CloudPoint<f32> {
    let thickness = layer.top - layer.base;
    let altitude = layer.base + thickness * (1.2 * random.uniform() as f32 - 0.1);
    let at = [0, 1, 2].map(|k| if k == 1 { altitude } else { (random.uniform() as f32 - 0.5) * 4e4 });
    CloudPoint { at, up: [0.0, 1.0, 0.0], altitude }
}

#[test]
fn density_is_a_part_and_blocks_bound_it() {
    let mut random = Random::new(11, 0);
    for model in MODELS {
        for case in 0..60 {
            let u = |random: &mut Random, low: f64, high: f64| (low + (high - low) * random.uniform()) as f32;
            let layer = CloudLayer {
                model,
                coverage: if case % 5 == 0 { (case / 5 % 2) as f32 } else { u(&mut random, 0.0, 1.0) },
                kind: u(&mut random, 0.0, 1.0),
                softness: u(&mut random, 0.01, 1.0),
                erosion: u(&mut random, 0.0, 0.95),
                size: u(&mut random, 100.0, 2e4),
                ..CloudLayer::CUMULUS
            };
            assert_eq!(layer.check(), Ok(()));
            let cloud = Cloud::<f32>::new(&layer, &Place::ORIGIN, 1e5);
            let mut met = 0;
            for _ in 0..400 {
                let point = anywhere(&mut random, &layer);
                let density = cloud.density(&VOLUME, &point, &cloud.weather);
                assert!((0.0..=1.0).contains(&density), "{layer:?}: {density}");
                met += usize::from(density > 0.0);
                let height = cloud.height(point.altitude);
                for mip in 1..MIPS {
                    let block = Cloud::block(cloud.shape_at(&point), mip);
                    let most = cloud.most(&VOLUME, block, mip, height - 0.01, height + 0.01, &cloud.weather);
                    assert!(density <= most + 1e-6, "{layer:?}, mip {mip}: {density} above {most}");
                }
            }
            assert!(layer.coverage < 1.0 || layer.erosion > 0.5 || met > 60, "{layer:?}: {met}");
            assert!(layer.coverage > 0.0 || met == 0, "{layer:?}: {met}");
        }
    }
}

/// Without the border that interpolation reaches into, a mip's texel is no bound.
#[test]
fn maxima_without_a_border_do_not_bound() {
    let mut random = Random::new(5, 0);
    let (mut broken, blocks) = (0, (TEXELS / 2) as f64);
    for _ in 0..20_000 {
        let u = place(&mut random);
        let value = VOLUME.sample(u)[0];
        let block = u.map(|u| (u * blocks) as usize);
        let naive = (0..8)
            .map(|c| {
                let [x, y, z] = [0, 1, 2].map(|k| 2 * block[k] + (c >> k & 1));
                VOLUME.mips[0][(z * TEXELS + y) * TEXELS + x][0]
            })
            .max();
        broken += usize::from(value > f64::from(naive.unwrap_or(0)) / 255.0 + 1e-9);
        let ours: f64 = VOLUME.most(block.map(|i| i as i64), 1)[0];
        assert!(value <= ours + 1e-12);
    }
    assert!(broken > 1_000, "{broken}");
}

#[test]
fn neither_place_nor_time_costs_digits() {
    let layer = CloudLayer::CUMULUS;
    let near = Cloud::<f32>::new(&layer, &Place::ORIGIN, 0.0);
    // A place that lies whole periods away: 2^30 · 5000 m, which are 2^33 · 625 / 4096 cells.
    let cells = (1_i64 << 30) * 5_000 / CELL as i64;
    let far = Cloud::<f32>::new(&layer, &Place { cell: [cells, 0, -cells], offset: [0.0; 3] }, 0.0);
    assert_eq!(near.offset, far.offset);
    // A year of wind is as fine as a second of it: a step of a minute moves shapes by as much.
    let year = 3.156e7;
    let [a, b] = [year, year + 60.0].map(|t| Cloud::<f64>::new(&layer, &Place::ORIGIN, t).offset[0]);
    let step = (a - b).rem_euclid(1.0) * f64::from(layer.size);
    assert!((step - 480.0).abs() < 1e-3, "{step}");
    for seconds in [0.0, -5.0, 1e12] {
        let cloud = Cloud::<f32>::new(&layer, &Place { cell: [i64::MIN, i64::MAX, 7], offset: [4095.9; 3] }, seconds);
        assert!(cloud.offset.iter().chain(&cloud.detail_offset).all(|x| (0.0..=1.0).contains(x)), "{cloud:?}");
    }
}

#[test]
fn single_precision_follows_double() {
    let mut random = Random::new(3, 0);
    for model in MODELS {
        let layer = CloudLayer { model, ..CloudLayer::CUMULUS };
        let (single, double) =
            (Cloud::<f32>::new(&layer, &Place::ORIGIN, 9.0), Cloud::<f64>::new(&layer, &Place::ORIGIN, 9.0));
        for _ in 0..4_000 {
            let point = anywhere(&mut random, &layer);
            let wide =
                CloudPoint { at: point.at.map(f64::from), up: [0.0, 1.0, 0.0], altitude: f64::from(point.altitude) };
            let ours = f64::from(single.density(&VOLUME, &point, &single.weather));
            let truth = double.density(&VOLUME, &wide, &double.weather);
            // At the faces a density can jump.
            let face = [0.0, 1.0].iter().any(|face| (double.height(wide.altitude) - face).abs() < 1e-5);
            assert!(face || (ours - truth).abs() < 2e-3, "{model:?}: {ours} {truth}");
        }
    }
}

#[test]
fn kinds_reach_as_high_as_they_say() {
    let cloud = Cloud::<f64>::new(&CloudLayer::CUMULUS, &Place::ORIGIN, 0.0);
    let at = |height: f64, kind: f64| cloud.base_density([1.0; 3], height, height, &Weather { coverage: 1.0, kind });
    assert!(at(0.1, 0.0) > 0.9 && at(0.31, 0.0) == 0.0);
    assert!(at(0.31, 1.0) > 0.9 && at(0.9, 1.0) > 0.0 && at(1.0, 1.0) == 0.0);
    assert_eq!(at(0.0, 1.0), 0.0);
}
