//! The truths about the sky: radiance in single directions by Monte Carlo, and pictures by all orders of scattering.

use std::fs;

use bevy::camera::Exposure;
use bevy::math::{DMat3, DVec3};
use horizon_light::medium::Medium;
use horizon_light::reference::picture::{HEIGHT, View, WIDTH};
use horizon_light::spectrum::Star;
use serde::Deserialize;

use crate::context::Context;
use crate::experiment::ChartsError;

/// What the truths are of.
pub const MEDIUM: Medium = Medium::BRUNETON;

/// Towards a sun over +x, at a zenith angle in degrees.
pub fn towards(zenith: f64) -> DVec3 {
    let (sin, cos) = zenith.to_radians().sin_cos();
    DVec3::new(sin, cos, 0.0)
}

/// What a sun at a zenith angle in degrees, seen from an altitude in metres, is called.
pub fn name(sun_zenith: f64, h: f64) -> String {
    let place = if h < 100.0 { "ground".to_owned() } else { format!("{} km", h / 1000.0) };
    format!("{sun_zenith}° {place}")
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
pub struct Direction {
    pub mu: f64,
    pub nu: f64,
    pub truth: [f64; 3],
}

/// A sun, an altitude, and directions.
#[derive(Clone, Debug)]
pub struct Case {
    pub sun_zenith: f64,
    pub h: f64,
    pub directions: Vec<Direction>,
}

impl Case {
    pub fn name(&self) -> String {
        name(self.sun_zenith, self.h)
    }

    /// Towards the sun, which stands over +x.
    pub fn sun(&self) -> DVec3 {
        towards(self.sun_zenith)
    }

    pub fn view(&self, direction: &Direction) -> DVec3 {
        let sun = self.sun();
        let side = (1.0 - direction.mu * direction.mu).max(0.0).sqrt();
        let along = if sun.x > 0.0 { (direction.nu - direction.mu * sun.y) / sun.x } else { side };
        let x = along.clamp(-side, side);
        DVec3::new(x, direction.mu, (side * side - x * x).max(0.0).sqrt()).normalize()
    }

    /// The exposure that brings the sky to about 1.
    pub fn exposure(&self) -> Exposure {
        let rgb_of = DMat3::from_cols_array_2d(&Star::of(&MEDIUM).matrix()).transpose();
        let sum: f64 = self.directions.iter().map(|d| (rgb_of * DVec3::from_array(d.truth)).max_element()).sum();
        Exposure { ev100: (sum / self.directions.len() as f64 / 1.2).log2() as f32 }
    }
}

/// All cases; in a quick run with fewer directions.
pub fn cases(ctx: &Context) -> Result<Vec<Case>, ChartsError> {
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
        case.directions.retain(|direction| direction.nu < (2.0 * MEDIUM.sun_radius).cos());
        case.directions = case.directions.iter().step_by(step).copied().collect();
    }
    Ok(cases)
}

/// The true picture of a view, made by the example `pictures` of `horizon_light`.
pub fn picture(ctx: &Context, view: &View) -> Result<Vec<[u8; 3]>, ChartsError> {
    let file = ctx.root.join("assets/truth").join(view.file());
    let fail = |reason| ChartsError::Image { file: file.clone(), reason };
    let picture = image::open(&file).map_err(|error| fail(error.to_string()))?.into_rgb8();
    if picture.dimensions() != (WIDTH as u32, HEIGHT as u32) {
        return Err(fail(format!("{:?} pixels, where there should be {WIDTH} × {HEIGHT}", picture.dimensions())));
    }
    Ok(picture.pixels().map(|pixel| pixel.0).collect())
}
