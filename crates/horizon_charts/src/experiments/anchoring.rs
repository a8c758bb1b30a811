//! How exact single precision is far from the origin: with lattices anchored near the place, as the device has them, and
//! with absolute coordinates.

use horizon_field::Place;
use horizon_field::field::{Field, Fractal, NoImages};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::readme::short;
use crate::store::Row;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Anchoring;

const TABLE: &str = "anchoring";

/// The errors at a distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnchoringRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The distance from the world's origin along each axis of the plane, in metres.
    pub distance_m: f64,
    /// How many points were asked.
    pub points: u32,
    /// The greatest error with anchors, in metres.
    pub anchored_max_m: f64,
    /// The mean error with anchors, in metres.
    pub anchored_mean_m: f64,
    /// The greatest error of absolute coordinates, in metres.
    pub naive_max_m: f64,
    /// The mean error of absolute coordinates, in metres.
    pub naive_mean_m: f64,
}

impl Row for AnchoringRow {
    type Key = (f64, u32);

    fn key(&self) -> Self::Key {
        (self.distance_m, self.points)
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// Hills of 60 m with details down to 12 cm.
fn meadow() -> Field {
    Field::Fractal(Fractal { wavelength: 500.0, amplitude: 60.0, octaves: 12.0, seed: 21, ..Fractal::default() })
}

/// Measures at a distance; the truth is f64, anchored.
pub fn measure(run: u64, distance: f64, points: u32) -> Result<AnchoringRow, ChartsError> {
    let field = meadow().compile::<2>(&NoImages)?;
    let here = field.anchor(&Place::from_metres([distance, 0.0, distance]));
    let origin = field.anchor(&Place::ORIGIN);
    let (mut anchored, mut naive) = (Vec::new(), Vec::new());
    for i in 0..points {
        // What is near the camera: some ten metres, in steps that no lattice shares.
        let q = [f64::from(i % 1009) * 0.037, f64::from(i % 1013) * 0.053];
        let truth = field.value_f64(&here, q, 0.0);
        let ours = field.value_f32(&here, q.map(|q| q as f32), 0.0);
        let absolute = field.value_f32(&origin, q.map(|q| (distance + q) as f32), 0.0);
        anchored.push((f64::from(ours) - truth).abs());
        naive.push((f64::from(absolute) - truth).abs());
    }
    let max = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let mean = crate::measure::samples::mean;
    Ok(AnchoringRow {
        run,
        distance_m: distance,
        points,
        anchored_max_m: max(&anchored),
        anchored_mean_m: mean(&anchored),
        naive_max_m: max(&naive),
        naive_mean_m: mean(&naive),
    })
}

impl Experiment for Anchoring {
    fn name(&self) -> &'static str {
        "anchoring"
    }

    fn about(&self) -> &'static str {
        "how exact single precision is, 1 m to 10⁹ m from the origin, with anchors and without"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<AnchoringRow>(TABLE)?;
        let points = ctx.pick(2_000, 50_000);
        // Two places a decade.
        let distances: Vec<f64> = (0..10).flat_map(|e| [1.0, 3.0].map(|s| s * 10.0_f64.powi(e))).take(19).collect();
        let progress = ctx.progress(self.name(), distances.len());
        for distance in distances {
            if !table.has(&(distance, points)) {
                table.push(measure(ctx.run, distance, points)?)?;
            }
            progress.done(&format!("{distance} m"));
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ordered(ctx)?;
        let curve = |error: fn(&AnchoringRow) -> f64| rows.iter().map(|r| (r.distance_m, error(r))).collect::<Vec<_>>();
        let worst = rows.iter().map(|row| row.anchored_max_m).fold(0.0, f64::max);
        let farthest = rows.last().map_or(f64::NAN, |row| row.naive_max_m);
        let chart = Lines {
            title: format!(
                "Anchored single precision is off by at most {} mm anywhere; absolute coordinates by {} m at 10⁹ m",
                short(worst * 1000.0),
                short(farthest),
            ),
            note: "Height in f32 against f64: fBm of 12 octaves, first wavelength 500 m, amplitude 60 m.".into(),
            x: Axis::log("distance from the world's origin, m"),
            panels: vec![Panel {
                y: Axis::log("error of the height, m"),
                series: vec![
                    Series::new("anchored, greatest", curve(|row| row.anchored_max_m)).marked(),
                    Series::new("absolute, greatest", curve(|row| row.naive_max_m)).marked(),
                    Series::new("anchored, mean", curve(|row| row.anchored_mean_m)).marked(),
                    Series::new("absolute, mean", curve(|row| row.naive_mean_m)).marked(),
                ],
            }],
        };
        Ok(vec![NamedChart::new("anchoring", chart)])
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let entry = |row: &AnchoringRow| {
            let errors = json!({
                "anchored_max_m": row.anchored_max_m, "anchored_mean_m": row.anchored_mean_m,
                "naive_max_m": row.naive_max_m, "naive_mean_m": row.naive_mean_m,
            });
            (format!("{:e}", row.distance_m), errors)
        };
        let entries: Map<_, _> = ordered(ctx)?.iter().map(entry).collect();
        Ok(Map::from_iter([("anchoring".to_owned(), Value::Object(entries))]))
    }
}

/// The rows by distance; of several at one distance, the one with most points.
fn ordered(ctx: &Context) -> Result<Vec<AnchoringRow>, ChartsError> {
    let mut rows = ctx.rows::<AnchoringRow>(TABLE)?;
    rows.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m).then(b.points.cmp(&a.points)));
    rows.dedup_by(|later, kept| later.distance_m == kept.distance_m);
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absolute_coordinates_fail_where_anchors_hold() {
        let (near, far) = (measure(0, 1.0, 300).unwrap(), measure(0, 1e9, 300).unwrap());
        assert!(near.anchored_max_m < 1e-3 && near.naive_max_m < 1e-2, "{near:?}");
        assert!(far.anchored_max_m < 1e-3 && far.anchored_max_m > 0.0 && far.naive_max_m > 1.0, "{far:?}");
        assert!(far.anchored_mean_m <= far.anchored_max_m);
    }
}
