//! Models of waves: how far the slope's variance that a footprint hides, as tiles keep it, is off brute supersampling of the sum of
//! all waves, and what either takes, over the footprint; and what tiles take on the device.

mod device;
mod variance;

use std::hint::black_box;
use std::time::Instant;

use horizon_field::waves::{FbmWaves, GRID, Gerstner, Sea, Sines, Waves};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::march::OURS;
use crate::measure::samples::{mean, median};
use crate::plot::{Axis, Dot, Group, Lines, Panel, Scatter, Series};
use crate::readme::short;
use crate::store::{Row, Table, of_one_run};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Water;

const TABLE: &str = "water";
const DEVICE: &str = "water_gpu";
/// The rival: the sum of all waves at some points of each square.
const DIRECT: &str = "direct sum";
/// How many points the rival takes along each side of a square.
const SIDES: [u32; 4] = [2, 4, 8, 16];
/// The truth takes more, elsewhere.
const TRUTH: u32 = 40;
/// Squares of an area: those of a picture of 128 × 128 pixels.
const SQUARES: f64 = (GRID * GRID) as f64;
/// How many times the tiles are made, to tell how long it takes.
const TILES: usize = 9;

/// The models, by default and as presets.
fn models() -> [(&'static str, Waves); 6] {
    [
        ("sines", Waves::Sines(Sines::default())),
        ("gerstner", Waves::Gerstner(Gerstner::default())),
        ("fbm", Waves::Fbm(FbmWaves::default())),
        ("lake", Waves::lake()),
        ("breeze", Waves::breeze()),
        ("gale", Waves::gale()),
    ]
}

/// The slope's variance that squares of one size hide, of a model by a method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaterRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The model.
    pub model: String,
    /// The method; [`OURS`], or the rival.
    pub method: String,
    /// Points along each side of a square; 0 for ours, which has none.
    pub side: u32,
    /// The square's side, in metres.
    pub footprint: f64,
    /// The time of 128 × 128 squares that lie side by side, on one core, in milliseconds; ours with the making of its tiles.
    pub ms: f64,
    /// The variance that is hidden, of slopes along x and z together: the mean over squares.
    pub truth: f64,
    /// What the method has for it.
    pub found: f64,
    /// How far a square is off, as a share of the truth: the root of the mean square.
    pub error: f64,
}

impl Row for WaterRow {
    type Key = (String, String, u32, String);

    fn key(&self) -> Self::Key {
        (self.model.clone(), self.method.clone(), self.side, self.footprint.to_string())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// What the tiles of a model take.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TilesRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The model.
    pub model: String,
    /// How many waves it is of.
    pub waves: u64,
    /// All tiles at all sizes on one core, in milliseconds.
    pub cpu_ms: f64,
    /// The passes that fill them on the device, in milliseconds.
    pub gpu_ms: f64,
}

impl Row for TilesRow {
    type Key = String;

    fn key(&self) -> String {
        self.model.clone()
    }

    fn run(&self) -> u64 {
        self.run
    }
}

fn ms(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// The time of all tiles at all sizes, on one core.
fn tiles_ms(sea: &Sea) -> f64 {
    let one = || {
        let start = Instant::now();
        black_box(variance::tiles(sea));
        ms(start)
    };
    median((0..TILES).map(|_| one()))
}

/// Measures a model's rows: over footprints, ours and the rival against the truth.
fn measure(ctx: &Context, model: &str, sea: &Sea, table: &mut Table<WaterRow>) -> Result<(), ChartsError> {
    let tiles_ms = tiles_ms(sea);
    let tiles = variance::tiles(sea);
    let middles = variance::middles(ctx.pick(3, 16));
    for footprint in variance::footprints(sea) {
        let truths: Vec<f64> =
            middles.iter().map(|middle| variance::direct(sea, *middle, footprint, ctx.pick(16, TRUTH), 0)).collect();
        let truth = mean(&truths);
        for side in [0].into_iter().chain(SIDES) {
            let start = Instant::now();
            let found: Vec<f64> = middles
                .iter()
                .map(|middle| match side {
                    0 => variance::filtered(&tiles, *middle, footprint),
                    _ => variance::direct(sea, *middle, footprint, side, side),
                })
                .collect();
            let squares_ms = ms(start) * SQUARES / middles.len() as f64;
            let off = found.iter().zip(&truths).map(|(found, truth)| (found - truth).powi(2));
            let method = if side == 0 { OURS } else { DIRECT };
            table.push(WaterRow {
                run: ctx.run,
                model: model.to_owned(),
                method: method.to_owned(),
                side,
                footprint,
                ms: squares_ms + if side == 0 { tiles_ms } else { 0.0 },
                truth,
                found: mean(&found),
                error: mean(&off.collect::<Vec<_>>()).sqrt() / truth,
            })?;
        }
    }
    Ok(())
}

impl Experiment for Water {
    fn name(&self) -> &'static str {
        TABLE
    }

    fn about(&self) -> &'static str {
        "the slope's variance that a footprint hides, of each model of waves, and the time of tiles"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE, DEVICE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<WaterRow>(TABLE)?;
        let mut fills = ctx.table::<TilesRow>(DEVICE)?;
        let progress = ctx.progress(self.name(), models().len());
        for (model, waves) in models() {
            let sea = Sea::new(&waves)?;
            if !fills.has(&model.to_owned()) {
                let count = sea.cascades.iter().map(|cascade| cascade.waves.len() as u64).sum();
                let (cpu_ms, gpu_ms) = (tiles_ms(&sea), device::fill_ms(ctx, &waves));
                fills.push(TilesRow { run: ctx.run, model: model.to_owned(), waves: count, cpu_ms, gpu_ms })?;
            }
            let keys: Vec<_> = variance::footprints(&sea)
                .iter()
                .flat_map(|footprint| {
                    let key = |method: &str, side| (model.to_owned(), method.to_owned(), side, footprint.to_string());
                    [key(OURS, 0)].into_iter().chain(SIDES.map(|side| key(DIRECT, side)))
                })
                .collect();
            if !table.has_together(&keys) {
                measure(ctx, model, &sea, &mut table)?;
            }
            progress.done(model);
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ctx.rows::<WaterRow>(TABLE)?;
        let sums = sums(&rows);
        Ok(vec![NamedChart::new("water_footprint", over_footprints(&rows)), NamedChart::new("water", plane(&sums))])
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<WaterRow>(TABLE)?;
        let fills = ctx.rows::<TilesRow>(DEVICE)?;
        let sums = sums(&rows);
        let compared: Map<_, _> = models()
            .iter()
            .filter_map(|(model, _)| Some(((*model).to_owned(), json!(speedup_at_equal_error(&sums, model)?))))
            .collect();
        let found = json!({
            "by_model": compared,
            "error_percent": sums.iter().filter(|sum| sum.method == OURS).map(|sum| 100.0 * sum.error).reduce(f64::max),
            "tiles_cpu_ms": median(fills.iter().map(|row| row.cpu_ms)),
            "tiles_gpu_ms": median(fills.iter().map(|row| row.gpu_ms)),
        });
        let entries = [
            ("water", json!(sums)),
            ("water_compared", found),
            ("water_by_footprint", json!(rows)),
            ("water_gpu", json!(fills)),
        ];
        Ok(entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// A model by a method, over all footprints.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Sum {
    model: String,
    method: String,
    side: u32,
    /// The mean of the times.
    ms: f64,
    /// Always 0: a square of the sea always has a variance, so that none can be missed. It is there as other methods' tables have it.
    missed: u64,
    /// How far squares are off, summed over the footprints, as a share of what is hidden, summed as well.
    error: f64,
}

fn sums(rows: &[WaterRow]) -> Vec<Sum> {
    let mut sums = Vec::new();
    for (model, _) in models() {
        let rows = of_one_run(rows.iter().filter(|row| row.model == model));
        for side in [0].into_iter().chain(SIDES) {
            let of: Vec<_> = rows.iter().filter(|row| row.side == side).collect();
            let Some(first) = of.first() else { continue };
            let hidden: f64 = of.iter().map(|row| row.truth).sum();
            sums.push(Sum {
                model: model.to_owned(),
                method: first.method.clone(),
                side,
                ms: mean(&of.iter().map(|row| row.ms).collect::<Vec<_>>()),
                missed: 0,
                error: of.iter().map(|row| row.error * row.truth).sum::<f64>() / hidden,
            });
        }
    }
    sums
}

/// What was compared with what.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Speedup {
    /// How many times as fast ours is.
    ratio: f64,
    /// Points along each side of the rival's squares.
    side: u32,
    /// Our time and the rival's, in milliseconds.
    ms: [f64; 2],
    /// Our error and the rival's.
    error: [f64; 2],
}

/// Ours against the fewest points of the rival that are as exact, of a model; `None` where none are.
fn speedup_at_equal_error(sums: &[Sum], model: &str) -> Option<Speedup> {
    let of = || sums.iter().filter(|sum| sum.model == model);
    let ours = of().find(|sum| sum.method == OURS)?;
    let rivals = of().filter(|sum| sum.method == DIRECT && sum.error <= ours.error);
    let rival = rivals.min_by(|a, b| a.ms.total_cmp(&b.ms))?;
    Some(Speedup {
        ratio: rival.ms / ours.ms,
        side: rival.side,
        ms: [ours.ms, rival.ms],
        error: [ours.error, rival.error],
    })
}

/// Error and time over the footprint: ours of each model, and the rival of one.
fn over_footprints(rows: &[WaterRow]) -> Lines {
    let series = |name: String, model: &str, side: u32, of: fn(&WaterRow) -> f64| {
        let rows = of_one_run(rows.iter().filter(|row| row.model == model && row.side == side));
        let mut points: Vec<_> = rows.iter().map(|row| (row.footprint, of(row))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Series::new(name, points).marked()
    };
    let lines = |of: fn(&WaterRow) -> f64| -> Vec<Series> {
        let ours = models().map(|(model, _)| series(model.to_owned(), model, 0, of));
        let rival = [4, 16].map(|side| series(format!("breeze, {side} × {side}"), "breeze", side, of).as_reference());
        ours.into_iter().chain(rival).filter(|series| !series.points.is_empty()).collect()
    };
    Lines {
        title: "The slope's variance that a footprint hides: from tiles, and from points of the sum of all waves".into(),
        note: "Error of a square, RMS, against 40 × 40 points; time of 128 × 128 squares on one core, with the tiles'. Black: sums."
            .into(),
        x: Axis::log("side of the square, m"),
        panels: vec![
            Panel { y: Axis::log("error, share of the hidden"), series: lines(|row| row.error) },
            Panel { y: Axis::log("time, ms"), series: lines(|row| row.ms) },
        ],
    }
}

/// The plane of time and error: a point for each model, and of the rival one for each number of points.
fn plane(sums: &[Sum]) -> Scatter {
    let group = |method: &str| {
        let of = sums.iter().filter(|sum| sum.method == method);
        let dot = |sum: &Sum| Dot {
            x: sum.ms,
            y: sum.error,
            missed: false,
            label: if method == OURS { sum.model.clone() } else { String::new() },
        };
        Group { name: method.to_owned(), dots: of.map(dot).collect() }
    };
    let title = match speedup_at_equal_error(sums, "breeze") {
        Some(found) => {
            format!("Hidden slopes of a breeze: {OURS} is {} times as fast at equal error", short(found.ratio))
        }
        None => "Hidden slopes of water: speed against accuracy".into(),
    };
    Scatter {
        title,
        note:
            "Over all footprints. The sum is taken at 2 × 2 to 16 × 16 points of each of 128 × 128 squares; one core."
                .into(),
        x: Axis::log("time, ms"),
        y: Axis::log("error, share of what is hidden"),
        groups: [OURS, DIRECT].map(group).into_iter().filter(|group| !group.dots.is_empty()).collect(),
        missed: String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_square_hides_what_points_find() {
        let sea = Sea::new(&Waves::breeze()).unwrap();
        let tiles = variance::tiles(&sea);
        let footprint = *variance::footprints(&sea).last().unwrap();
        let whole: f64 = sea.cascades.iter().map(|cascade| cascade.slope_variance()).sum();
        for middle in variance::middles(2) {
            let [ours, points] =
                [variance::filtered(&tiles, middle, footprint), variance::direct(&sea, middle, footprint, 12, 3)];
            assert!((0.8..1.3).contains(&(ours / whole)), "{ours} of {whole}");
            assert!((0.6..1.6).contains(&(points / whole)), "{points} of {whole}");
        }
        // One point knows of no variance.
        assert!(variance::direct(&sea, [0.0; 2], footprint, 1, 3).abs() < 1e-12);
    }

    #[test]
    fn ours_is_held_against_as_few_points_as_are_as_exact() {
        let sum = |method: &str, side, ms, error| Sum {
            model: "lake".into(),
            method: method.into(),
            side,
            ms,
            missed: 0,
            error,
        };
        let mut sums = vec![sum(OURS, 0, 2.0, 0.1), sum(DIRECT, 2, 1.0, 0.4), sum(DIRECT, 16, 80.0, 0.01)];
        sums.push(sum(DIRECT, 8, 20.0, 0.1));
        let found = speedup_at_equal_error(&sums, "lake").unwrap();
        assert_eq!((found.ratio, found.side), (10.0, 8));
        assert!(
            speedup_at_equal_error(&sums, "gale").is_none() && speedup_at_equal_error(&sums[..2], "lake").is_none()
        );
    }
}
