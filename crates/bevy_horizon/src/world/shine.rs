//! The air's light in Bevy's own lights: what it leaves of the sun at the camera, and what the sky adds.

use std::f32::consts::PI;

use bevy::light::GlobalAmbientLight;
use bevy::math::DVec3;
use bevy::prelude::*;
use horizon_field::CELL;
use horizon_light::geometry::horizon_cosine;
use horizon_light::medium::Medium;
use horizon_light::reference::transmittance::transmittance_to_top;
use horizon_light::spectrum::Star;
use horizon_light::sun::{SunDisc, above_horizon};

use super::air_light::CompiledAtmosphere;
use super::{Sunlight, WorldOrigin};
use crate::camera::HorizonCamera;

/// Illuminance of a surface that faces the sun at altitude `h` in metres, in lux, linear sRGB, where the sun stands `mu_s` from the
/// vertical (a cosine): through the air, and as far as the disc stands over the horizon.
pub fn illuminance(medium: &Medium, h: f64, mu_s: f64) -> [f64; 3] {
    rgb(&Star::of(medium).matrix(), irradiance(medium, h, mu_s))
}

/// What is left of the sun's irradiance at the medium's wavelengths.
fn irradiance(medium: &Medium, h: f64, mu_s: f64) -> [f64; 3] {
    let h = h.max(0.0);
    let disc = SunDisc::of(medium);
    let visible = disc.visible(above_horizon(mu_s, h, medium.radius));
    // Of a disc that sets, what is seen stands on the horizon.
    let through = if h < medium.height {
        transmittance_to_top(medium, h, mu_s.max(horizon_cosine(medium.radius, h)))
    } else {
        [1.0; 3]
    };
    core::array::from_fn(|k| medium.irradiance[k] * through[k] * visible[k])
}

/// Linear sRGB, in photometric units, of values at the medium's wavelengths. What lies outside of it is brought to its edge.
fn rgb(matrix: &[[f64; 3]; 3], values: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| (0..3).map(|k| row[k] * values[k]).sum::<f64>().max(0.0))
}

/// A camera's altitude over the ground of an atmosphere whose entity is at `datum`, in metres; at least 0.
pub(crate) fn altitude(origin: &WorldOrigin, eye: Vec3, datum: Vec3) -> f64 {
    let place = origin.0.translated((eye - datum).as_dvec3().to_array());
    (place.cell[1] as f64 * CELL + place.offset[1]).max(0.0)
}

/// A colour of length 1 in its brightest channel, and how bright that is.
fn apart(rgb: Vec3) -> (Color, f32) {
    let brightest = rgb.max_element();
    let colour = if brightest > 0.0 { rgb / brightest } else { Vec3::ONE };
    (Color::linear_rgb(colour.x, colour.y, colour.z), brightest)
}

/// Sets the lights that are suns, and the ambient light, to what the first camera that draws worlds has of them.
pub(crate) fn shine(
    origin: Res<WorldOrigin>,
    atmospheres: Query<(&CompiledAtmosphere, &GlobalTransform, &InheritedVisibility)>,
    cameras: Query<(&Camera, &GlobalTransform), With<HorizonCamera>>,
    mut suns: Query<(&mut DirectionalLight, &GlobalTransform), With<Sunlight>>,
    ambient: Option<ResMut<GlobalAmbientLight>>,
) {
    let Some((compiled, light, at)) = atmospheres
        .iter()
        .filter(|(_, _, visible)| visible.get())
        .find_map(|(compiled, at, _)| Some((compiled, compiled.light.as_ref()?, at)))
    else {
        return;
    };
    let medium = &compiled.atmosphere.medium;
    let eye = cameras.iter().find(|(camera, _)| camera.is_active).map_or(Vec3::ZERO, |(_, eye)| eye.translation());
    let h = altitude(&origin, eye, at.translation());
    let mut sky = Vec3::ZERO;
    for (mut sun, transform) in &mut suns {
        let mu_s = transform.back().y.clamp(-1.0, 1.0);
        let (color, illuminance) =
            apart(DVec3::from_array(rgb(&light.to_rgb, irradiance(medium, h, mu_s.into()))).as_vec3());
        if sun.color != color || sun.illuminance != illuminance {
            (sun.color, sun.illuminance) = (color, illuminance);
        }
        let diffuse = light.moments.irradiance(&light.air, h as f32, mu_s, 1.0, mu_s);
        sky += DVec3::from_array(rgb(&light.to_rgb, diffuse.map(f64::from))).as_vec3() / PI;
    }
    if let Some(mut ambient) = ambient.filter(|_| !suns.is_empty()) {
        let (color, brightness) = apart(sky + compiled.atmosphere.night);
        if ambient.color != color || ambient.brightness != brightness {
            (ambient.color, ambient.brightness) = (color, brightness);
        }
    }
}
