//! Bars in groups.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, Span};
use super::sheet::{INK, Name, colour, failed, frame, names, px, sheet, text, wrap};
use super::{PlotError, SIZE};
use crate::readme::rounded;

/// Bars in groups: a group for each category, in it a bar for each series.
#[derive(Clone, Debug)]
pub struct Bars {
    /// What was found.
    pub title: String,
    /// How, in small print; may be empty.
    pub note: String,
    /// What the categories are.
    pub x: String,
    /// What was measured. Bars begin at 0.
    pub y: Axis,
    /// The categories, from the left.
    pub categories: Vec<String>,
    /// The series.
    pub series: Vec<BarSeries>,
}

/// A series of bars.
#[derive(Clone, Debug)]
pub struct BarSeries {
    /// Its name.
    pub name: String,
    /// A value for each category; what is not a number has no bar.
    pub values: Vec<f64>,
}

/// The share of a category's width that its bars take.
const FILLED: f64 = 0.8;

pub(super) fn svg(chart: &Bars) -> Result<String, PlotError> {
    let values = chart.series.iter().flat_map(|series| series.values.iter().copied());
    let most = values.filter(|value| value.is_finite()).fold(f64::NEG_INFINITY, f64::max);
    let count = chart.categories.len();
    if most == f64::NEG_INFINITY || count == 0 {
        return Err(PlotError::Empty);
    }
    let y = Span { low: 0.0, high: if most > 0.0 { most * 1.08 } else { 1.0 }, log: false };
    let x = Span { low: 0.0, high: count as f64, log: false };
    sheet(&chart.title, &chart.note, |area, top| {
        // Of the horizontal axis only the line is wanted: categories have names, not numbers.
        let bottom = SIZE[1] - 8 - 40;
        let frame = frame(area, [top, bottom], [&Axis::linear(""), &chart.y], [x, y], false)?;
        let at = |x: f64, y: f64| frame.backend_coord(&(x, y));
        let width = FILLED / chart.series.len() as f64;
        let (_, heights) = frame.plotting_area().get_pixel_range();
        for (category, name) in chart.categories.iter().enumerate() {
            let from = category as f64 + (1.0 - FILLED) / 2.0;
            for (index, series) in chart.series.iter().enumerate() {
                let Some(value) = series.values.get(category).filter(|value| value.is_finite()) else { continue };
                let (left, right) = (from + width * index as f64, from + width * (index as f64 + 0.94));
                let corners = [at(left, 0.0), at(right, *value)];
                area.draw(&Rectangle::new(corners, colour(index).filled())).map_err(failed)?;
                let above = (corners[0].0.midpoint(corners[1].0), corners[1].1 - px(3.0));
                text(area, &rounded(*value, 2), above, 10.0, INK, (HPos::Center, VPos::Bottom))?;
            }
            let middle = at(category as f64 + 0.5, 0.0).0;
            for (line, words) in wrap(name, 14).iter().enumerate() {
                let below = (middle, heights.end + px(10.0 + 14.0 * line as f64));
                text(area, words, below, 12.0, INK, (HPos::Center, VPos::Top))?;
            }
        }
        let centre = (at(count as f64 / 2.0, 0.0).0, px(f64::from(SIZE[1] - 6)));
        text(area, &chart.x, centre, 13.0, INK, (HPos::Center, VPos::Bottom))?;
        let place = (0, heights.start + px(8.0));
        let series = chart.series.iter().enumerate();
        let key: Vec<_> = series
            .map(|(index, series)| Name { text: &series.name, colour: colour(index), mark: Some(1), at: place })
            .collect();
        names(area, &key, [heights.start, heights.end])
    })
}
