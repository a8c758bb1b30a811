//! What an experiment is.

use std::io;
use std::path::PathBuf;

use horizon_field::FieldError;
use horizon_field::trees::ForestError;
use horizon_field::waves::WavesError;
use serde_json::{Map, Value};
use thiserror::Error;

use crate::context::Context;
use crate::plot::{Chart, PlotError};
use crate::readme::FigureError;
use crate::store::StoreError;

/// Something to measure, to draw and to sum up. Measuring only writes tables; drawing and summing up only read them.
pub trait Experiment {
    /// What `--only` calls it.
    fn name(&self) -> &'static str;

    /// What it asks, in a line.
    fn about(&self) -> &'static str;

    /// The tables that it writes. The first one tells whether it was ever measured.
    fn tables(&self) -> &'static [&'static str];

    /// Measures the rows that are not there yet.
    fn measure(&self, ctx: &Context) -> Result<(), ChartsError>;

    /// Draws the tables.
    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError>;

    /// Sums the tables up: entries for the top level of `summary.json`.
    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError>;
}

/// A chart and its file's name, without `.svg`.
#[derive(Clone, Debug)]
pub struct NamedChart {
    /// The name.
    pub name: String,
    /// The chart.
    pub chart: Chart,
}

impl NamedChart {
    /// A chart under a name.
    pub fn new(name: impl Into<String>, chart: impl Into<Chart>) -> Self {
        Self { name: name.into(), chart: chart.into() }
    }
}

/// Why a run failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ChartsError {
    /// `--only` named what there is not.
    #[error("there is no experiment `{name}`; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A table failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A chart failed.
    #[error("chart `{chart}`: {source}")]
    Plot {
        /// The chart's name.
        chart: String,
        /// Why.
        source: PlotError,
    },
    /// A field was refused.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A forest was refused.
    #[error(transparent)]
    Forest(#[from] ForestError),
    /// Waves were refused.
    #[error(transparent)]
    Waves(#[from] WavesError),
    /// An image can't be had.
    #[error("{}: {reason}", file.display())]
    Image {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// A figure of the README failed.
    #[error("README.md: {0}")]
    Figure(#[from] FigureError),
    /// The README shows a chart that was not drawn.
    #[error("README.md shows assets/charts/{name}, which was not drawn: run its experiment")]
    NotDrawn {
        /// The chart's file name.
        name: String,
    },
    /// A quick run's figures are not to be quoted.
    #[error("a quick run is not published: leave `--quick` out")]
    QuickPublished,
    /// A summary can't be read.
    #[error("{}: {source}", file.display())]
    Summary {
        /// The file.
        file: PathBuf,
        /// Why.
        source: serde_json::Error,
    },
    /// The file system refused.
    #[error("{}: {source}", file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
}

impl ChartsError {
    /// The file system refused this file.
    pub fn io(file: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        |source| Self::Io { file: file.into(), source }
    }
}
