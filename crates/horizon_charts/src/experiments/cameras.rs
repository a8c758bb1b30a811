//! Cameras drawn by lot over fields drawn by lot: does the march miss a pixel, or invent one?

use bevy_horizon_workspace::judge::{Judge, by_lot};
use horizon_field::Place;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::store::Row;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Cameras;

const TABLE: &str = "cameras";
/// Over ten thousand rays.
const SIZE: [usize; 2] = [134, 76];

/// A camera and its field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The lot's seed.
    pub seed: u32,
    /// Rays.
    pub rays: u64,
    /// Pixels outside silhouettes without ground where the truth has some.
    pub missed: u64,
    /// Pixels outside silhouettes with ground where the truth has none.
    #[serde(rename = "false")]
    pub false_hits: u64,
    /// The share of pixels that are silhouettes.
    pub silhouette_share: f64,
    /// The mean error along the ray, in pixels.
    pub ide_px_mean: f64,
    /// The 99th percentile of the distance to the surface, in pixels.
    pub normal_px_p99: f64,
}

impl Row for CameraRow {
    type Key = u32;

    fn key(&self) -> u32 {
        self.seed
    }

    fn run(&self) -> u64 {
        self.run
    }
}

impl Experiment for Cameras {
    fn name(&self) -> &'static str {
        "cameras"
    }

    fn about(&self) -> &'static str {
        "missed and invented pixels of cameras drawn by lot (`--seeds N` of them)"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<CameraRow>(TABLE)?;
        let seeds: Vec<u32> = (0..ctx.seeds).filter(|seed| !table.has(seed)).collect();
        if seeds.is_empty() {
            return Ok(());
        }
        let progress = ctx.progress(self.name(), seeds.len());
        let mut judge = Judge::new(SIZE);
        for seed in seeds {
            let report = judge.report(&by_lot(seed), Place::ORIGIN)?;
            table.push(CameraRow {
                run: ctx.run,
                seed,
                rays: report.pixels as u64,
                missed: report.missed as u64,
                false_hits: report.false_hits as u64,
                silhouette_share: report.silhouette_share(),
                ide_px_mean: report.ide_pixels.mean,
                normal_px_p99: report.surface.p99,
            })?;
            progress.done(&format!("seed {seed}: {} missed, {} false", report.missed, report.false_hits));
        }
        Ok(())
    }

    fn draw(&self, _: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        Ok(Vec::new())
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<CameraRow>(TABLE)?;
        let sum = |of: fn(&CameraRow) -> u64| rows.iter().map(of).sum::<u64>();
        let most = |of: fn(&CameraRow) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        let found = json!({
            "cameras": rows.len(),
            "rays": sum(|row| row.rays),
            "missed": sum(|row| row.missed),
            "false": sum(|row| row.false_hits),
            "worst_ide_px_mean": most(|row| row.ide_px_mean),
            "worst_normal_px_p99": most(|row| row.normal_px_p99),
        });
        Ok(Map::from_iter([("cameras".to_owned(), found)]))
    }
}
