//! The sky of each model, and of Bevy's own `Atmosphere`, against the Monte Carlo reference and in pictures; what each adds to a frame, and
//! how large its tables are.

mod scene;
mod truth;

use bevy::math::DVec3;
use bevy_horizon::prelude::*;
use horizon_light::reference::picture::{ALTITUDE, HEIGHT, VIEWS, View, WIDTH, passes_sun, sees_sky};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::measure::samples::median;
use crate::plot::{Axis, Dot, Group, Scatter};
use crate::store::Row;
use scene::{Model, Scene};
use truth::{MEDIUM, cases};

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Sky;

const TABLE: &str = "sky";
const FULL: [u32; 2] = [1280, 720];
const PICTURE: [u32; 2] = [WIDTH as u32, HEIGHT as u32];
/// By how much the sun turns in a frame while time is taken, in radians: so much that tables are made anew.
const TURN: f32 = 2e-3;

/// A model under one sun, from one altitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkyRow {
    /// When the run began, in seconds since 1970.
    pub run: u64,
    /// The model.
    pub model: String,
    /// The sun's zenith angle and the altitude.
    pub view: String,
    /// What the sky adds to a frame of 1280 × 720 while the sun turns, in milliseconds.
    pub ms: f64,
    /// The same while all stands still.
    pub still_ms: f64,
    /// Root of the mean square of relative errors, over directions and wavelengths.
    pub rmse_rel: f64,
    /// At 680 nm.
    pub rmse_680: f64,
    /// At 550 nm.
    pub rmse_550: f64,
    /// At 440 nm.
    pub rmse_440: f64,
    /// Peak signal to noise ratio of the sky in a tonemapped picture, in dB; for the views that have a true one.
    pub psnr_db: Option<f64>,
    /// Bytes on the device of the tables of one medium and one camera.
    pub table_bytes: u64,
}

impl Row for SkyRow {
    type Key = (String, String);

    fn key(&self) -> Self::Key {
        (self.model.clone(), self.view.clone())
    }

    fn run(&self) -> u64 {
        self.run
    }
}

/// The default model's root of the mean square of relative errors, over every `step`th direction of each case: with the case's name.
///
/// # Errors
/// No truth to read.
pub fn default_errors(ctx: &Context, step: usize) -> Result<Vec<(String, f64)>, ChartsError> {
    let mut scene = Scene::new(Model::Own(SkyModel::Full), [16, 16]);
    let mut errors = Vec::new();
    for mut case in cases(ctx)? {
        case.directions = case.directions.iter().step_by(step).copied().collect();
        errors.push((case.name(), root_mean_square(scene.errors(&case).iter().flatten())));
    }
    Ok(errors)
}

/// The default model's pictures: each view, and the peak signal to noise ratio in dB of the whole and of the sky alone. The sun's disc
/// is left out.
///
/// # Errors
/// No truth to read.
pub fn default_pictures(ctx: &Context) -> Result<Vec<(View, [f64; 2])>, ChartsError> {
    let mut scene = Scene::new(Model::Own(SkyModel::Full), PICTURE);
    let of = |view: View| -> Result<_, ChartsError> {
        let (ours, truth) = (scene.picture(&view), truth::picture(ctx, &view)?);
        Ok((view, [passes_sun, sees_sky].map(|counts| view.psnr(&ours, &truth, |ray| counts(&MEDIUM, ray)))))
    };
    VIEWS.into_iter().map(of).collect()
}

/// Each view's name, and what a model's picture of its sky has.
fn pictures(ctx: &Context, model: Model) -> Result<Vec<(String, f64)>, ChartsError> {
    let mut scene = Scene::new(model, PICTURE);
    let of = |view: View| -> Result<_, ChartsError> {
        let (drawn, truth) = (scene.picture(&view), truth::picture(ctx, &view)?);
        // The ground is left out: not every model draws one.
        Ok((truth::name(view.sun_zenith, ALTITUDE), view.psnr(&drawn, &truth, |ray| sees_sky(&MEDIUM, ray))))
    };
    VIEWS.into_iter().map(of).collect()
}

fn root_mean_square<'a>(errors: impl IntoIterator<Item = &'a f64>) -> f64 {
    let (sum, count) = errors.into_iter().fold((0.0, 0.0), |(sum, count), error| (sum + error * error, count + 1.0));
    (sum / count).sqrt()
}

/// What each model adds to a frame while the sun turns, and while it stands: frames of all models by turns.
fn costs(ctx: &Context) -> Vec<(Model, [f64; 2])> {
    let mut scenes: Vec<Scene> =
        [Model::None].into_iter().chain(Model::ALL).map(|model| Scene::new(model, FULL)).collect();
    for scene in &mut scenes {
        scene.shine(DVec3::new(0.8, 0.6, 0.0));
        scene.look(100.0, DVec3::new(0.6, 0.1, -0.8));
        scene.settle();
    }
    let mut medians = Vec::new();
    for turn in [TURN, 0.0] {
        let mut times = vec![Vec::new(); scenes.len()];
        let mut angle = 0.9f32;
        for _ in 0..ctx.pick(3, 20) {
            angle -= turn;
            for (scene, times) in scenes.iter_mut().zip(&mut times) {
                let (sin, cos) = f64::from(angle).sin_cos();
                scene.shine(DVec3::new(sin, cos, 0.0));
                times.push(scene.stage.frame());
            }
        }
        medians.push(times.into_iter().map(median).collect::<Vec<_>>());
    }
    let added = |i: usize| [0, 1].map(|still: usize| medians[still][i] - medians[still][0]);
    Model::ALL.into_iter().enumerate().map(|(i, model)| (model, added(i + 1))).collect()
}

impl Experiment for Sky {
    fn name(&self) -> &'static str {
        TABLE
    }

    fn about(&self) -> &'static str {
        "the sky of each model and of Bevy's own against the truth, and what each costs in time and tables"
    }

    fn tables(&self) -> &'static [&'static str] {
        &[TABLE]
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<SkyRow>(TABLE)?;
        let cases = cases(ctx)?;
        let keys: Vec<_> = Model::ALL
            .into_iter()
            .flat_map(|model| cases.iter().map(move |case| (model.name().to_owned(), case.name())))
            .collect();
        if table.has_together(&keys) {
            return Ok(());
        }
        let progress = ctx.progress(self.name(), 1 + Model::ALL.len());
        let costs = costs(ctx);
        progress.done("times");
        for (model, [ms, still_ms]) in costs {
            let pictures = pictures(ctx, model)?;
            let mut scene = Scene::new(model, [16, 16]);
            for case in &cases {
                let errors = scene.errors(case);
                let [rmse_680, rmse_550, rmse_440] = errors.each_ref().map(root_mean_square);
                table.push(SkyRow {
                    run: ctx.run,
                    model: model.name().to_owned(),
                    view: case.name(),
                    ms,
                    still_ms,
                    rmse_rel: root_mean_square(errors.iter().flatten()),
                    rmse_680,
                    rmse_550,
                    rmse_440,
                    psnr_db: pictures.iter().find(|(view, _)| *view == case.name()).map(|(_, psnr)| *psnr),
                    table_bytes: model.table_bytes(),
                })?;
            }
            progress.done(model.name());
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let rows = ctx.rows::<SkyRow>(TABLE)?;
        let mut views: Vec<&str> = Vec::new();
        for row in &rows {
            if !views.contains(&row.view.as_str()) {
                views.push(&row.view);
            }
        }
        let groups = |view: &str, x: fn(&SkyRow) -> f64| {
            let of = rows.iter().filter(|row| row.view == view);
            let dot = |row: &SkyRow| Dot { x: x(row), y: row.rmse_rel, missed: false, label: String::new() };
            of.map(|row| Group { name: row.model.clone(), dots: vec![dot(row)] }).collect::<Vec<_>>()
        };
        let charts = |(i, view): (usize, &&str)| {
            let time = Scatter {
                title: format!("The sky under a sun at zenith angle {view}: error against time"),
                note: "81 directions, three wavelengths, against Monte Carlo. Time: what the sky adds to a frame of 1280 × 720 while the sun turns."
                    .into(),
                x: Axis::log("added to a frame, ms"),
                y: Axis::log("RMS relative error"),
                groups: groups(view, |row| row.ms.max(0.1)),
                missed: String::new(),
            };
            let size = Scatter {
                title: format!("The sky under a sun at zenith angle {view}: error against tables"),
                note: "81 directions, three wavelengths, against Monte Carlo. Tables of one medium and one camera; the gradient has none."
                    .into(),
                x: Axis::log("tables, kB"),
                y: Axis::log("RMS relative error"),
                groups: groups(view, |row| (row.table_bytes as f64 / 1e3).max(1.0)),
                missed: String::new(),
            };
            [NamedChart::new(format!("sky_{i}"), time), NamedChart::new(format!("sky_bytes_{i}"), size)]
        };
        Ok(views.iter().enumerate().flat_map(charts).collect())
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<SkyRow>(TABLE)?;
        let of = |model: Model, view: &str| rows.iter().rev().find(|row| row.model == model.name() && row.view == view);
        let (full, bevy) = (Model::Own(SkyModel::Full), Model::Bevy { published: false });
        let rmse = |model, view: &str| of(model, view).map(|row| 100.0 * row.rmse_rel);
        let psnr = |model, view: &str| of(model, view).and_then(|row| row.psnr_db);
        let share = |ms: fn(&SkyRow) -> f64| Some(ms(of(full, "65° ground")?) / ms(of(bevy, "65° ground")?));
        let published = Model::Bevy { published: true };
        let compared = json!({
            "full_percent_65": rmse(full, "65° ground"),
            "full_percent_88": rmse(full, "88° ground"),
            "full_percent_91": rmse(full, "91.5° ground"),
            "fast_percent_65": rmse(Model::Own(SkyModel::Fast), "65° ground"),
            "single_percent_65": rmse(Model::Own(SkyModel::Single), "65° ground"),
            "bevy_percent_65": rmse(bevy, "65° ground"),
            "bevy_published_percent_65": rmse(published, "65° ground"),
            "full_psnr_65": psnr(full, "65° ground"),
            "full_psnr_88": psnr(full, "88° ground"),
            "fast_psnr_65": psnr(Model::Own(SkyModel::Fast), "65° ground"),
            "bevy_published_psnr_65": psnr(published, "65° ground"),
            "full_table_kb": of(full, "65° ground").map(|row| row.table_bytes as f64 / 1e3),
            "bevy_table_kb": of(bevy, "65° ground").map(|row| row.table_bytes as f64 / 1e3),
            "share_of_bevys_time": share(|row| row.still_ms),
            "share_of_bevys_time_turning": share(|row| row.ms),
        });
        let entries = [("sky", json!(rows)), ("sky_compared", compared)];
        Ok(entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}
