//! How natural generated ground is. Seed 000 (§4.1.1) asked people, who preferred its dual height map and found domain
//! distortion no better; here figures answer: spectrum, slopes and hypsometry, beside those of real ground.
//!
//! Every generator is sampled on the grid of the real height map, without the waves that such a grid can't show, and is
//! stretched to the same range of heights.

mod charts;
mod generators;
mod table;

use horizon_field::Place;
use horizon_field::field::{HeightImage, NoImages};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::measure::Relief;
use crate::measure::samples::{ascending, mean, median, quantile, skewness, wasserstein};
use crate::measure::{relief, spectrum};
use table::Tables;
pub use table::{Curve, CurveRow, FigureRow};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Naturalness;

const FIGURES: &str = "naturalness";
const CURVES: &str = "naturalness_curves";

/// What the tables call the real height map.
pub const REAL: &str = "real";

/// The wavelengths in metres between which spectra are fitted: what the map resolves, and a quarter of it.
const FITTED: [f64; 2] = [300.0, 8000.0];
/// The spacing of the map's pixels along x and z, in metres (assets/heights/README.md).
const SPACING: [f64; 2] = [74.5, 92.6];

/// The real height map: the Jacksboro fault. A pixel's value is metres.
pub fn real(ctx: &Context) -> Result<Relief, ChartsError> {
    let file = ctx.root.join("assets/heights/jacksboro-fault.png");
    let bytes = std::fs::read(&file).map_err(ChartsError::io(&file))?;
    let image = HeightImage::from_png(&bytes).map_err(|reason| ChartsError::Image { file, reason })?;
    let size = [image.width as usize, image.height as usize];
    // A quick run takes a part of it.
    let part = ctx.pick(size.map(|count| count / 2), size);
    Ok(Relief::new(part, SPACING, |x, z| f64::from(image.texels[z * size[0] + x])))
}

/// What is kept of a relief to hold others against it.
struct Measured {
    figures: FigureRow,
    curves: Vec<(Curve, Vec<(f64, f64)>)>,
    slopes: Vec<f64>,
    heights: Vec<f64>,
}

fn measured(ctx: &Context, generator: &str, seed: u32, relief: &Relief) -> Measured {
    let radial = spectrum::radial(relief, 28);
    let slopes = relief.slopes();
    let figures = FigureRow {
        run: ctx.run,
        generator: generator.to_owned(),
        seed,
        width: relief.size[0],
        height: relief.size[1],
        beta: spectrum::exponent(&radial, FITTED),
        beta_rows: spectrum::exponent(&spectrum::rows(relief), FITTED),
        slope_mean_deg: mean(&slopes),
        slope_p50_deg: quantile(&slopes, 0.5),
        slope_p95_deg: quantile(&slopes, 0.95),
        slope_p99_deg: quantile(&slopes, 0.99),
        slope_max_deg: quantile(&slopes, 1.0),
        hypsometric_integral: relief.hypsometric_integral(),
        height_skewness: skewness(&relief.heights),
        beta_distance: 0.0,
        slope_distance_deg: 0.0,
        height_distance_m: 0.0,
    };
    let curves = vec![
        (Curve::Spectrum, radial),
        (Curve::Slopes, relief::histogram(&slopes, 60, [0.0, 60.0])),
        (Curve::Hypsometry, relief.hypsometric_curve(50)),
    ];
    Measured { figures, curves, slopes, heights: ascending(relief.heights.iter().copied()) }
}

impl Measured {
    fn held_against(mut self, real: &Self) -> Self {
        self.figures.beta_distance = (self.figures.beta - real.figures.beta).abs();
        self.figures.slope_distance_deg = wasserstein(&self.slopes, &real.slopes);
        self.figures.height_distance_m = wasserstein(&self.heights, &real.heights);
        self
    }
}

impl Experiment for Naturalness {
    fn name(&self) -> &'static str {
        "naturalness"
    }

    fn about(&self) -> &'static str {
        "spectrum, slopes and hypsometry of each generator, beside real ground"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[FIGURES, CURVES]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut tables = Tables::open(ctx)?;
        let ground = real(ctx)?;
        let (size, spacing, range) = (ground.size, ground.spacing, ground.range());
        let truth = measured(ctx, REAL, 0, &ground);
        let progress = ctx.progress(self.name(), 1 + generators::ALL.len());
        if !tables.have(REAL, 0, size) {
            tables.write(&truth.figures, &truth.curves)?;
        }
        progress.done(REAL);
        for generator in &generators::ALL {
            for seed in 0..ctx.pick(2, 8) {
                if tables.have(generator.name, seed, size) {
                    continue;
                }
                let field = (generator.field)(seed).compile::<2>(&NoImages)?;
                // Places without anything in common.
                let anchors = field.anchor(&Place::from_metres([1e5 * f64::from(seed), 0.0, 3e5]));
                let height = |x: usize, z: usize| {
                    let q = [x as f64 * spacing[0], z as f64 * spacing[1]];
                    field.value_f64(&anchors, q, spacing[0].max(spacing[1]))
                };
                let relief = Relief::new(size, spacing, height).normalised(range);
                let found = measured(ctx, generator.name, seed, &relief).held_against(&truth);
                tables.write(&found.figures, &found.curves)?;
            }
            progress.done(generator.name);
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        Ok(charts::all(&ctx.rows(FIGURES)?, &ctx.rows(CURVES)?))
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<FigureRow>(FIGURES)?;
        let entries: Map<_, _> = by_generator(&rows)
            .into_iter()
            .map(|(name, rows)| {
                let middle = |value: fn(&FigureRow) -> f64| median(rows.iter().map(|row| value(row)));
                let figures = json!({
                    "beta": middle(|row| row.beta),
                    "beta_rows": middle(|row| row.beta_rows),
                    "slope_mean_deg": middle(|row| row.slope_mean_deg),
                    "slope_p50_deg": middle(|row| row.slope_p50_deg),
                    "slope_p95_deg": middle(|row| row.slope_p95_deg),
                    "slope_p99_deg": middle(|row| row.slope_p99_deg),
                    "hypsometric_integral": middle(|row| row.hypsometric_integral),
                    "height_skewness": middle(|row| row.height_skewness),
                    "beta_distance": middle(|row| row.beta_distance),
                    "slope_distance_deg": middle(|row| row.slope_distance_deg),
                    "height_distance_m": middle(|row| row.height_distance_m),
                });
                (name.to_owned(), figures)
            })
            .collect();
        Ok(Map::from_iter([("naturalness".to_owned(), Value::Object(entries))]))
    }
}

/// The rows of each generator, in the order of the table.
fn by_generator(rows: &[FigureRow]) -> Vec<(&str, Vec<&FigureRow>)> {
    let mut groups: Vec<(&str, Vec<&FigureRow>)> = Vec::new();
    for row in rows {
        match groups.iter_mut().find(|(name, _)| *name == row.generator) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((&row.generator, vec![row])),
        }
    }
    groups
}

#[cfg(test)]
mod tests;
