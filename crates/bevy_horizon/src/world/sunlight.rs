//! The sun as a light: where it stands by place and hour, and what the air leaves of it.

use bevy::prelude::*;
use horizon_field::field::Param;
use horizon_light::solar::{Instant, Place, SolarError, by_hand, sun_direction};
use serde::{Deserialize, Serialize};

/// On a `DirectionalLight`: this is the sun above the air of the scene's [`Atmosphere`](super::Atmosphere). The light's colour and
/// illuminance are set each frame to what the air leaves of it at the camera; ground and sky take their own points' share. Bevy's
/// `GlobalAmbientLight` is set to the sky's.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct Sunlight;

/// On a [`Sunlight`]: turns it to where the sun stands at a place of the Earth and a moment, which goes on with time.
#[derive(Component, Clone, Copy, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Clone, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub struct TimeOfDay {
    /// Latitude, north positive, in radians. Default: 0.8, as in the Alps.
    #[reflect(@Param { min: -1.570_796_4, max: 1.570_796_4, unit: "rad", help: "Latitude, north positive" })]
    pub latitude: f64,
    /// Longitude, east positive, in radians. Default: 0.
    #[reflect(@Param { min: -10.0, max: 10.0, unit: "rad", help: "Longitude, east positive" })]
    pub longitude: f64,
    /// Year. Default: 2026.
    #[reflect(@Param { min: -500.0, max: 3000.0, unit: "", help: "Year" })]
    pub year: i32,
    /// Month, 1 to 12. Default: 6.
    #[reflect(@Param { min: 1.0, max: 12.0, unit: "", help: "Month" })]
    pub month: u32,
    /// Day of the month. Default: 21.
    #[reflect(@Param { min: 1.0, max: 31.0, unit: "", help: "Day of the month" })]
    pub day: u32,
    /// Hours of universal time since midnight; any number. Default: 10.
    #[reflect(@Param { min: -1e6, max: 1e6, unit: "h", help: "Hours since midnight" })]
    pub hours: f64,
    /// Hours that go by in a second of the game's time. Default: 0, the sun stands.
    #[reflect(@Param { min: -1e3, max: 1e3, unit: "h/s", help: "Hours that go by in a second" })]
    pub speed: f64,
}

impl Default for TimeOfDay {
    fn default() -> Self {
        Self { latitude: 0.8, longitude: 0.0, year: 2026, month: 6, day: 21, hours: 10.0, speed: 0.0 }
    }
}

impl TimeOfDay {
    /// The unit vector towards the sun: x east, y up, z south.
    ///
    /// # Errors
    /// A latitude, a date or an hour for which the sun has no place.
    pub fn direction(&self) -> Result<Vec3, SolarError> {
        let place = Place { latitude: self.latitude, longitude: self.longitude };
        let [x, y, z] = sun_direction(place, Instant::utc(self.year, self.month, self.day, self.hours)?)?;
        Ok(Vec3::new(x as f32, y as f32, z as f32))
    }
}

/// The unit vector towards a sun at an azimuth, from −z (north) towards +x (east), and an elevation, in radians.
pub fn towards_sun(azimuth: f32, elevation: f32) -> Vec3 {
    let [x, y, z] = by_hand(azimuth.into(), elevation.into());
    Vec3::new(x as f32, y as f32, z as f32)
}

/// Lets time go by, and turns the sun.
pub(crate) fn turn_suns(time: Res<Time>, mut suns: Query<(Entity, &mut TimeOfDay, &mut Transform)>) {
    for (entity, mut day, mut transform) in &mut suns {
        if day.speed != 0.0 {
            day.hours += day.speed * time.delta_secs_f64();
        } else if !day.is_changed() {
            continue;
        }
        match day.direction() {
            Ok(towards) => *transform = transform.looking_to(-towards, sideways(towards)),
            Err(error) if day.is_changed() => error!("the sun of {entity} stays where it is: {error}"),
            Err(_) => {}
        }
    }
}

/// Any direction that is not along the sun's.
fn sideways(towards: Vec3) -> Vec3 {
    if towards.y.abs() > 0.99 { Vec3::X } else { Vec3::Y }
}
