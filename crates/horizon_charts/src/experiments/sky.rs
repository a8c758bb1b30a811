//! The sky of each model, and of Bevy's own `Atmosphere`, against the Monte Carlo reference; and what each adds to a frame.

use std::fs;

use bevy::camera::Exposure;
use bevy::light::atmosphere::{Falloff, PhaseFunction, ScatteringMedium, ScatteringTerm};
use bevy::math::{DMat3, DVec3};
use bevy::pbr::AtmosphereSettings;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon_workspace::stage::Stage;
use horizon_light::medium::Medium;
use horizon_light::spectrum::Star;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment, NamedChart};
use crate::measure::samples::median;
use crate::plot::{Axis, Dot, Group, Scatter};
use crate::store::Row;

/// The experiment.
#[derive(Clone, Copy, Debug)]
pub struct Sky;

const TABLE: &str = "sky";
const FULL: [u32; 2] = [1280, 720];
/// Lux of Bevy's sun; its sky is in proportion.
const BEVY_SUN: f32 = 100_000.0;
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

/// What draws the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Model {
    None,
    Own(SkyModel),
    /// Bevy's, with its own medium, or with the published one.
    Bevy {
        published: bool,
    },
}

impl Model {
    const ALL: [Self; 6] = [
        Self::Own(SkyModel::Gradient),
        Self::Own(SkyModel::Single),
        Self::Own(SkyModel::Fast),
        Self::Own(SkyModel::Full),
        Self::Bevy { published: false },
        Self::Bevy { published: true },
    ];

    fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Own(SkyModel::Gradient) => "gradient",
            Self::Own(SkyModel::Single) => "single",
            Self::Own(SkyModel::Fast) => "fast",
            Self::Own(SkyModel::Full) => "full",
            Self::Bevy { published: false } => "bevy_default",
            Self::Bevy { published: true } => "bevy_published_medium",
        }
    }
}

/// A row of the truth: `assets/truth/sky.csv`, made by the example `truth` of `horizon_light`.
#[derive(Clone, Copy, Debug, Deserialize)]
struct TruthRow {
    case: usize,
    sun_zenith_deg: f64,
    h: f64,
    mu: f64,
    nu: f64,
    wavelength: usize,
    mean: f64,
}

/// A direction, and its true radiance at the three wavelengths.
#[derive(Clone, Copy, Debug)]
struct Direction {
    mu: f64,
    nu: f64,
    truth: [f64; 3],
}

/// A sun, an altitude, and directions.
#[derive(Clone, Debug)]
struct Case {
    sun_zenith: f64,
    h: f64,
    directions: Vec<Direction>,
}

impl Case {
    fn name(&self) -> String {
        let place = if self.h < 100.0 { "ground".to_owned() } else { format!("{} km", self.h / 1000.0) };
        format!("{}° {place}", self.sun_zenith)
    }

    /// Towards the sun, which stands over +x.
    fn sun(&self) -> DVec3 {
        let (sin, cos) = self.sun_zenith.to_radians().sin_cos();
        DVec3::new(sin, cos, 0.0)
    }

    fn view(&self, direction: &Direction) -> DVec3 {
        let sun = self.sun();
        let side = (1.0 - direction.mu * direction.mu).max(0.0).sqrt();
        let along = if sun.x > 0.0 { (direction.nu - direction.mu * sun.y) / sun.x } else { side };
        let x = along.clamp(-side, side);
        DVec3::new(x, direction.mu, (side * side - x * x).max(0.0).sqrt()).normalize()
    }

    /// The exposure that brings the sky to about 1.
    fn exposure(&self) -> Exposure {
        let rgb_of = DMat3::from_cols_array_2d(&Star::new(Medium::EARTH.irradiance).matrix()).transpose();
        let sum: f64 = self.directions.iter().map(|d| (rgb_of * DVec3::from_array(d.truth)).max_element()).sum();
        Exposure { ev100: (sum / self.directions.len() as f64 / 1.2).log2() as f32 }
    }
}

fn cases(ctx: &Context) -> Result<Vec<Case>, ChartsError> {
    let file = ctx.root.join("assets/truth/sky.csv");
    let text = fs::read_to_string(&file).map_err(ChartsError::io(&file))?;
    let mut cases: Vec<Case> = Vec::new();
    for row in csv::Reader::from_reader(text.as_bytes()).deserialize() {
        let row: TruthRow =
            row.map_err(|error| ChartsError::Image { file: file.clone(), reason: error.to_string() })?;
        if row.case == cases.len() {
            cases.push(Case { sun_zenith: row.sun_zenith_deg, h: row.h, directions: Vec::new() });
        }
        let case = &mut cases[row.case];
        let k = [680, 550, 440].iter().position(|nm| *nm == row.wavelength).unwrap_or(0);
        match case.directions.iter_mut().find(|d| d.mu == row.mu && d.nu == row.nu) {
            Some(found) => found.truth[k] = row.mean,
            None => {
                let mut truth = [0.0; 3];
                truth[k] = row.mean;
                case.directions.push(Direction { mu: row.mu, nu: row.nu, truth });
            }
        }
    }
    let step = ctx.pick(27, 1);
    for case in &mut cases {
        // Not into the sun: the truth has no disc.
        case.directions.retain(|direction| direction.nu < (2.0 * Medium::EARTH.sun_radius).cos());
        case.directions = case.directions.iter().step_by(step).copied().collect();
    }
    Ok(cases)
}

/// Bruneton's air in Bevy's terms: scale heights are parts of the shell's 60 km, and the tent is 30 km wide.
fn published() -> ScatteringMedium {
    let air = Medium::EARTH;
    let vec = |v: [f64; 3]| DVec3::from_array(v).as_vec3();
    let exponential = |height: f64| Falloff::Exponential { scale: (height / air.height) as f32 };
    let terms = [
        ScatteringTerm {
            absorption: Vec3::ZERO,
            scattering: vec(air.rayleigh),
            falloff: exponential(air.rayleigh_height),
            phase: PhaseFunction::Rayleigh,
        },
        ScatteringTerm {
            absorption: vec(air.mie_absorption),
            scattering: vec(air.mie_scattering),
            falloff: exponential(air.mie_height),
            phase: PhaseFunction::Mie { asymmetry: air.mie_asymmetry as f32 },
        },
        ScatteringTerm {
            absorption: vec(air.absorption),
            scattering: Vec3::ZERO,
            falloff: Falloff::Tent {
                center: (1.0 - air.absorption_peak / air.height) as f32,
                width: (2.0 * air.absorption_width / air.height) as f32,
            },
            phase: PhaseFunction::Isotropic,
        },
    ];
    ScatteringMedium::new(256, 256, terms)
}

/// A stage under a model's sky.
struct Scene {
    stage: Stage,
    sun: Entity,
    model: Model,
}

impl Scene {
    fn new(model: Model, [width, height]: [u32; 2]) -> Self {
        let mut stage = Stage::new(width, height);
        let camera = stage.camera;
        let light = DirectionalLight { illuminance: BEVY_SUN, ..default() };
        let sun = stage.world().spawn((light, Transform::default())).id();
        match model {
            Model::None => {}
            Model::Own(own) => {
                stage.world().entity_mut(sun).insert(Sunlight);
                stage.world().spawn(Atmosphere { model: own, night: 0.0, ..default() });
            }
            Model::Bevy { published: wanted } => {
                let medium = if wanted { published() } else { ScatteringMedium::earth(256, 256) };
                let medium = stage.world().resource_mut::<Assets<ScatteringMedium>>().add(medium);
                let mut air = bevy::light::Atmosphere::earth(medium);
                if wanted {
                    air.outer_radius = (Medium::EARTH.radius + Medium::EARTH.height) as f32;
                    air.ground_albedo = Vec3::splat(Medium::EARTH.albedo[0] as f32);
                }
                stage.world().spawn(air);
                stage.world().entity_mut(camera).insert(AtmosphereSettings::default());
            }
        }
        Self { stage, sun, model }
    }

    fn shine(&mut self, towards: DVec3) {
        let to = Transform::default().looking_to(-towards.as_vec3(), Vec3::Z);
        *self.stage.world().get_mut::<Transform>(self.sun).expect("the sun is there") = to;
    }

    fn look(&mut self, h: f64, towards: DVec3) {
        let up = if towards.y.abs() > 0.99 { Vec3::X } else { Vec3::Y };
        self.stage.look(Transform::from_xyz(0.0, h as f32, 0.0).looking_to(towards.as_vec3(), up));
    }

    fn settle(&mut self) {
        for _ in 0..6 {
            self.stage.frame();
        }
        if let Model::Own(own) = self.model
            && own != SkyModel::Gradient
        {
            self.stage.settle();
        }
    }

    /// Relative errors at the three wavelengths, over a case's directions.
    fn errors(&mut self, case: &Case) -> [Vec<f64>; 3] {
        let camera = self.stage.camera;
        let exposure = case.exposure();
        // So narrow that a picture is one direction.
        let lens = Projection::Perspective(PerspectiveProjection { fov: 0.01, near: 0.1, ..default() });
        self.stage.world().entity_mut(camera).insert((exposure, lens));
        self.shine(case.sun());
        self.look(case.h, DVec3::Y);
        self.settle();
        let radiance_of =
            DMat3::from_cols_array_2d(&Star::new(Medium::EARTH.irradiance).matrix()).transpose().inverse();
        let mut errors = [const { Vec::new() }; 3];
        for direction in &case.directions {
            self.look(case.h, case.view(direction));
            self.stage.frame();
            let picture = self.stage.colour();
            // Four pixels meet at the middle of an even picture.
            let side = (picture.len() as f64).sqrt() as usize;
            let middle = [0, 1, side, side + 1].map(|i| picture[(side / 2 - 1) * (side + 1) + i]);
            let mean: [f64; 3] = core::array::from_fn(|k| middle.iter().map(|p| f64::from(p[k])).sum::<f64>() / 4.0);
            let luminance = DVec3::from_array(mean) / f64::from(exposure.exposure());
            let drawn = match self.model {
                Model::Bevy { .. } => luminance / f64::from(BEVY_SUN) * DVec3::from_array(Medium::EARTH.irradiance),
                _ => radiance_of * luminance,
            };
            for (k, errors) in errors.iter_mut().enumerate() {
                errors.push(drawn[k] / direction.truth[k] - 1.0);
            }
        }
        errors
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
        "the sky of each model and of Bevy's own, against Monte Carlo, and what each costs"
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
        let chart = |(i, view): (usize, &&str)| {
            let of = rows.iter().filter(|row| row.view == **view);
            let groups = of.map(|row| Group {
                name: row.model.clone(),
                dots: vec![Dot { x: row.ms.max(0.1), y: row.rmse_rel, missed: false, label: String::new() }],
            });
            let scatter = Scatter {
                title: format!("The sky under a sun at zenith angle {view}: error against time"),
                note: "81 directions, three wavelengths, against Monte Carlo. Time: what the sky adds to a frame of 1280 × 720 while the sun turns."
                    .into(),
                x: Axis::log("added to a frame, ms"),
                y: Axis::log("RMS relative error"),
                groups: groups.collect(),
                missed: String::new(),
            };
            NamedChart::new(format!("sky_{i}"), scatter)
        };
        Ok(views.iter().enumerate().map(chart).collect())
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let rows = ctx.rows::<SkyRow>(TABLE)?;
        let of = |model: Model, view: &str| rows.iter().rev().find(|row| row.model == model.name() && row.view == view);
        let (full, bevy) = (Model::Own(SkyModel::Full), Model::Bevy { published: false });
        let rmse = |model, view: &str| of(model, view).map(|row| 100.0 * row.rmse_rel);
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
            "share_of_bevys_time": share(|row| row.still_ms),
            "share_of_bevys_time_turning": share(|row| row.ms),
        });
        let entries = [("sky", json!(rows)), ("sky_compared", compared)];
        Ok(entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}
