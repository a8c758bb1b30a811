//! The plane of cost and error: a point for each setting, the front of what nothing else beats, and a cross where pixels
//! were missed, for what misses is not to be had at any price.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::sheet::{INK, NAMES, Name, colour, cross, failed, frame, mark, names, px, sheet, stroke, text};
use super::{PlotError, SIZE};
use crate::pareto;

/// Points of cost and error.
#[derive(Clone, Debug)]
pub struct Scatter {
    /// What was found.
    pub title: String,
    /// How, in small print; may be empty.
    pub note: String,
    /// The cost.
    pub x: Axis,
    /// The error.
    pub y: Axis,
    /// The methods.
    pub groups: Vec<Group>,
    /// What a cross says; the column of names explains it where there is one.
    pub missed: String,
}

/// A method.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Its points, one for each setting.
    pub dots: Vec<Dot>,
}

/// A point.
#[derive(Clone, Debug, Default)]
pub struct Dot {
    /// The cost.
    pub x: f64,
    /// The error.
    pub y: f64,
    /// Whether it missed pixels: it then has a cross, and no place on the front.
    pub missed: bool,
    /// What stands beside it; may be empty.
    pub label: String,
}

pub(super) fn svg(chart: &Scatter) -> Result<String, PlotError> {
    let shown = |dot: &&Dot| dot.x.is_finite() && dot.y.is_finite();
    let dots: Vec<&Dot> = chart.groups.iter().flat_map(|group| &group.dots).filter(shown).collect();
    let x = chart.x.span(dots.iter().map(|dot| dot.x), true).ok_or(PlotError::Empty)?;
    let y = chart.y.span(dots.iter().map(|dot| dot.y), true).ok_or(PlotError::Empty)?;
    sheet(&chart.title, &chart.note, |area, top| {
        let frame = frame(area, [top, SIZE[1] - 8], [&chart.x, &chart.y], [x, y], true)?;
        let at = |dot: &Dot| frame.backend_coord(&(dot.x, dot.y));
        let whole: Vec<&Dot> = dots.iter().copied().filter(|dot| !dot.missed).collect();
        let points: Vec<_> = whole.iter().map(|dot| (dot.x, dot.y)).collect();
        let front = pareto::front(&points).map_err(failed)?;
        // Between two points of the front there is nothing: it goes in steps.
        let mut path: Vec<(i32, i32)> = Vec::new();
        for place in front.iter().map(|&index| at(whole[index])) {
            path.extend(path.last().map(|last| (place.0, last.1)));
            path.push(place);
        }
        if path.len() > 1 {
            area.draw(&PathElement::new(path, stroke(INK, 1.2))).map_err(failed)?;
        }
        for (index, group) in chart.groups.iter().enumerate() {
            for dot in group.dots.iter().filter(shown) {
                let place = at(dot);
                mark(area, place, index, colour(index), 4.5)?;
                if dot.missed {
                    cross(area, place, INK, 5.5)?;
                }
                let beside = (place.0 + px(8.0), place.1 - px(7.0));
                text(area, &dot.label, beside, 10.5, INK, (HPos::Left, VPos::Center))?;
            }
        }
        let (_, heights) = frame.plotting_area().get_pixel_range();
        let first = (0, heights.start + px(8.0));
        let mut key: Vec<Name> = Vec::new();
        for (index, group) in chart.groups.iter().enumerate() {
            key.push(Name { text: &group.name, colour: colour(index), mark: Some(index), at: first });
        }
        names(area, &key, [heights.start, heights.end])?;
        let below = first.1 + px(17.0 * (key.len() as f64 + 0.5));
        let left = px(f64::from(SIZE[0] - NAMES + 14));
        let line = |row: f64| below + px(17.0 * row);
        let beside = |words: &str, row: f64| {
            text(area, words, (left + px(13.0), line(row)), 12.0, INK, (HPos::Left, VPos::Center))
        };
        let piece = [(left - px(4.0), line(0.0)), (left + px(6.0), line(0.0))];
        area.draw(&PathElement::new(piece, stroke(INK, 1.2))).map_err(failed)?;
        beside("Pareto front", 0.0)?;
        if dots.iter().any(|dot| dot.missed) {
            cross(area, (left, line(1.0)), INK, 5.0)?;
            beside(&chart.missed, 1.0)?;
        }
        Ok(())
    })
}
