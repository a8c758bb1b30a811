//! Every check and test, in order, with the minutes that each took. It stops at the first that fails.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;

use crate::run::{Failure, Tool, target};
use crate::suites::Tally;
use crate::{examples, readme, setup, suites};

/// What to verify.
#[derive(Args)]
pub struct Options {
    /// Run this step alone; may be given more than once
    #[arg(long, value_name = "STEP", value_parser = STEPS.map(|step| step.name))]
    only: Vec<String>,
    /// List the steps and run none
    #[arg(long)]
    list: bool,
}

struct Step {
    name: &'static str,
    about: &'static str,
    /// What to do when it fails; empty where the failure itself says it.
    advice: &'static str,
    run: fn(&mut Tally) -> Result<(), Failure>,
}

const STEPS: [Step; 11] = [
    Step { name: "setup", about: "a Vulkan driver, rustfmt and clippy", advice: "", run: |_| prepare() },
    Step {
        name: "format",
        about: "rustfmt changes nothing",
        advice: "run `cargo fmt --all`",
        run: |_| Tool::cargo().args(["fmt", "--all", "--check"]).run(),
    },
    Step {
        name: "server",
        about: "the plugin without rendering compiles, and depends on no renderer",
        advice: "",
        run: |_| without_renderer(),
    },
    Step {
        name: "clippy",
        about: "no lint warns",
        advice: "mend what clippy says above; an exception needs its reason beside it",
        run: |_| Tool::cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]).run(),
    },
    Step {
        name: "docs",
        about: "the documentation builds without a warning",
        advice: "mend the documentation named above",
        run: |_| Tool::cargo().env("RUSTDOCFLAGS", "-Dwarnings").args(["doc", "--workspace", "--no-deps"]).run(),
    },
    Step {
        name: "build",
        about: "everything compiles",
        advice: "mend the errors above",
        run: |_| Tool::cargo().args(["build", "--workspace", "--all-targets"]).run(),
    },
    Step {
        name: "test",
        about: "unit, property and integration tests",
        advice: "look at the failures above; `cargo test --workspace NAME` repeats one",
        run: suites::all,
    },
    Step {
        name: "doctest",
        about: "the examples in the documentation",
        advice: "`cargo test --workspace --doc` repeats it",
        run: suites::documentation,
    },
    Step { name: "examples", about: "each example, off screen", advice: "", run: |_| examples::off_screen() },
    Step { name: "window", about: "each example, in a window of Xvfb", advice: "", run: |_| examples::in_window() },
    Step { name: "readme", about: "the commands in the README", advice: "", run: |_| readme::run() },
];

/// Runs the steps, and prints as its last line how many tests passed and failed.
pub fn run(options: &Options) -> ExitCode {
    if options.list {
        for step in &STEPS {
            println!("{:9} {}", step.name, step.about);
        }
        return ExitCode::SUCCESS;
    }
    let mut tally = Tally::default();
    let mut times = Vec::new();
    let mut code = ExitCode::SUCCESS;
    for step in STEPS.iter().filter(|step| options.only.is_empty() || options.only.iter().any(|name| name == step.name))
    {
        println!("== {}: {}", step.name, step.about);
        let start = Instant::now();
        let outcome = (step.run)(&mut tally);
        times.push((step.name, start.elapsed()));
        println!("== {}: {:.1} min", step.name, minutes(start.elapsed()));
        if let Err(failure) = outcome {
            let failure = if step.advice.is_empty() { failure } else { failure.advise(step.advice) };
            println!("== {} failed: {failure}", step.name);
            code = ExitCode::FAILURE;
            break;
        }
    }
    println!("== minutes");
    for (name, time) in &times {
        println!("{name:9} {:5.1}", minutes(*time));
    }
    println!("{:9} {:5.1}", "total", minutes(times.iter().map(|(_, time)| *time).sum()));
    println!("{} passed, {} failed", tally.passed, tally.failed);
    code
}

fn minutes(time: Duration) -> f64 {
    time.as_secs_f64() / 60.0
}

/// A driver for the tests, and the tools of Rust's that its minimal profile leaves out.
fn prepare() -> Result<(), Failure> {
    setup::run()?;
    if ["fmt", "clippy"].iter().all(|tool| Tool::cargo().args([tool, "--version"]).text().is_ok()) {
        return Ok(());
    }
    println!("setup: adding rustfmt and clippy to the Rust toolchain");
    Tool::new("rustup").args(["component", "add", "rustfmt", "clippy"]).run()
}

/// Reads the trees of dependencies, then compiles what a server compiles.
fn without_renderer() -> Result<(), Failure> {
    const RENDERER: [&str; 8] =
        ["wgpu", "wgpu-core", "wgpu-hal", "bevy_render", "bevy_pbr", "bevy_core_pipeline", "bevy_winit", "winit"];
    const ENGINE: [&str; 3] = ["bevy", "bevy_app", "bevy_ecs"];
    let forbidden: [(&str, &str, &[&[&str]]); 2] = [
        ("bevy_horizon", "--no-default-features", &[&RENDERER]),
        ("horizon_field", "--all-features", &[&RENDERER, &ENGINE]),
    ];
    for (package, features, lists) in forbidden {
        let tree = ["tree", "--package", package, features, "--edges", "normal", "--prefix", "none"];
        let tree = Tool::cargo().args(tree).text()?;
        let found = tree.lines().filter_map(|line| line.split(' ').next()).find(|name| lists.concat().contains(name));
        if let Some(name) = found {
            return Err(Failure::new(
                format!("`{package} {features}` depends on `{name}`"),
                "put the dependency behind the `render` feature",
            ));
        }
    }
    // In a directory of its own: other features in the common one would build Bevy twice over.
    let own = target().join("server");
    Tool::cargo()
        .args(["check", "--package", "bevy_horizon", "--no-default-features", "--target-dir"])
        .args([own])
        .run()
}
