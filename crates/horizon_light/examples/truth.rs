//! Writes the truth that models of the sky are measured against: radiance by Monte Carlo in 81 directions, for six suns
//! and three wavelengths, each with a standard error below 0.3 % of it. Some minutes on one core.
//!
//! `cargo run -p horizon_light --example truth -- assets/truth/sky.csv`

use std::fmt::Write;
use std::process::ExitCode;

use horizon_light::medium::{Medium, WAVELENGTHS};
use horizon_light::reference::Ray;
use horizon_light::reference::monte_carlo::Sky;

/// Altitude in metres and the sun's zenith angle in degrees.
const CASES: [(f64, f64); 6] = [(2.0, 30.0), (2.0, 65.0), (2.0, 80.0), (2.0, 88.0), (2.0, 91.5), (8_000.0, 65.0)];

/// Zenith angles of the views, in degrees: closer towards the horizon, where the sky changes most. 0 is left out, as
/// all azimuths are one there.
const ZENITHS: [f64; 9] = [5.0, 20.0, 35.0, 50.0, 62.0, 72.0, 80.0, 85.0, 88.0];

/// The standard error asked for, relative to the mean.
const RELATIVE: f64 = 0.003;

/// Paths after which a direction is taken as it is; the darkest need a tenth.
const MOST: u64 = 50_000_000;

fn main() -> ExitCode {
    let Some(file) = std::env::args().nth(1) else {
        eprintln!("say which file to write");
        return ExitCode::FAILURE;
    };
    let medium = Medium::BRUNETON;
    let sky = Sky::new(&medium);
    let mut table = "case,sun_zenith_deg,h,mu,nu,wavelength,mean,standard_error\n".to_owned();
    for (case, (h, sun)) in CASES.into_iter().enumerate() {
        for zenith in ZENITHS {
            for k in 0..9 {
                let azimuth = 22.5 * k as f64;
                let view = Ray::of_angles(h, zenith.to_radians(), sun.to_radians(), azimuth.to_radians());
                for (wavelength, nanometres) in WAVELENGTHS.into_iter().enumerate() {
                    let found = sky.radiance_within(&view, wavelength, RELATIVE, MOST, 4);
                    let Ray { mu, nu, .. } = view;
                    let (mean, error) = (found.mean, found.standard_error);
                    // Writing to a string does not fail.
                    let _ = writeln!(table, "{case},{sun},{h},{mu},{nu},{nanometres},{mean:.6e},{error:.2e}");
                }
            }
        }
        eprintln!("sun at {sun} degrees, {h} m: done");
    }
    if let Err(error) = std::fs::write(&file, table) {
        eprintln!("cannot write {file}: {error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
