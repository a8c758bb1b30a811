//! Finding the plant that a ray meets: seed 000's search of nine cells over a grid of its step parameters, sphere tracing of the
//! whole domain, and ours, on the CPU with the same plants, on one thread; and ours on the device, in woods without end and in
//! woods of 1 km².

mod endless;
mod search;
mod woods;

use std::time::Instant;

use horizon_field::trees::{Grove, PlantWork};
use horizon_field::truth::TruthCamera;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::march::OURS;
use crate::measure::samples::{mean, median};
use crate::plot::{Axis, Dot, Group, Scatter};
use crate::readme::short;
use crate::store::{Row, of_one_run};
use search::{LIKE, NINE, NINE_CACHED, Search};
use woods::{Sight, Truth, VIEWS, View, Woods};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Trees;

const TABLE: &str = "trees";
const DEVICE: &str = "trees_gpu";
/// The woods on the device, by their names in the table.
const ENDLESS: &str = "endless";
const SQUARE: &str = "1 km²";
/// A picture that takes longer, in milliseconds, is drawn once; others several times.
const LONG: f64 = 1000.0;

/// A view's plants by one search with one setting, against the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreesRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The view.
    pub view: String,
    /// The search; [`OURS`] or a rival.
    pub method: String,
    /// Its settings.
    pub settings: String,
    /// The time of a picture on one core, in milliseconds: the median of several.
    pub ms: f64,
    /// Steps for each ray: of ours, dual cells looked at; of a rival, points.
    pub steps_per_ray: f64,
    /// Plants tested, for each ray.
    pub plants_per_ray: f64,
    /// Evaluations of a crown's function, for each ray.
    pub evals_per_ray: f64,
    /// The share of pixels that show a plant.
    pub plants_share: f64,
    /// The share of pixels that are silhouettes, which don't count.
    pub silhouette_share: f64,
    /// Pixels outside silhouettes without a plant where the truth has one.
    pub missed: u64,
    /// Pixels outside silhouettes with a plant where the truth has none.
    #[serde(rename = "false")]
    pub false_hits: u64,
    /// The mean error along the ray, in footprints of a pixel, outside silhouettes.
    pub error: f64,
}

impl Row for TreesRow {
    type Key = (String, String, String);

    fn key(&self) -> Self::Key {
        (self.view.clone(), self.method.clone(), self.settings.clone())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

impl TreesRow {
    /// Pixels that are wrong, not only inexact: missed, or invented.
    fn wrong(&self) -> u64 {
        self.missed + self.false_hits
    }

    fn is_ours(&self) -> bool {
        self.method == OURS
    }

    /// Whether it is ours over the stretch of rays that rivals search.
    fn is_like(&self) -> bool {
        self.is_ours() && self.settings == LIKE
    }

    fn is_no_worse_than(&self, other: &Self) -> bool {
        self.missed <= other.missed && self.wrong() <= other.wrong() && self.error <= other.error
    }
}

/// The pass that draws a view's plants, on the device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PassRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The view.
    pub view: String,
    /// How far the woods reach: `endless`, or `1 km²` around the camera.
    pub woods: String,
    /// The pass, in milliseconds: the median over some frames.
    pub ms: f64,
    /// Whole frames on the clock, in milliseconds: the median.
    pub frame_ms: f64,
}

impl Row for PassRow {
    type Key = (String, String);

    fn key(&self) -> Self::Key {
        (self.view.clone(), self.woods.clone())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// A view, and what is known of it before anything is searched.
struct Looked {
    name: &'static str,
    camera: TruthCamera,
    sights: Vec<Sight>,
    truth: Vec<Truth>,
}

impl Looked {
    fn new(woods: &Woods, view: &View, size: [usize; 2]) -> Result<Self, ChartsError> {
        let camera = woods.camera(view, size);
        Ok(Self { name: view.name, sights: woods.sights(&camera), truth: woods.truth(&camera, 2)?, camera })
    }

    /// What a picture by a search takes, and how far it is off.
    fn row(&self, ctx: &Context, search: &Search, grove: &mut Grove<'_>) -> TreesRow {
        let cone = Woods::cone(&self.camera);
        let mut picture = || {
            let mut work = PlantWork::default();
            let start = Instant::now();
            let met: Vec<_> = self.sights.iter().map(|sight| search.cast(grove, sight, cone, &mut work)).collect();
            (start.elapsed().as_secs_f64() * 1e3, met, work)
        };
        let (first, met, work) = picture();
        let again = if first > LONG { 0 } else { ctx.pick(0, 4) };
        let ms = median([first].into_iter().chain((0..again).map(|_| picture().0)));
        let (mut missed, mut false_hits, mut off) = (0, 0, Vec::new());
        for (truth, met) in self.truth.iter().zip(met).filter(|(truth, _)| !truth.silhouette) {
            match (truth.t, met) {
                (Some(t), Some(met)) => off.push((met - t).abs() / cone.at(t)),
                (Some(_), None) => missed += 1,
                (None, Some(_)) => false_hits += 1,
                (None, None) => {}
            }
        }
        let rays = self.sights.len() as f64;
        let share = |of: fn(&Truth) -> bool| self.truth.iter().filter(|truth| of(truth)).count() as f64 / rays;
        TreesRow {
            run: ctx.run,
            view: self.name.to_owned(),
            method: search.method().to_owned(),
            settings: search.settings(),
            ms,
            steps_per_ray: work.cells as f64 / rays,
            plants_per_ray: work.plants as f64 / rays,
            evals_per_ray: work.steps as f64 / rays,
            plants_share: share(|truth| truth.t.is_some()),
            silhouette_share: share(|truth| truth.silhouette),
            missed,
            false_hits,
            error: mean(&off),
        }
    }
}

impl Experiment for Trees {
    fn name(&self) -> &'static str {
        TABLE
    }

    fn about(&self) -> &'static str {
        "speed against accuracy of each way to find plants, and woods without end against 1 km²"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE, DEVICE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<TreesRow>(TABLE)?;
        let mut passes = ctx.table::<PassRow>(DEVICE)?;
        let woods = Woods::new()?;
        let searches = search::all(ctx.quick);
        let progress = ctx.progress(self.name(), 2 * VIEWS.len());
        for view in VIEWS {
            let key = |search: &Search| (view.name.to_owned(), search.method().to_owned(), search.settings());
            // Times are compared with one another: a view is measured in one run, or again.
            if !table.has_together(&searches.iter().map(key).collect::<Vec<_>>()) {
                let looked = Looked::new(&woods, &view, ctx.pick([48, 27], [160, 90]))?;
                let mut grove = woods.grove();
                // What fills the tiles of plants is not counted.
                looked.row(ctx, &searches[0], &mut grove);
                for search in &searches {
                    table.push(looked.row(ctx, search, &mut grove))?;
                }
            }
            progress.done(&format!("{}, searches", view.name));
        }
        for view in VIEWS {
            let key = |woods: &str| (view.name.to_owned(), woods.to_owned());
            if !passes.has_together(&[key(ENDLESS), key(SQUARE)]) {
                for (woods, [ms, frame_ms]) in [ENDLESS, SQUARE].into_iter().zip(endless::passes(ctx, &view)?) {
                    let (view, woods) = key(woods);
                    passes.push(PassRow { run: ctx.run, view, woods, ms, frame_ms })?;
                }
            }
            progress.done(&format!("{}, on the device", view.name));
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ctx.rows::<TreesRow>(TABLE)?;
        Ok(views(&rows)
            .into_iter()
            .map(|(view, rows)| NamedChart::new(format!("trees_{view}"), plane(view, &rows)))
            .collect())
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<TreesRow>(TABLE)?;
        let passes = ctx.rows::<PassRow>(DEVICE)?;
        let views = views(&rows);
        let against = |rival: &str| -> Map<String, Value> {
            let found = |(view, rows): &(&str, Vec<&TreesRow>)| {
                Some(((*view).to_owned(), json!(speedup_at_equal_error(rows, rival)?)))
            };
            views.iter().filter_map(found).collect()
        };
        // In the view where it is least.
        let speedup = |rival: &str| {
            let ratios = views.iter().filter_map(|(_, rows)| Some(speedup_at_equal_error(rows, rival)?.ratio));
            ratios.min_by(f64::total_cmp)
        };
        let list: Vec<_> = views.iter().flat_map(|(_, rows)| rows).collect();
        let ours = |of: fn(&TreesRow) -> u64| list.iter().filter(|row| row.is_like()).map(|row| of(row)).sum::<u64>();
        let found = json!({
            "speedup_at_equal_error": speedup(NINE),
            "speedup_with_our_cache": speedup(NINE_CACHED),
            "by_view": against(NINE),
            "by_view_with_our_cache": against(NINE_CACHED),
            "settings": views.first().map(|(_, rows)| rows.iter().filter(|row| row.method == NINE).count()),
            "missed": ours(|row| row.missed),
            "false": ours(|row| row.false_hits),
            "endless_over_1km2": endless_over_square(&passes),
        });
        let entries = [("trees", json!(list)), ("trees_compared", found), ("trees_gpu", json!(passes))];
        Ok(entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

/// The views in the order of the table, each with the rows of one run.
fn views(rows: &[TreesRow]) -> Vec<(&str, Vec<&TreesRow>)> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.view.as_str()) {
            names.push(&row.view);
        }
    }
    let of = |name: &str| of_one_run(rows.iter().filter(|row| row.view == name));
    names.into_iter().map(|name| (name, of(name))).collect()
}

/// What was compared with what.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Speedup {
    /// How many times as fast ours is.
    ratio: f64,
    /// The rival's method and settings.
    rival: String,
    /// Our time and the rival's, in milliseconds.
    ms: [f64; 2],
    /// Whether the rival is as exact as ours; if not, it is the most exact that there is.
    as_exact: bool,
    /// Wrong pixels: ours and the rival's.
    wrong: [u64; 2],
    /// The mean error along the ray, in pixels: ours and the rival's.
    error: [f64; 2],
}

/// Ours from the canopy on against the fastest setting of a rival that has no more wrong pixels and no larger error, in the rows of
/// one view and run; or against the most exact, where none is as exact.
fn speedup_at_equal_error(rows: &[&TreesRow], rival: &str) -> Option<Speedup> {
    let ours = rows.iter().find(|row| row.is_like())?;
    let rivals = || rows.iter().filter(|row| row.method == rival && row.error.is_finite());
    let reaching = rivals().filter(|row| row.is_no_worse_than(ours)).min_by(|a, b| a.ms.total_cmp(&b.ms));
    let most_exact = || rivals().min_by(|a, b| a.wrong().cmp(&b.wrong()).then(a.error.total_cmp(&b.error)));
    let rival = reaching.or_else(most_exact)?;
    Some(Speedup {
        ratio: rival.ms / ours.ms,
        rival: format!("{} {}", rival.method, rival.settings),
        ms: [ours.ms, rival.ms],
        as_exact: reaching.is_some(),
        wrong: [ours.wrong(), rival.wrong()],
        error: [ours.error, rival.error],
    })
}

/// How many times as long as in woods of 1 km² the pass takes in woods without end: in all views together.
fn endless_over_square(passes: &[PassRow]) -> Option<f64> {
    let sum = |woods: &str| passes.iter().filter(|row| row.woods == woods).map(|row| row.ms).sum::<f64>();
    let ratio = sum(ENDLESS) / sum(SQUARE);
    ratio.is_finite().then_some(ratio)
}

/// The plane of time and error of a view.
fn plane(view: &str, rows: &[&TreesRow]) -> Scatter {
    let mut groups: Vec<Group> = Vec::new();
    for row in rows {
        let label = if row.is_ours() { row.settings.clone() } else { String::new() };
        let dot = Dot { x: row.ms, y: row.error, missed: row.wrong() > 0, label };
        match groups.iter_mut().find(|group| group.name == row.method) {
            Some(group) => group.dots.push(dot),
            None => groups.push(Group { name: row.method.clone(), dots: vec![dot] }),
        }
    }
    let title = match speedup_at_equal_error(rows, NINE) {
        Some(found) => format!("Plants, view “{view}”: {OURS} is {} times as fast at equal error", short(found.ratio)),
        None => format!("Plants, view “{view}”: speed against accuracy"),
    };
    Scatter {
        title,
        note: "Each point is a setting; one core, the same plants for all. Silhouettes are left out.".into(),
        x: Axis::log("time of a picture of 160 × 90, ms"),
        y: Axis::log("mean error along the ray, pixels"),
        groups,
        missed: "has wrong pixels".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(method: &str, ms: f64, missed: u64, error: f64) -> TreesRow {
        TreesRow {
            run: 1,
            view: "over".into(),
            method: method.into(),
            settings: if method == OURS { LIKE.into() } else { ms.to_string() },
            ms,
            steps_per_ray: 1.0,
            plants_per_ray: 1.0,
            evals_per_ray: 1.0,
            plants_share: 0.5,
            silhouette_share: 0.1,
            missed,
            false_hits: 0,
            error,
        }
    }

    #[test]
    fn ours_is_held_against_the_fastest_that_is_as_exact() {
        let mut rows = vec![row(OURS, 2.0, 1, 0.3), row(NINE, 10.0, 9, 0.1), row(NINE, 50.0, 1, 0.3)];
        rows.extend([row(NINE, 40.0, 1, 0.4), row(NINE, 90.0, 0, 0.1), row(NINE_CACHED, 1.0, 0, 0.0)]);
        let of = |rows: &[TreesRow]| speedup_at_equal_error(&rows.iter().collect::<Vec<_>>(), NINE);
        let found = of(&rows).unwrap();
        assert_eq!((found.ratio, found.as_exact, found.wrong), (25.0, true, [1, 1]));
        // Where none is, against the most exact.
        rows[0].error = 0.01;
        let found = of(&rows).unwrap();
        assert_eq!((found.ratio, found.as_exact, found.wrong), (45.0, false, [1, 0]));
        assert!(of(&rows[1..]).is_none() && of(&rows[..1]).is_none());
    }
}
