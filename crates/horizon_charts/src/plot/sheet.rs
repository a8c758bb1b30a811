//! The sheet that every chart is drawn on: paper, ink, colours, marks, title, and the names beside what they name.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::{Axis, Span};
use super::{PlotError, SIZE};

/// Plotters' coordinates are whole numbers; so many of them make a pixel, which keeps lines smooth.
const FINE: i32 = 4;

pub(super) const PAPER: RGBColor = RGBColor(255, 255, 255);
pub(super) const INK: RGBColor = RGBColor(34, 34, 34);
const PALE: RGBColor = RGBColor(96, 96, 96);
const GRID: RGBColor = RGBColor(226, 226, 226);

/// Okabe and Ito's colours without yellow, which white paper swallows, and two of Tol's for longer lists.
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(136, 34, 85),
    RGBColor(153, 153, 51),
];

/// The width of the column of names, in pixels.
pub(super) const NAMES: i32 = 176;
/// The height of a name.
const NAME: i32 = 17;

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Frame<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Span, Span>>;

/// Pixels, in plotters' coordinates.
pub(super) fn px(pixels: f64) -> i32 {
    (pixels * f64::from(FINE)).round() as i32
}

pub(super) fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

/// A line's style of this width in pixels.
pub(super) fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width(px(width) as u32)
}

pub(super) fn failed(error: impl core::fmt::Display) -> PlotError {
    PlotError::Draw(error.to_string())
}

/// Where text stands about its place.
pub(super) type Anchor = (HPos, VPos);

fn font(size: f64, style: FontStyle) -> FontDesc<'static> {
    // Plotters divides by 1.24 for SVG.
    FontDesc::new(FontFamily::SansSerif, f64::from(FINE) * size * 1.24, style)
}

fn style(size: f64, colour: RGBColor, anchor: Anchor, weight: FontStyle) -> TextStyle<'static> {
    TextStyle { color: colour.to_backend_color(), ..TextStyle::from(font(size, weight)) }
        .pos(Pos::new(anchor.0, anchor.1))
}

/// Text at a place in plotters' coordinates.
pub(super) fn text(
    area: &Area,
    words: &str,
    at: (i32, i32),
    size: f64,
    colour: RGBColor,
    anchor: Anchor,
) -> Result<(), PlotError> {
    area.draw_text(words, &style(size, colour, anchor, FontStyle::Normal), at).map_err(failed)
}

/// Draws a chart: `draw` gets the whole sheet and where, in pixels from its top, the title ends.
pub(super) fn sheet(
    title: &str,
    note: &str,
    draw: impl for<'a> FnOnce(&Area<'a>, i32) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let mut svg = String::new();
    let fine = SIZE.map(|pixels| pixels * FINE);
    {
        let area = SVGBackend::with_string(&mut svg, (fine[0] as u32, fine[1] as u32)).into_drawing_area();
        area.fill(&PAPER).map_err(failed)?;
        let mut top = 14;
        let anchor = (HPos::Left, VPos::Top);
        for line in wrap(title, 78) {
            let bold = style(17.0, INK, anchor, FontStyle::Bold);
            area.draw_text(&line, &bold, (px(18.0), px(f64::from(top)))).map_err(failed)?;
            top += 22;
        }
        for line in wrap(note, 130) {
            text(&area, &line, (px(18.0), px(f64::from(top))), 12.0, PALE, anchor)?;
            top += 16;
        }
        draw(&area, top + 6)?;
        area.present().map_err(failed)?;
    }
    let size = |[width, height]: [i32; 2]| format!("width=\"{width}\" height=\"{height}\"");
    Ok(svg.replacen(&size(fine), &size(SIZE), 1))
}

/// A title in lines of at most so many characters.
pub(super) fn wrap(words: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A frame with its axes between two heights of the sheet, in pixels. The lowest one of several has the shared axis's
/// numbers.
pub(super) fn frame<'a>(
    area: &Area<'a>,
    [top, bottom]: [i32; 2],
    axes: [&Axis; 2],
    [x, y]: [Span; 2],
    lowest: bool,
) -> Result<Frame<'a>, PlotError> {
    let below = if lowest { 46 } else { 10 };
    let part = area.clone().shrink((0, px(f64::from(top))), (px(f64::from(SIZE[0])), px(f64::from(bottom - top))));
    let mut frame = ChartBuilder::on(&part)
        .margin_left(px(12.0))
        .margin_top(px(6.0))
        .margin_right(px(f64::from(NAMES)))
        .set_label_area_size(LabelAreaPosition::Left, px(62.0))
        .set_label_area_size(LabelAreaPosition::Bottom, px(f64::from(below)))
        .build_cartesian_2d(x, y)
        .map_err(failed)?;
    let numbers = TextStyle::from(font(12.0, FontStyle::Normal)).color(&INK);
    let words = TextStyle::from(font(13.0, FontStyle::Normal)).color(&INK);
    let mut mesh = frame.configure_mesh();
    mesh.axis_style(stroke(PALE, 1.0))
        .bold_line_style(stroke(GRID, 1.0))
        .light_line_style(TRANSPARENT)
        .set_all_tick_mark_size(px(4.0))
        .x_labels(10)
        .y_labels(((bottom - top) / 45).max(3) as usize)
        .label_style(numbers)
        .axis_desc_style(words)
        .y_desc(axes[1].label.clone());
    if lowest {
        mesh.x_desc(axes[0].label.clone());
    } else {
        mesh.x_label_formatter(&|_| String::new());
    }
    mesh.draw().map_err(failed)?;
    Ok(frame)
}

/// A mark of a series: its shape tells it apart where colours don't.
pub(super) fn mark(area: &Area, at: (i32, i32), index: usize, colour: RGBColor, size: f64) -> Result<(), PlotError> {
    let (r, fill) = (px(size), colour.filled());
    let (x, y) = at;
    let polygon = |corners: &[(i32, i32)]| {
        let corners: Vec<_> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
        area.draw(&Polygon::new(corners, fill)).map_err(failed)
    };
    match index % 4 {
        0 => area.draw(&Circle::new(at, r, fill)).map_err(failed),
        1 => polygon(&[(-r, -r), (r, -r), (r, r), (-r, r)]),
        2 => polygon(&[(0, -r * 5 / 4), (r * 5 / 4, r), (-r * 5 / 4, r)]),
        _ => polygon(&[(0, -r * 4 / 3), (r * 4 / 3, 0), (0, r * 4 / 3), (-r * 4 / 3, 0)]),
    }
}

/// A cross through a point.
pub(super) fn cross(area: &Area, (x, y): (i32, i32), colour: RGBColor, size: f64) -> Result<(), PlotError> {
    let r = px(size);
    for path in [[(x - r, y - r), (x + r, y + r)], [(x - r, y + r), (x + r, y - r)]] {
        area.draw(&PathElement::new(path, stroke(colour, 1.8))).map_err(failed)?;
    }
    Ok(())
}

/// What the column of names says of a series.
pub(super) struct Name<'a> {
    pub text: &'a str,
    pub colour: RGBColor,
    /// The mark's index; `None` draws a piece of line.
    pub mark: Option<usize>,
    /// Where the series ends, in plotters' coordinates.
    pub at: (i32, i32),
}

/// Writes names in the column right of a frame, each as near its height as the others leave it.
pub(super) fn names(area: &Area, names: &[Name], [top, bottom]: [i32; 2]) -> Result<(), PlotError> {
    let mut order: Vec<&Name> = names.iter().collect();
    order.sort_by_key(|name| name.at.1);
    let heights: Vec<i32> = order.iter().map(|name| name.at.1).collect();
    let left = px(f64::from(SIZE[0] - NAMES + 14));
    for (name, y) in order.iter().zip(spread(&heights, px(f64::from(NAME)), [top, bottom])) {
        if name.mark.is_none() {
            let path = [(name.at.0, name.at.1), (left - px(4.0), y), (left + px(8.0), y)];
            area.draw(&PathElement::new(path, stroke(name.colour, 1.0))).map_err(failed)?;
            let swatch = [(left - px(4.0), y), (left + px(8.0), y)];
            area.draw(&PathElement::new(swatch, stroke(name.colour, 2.6))).map_err(failed)?;
        } else if let Some(index) = name.mark {
            mark(area, (left, y), index, name.colour, 4.0)?;
        }
        text(area, name.text, (left + px(13.0), y), 12.0, INK, (HPos::Left, VPos::Center))?;
    }
    Ok(())
}

/// Heights in ascending order, moved apart to at least `gap` and kept within the limits while there is room.
pub(super) fn spread(heights: &[i32], gap: i32, [top, bottom]: [i32; 2]) -> Vec<i32> {
    let mut placed: Vec<i32> = Vec::with_capacity(heights.len());
    for &height in heights {
        placed.push(placed.last().map_or(height, |last| height.max(last + gap)).max(top));
    }
    let mut limit = bottom;
    for height in placed.iter_mut().rev() {
        *height = (*height).min(limit);
        limit = *height - gap;
    }
    placed
}
