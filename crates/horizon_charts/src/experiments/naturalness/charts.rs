//! The charts: spectra, slopes and hypsometric curves over bands of all seeds, and the distances from real ground.

use super::table::{Curve, CurveRow, FigureRow};
use super::{REAL, by_generator, generators};
use crate::experiment::NamedChart;
use crate::measure::samples::{ascending, median, quantile};
use crate::plot::{Axis, BarSeries, Bars, Lines, Panel, Series};
use crate::readme::short;

pub(super) fn all(figures: &[FigureRow], curves: &[CurveRow]) -> Vec<NamedChart> {
    vec![
        NamedChart::new("naturalness_spectra", spectra(figures, curves)),
        NamedChart::new("naturalness_slopes", slopes(figures, curves)),
        NamedChart::new("naturalness_hypsometry", hypsometry(figures, curves)),
        NamedChart::new("naturalness_distances", distances(figures)),
    ]
}

const NOTE: &str = "Same grid (74.5 × 92.6 m) and range of heights. Lines: medians over seeds; bands: all seeds.";

fn shown(generator: &str) -> &str {
    let known = generators::ALL.iter().find(|g| g.name == generator);
    known.map_or(if generator == REAL { "real ground" } else { generator }, |g| g.title)
}

/// The generator whose median of a figure is least, real ground apart.
fn closest(figures: &[FigureRow], value: fn(&FigureRow) -> f64) -> Option<(&str, f64)> {
    middles(figures, value).into_iter().filter(|(name, _)| *name != REAL).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The median of a figure, for each generator.
fn middles(figures: &[FigureRow], value: fn(&FigureRow) -> f64) -> Vec<(&str, f64)> {
    let groups = by_generator(figures).into_iter();
    groups.map(|(name, rows)| (name, median(rows.into_iter().map(value)))).collect()
}

/// The curves of one kind: for each generator the median over seeds, with a band over all.
fn series(curves: &[CurveRow], kind: Curve) -> Vec<Series> {
    let mut names: Vec<&str> = Vec::new();
    for row in curves {
        if !names.contains(&row.generator.as_str()) {
            names.push(&row.generator);
        }
    }
    // Real ground comes last, so that generators have the palette's first colours.
    names.sort_by_key(|name| *name == REAL);
    let of = |name: &str| {
        let rows: Vec<_> = curves.iter().filter(|row| row.generator == name && row.curve == kind).collect();
        let count = rows.iter().map(|row| row.index + 1).max().unwrap_or(0);
        let (mut points, mut band) = (Vec::new(), Vec::new());
        for index in 0..count {
            let here: Vec<_> = rows.iter().filter(|row| row.index == index).collect();
            let values = ascending(here.iter().map(|row| row.y));
            let Some(first) = here.first() else { continue };
            points.push((first.x, quantile(&values, 0.5)));
            band.push((first.x, values[0], values[values.len() - 1]));
        }
        let series = Series::new(shown(name), points);
        if name == REAL { series.as_reference() } else { series.with_band(band) }
    };
    names.into_iter().map(of).collect()
}

fn real(figures: &[FigureRow], value: fn(&FigureRow) -> f64) -> f64 {
    figures.iter().find(|row| row.generator == REAL).map_or(f64::NAN, value)
}

fn spectra(figures: &[FigureRow], curves: &[CurveRow]) -> Lines {
    let mut series = series(curves, Curve::Spectrum);
    for point in series.iter_mut().flat_map(|series| &mut series.points) {
        point.0 *= 1000.0;
    }
    for point in series.iter_mut().flat_map(|series| &mut series.band) {
        point.0 *= 1000.0;
    }
    let title = closest(figures, |row| row.beta_distance).map_or(String::new(), |(name, _)| {
        let beta = middles(figures, |row| row.beta).into_iter().find(|(n, _)| *n == name).map_or(f64::NAN, |m| m.1);
        let truth = real(figures, |row| row.beta);
        format!("“{}” falls off most like real ground: exponent {beta:.2} against {truth:.2}", shown(name))
    });
    Lines {
        title: title.replace('-', "−"),
        note: NOTE.into(),
        x: Axis::log("wavenumber, cycles per km"),
        panels: vec![Panel { y: Axis::log("power spectral density, m⁴"), series }],
    }
}

fn slopes(figures: &[FigureRow], curves: &[CurveRow]) -> Lines {
    let mut series = series(curves, Curve::Slopes);
    for point in series.iter_mut().flat_map(|series| &mut series.points) {
        point.1 *= 100.0;
    }
    for band in series.iter_mut().flat_map(|series| &mut series.band) {
        (band.1, band.2) = (band.1 * 100.0, band.2 * 100.0);
    }
    let title = closest(figures, |row| row.slope_distance_deg).map_or(String::new(), |(name, distance)| {
        format!("“{}” has the most real slopes: {}° off in the mean", shown(name), short(distance))
    });
    Lines {
        title,
        note: NOTE.into(),
        x: Axis::linear("steepness, degrees"),
        panels: vec![Panel { y: Axis::linear("share of the area per degree, %"), series }],
    }
}

fn hypsometry(figures: &[FigureRow], curves: &[CurveRow]) -> Lines {
    let title = closest(figures, |row| row.height_distance_m).map_or(String::new(), |(name, distance)| {
        format!("“{}” has the most real heights: {} m off in the mean", shown(name), short(distance))
    });
    Lines {
        title,
        note: NOTE.into(),
        x: Axis::linear("share of the area that lies above"),
        panels: vec![Panel {
            y: Axis::linear("height, as a share of the range").from_to(0.0, 1.0),
            series: series(curves, Curve::Hypsometry),
        }],
    }
}

/// Distances from real ground, as multiples of plain fBm's: so that three units share an axis.
fn distances(figures: &[FigureRow]) -> Bars {
    let of = |name: &str, value: fn(&FigureRow) -> f64| {
        let all = middles(figures, value);
        let base = all.iter().find(|(name, _)| *name == generators::ALL[0].name).map_or(f64::NAN, |(_, v)| *v);
        let values = all.into_iter().filter(|(name, _)| *name != REAL).map(|(_, v)| v / base).collect();
        BarSeries { name: name.into(), values }
    };
    let series = vec![
        of("spectral exponent", |row| row.beta_distance),
        of("slopes", |row| row.slope_distance_deg),
        of("heights", |row| row.height_distance_m),
    ];
    let categories: Vec<&str> = by_generator(figures).into_iter().map(|(n, _)| n).filter(|n| *n != REAL).collect();
    // The one that is best on the whole: by the mean of the three.
    let whole = |at: usize| series.iter().map(|s| s.values[at]).sum::<f64>() / series.len() as f64;
    let best = (0..categories.len()).min_by(|a, b| whole(*a).total_cmp(&whole(*b)));
    let title = best.map_or(String::new(), |best| {
        format!(
            "On the whole “{}” is nearest to real ground: {} of plain fBm's distance",
            shown(categories[best]),
            short(whole(best)),
        )
    });
    Bars {
        title,
        note: "Medians over seeds. Slopes and heights: Wasserstein distance of their distributions.".into(),
        x: "generator".into(),
        y: Axis::linear("distance from real ground; plain fBm = 1"),
        categories: categories.into_iter().map(|name| shown(name).to_owned()).collect(),
        series,
    }
}
