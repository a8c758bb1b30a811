//! Seed 000's four experiments (§4.2.2): one parameter of its march at a time, over the values that it took, with its
//! other parameters; error and time on one chart. `c` is a share of the height in metres, as its equation 3.4 has it.

use bevy_horizon::prelude::HorizonCamera;
use bevy_horizon_workspace::views::{Seen, four};
use horizon_field::Place;
use horizon_field::methods::Method;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::gpu::{Rig, Shot};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::store::Row;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Seed000;

const TABLE: &str = "seed_000";
/// Square, as there; smaller, as the device is.
const SIZE: [usize; 2] = [200, 200];

/// A setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The parameter that varies.
    pub parameter: String,
    /// Its value.
    pub value: f64,
    /// The pass, in milliseconds.
    pub ms: f64,
    /// Evaluations of the field for each ray.
    pub evals_per_ray: f64,
    /// Its HDE: the mean of |y − H|, in metres.
    pub hde_m: f64,
    /// Its IDE: the mean of |t − t_truth|, in metres.
    pub ide_m: f64,
    /// The share of pixels that miss the ground, silhouettes aside.
    pub missed_share: f64,
}

impl Row for SeedRow {
    type Key = (String, String);

    fn key(&self) -> Self::Key {
        (self.parameter.clone(), self.value.to_string())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// The four experiments: the parameter, and the settings over its values.
fn experiments() -> [(&'static str, Vec<(f64, Method)>); 4] {
    let fixed = |a: f64, b: f64, c: f64, k: u32| Method::FixedStep { a, b, c, k };
    [
        ("a", [0.1, 1.0, 5.0, 10.0, 20.0, 50.0, 100.0].map(|a| (a, fixed(a, 0.004, 50.0, 0))).to_vec()),
        ("b", [1.0, 2.0, 4.0, 10.0, 20.0, 50.0, 100.0].map(|b| (b * 1e-3, fixed(5.0, b * 1e-3, 50.0, 0))).to_vec()),
        (
            "c",
            [0.0, 0.1, 0.3, 0.5, 0.9, 1.0, 2.0, 4.0, 10.0, 20.0, 50.0, 100.0]
                .map(|c| (c, fixed(5.0, 0.005, c, 0)))
                .to_vec(),
        ),
        ("k", [0, 1, 2, 4, 6, 10, 15, 20].map(|k| (f64::from(k), fixed(5.0, 0.01, 50.0, k))).to_vec()),
    ]
}

impl Experiment for Seed000 {
    fn name(&self) -> &'static str {
        "seed_000"
    }

    fn about(&self) -> &'static str {
        "seed 000's four experiments: error and time against a, b, c and k"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<SeedRow>(TABLE)?;
        let all = experiments();
        let progress = ctx.progress(self.name(), all.len());
        let [_, ridge, ..] = four();
        let seen = Seen::new(ridge, Place::ORIGIN)?;
        let mut rig: Option<Rig> = None;
        for (parameter, settings) in all {
            for (value, method) in settings {
                if table.has(&(parameter.to_owned(), value.to_string())) {
                    continue;
                }
                let rig = rig.get_or_insert_with(|| {
                    let camera = HorizonCamera::default();
                    Rig::new(&seen, Shot { size: SIZE, camera, rival: Some(method), zoom: 1.0 })
                });
                rig.set_rival(method);
                let cost = rig.cost(ctx.pick(2, 7), 0.0);
                let report = rig.report(ctx)?;
                table.push(SeedRow {
                    run: ctx.run,
                    parameter: parameter.to_owned(),
                    value,
                    ms: cost.ground,
                    evals_per_ray: rig.work()[0],
                    hde_m: report.hde.mean,
                    ide_m: report.ide.mean,
                    missed_share: report.missed as f64 / report.pixels as f64,
                })?;
            }
            progress.done(parameter);
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ctx.rows::<SeedRow>(TABLE)?;
        let chart = |(parameter, _): (&str, _)| {
            let series = |name: &str, of: fn(&SeedRow) -> f64| {
                let rows = rows.iter().filter(|row| row.parameter == parameter);
                Series::new(name, rows.map(|row| (row.value, of(row))).collect()).marked()
            };
            let panels = vec![
                Panel {
                    y: Axis::log("mean error, m"),
                    series: vec![
                        series("along the ray (IDE)", |row| row.ide_m),
                        series("of height (HDE)", |row| row.hde_m),
                    ],
                },
                Panel {
                    y: Axis::linear("missed, % of pixels"),
                    series: vec![series("missed", |row| 100.0 * row.missed_share)],
                },
                Panel { y: Axis::linear("time, ms"), series: vec![series("time of the pass", |row| row.ms)] },
            ];
            let x = if matches!(parameter, "a" | "b") { Axis::log(parameter) } else { Axis::linear(parameter) };
            let title = format!("Seed 000's march against its parameter {parameter}");
            let note =
                "View “ridge”, 200 × 200 pixels, 13 octaves; the other parameters are those of its experiment.".into();
            NamedChart::new(format!("seed_000_{parameter}"), Lines { title, note, x, panels })
        };
        Ok(experiments().into_iter().map(chart).collect())
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<SeedRow>(TABLE)?;
        let list = rows.iter().map(|row| serde_json::to_value(row).expect("a row is plain data")).collect();
        Ok(Map::from_iter([("seed_000".to_owned(), Value::Array(list))]))
    }
}
