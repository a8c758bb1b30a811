//! Flies through a world: in a window with a free camera, or off screen into pictures where there is no display.
//!
//! `cargo run --example fly_through -- --world worlds/islands.ron --path`; `--help` lists the options.

mod film;
mod flight;
mod options;
mod pictures;
mod props;
mod scene;
mod window;

use std::process::ExitCode;

use bevy_horizon_workspace::example::has_display;
use clap::Parser;

fn main() -> ExitCode {
    let options = options::Options::parse();
    if has_display() {
        return window::run(&options);
    }
    match film::run(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
