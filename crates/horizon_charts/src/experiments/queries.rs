//! How many heights a core answers in a second, beside the `noise` crate's fBm of as many octaves.

use std::hint::black_box;
use std::time::Instant;

use horizon_field::field::{Anchors, Field, Fractal, NoImages};
use horizon_field::{Compiled, Place};
use noise::{Fbm, MultiFractal, NoiseFn, Perlin};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::measure::samples::median;
use crate::plot::{Axis, BarSeries, Bars};
use crate::readme::short;
use crate::store::{Row, of_one_run};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Queries;

const TABLE: &str = "queries";
const OCTAVES: [u32; 5] = [4, 8, 10, 12, 16];
const WAVELENGTH: f64 = 4000.0;
/// How many queries a contestant answers before it is the next one's turn: some tenth of a millisecond.
const TURN: usize = 256;

/// A round: all contestants, one after the other, at the same points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QueriesRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// How many octaves.
    pub octaves: u32,
    /// How many points a contestant is asked in a round.
    pub points: usize,
    /// The round.
    pub round: u32,
    /// Ours, one at a time, in nanoseconds for each query.
    pub single_ns: f64,
    /// Ours, in a batch.
    pub batched_ns: f64,
    /// `noise::Fbm<noise::Perlin>`.
    pub noise_ns: f64,
}

impl Row for QueriesRow {
    type Key = (u32, usize, u32);

    fn key(&self) -> Self::Key {
        (self.octaves, self.points, self.round)
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// What is asked of both.
struct Contest {
    field: Compiled<2>,
    anchors: Anchors<2>,
    rival: Fbm<Perlin>,
    at: Vec<[f64; 2]>,
    out: Vec<f64>,
}

impl Contest {
    fn new(octaves: u32, points: usize) -> Result<Self, ChartsError> {
        let fractal = Fractal { wavelength: WAVELENGTH, octaves: f64::from(octaves), ..Fractal::default() };
        let field = Field::Fractal(fractal).compile::<2>(&NoImages)?;
        let rival = Fbm::<Perlin>::new(7).set_octaves(octaves as usize).set_lacunarity(2.0).set_persistence(0.5);
        // Scattered over 20 km, by Weyl's sequence in two dimensions: no point is near the one before it.
        let scattered = |i: usize, step: f64| ((i as f64 * step).fract() - 0.5) * 20_000.0;
        let at = (1..=points).map(|i| [scattered(i, 0.754_877_666_246_692_7), scattered(i, 0.569_840_290_998_053_2)]);
        Ok(Self { anchors: field.anchor(&Place::ORIGIN), field, rival, at: at.collect(), out: vec![0.0; points] })
    }

    fn round(&mut self, run: u64, octaves: u32, round: u32) -> QueriesRow {
        let mut times: [Vec<f64>; 3] = Default::default();
        let mut out = core::mem::take(&mut self.out);
        // In short turns, of which the median counts: another process that takes the core away spoils few of them.
        for (at, out) in self.at.chunks(TURN).zip(out.chunks_mut(TURN)) {
            let (field, anchors) = (&self.field, &self.anchors);
            times[0].push(timed(out, |out| {
                for (out, q) in out.iter_mut().zip(black_box(at)) {
                    *out = field.value_f64(anchors, *q, 0.0);
                }
            }));
            times[1].push(timed(out, |out| batched(field, anchors, black_box(at), out)));
            times[2].push(timed(out, |out| {
                for (out, q) in out.iter_mut().zip(black_box(at)) {
                    *out = self.rival.get(q.map(|q| q * (1.0 / WAVELENGTH)));
                }
            }));
        }
        self.out = out;
        let points = self.at.len();
        let [single_ns, batched_ns, noise_ns] = times.map(median);
        QueriesRow { run, octaves, points, round, single_ns, batched_ns, noise_ns }
    }
}

/// The nanoseconds for each query of what fills `out`.
fn timed(out: &mut [f64], fill: impl FnOnce(&mut [f64])) -> f64 {
    let start = Instant::now();
    fill(out);
    black_box(&mut *out);
    start.elapsed().as_secs_f64() * 1e9 / out.len() as f64
}

/// The heights at many points.
fn batched(field: &Compiled<2>, anchors: &Anchors<2>, at: &[[f64; 2]], out: &mut [f64]) {
    field.values_f64(anchors, at, 0.0, out);
}

impl Experiment for Queries {
    fn name(&self) -> &'static str {
        "queries"
    }

    fn about(&self) -> &'static str {
        "how many heights a core answers in a second, beside the `noise` crate"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<QueriesRow>(TABLE)?;
        let (points, rounds) = ctx.pick((8_192, 5), (65_536, 15));
        let mut contests = Vec::new();
        for octaves in OCTAVES {
            let keys: Vec<_> = (0..rounds).map(|round| (octaves, points, round)).collect();
            if !table.has_together(&keys) {
                contests.push((octaves, Contest::new(octaves, points)?));
            }
        }
        let progress = ctx.progress(self.name(), if contests.is_empty() { 0 } else { rounds as usize });
        for (octaves, contest) in &mut contests {
            // The first round warms caches up, and is not written down.
            contest.round(ctx.run, *octaves, 0);
        }
        // Interleaved: what slows the machine down for a while slows all of them.
        for round in 0..rounds {
            for (octaves, contest) in &mut contests {
                table.push(contest.round(ctx.run, *octaves, round))?;
            }
            progress.done(&format!("round {round}"));
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let all = medians(&ctx.rows(TABLE)?);
        let series = |name: &str, ns: fn(&Medians) -> f64| BarSeries {
            name: name.into(),
            values: all.iter().map(|medians| 1e3 / ns(medians)).collect(),
        };
        let times = |ratio: f64| format!("{} times", short(ratio));
        let twelve = all.iter().find(|medians| medians.octaves == 12).or(all.last());
        let title = twelve.map_or(String::new(), |medians| {
            format!(
                "At {} octaves a core answers {} as many heights as noise's fBm one by one, {} in batches",
                medians.octaves,
                times(medians.single_speedup),
                times(medians.batched_speedup),
            )
        });
        let chart = Bars {
            title,
            note: "Gradient noise in f64, scattered points; medians of interleaved rounds on one core.".into(),
            x: "octaves".into(),
            y: Axis::linear("heights a second and core, millions"),
            categories: all.iter().map(|medians| medians.octaves.to_string()).collect(),
            series: vec![
                series("one by one", |medians| medians.single_ns),
                series("noise::Fbm<Perlin>", |medians| medians.noise_ns),
                series("in batches", |medians| medians.batched_ns),
            ],
        };
        Ok(vec![NamedChart::new("queries", chart)])
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let entries: Map<_, _> =
            medians(&ctx.rows(TABLE)?).iter().map(|medians| (medians.octaves.to_string(), json!(medians))).collect();
        Ok(Map::from_iter([("queries".to_owned(), Value::Object(entries))]))
    }
}

/// What the rounds of one count of octaves say.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Medians {
    octaves: u32,
    single_ns: f64,
    batched_ns: f64,
    noise_ns: f64,
    /// How many times as fast as the rival: the median of the rounds' ratios.
    single_speedup: f64,
    batched_speedup: f64,
}

fn medians(rows: &[QueriesRow]) -> Vec<Medians> {
    let mut octaves: Vec<u32> = rows.iter().map(|row| row.octaves).collect();
    octaves.sort_unstable();
    octaves.dedup();
    let of = |octaves: u32| {
        let rows = of_one_run(rows.iter().filter(|row| row.octaves == octaves));
        let middle = |value: fn(&QueriesRow) -> f64| median(rows.iter().map(|row| value(row)));
        Medians {
            octaves,
            single_ns: middle(|row| row.single_ns),
            batched_ns: middle(|row| row.batched_ns),
            noise_ns: middle(|row| row.noise_ns),
            single_speedup: middle(|row| row.noise_ns / row.single_ns),
            batched_speedup: middle(|row| row.noise_ns / row.batched_ns),
        }
    };
    octaves.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contestants_are_asked_the_same_many_things() {
        let mut contest = Contest::new(4, 64).unwrap();
        let row = contest.round(5, 4, 2);
        assert_eq!(row.key(), (4, 64, 2));
        assert!([row.single_ns, row.batched_ns, row.noise_ns].iter().all(|ns| ns.is_finite() && *ns > 0.0));
        // The last one that filled it was the rival, whose noise is that of its octaves and not all alike.
        assert!(contest.out.iter().all(|v| v.abs() < 2.0) && contest.out[0] != contest.out[1]);
        let mut out = vec![0.0; 64];
        batched(&contest.field, &contest.anchors, &contest.at, &mut out);
        for (value, q) in out.iter().zip(&contest.at) {
            assert_eq!(*value, contest.field.value_f64(&contest.anchors, *q, 0.0));
            assert!(q.iter().all(|q| q.abs() <= 10_000.0));
        }
    }

    #[test]
    fn ratios_are_taken_round_by_round_in_one_run() {
        let row = |run: u64, round: u32, ours: f64, theirs: f64| QueriesRow {
            run,
            octaves: 8,
            points: 1,
            round,
            single_ns: ours,
            batched_ns: ours / 2.0,
            noise_ns: theirs,
        };
        // The second round was slow for both; the other run had fewer rounds.
        let rows = [row(1, 0, 100.0, 200.0), row(1, 1, 900.0, 1900.0), row(1, 2, 100.0, 210.0), row(2, 0, 1.0, 9.0)];
        let found = medians(&rows);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].single_ns, found[0].noise_ns), (100.0, 210.0));
        assert!((found[0].single_speedup - 2.1).abs() < 1e-12 && (found[0].batched_speedup - 4.2).abs() < 1e-12);
    }
}
