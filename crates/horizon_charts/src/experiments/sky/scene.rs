//! What draws the sky, and what it draws.

use bevy::camera::Exposure;
use bevy::light::atmosphere::{Falloff, PhaseFunction, ScatteringMedium, ScatteringTerm};
use bevy::math::{DMat3, DVec3};
use bevy::pbr::AtmosphereSettings;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::render::sky_table_bytes;
use bevy_horizon_workspace::stage::Stage;
use horizon_light::reference::picture::{self, View};
use horizon_light::spectrum::Star;

use super::truth::{Case, MEDIUM, towards};

/// Lux of Bevy's sun; its sky is in proportion.
const BEVY_SUN: f32 = 100_000.0;
/// Altitudes and angles of the tables of Bevy's medium.
const BEVY_MEDIUM: u32 = 256;

/// What draws the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    None,
    Own(SkyModel),
    /// Bevy's, with its own medium, or with the published one.
    Bevy {
        published: bool,
    },
}

impl Model {
    pub const ALL: [Self; 6] = [
        Self::Own(SkyModel::Gradient),
        Self::Own(SkyModel::Single),
        Self::Own(SkyModel::Fast),
        Self::Own(SkyModel::Full),
        Self::Bevy { published: false },
        Self::Bevy { published: true },
    ];

    pub fn name(self) -> &'static str {
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

    /// Bytes on the device of the tables of one medium and one camera.
    pub fn table_bytes(self) -> u64 {
        match self {
            Self::None => 0,
            Self::Own(own) => sky_table_bytes(own),
            Self::Bevy { .. } => {
                let settings = AtmosphereSettings::default();
                let planes =
                    [settings.transmittance_lut_size, settings.multiscattering_lut_size, settings.sky_view_lut_size];
                let volume = u64::from(settings.aerial_view_lut_size.element_product());
                let texels = planes.iter().map(|size| u64::from(size.element_product())).sum::<u64>() + volume;
                // Half floats there; in the medium's two tables, of density and of scattering, whole ones.
                let medium = u64::from(BEVY_MEDIUM) * (2 + u64::from(BEVY_MEDIUM));
                8 * texels + 16 * medium
            }
        }
    }
}

/// Bruneton's air in Bevy's terms: scale heights are parts of the shell's 60 km, and the tent is 30 km wide.
fn published() -> ScatteringMedium {
    let air = MEDIUM;
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
    ScatteringMedium::new(BEVY_MEDIUM, BEVY_MEDIUM, terms)
}

/// A stage under a model's sky.
pub struct Scene {
    pub stage: Stage,
    sun: Entity,
    model: Model,
}

impl Scene {
    pub fn new(model: Model, [width, height]: [u32; 2]) -> Self {
        let mut stage = Stage::new(width, height);
        let camera = stage.camera;
        let light = DirectionalLight { illuminance: BEVY_SUN, ..default() };
        let sun = stage.world().spawn((light, Transform::default())).id();
        match model {
            Model::None => {}
            Model::Own(own) => {
                stage.world().entity_mut(sun).insert(Sunlight);
                stage.world().spawn(Atmosphere { model: own, night: 0.0, ..Atmosphere::BRUNETON });
            }
            Model::Bevy { published: wanted } => {
                let medium = if wanted { published() } else { ScatteringMedium::earth(BEVY_MEDIUM, BEVY_MEDIUM) };
                let medium = stage.world().resource_mut::<Assets<ScatteringMedium>>().add(medium);
                let mut air = bevy::light::Atmosphere::earth(medium);
                if wanted {
                    air.outer_radius = (MEDIUM.radius + MEDIUM.height) as f32;
                    air.ground_albedo = Vec3::splat(MEDIUM.albedo[0] as f32);
                }
                stage.world().spawn(air);
                stage.world().entity_mut(camera).insert(AtmosphereSettings::default());
            }
        }
        Self { stage, sun, model }
    }

    pub fn shine(&mut self, towards: DVec3) {
        let to = Transform::default().looking_to(-towards.as_vec3(), Vec3::Z);
        *self.stage.world().get_mut::<Transform>(self.sun).expect("the sun is there") = to;
    }

    pub fn look(&mut self, h: f64, towards: DVec3) {
        let up = if towards.y.abs() > 0.99 { Vec3::X } else { Vec3::Y };
        self.stage.look(Transform::from_xyz(0.0, h as f32, 0.0).looking_to(towards.as_vec3(), up));
    }

    pub fn settle(&mut self) {
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
    pub fn errors(&mut self, case: &Case) -> [Vec<f64>; 3] {
        let camera = self.stage.camera;
        let exposure = case.exposure();
        // So narrow that a picture is one direction.
        let lens = Projection::Perspective(PerspectiveProjection { fov: 0.01, near: 0.1, ..default() });
        self.stage.world().entity_mut(camera).insert((exposure, lens));
        self.shine(case.sun());
        self.look(case.h, DVec3::Y);
        self.settle();
        let radiance_of = DMat3::from_cols_array_2d(&Star::of(&MEDIUM).matrix()).transpose().inverse();
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
                Model::Bevy { .. } => radiance_of_bevy(luminance),
                _ => radiance_of * luminance,
            };
            for (k, errors) in errors.iter_mut().enumerate() {
                errors.push(drawn[k] / direction.truth[k] - 1.0);
            }
        }
        errors
    }

    /// A view's picture, tonemapped as the truth is; the scene is of its size.
    pub fn picture(&mut self, view: &View) -> Vec<[u8; 3]> {
        let camera = self.stage.camera;
        let exposure = Exposure { ev100: view.ev100 as f32 };
        let lens = Projection::Perspective(PerspectiveProjection { fov: picture::FOV as f32, near: 0.1, ..default() });
        self.stage.world().entity_mut(camera).insert((exposure, lens));
        self.shine(towards(view.sun_zenith));
        let [along, up] = picture::FORWARD;
        self.look(picture::ALTITUDE, DVec3::new(along, up, 0.0));
        self.settle();
        let to_rgb = Star::of(&MEDIUM).matrix();
        let colours = self
            .stage
            .colour()
            .into_iter()
            .map(|[red, green, blue, _]| DVec3::new(red.into(), green.into(), blue.into()));
        let pixel = |colour: DVec3| match self.model {
            Model::Bevy { .. } => view.pixel(&to_rgb, radiance_of_bevy(colour / view.exposure()).to_array()),
            _ => picture::tonemapped(colour.to_array()),
        };
        colours.map(pixel).collect()
    }
}

/// Bevy takes three radiances as RGB, per illuminance of its white sun.
fn radiance_of_bevy(luminance: DVec3) -> DVec3 {
    luminance / f64::from(BEVY_SUN) * DVec3::from_array(MEDIUM.irradiance)
}
