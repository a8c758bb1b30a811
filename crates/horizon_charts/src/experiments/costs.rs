//! What the cached march costs as a scene grows: octaves, nodes of the field, how far one sees, pixels, speed, focal
//! length; and one setting of seed 000's march beside it.

use bevy_horizon::prelude::HorizonCamera;
use bevy_horizon_workspace::views::{Seen, View, four, mountains};
use horizon_field::Place;
use horizon_field::field::{Field, Fractal};
use horizon_field::methods::Method;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::gpu::{Rig, Shot};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::readme::short;
use crate::store::Row;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Costs;

const TABLE: &str = "costs";
const FULL: [usize; 2] = [1280, 720];
/// 10 m/s, in metres for each of 60 frames a second.
const WALK: f64 = 10.0 / 60.0;
/// The rival: seed 000's march at a setting that misses nothing in most views.
const RIVAL: Method = Method::FixedStep { a: 2.0, b: 0.004, c: 0.5, k: 6 };

/// A point of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// What is swept.
    pub sweep: String,
    /// Its value there.
    pub value: f64,
    /// `cached` or `fixed step`.
    pub method: String,
    /// The ground's passes, in milliseconds.
    pub ms: f64,
    /// The cache's passes, in milliseconds a frame.
    pub fill_ms: f64,
    /// A whole frame on the clock: the median, in milliseconds.
    pub frame_ms: f64,
    /// The longest frame.
    pub worst_ms: f64,
    /// Texels that are filled in a frame.
    pub texels: f64,
    /// The mean error along the ray, in pixels; only where focal length is swept.
    pub ide_px_mean: f64,
    /// Pixels outside silhouettes that are missed or invented; only where focal length is swept.
    pub wrong: u64,
}

impl Row for CostRow {
    type Key = (String, String, String);

    fn key(&self) -> Self::Key {
        (self.sweep.clone(), self.value.to_string(), self.method.clone())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// What is drawn at a point of a sweep.
struct Point {
    sweep: &'static str,
    value: f64,
    view: View,
    size: [usize; 2],
    zoom: f32,
    /// Metres the camera goes in a frame.
    step: f64,
    frames: usize,
}

/// Fields of more and more nodes: a sum of fractals with as many octaves in all.
fn nodes(count: u32) -> Field {
    let one = |seed: u32| {
        Field::Fractal(Fractal {
            wavelength: 6000.0,
            amplitude: 1500.0 / f64::from(count),
            octaves: 12.0,
            gain: 0.47,
            seed,
            ..Fractal::default()
        })
    };
    Field::Add((0..count).map(one).collect())
}

fn sweeps(ctx: &Context) -> Vec<Point> {
    let [valley, ridge, ..] = four();
    let base = |sweep, value: f64, view: View| Point {
        sweep,
        value,
        view,
        size: ctx.pick([160, 90], FULL),
        zoom: 1.0,
        step: WALK,
        frames: ctx.pick(3, 20),
    };
    let mut points = Vec::new();
    for &octaves in ctx.pick(&[8.0, 16.0][..], &[1.0, 4.0, 8.0, 12.0, 16.0]) {
        points.push(base("octaves", octaves, View { field: mountains(octaves), ..valley.clone() }));
    }
    for &count in ctx.pick(&[1, 8][..], &[1, 2, 4, 8]) {
        points.push(base("nodes", f64::from(count), View { field: nodes(count), ..ridge.clone() }));
    }
    for &far in ctx.pick(&[10.0f32, 100.0][..], &[1.0, 10.0, 30.0, 100.0]) {
        points.push(base("far, km", f64::from(far), View { far: 1000.0 * far, ..ridge.clone() }));
    }
    for &height in ctx.pick(&[45usize, 90][..], &[180, 360, 720]) {
        let size = [height * 16 / 9, height];
        points.push(Point { size, ..base("pixels", (size[0] * size[1]) as f64, ridge.clone()) });
    }
    let low = View { above: 50.0, ..ridge.clone() };
    for &speed in ctx.pick(&[0.0, 100.0][..], &[0.0, 10.0, 100.0]) {
        let frames = ctx.pick(3, if speed == 100.0 { 300 } else { 40 });
        points.push(Point { step: speed / 60.0, frames, ..base("speed, m/s", speed, low.clone()) });
    }
    for &zoom in ctx.pick(&[1.0f32, 10.0][..], &[1.0, 3.0, 10.0]) {
        points.push(Point {
            zoom,
            size: ctx.pick([160, 90], [640, 360]),
            ..base("focal length, times", f64::from(zoom), ridge.clone())
        });
    }
    points
}

impl Point {
    fn row(&self, ctx: &Context, rival: Option<Method>) -> Result<CostRow, ChartsError> {
        let seen = Seen::new(self.view.clone(), Place::ORIGIN)?;
        let shot = Shot { size: self.size, camera: HorizonCamera::default(), rival, zoom: self.zoom };
        let mut rig = Rig::new(&seen, shot);
        let cost = rig.cost(if rival.is_some() { 2 } else { self.frames }, self.step);
        let (mut ide_px_mean, mut wrong) = (0.0, 0);
        if self.sweep.starts_with("focal") && rival.is_none() {
            let report = rig.report(ctx)?;
            ide_px_mean = report.ide_pixels.mean;
            wrong = (report.missed + report.false_hits) as u64;
        }
        Ok(CostRow {
            run: ctx.run,
            sweep: self.sweep.to_owned(),
            value: self.value,
            method: if rival.is_some() { "fixed step" } else { "cached" }.to_owned(),
            ms: cost.ground,
            fill_ms: cost.fill,
            frame_ms: cost.frame,
            worst_ms: cost.worst,
            texels: cost.texels,
            ide_px_mean,
            wrong,
        })
    }
}

impl Experiment for Costs {
    fn name(&self) -> &'static str {
        "costs"
    }

    fn about(&self) -> &'static str {
        "what the march costs against octaves, nodes, distance, pixels, speed and focal length"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<CostRow>(TABLE)?;
        let points = sweeps(ctx);
        let progress = ctx.progress(self.name(), points.len());
        // A sweep's points are compared with one another: it is measured in one run, or again.
        for chunk in points.chunk_by(|a, b| a.sweep == b.sweep) {
            let key = |point: &Point, method: &str| (point.sweep.into(), point.value.to_string(), method.into());
            let keys: Vec<_> = chunk.iter().map(|point| key(point, "cached")).collect();
            let there = table.has_together(&keys);
            for point in chunk {
                if !there {
                    table.push(point.row(ctx, None)?)?;
                }
                let swept = ["octaves", "nodes", "far, km"].contains(&point.sweep);
                if swept && !table.has(&key(point, "fixed step")) {
                    table.push(point.row(ctx, Some(RIVAL))?)?;
                }
                progress.done(&format!("{} {}", point.sweep, point.value));
            }
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ctx.rows::<CostRow>(TABLE)?;
        let mut charts = Vec::new();
        for sweep in names(&rows) {
            let series = |name: &str, method: &str, of: fn(&CostRow) -> f64| {
                let points = latest(&rows, &sweep, method).iter().map(|row| (row.value, of(row))).collect();
                Series::new(name, points).marked()
            };
            let mut lines = vec![
                series("cached: march", "cached", |row| row.ms),
                series("cached: march and fill", "cached", |row| row.ms + row.fill_ms),
            ];
            let rival = series("fixed step", "fixed step", |row| row.ms);
            if !rival.points.is_empty() {
                lines.push(rival);
            }
            let title = match growth(&rows, &sweep) {
                Some((from, to, times)) => {
                    format!("From {from} to {to} {sweep}, the cached march costs {} times as much", short(times))
                }
                None => format!("Cost against {sweep}"),
            };
            let plain = matches!(sweep.as_str(), "octaves" | "nodes" | "speed, m/s");
            let x = if plain { Axis::linear(sweep.clone()) } else { Axis::log(sweep.clone()) };
            let panels = vec![Panel { y: Axis::log("ms a frame"), series: lines }];
            let note = "1280 × 720 on the software driver but for the sweep of pixels and of focal length (640 × 360).";
            let file: String = sweep.chars().take_while(|c| c.is_alphabetic()).collect();
            charts.push(NamedChart::new(format!("cost_{file}"), Lines { title, note: note.into(), x, panels }));
        }
        Ok(charts)
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<CostRow>(TABLE)?;
        let at = |sweep: &str, value: f64| {
            latest(&rows, sweep, "cached").into_iter().find(|row| row.value == value).cloned()
        };
        let ratio = |sweep: &str, from: f64, to: f64, of: fn(&CostRow) -> f64| {
            Some(of(&at(sweep, to)?) / of(&at(sweep, from)?))
        };
        let total = |row: &CostRow| row.ms + row.fill_ms;
        let fast = at("speed, m/s", 100.0);
        let far = at("focal length, times", 10.0);
        let found = json!({
            "octaves_8_to_16": ratio("octaves", 8.0, 16.0, total),
            "octaves_8_to_16_march": ratio("octaves", 8.0, 16.0, |row| row.ms),
            "far_10_to_100_km": ratio("far, km", 10.0, 100.0, total),
            "speed_0_to_100": ratio("speed, m/s", 0.0, 100.0, |row| row.frame_ms),
            "worst_to_median_at_100": fast.map(|row| row.worst_ms / row.frame_ms),
            "zoom_10_ide_px_mean": far.as_ref().map(|row| row.ide_px_mean),
            "zoom_10_wrong": far.map(|row| row.wrong),
            "rows": rows,
        });
        Ok(Map::from_iter([("costs".to_owned(), found)]))
    }
}

fn names(rows: &[CostRow]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in rows {
        if !names.contains(&row.sweep) {
            names.push(row.sweep.clone());
        }
    }
    names
}

/// A sweep's rows by a method, of its last run, in ascending order.
fn latest<'a>(rows: &'a [CostRow], sweep: &str, method: &str) -> Vec<&'a CostRow> {
    let of = || rows.iter().filter(|row| row.sweep == sweep && row.method == method);
    let last = of().map(|row| row.run).max();
    let mut rows: Vec<_> = of().filter(|row| Some(row.run) == last).collect();
    rows.sort_by(|a, b| a.value.total_cmp(&b.value));
    rows
}

/// From which to which value a sweep goes, and how many times the cost grows.
fn growth(rows: &[CostRow], sweep: &str) -> Option<(f64, f64, f64)> {
    let rows = latest(rows, sweep, "cached");
    let (first, last) = (rows.first()?, rows.last()?);
    Some((first.value, last.value, (last.ms + last.fill_ms) / (first.ms + first.fill_ms)))
}
