//! Charts as SVG, in one visual language: light ground, one colour and one mark for each series that colour-blind eyes tell
//! apart, names beside the lines in place of a box, units on the axes, and a title that says what was found.

mod axis;
mod bars;
mod lines;
mod scatter;
mod sheet;
#[cfg(test)]
mod tests;

use thiserror::Error;

pub use axis::{Axis, Scale};
pub use bars::{BarSeries, Bars};
pub use lines::{Lines, Panel, Series};
pub use scatter::{Dot, Group, Scatter};

/// The width and the height of a chart, in pixels.
pub const SIZE: [i32; 2] = [860, 520];

/// What is drawn.
#[derive(Clone, Debug)]
pub enum Chart {
    /// Lines over a parameter, in one panel or in several that share it.
    Lines(Lines),
    /// Points of a plane of cost and error, with their Pareto front.
    Scatter(Scatter),
    /// Bars in groups.
    Bars(Bars),
}

/// Why a chart can't be drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// No point of it can be shown.
    #[error("there is nothing to show")]
    Empty,
    /// The drawing failed.
    #[error("{0}")]
    Draw(String),
}

impl Chart {
    /// The chart as SVG. Text is left as text, in whatever sans-serif font the reader has.
    pub fn svg(&self) -> Result<String, PlotError> {
        match self {
            Self::Lines(chart) => lines::svg(chart),
            Self::Scatter(chart) => scatter::svg(chart),
            Self::Bars(chart) => bars::svg(chart),
        }
    }
}

impl From<Lines> for Chart {
    fn from(chart: Lines) -> Self {
        Self::Lines(chart)
    }
}

impl From<Scatter> for Chart {
    fn from(chart: Scatter) -> Self {
        Self::Scatter(chart)
    }
}

impl From<Bars> for Chart {
    fn from(chart: Bars) -> Self {
        Self::Bars(chart)
    }
}
