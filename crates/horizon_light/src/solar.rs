//! Where the sun stands: by place, date and hour, or by hand. Axes as in the plugin: x east, y up, z south.
//!
//! NREL's Solar Position Algorithm (Reda & Andreas 2004) by the crate `solar-positioning`, good to 0.0003° from −500 to 3000.
//! It is geometric: where the sun's light comes from without the air's refraction, as the models' straight rays have it.
//! The eye sees a setting sun about 0.57° higher, and so some minutes longer.

#[cfg(test)]
mod tests;

use core::f64::consts::{FRAC_PI_2, TAU};
use serde::{Deserialize, Serialize};
use solar_positioning::time::JulianDate;
use solar_positioning::{Location, SolarPositions, delta_t};

/// Julian date of J2000: noon of 1 January 2000.
const J2000: f64 = 2_451_545.0;

/// Days in a mean Gregorian year.
const YEAR: f64 = 365.2425;

/// A place on Earth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Latitude in radians, north positive, −π/2 – π/2.
    pub latitude: f64,
    /// Longitude in radians, east positive; whole turns do not matter.
    pub longitude: f64,
}

/// A moment of universal time.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Instant {
    /// Days since J2000, noon of 1 January 2000.
    pub days: f64,
}

/// Why the sun has no place.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolarError {
    /// Latitude beyond a pole, or not a number.
    #[error("latitude {0} rad is not within −π/2 – π/2")]
    Latitude(f64),
    /// Longitude not finite.
    #[error("longitude {0} rad is not finite")]
    Longitude(f64),
    /// No such day in the Gregorian calendar.
    #[error("{year}-{month:02}-{day:02} is not a day of the calendar")]
    Date {
        /// The year, 0 being 1 BC.
        year: i32,
        /// The month, 1 – 12.
        month: u32,
        /// The day, from 1.
        day: u32,
    },
    /// Outside the years −500 – 3000, for which Earth's rotation is known well enough; or not a number.
    #[error("{0} days from the year 2000 are not within the years −500 – 3000")]
    Instant(f64),
}

impl Instant {
    /// A date of the Gregorian calendar, carried on before its own time, and hours of universal time since that day's
    /// midnight: any number, so that 30 is the next day's 6 o'clock.
    pub fn utc(year: i32, month: u32, day: u32, hours: f64) -> Result<Self, SolarError> {
        let midnight = JulianDate::from_utc_simple(year, month, day, 0, 0, 0.0).map_err(|_| SolarError::Date {
            year,
            month,
            day,
        })?;
        Ok(Self { days: midnight.julian_date() - J2000 + hours / 24.0 })
    }
}

/// Unit vector to the sun: x east, y up, z south.
pub fn sun_direction(place: Place, instant: Instant) -> Result<[f64; 3], SolarError> {
    if !(-FRAC_PI_2..=FRAC_PI_2).contains(&place.latitude) {
        return Err(SolarError::Latitude(place.latitude));
    }
    if !place.longitude.is_finite() {
        return Err(SolarError::Longitude(place.longitude));
    }
    let unknown = |_| SolarError::Instant(instant.days);
    // Universal time lags behind the planets' even time by a minute today, and by hours in antiquity.
    let lag = delta_t::estimate(2000.0 + instant.days / YEAR).map_err(unknown)?;
    let moment = JulianDate::new(J2000 + instant.days, lag).map_err(unknown)?;
    let turned = place.longitude - TAU * (place.longitude / TAU).round();
    let location = Location {
        latitude: place.latitude.to_degrees().clamp(-90.0, 90.0),
        longitude: turned.to_degrees().clamp(-180.0, 180.0),
    };
    let sun = SolarPositions::new().at_from_julian(moment, location, 0.0, None).map_err(unknown)?;
    Ok(by_hand(sun.azimuth().to_radians(), sun.elevation_angle().to_radians()))
}

/// Unit vector to a sun at `azimuth`, clockwise from north, and `elevation` over the horizon, in radians.
///
/// Seed 000 eq. B.10 calls θ in (sin θ cos φ, cos θ, sin θ sin φ) the elevation: it is the angle from the zenith,
/// π/2 − `elevation`, and its φ counts from east, `azimuth` − π/2.
pub fn by_hand(azimuth: f64, elevation: f64) -> [f64; 3] {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (libm::sincos(azimuth), libm::sincos(elevation));
    [cos_e * sin_a, sin_e, -cos_e * cos_a]
}
