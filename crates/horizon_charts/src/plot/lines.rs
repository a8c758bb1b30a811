//! Lines over a parameter, with bands: in one panel, or in panels above one another, such as error and time.

use plotters::prelude::*;

use super::PlotError;
use super::axis::Axis;
use super::sheet::{Area, Frame, INK, Name, colour, failed, frame, mark, names, px, sheet, stroke};
use crate::plot::SIZE;

/// Lines over a parameter.
#[derive(Clone, Debug)]
pub struct Lines {
    /// What was found.
    pub title: String,
    /// How, in small print; may be empty.
    pub note: String,
    /// The parameter.
    pub x: Axis,
    /// The panels, from the top; they share the parameter.
    pub panels: Vec<Panel>,
}

/// A panel.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What was measured.
    pub y: Axis,
    /// The lines.
    pub series: Vec<Series>,
}

/// A line.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// Its points, by ascending parameter.
    pub points: Vec<(f64, f64)>,
    /// The band about it: parameter, low, high. May be empty.
    pub band: Vec<(f64, f64, f64)>,
    /// Whether each point has a mark: for a few points that were measured, not for curves.
    pub marks: bool,
    /// Whether it is what the others are held against: drawn thick and black.
    pub reference: bool,
}

impl Series {
    /// A plain line.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, ..Self::default() }
    }

    /// The line with a mark at each point.
    pub fn marked(self) -> Self {
        Self { marks: true, ..self }
    }

    /// The line with a band.
    pub fn with_band(self, band: Vec<(f64, f64, f64)>) -> Self {
        Self { band, ..self }
    }

    /// The line as what the others are held against.
    pub fn as_reference(self) -> Self {
        Self { reference: true, ..self }
    }
}

pub(super) fn svg(chart: &Lines) -> Result<String, PlotError> {
    let all = || chart.panels.iter().flat_map(|panel| &panel.series);
    let x = chart.x.span(all().flat_map(|s| s.points.iter().map(|p| p.0)), false).ok_or(PlotError::Empty)?;
    sheet(&chart.title, &chart.note, |area, top| {
        let count = chart.panels.len() as i32;
        // The lowest panel holds the parameter's numbers too.
        let height = (SIZE[1] - 8 - 36 - top) / count;
        for (index, panel) in chart.panels.iter().enumerate() {
            let lowest = index + 1 == chart.panels.len();
            let from = top + height * index as i32;
            let to = if lowest { SIZE[1] - 8 } else { from + height };
            let bands = panel.series.iter().flat_map(|s| s.band.iter().flat_map(|b| [b.1, b.2]));
            let values = panel.series.iter().flat_map(|s| s.points.iter().map(|p| p.1)).chain(bands);
            let y = panel.y.span(values, true).ok_or(PlotError::Empty)?;
            let frame = frame(area, [from, to], [&chart.x, &panel.y], [x, y], lowest)?;
            draw(area, &frame, panel)?;
        }
        Ok(())
    })
}

fn draw(area: &Area, frame: &Frame, panel: &Panel) -> Result<(), PlotError> {
    let at = |x: f64, y: f64| frame.backend_coord(&(x, y));
    for (index, series) in panel.series.iter().enumerate() {
        if !series.band.is_empty() {
            let low = series.band.iter().map(|b| at(b.0, b.1));
            let high = series.band.iter().rev().map(|b| at(b.0, b.2));
            let band = Polygon::new(low.chain(high).collect::<Vec<_>>(), ink(index, series).mix(0.13).filled());
            area.draw(&band).map_err(failed)?;
        }
    }
    let mut labels = Vec::new();
    // What the others are held against is drawn last, on top.
    let mut order: Vec<_> = panel.series.iter().enumerate().collect();
    order.sort_by_key(|(_, series)| series.reference);
    for (index, series) in order {
        let shown = series.points.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let places: Vec<_> = shown.map(|(x, y)| at(*x, *y)).collect();
        let Some(&end) = places.last() else { continue };
        let ink = ink(index, series);
        let width = if series.reference { 2.6 } else { 1.8 };
        area.draw(&PathElement::new(places.clone(), stroke(ink, width))).map_err(failed)?;
        if series.marks {
            for place in places {
                mark(area, place, index, ink, 3.5)?;
            }
        }
        labels.push(Name { text: &series.name, colour: ink, mark: None, at: end });
    }
    let (_, heights) = frame.plotting_area().get_pixel_range();
    names(area, &labels, [heights.start + px(6.0), heights.end - px(2.0)])
}

fn ink(index: usize, series: &Series) -> RGBColor {
    if series.reference { INK } else { colour(index) }
}
