//! Marching: what each method costs and how far it is off, on the device or on the CPU, and how many times as fast ours is
//! at equal error.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::experiment::NamedChart;
use crate::plot::{Axis, Dot, Group, Scatter};
use crate::readme::short;
use crate::store::{Row, of_one_run};

/// What [`MarchRow::method`] says of the march over the cache. All other methods are its rivals.
pub const OURS: &str = "cached";

/// What marched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Device {
    /// The graphics device.
    Gpu,
    /// The processor.
    Cpu,
}

/// A picture by one method with one setting, against the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MarchRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// What marched.
    pub device: Device,
    /// The view: world, camera and size of the picture.
    pub view: String,
    /// The method; [`OURS`] or a rival.
    pub method: String,
    /// Its settings.
    pub settings: String,
    /// Over how many frames the time was taken.
    pub frames: u64,
    /// The time of a picture, in milliseconds, without the cache's.
    pub ms: f64,
    /// The time that the cache takes of it, in milliseconds: 0 for methods without one.
    pub fill_ms: f64,
    /// Evaluations of the field, for each ray.
    pub evals_per_ray: f64,
    /// Texels of the cache that are read, for each ray: 0 for methods without one.
    pub loads_per_ray: f64,
    /// Pixels outside silhouettes without ground where the truth has some.
    pub missed: u64,
    /// Pixels outside silhouettes with ground where the truth has none.
    #[serde(rename = "false")]
    pub false_hits: u64,
    /// The share of pixels that are silhouettes, which don't count.
    pub silhouette_share: f64,
    /// The mean error along the ray, in footprints of a pixel.
    pub ide_px_mean: f64,
    /// The 99th percentile of the distance to the surface along its normal, in footprints of a pixel.
    pub normal_px_p99: f64,
    /// The mean error of height, in footprints of a pixel.
    pub hde_px_mean: f64,
}

impl Row for MarchRow {
    type Key = (Device, String, String, String);

    fn key(&self) -> Self::Key {
        (self.device, self.view.clone(), self.method.clone(), self.settings.clone())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

impl MarchRow {
    /// The time of a picture with the cache's share, in milliseconds.
    pub fn total_ms(&self) -> f64 {
        self.ms + self.fill_ms
    }

    /// Whether it is ours.
    pub fn is_ours(&self) -> bool {
        self.method == OURS
    }

    /// Pixels that are wrong, not only inexact: missed, or invented.
    pub fn wrong(&self) -> u64 {
        self.missed + self.false_hits
    }

    /// Whether no error is greater than the other's. What is not a number is worse than anything.
    pub fn is_no_worse_than(&self, other: &Self) -> bool {
        self.wrong() <= other.wrong()
            && self.ide_px_mean <= other.ide_px_mean
            && self.normal_px_p99 <= other.normal_px_p99
    }

    /// Whether all that is compared is a number.
    fn is_measured(&self) -> bool {
        [self.ms, self.fill_ms, self.ide_px_mean, self.normal_px_p99].iter().all(|x| x.is_finite())
    }

    /// Whether no error is greater than the other's, but for those in which even `exact` is worse than the other.
    fn is_no_worse_as_far_as(&self, exact: &Self, other: &Self) -> bool {
        let reached = |of: fn(&Self) -> f64| of(self) <= of(other) || of(exact) > of(other);
        self.wrong() <= other.wrong() && reached(|row| row.ide_px_mean) && reached(|row| row.normal_px_p99)
    }

    /// Errors in the order in which they weigh: wrong pixels first.
    fn weight(&self) -> (u64, f64, f64) {
        (self.wrong(), self.ide_px_mean, self.normal_px_p99)
    }
}

/// What was compared with what.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedup {
    /// How many times as fast ours is.
    pub ratio: f64,
    /// Our settings.
    pub ours: String,
    /// The time of our picture with the cache's share, in milliseconds.
    pub ours_ms: f64,
    /// The rival's method and settings.
    pub rival: String,
    /// The time of its picture, in milliseconds.
    pub rival_ms: f64,
    /// Whether no rival is as exact as ours at its most exact, so that ours was loosened to the most exact rival.
    pub loosened: bool,
    /// The mean error along the ray, in pixels: ours and the rival's.
    pub ide_px_mean: [f64; 2],
    /// The 99th percentile of the distance to the surface, in pixels: ours and the rival's.
    pub normal_px_p99: [f64; 2],
    /// Wrong pixels: ours and the rival's.
    pub wrong: [u64; 2],
}

fn least<'a>(
    rows: impl IntoIterator<Item = &'a MarchRow>,
    by: impl Fn(&MarchRow) -> (u64, f64, f64),
) -> Option<&'a MarchRow> {
    rows.into_iter().min_by(|a, b| by(a).partial_cmp(&by(b)).expect("rows are measured"))
}

fn fastest<'a>(rows: impl IntoIterator<Item = &'a MarchRow>) -> Option<&'a MarchRow> {
    least(rows, |row| (0, row.total_ms(), 0.0))
}

/// The row with the least errors: wrong pixels first, then the mean along the ray, then the 99th percentile along the
/// normal. Rows with errors or times that are not numbers don't count.
pub fn most_exact<'a>(rows: impl IntoIterator<Item = &'a MarchRow>) -> Option<&'a MarchRow> {
    least(rows.into_iter().filter(|row| row.is_measured()), MarchRow::weight)
}

/// How many times as fast ours is at equal error, over the rows of one view, device and run.
///
/// Ours, at its most exact, is held against the fastest rival that is no worse in any error. Where none is as exact, the most
/// exact rival is held against our fastest setting that is no worse than it: in wrong pixels, and in those of the two other
/// errors in which ours can be. `None` where ours has more wrong pixels, or is worse in both.
pub fn speedup_at_equal_error<'a>(rows: impl IntoIterator<Item = &'a MarchRow>) -> Option<Speedup> {
    let (ours, rivals): (Vec<_>, Vec<_>) =
        rows.into_iter().filter(|row| row.is_measured()).partition(|row| row.is_ours());
    let exact = most_exact(ours.iter().copied())?;
    let reaching = fastest(rivals.iter().copied().filter(|rival| rival.is_no_worse_than(exact)));
    let (ours, rival) = match reaching {
        Some(rival) => (exact, rival),
        None => {
            let rival = most_exact(rivals)?;
            if exact.ide_px_mean > rival.ide_px_mean && exact.normal_px_p99 > rival.normal_px_p99 {
                return None;
            }
            (fastest(ours.into_iter().filter(|row| row.is_no_worse_as_far_as(exact, rival)))?, rival)
        }
    };
    Some(Speedup {
        ratio: rival.total_ms() / ours.total_ms(),
        ours: ours.settings.clone(),
        ours_ms: ours.total_ms(),
        rival: format!("{} {}", rival.method, rival.settings),
        rival_ms: rival.total_ms(),
        loosened: reaching.is_none(),
        ide_px_mean: [ours.ide_px_mean, rival.ide_px_mean],
        normal_px_p99: [ours.normal_px_p99, rival.normal_px_p99],
        wrong: [ours, rival].map(MarchRow::wrong),
    })
}

/// A device's views in the order of the table, each with the rows of one run; of a setting that was tried and then timed
/// well, the row with most frames, and of several the last.
fn views(rows: &[MarchRow], device: Device) -> Vec<(&str, Vec<&MarchRow>)> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| row.device == device) {
        if !names.contains(&row.view.as_str()) {
            names.push(&row.view);
        }
    }
    let of = |name: &str| {
        let mut kept: Vec<&MarchRow> = Vec::new();
        for row in of_one_run(rows.iter().filter(|row| row.device == device && row.view == name)) {
            match kept.iter_mut().find(|other| other.key() == row.key()) {
                Some(other) if row.frames >= other.frames => *other = row,
                Some(_) => {}
                None => kept.push(row),
            }
        }
        kept
    };
    names.into_iter().map(|name| (name, of(name))).collect()
}

/// What a device's rows say: entries for the top level of the summary. `march` lists the rows,
/// `march_speedup_at_equal_error` has a ratio for each view, `march_compared` what stands behind it; for the CPU they begin
/// with `march_cpu`.
pub fn summary(rows: &[MarchRow], device: Device) -> Map<String, Value> {
    let prefix = if device == Device::Gpu { "march" } else { "march_cpu" };
    let (mut list, mut ratios, mut compared) = (Vec::new(), Map::new(), Map::new());
    for (view, rows) in views(rows, device) {
        if let Some(speedup) = speedup_at_equal_error(rows.iter().copied()) {
            ratios.insert(view.to_owned(), json!(speedup.ratio));
            compared.insert(view.to_owned(), json!(speedup));
        }
        list.extend(rows.iter().map(|row| json!(row)));
    }
    let entries = [("", json!(list)), ("_speedup_at_equal_error", json!(ratios)), ("_compared", json!(compared))];
    entries.into_iter().map(|(name, value)| (format!("{prefix}{name}"), value)).collect()
}

/// A chart of speed against accuracy for each of a device's views.
pub fn charts(rows: &[MarchRow], device: Device) -> Vec<NamedChart> {
    let name = if device == Device::Gpu { "march" } else { "march_cpu" };
    let chart = |(view, rows): (&str, Vec<&MarchRow>)| NamedChart::new(format!("{name}_{view}"), plane(view, &rows));
    views(rows, device).into_iter().map(chart).collect()
}

/// The plane of time and error of a view.
pub fn plane(view: &str, rows: &[&MarchRow]) -> Scatter {
    let mut groups: Vec<Group> = Vec::new();
    for row in rows {
        let dot = Dot {
            x: row.total_ms(),
            y: row.ide_px_mean,
            missed: row.wrong() > 0,
            label: if row.is_ours() { row.settings.clone() } else { String::new() },
        };
        match groups.iter_mut().find(|group| group.name == row.method) {
            Some(group) => group.dots.push(dot),
            None => groups.push(Group { name: row.method.clone(), dots: vec![dot] }),
        }
    }
    // Ours first: it then has the same colour and mark in all charts.
    groups.sort_by_key(|group| group.name != OURS);
    let title = match speedup_at_equal_error(rows.iter().copied()) {
        Some(found) => format!("View “{view}”: {OURS} is {} times as fast at equal error", short(found.ratio)),
        None => format!("View “{view}”: speed against accuracy"),
    };
    Scatter {
        title,
        note: "Each point is a setting. Silhouettes are left out; the cache's share of time is counted.".into(),
        x: Axis::log("time of a picture, ms"),
        y: Axis::log("mean error along the ray, pixels"),
        groups,
        missed: "has wrong pixels".into(),
    }
}

#[cfg(test)]
mod tests;
