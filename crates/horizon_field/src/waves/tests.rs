//! Tests of the waves.

mod accuracy;
mod filters;
mod models;
#[cfg(feature = "reflect")]
mod reflection;
mod refusal;

use super::{FbmWaves, Gerstner, Sea, Sines, Waves};

/// A sea that is there.
fn sea(waves: &Waves) -> Sea {
    Sea::new(waves).expect("the parameters are in range")
}

/// Each model that moves, by default or as a preset.
fn every_model() -> [(&'static str, Waves); 6] {
    [
        ("sines", Waves::Sines(Sines::default())),
        ("gerstner", Waves::Gerstner(Gerstner::default())),
        ("fbm", Waves::Fbm(FbmWaves::default())),
        ("lake", Waves::lake()),
        ("breeze", Waves::breeze()),
        ("gale", Waves::gale()),
    ]
}
