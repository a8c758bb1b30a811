//! The project's own commands: `cargo demo`, `cargo charts`, `cargo verify`, `cargo bless`. They set the machine up first, so that a fresh
//! one needs Rust, a C linker and git, and nothing else.

mod apt;
mod examples;
mod readme;
mod run;
mod setup;
mod suites;
mod verify;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::run::{Failure, Tool};

#[derive(Parser)]
#[command(name = "cargo", about = "The project's own commands")]
enum Command {
    /// Flies through a world: in a window, or where there is no display, into a file
    #[command(disable_help_flag = true)]
    Demo {
        /// Options of the `fly_through` example (`--help` lists them)
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        options: Vec<OsString>,
    },
    /// Measures speed against accuracy, and draws it
    #[command(disable_help_flag = true)]
    Charts {
        /// Options of the charts (`--help` lists them)
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        options: Vec<OsString>,
    },
    /// Runs every check and test
    Verify(verify::Options),
    /// Renders golden images anew and keeps them; look at each before it is committed
    Bless {
        /// The images to renew; all of them when none is named
        names: Vec<String>,
    },
    /// Installs a Vulkan driver where there is none
    Setup,
}

fn main() -> ExitCode {
    let outcome = match Command::parse() {
        Command::Demo { options } => demo(&options),
        Command::Charts { options } => charts(&options),
        Command::Verify(options) => return verify::run(&options),
        Command::Bless { names } => setup::run().and_then(|()| suites::bless(&names)),
        Command::Setup => setup::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

/// Builds everything, as every command does, and runs the program: built alone it would have Bevy with other features.
fn charts(options: &[OsString]) -> Result<(), Failure> {
    setup::run()?;
    Tool::cargo().args(["build", "--workspace", "--all-targets"]).run()?;
    let program = run::target().join("debug").join(format!("horizon_charts{}", std::env::consts::EXE_SUFFIX));
    let tool = Tool::program(program).args(options);
    // A bar has no room for what each of many apps says as it starts.
    let tool = if std::env::var_os("RUST_LOG").is_none() { tool.env("RUST_LOG", "error,bevy_log=off") } else { tool };
    tool.run()
}

fn demo(options: &[OsString]) -> Result<(), Failure> {
    setup::run()?;
    Tool::cargo().args(["run", "--example", "fly_through", "--"]).args(options).run()
}
