//! The rows of the two tables: figures, one row for each generator and seed, and the curves behind them.

use serde::{Deserialize, Serialize};

use super::{CURVES, FIGURES};
use crate::context::Context;
use crate::store::{Row, StoreError, Table};

/// What a relief is like, in figures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FigureRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The generator, or [`REAL`](super::REAL).
    pub generator: String,
    /// Its seed.
    pub seed: u32,
    /// Points of the grid along x.
    pub width: usize,
    /// Points of the grid along z.
    pub height: usize,
    /// The exponent of the radially averaged power spectrum.
    pub beta: f64,
    /// The exponent of the rows' power spectrum.
    pub beta_rows: f64,
    /// The mean steepness, in degrees.
    pub slope_mean_deg: f64,
    /// The median steepness.
    pub slope_p50_deg: f64,
    /// The 95th percentile of steepness.
    pub slope_p95_deg: f64,
    /// The 99th percentile of steepness.
    pub slope_p99_deg: f64,
    /// The greatest steepness.
    pub slope_max_deg: f64,
    /// The mean height as a share of the range.
    pub hypsometric_integral: f64,
    /// The third standardised moment of heights.
    pub height_skewness: f64,
    /// How far the exponent is from the real one's.
    pub beta_distance: f64,
    /// The Wasserstein distance of steepness from the real one, in degrees.
    pub slope_distance_deg: f64,
    /// The Wasserstein distance of heights from the real ones, in metres.
    pub height_distance_m: f64,
}

impl Row for FigureRow {
    type Key = (String, u32, usize, usize);

    fn key(&self) -> Self::Key {
        (self.generator.clone(), self.seed, self.width, self.height)
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// What a curve shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Curve {
    /// Power in m⁴ over the wavenumber in cycles per metre.
    Spectrum,
    /// The share of the area per degree over steepness in degrees.
    Slopes,
    /// The height as a share of the range over the share of the area that lies above it.
    Hypsometry,
}

/// A point of a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The generator, or [`REAL`](super::REAL).
    pub generator: String,
    /// Its seed.
    pub seed: u32,
    /// Points of the grid along x.
    pub width: usize,
    /// The curve.
    pub curve: Curve,
    /// The point's index.
    pub index: usize,
    /// The point's place.
    pub x: f64,
    /// The point's value.
    pub y: f64,
}

impl Row for CurveRow {
    type Key = (String, u32, usize, Curve, usize);

    fn key(&self) -> Self::Key {
        (self.generator.clone(), self.seed, self.width, self.curve, self.index)
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// Both tables, open for measuring.
pub(super) struct Tables {
    figures: Table<FigureRow>,
    curves: Table<CurveRow>,
}

impl Tables {
    pub fn open(ctx: &Context) -> Result<Self, StoreError> {
        Ok(Self { figures: ctx.table(FIGURES)?, curves: ctx.table(CURVES)? })
    }

    /// Whether all of a relief is there.
    pub fn have(&self, generator: &str, seed: u32, [width, height]: [usize; 2]) -> bool {
        self.figures.has(&(generator.to_owned(), seed, width, height))
    }

    /// Appends a relief: curves first, so that figures say that all of it is there.
    pub fn write(&mut self, figures: &FigureRow, curves: &[(Curve, Vec<(f64, f64)>)]) -> Result<(), StoreError> {
        for (curve, points) in curves {
            for (index, &(x, y)) in points.iter().enumerate() {
                let FigureRow { run, seed, width, .. } = *figures;
                let generator = figures.generator.clone();
                let row = CurveRow { run, generator, seed, width, curve: *curve, index, x, y };
                // An interrupted run may have left some.
                if !self.curves.has(&row.key()) {
                    self.curves.push(row)?;
                }
            }
        }
        self.figures.push(figures.clone())
    }
}
