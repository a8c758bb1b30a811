//! Measures how fast and how exact the worlds' methods are, and draws it: `cargo charts`.
//!
//! Data flows one way: an [`Experiment`] measures rows into tables ([`store`], one CSV file each), and from the tables
//! alone come the charts ([`plot`], SVG) and the figures ([`summary`], `summary.json`). What the README says of speed is
//! copied out of the summary by [`readme`], so that no figure there is typed by hand. A run that was interrupted goes on
//! where it stopped.
#![deny(missing_docs)]

pub mod columns;
pub mod context;
pub mod experiment;
pub mod experiments;
pub mod gpu;
pub mod march;
pub mod measure;
pub mod pareto;
pub mod plot;
pub mod readme;
pub mod run;
pub mod store;
pub mod summary;

pub use context::Context;
pub use experiment::{ChartsError, Experiment, NamedChart};
pub use run::{Options, run};
pub use store::{Row, StoreError, Table};
