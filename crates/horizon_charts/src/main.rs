//! `cargo charts`: measures, draws and sums up.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use horizon_charts::context::root;
use horizon_charts::{Context, Options, experiments, run};

/// Measures how fast and how exact the methods are, and draws it. Run it again to go on where it was interrupted.
#[derive(Parser)]
#[command(name = "cargo charts")]
struct Arguments {
    /// Only these experiments, by their names, with commas between
    #[arg(long, value_name = "EXPERIMENT", value_delimiter = ',')]
    only: Vec<String>,
    /// Small grids and few repetitions, into a directory of their own: to see that it works
    #[arg(long)]
    quick: bool,
    /// Where tables, charts and the summary go; `target/charts` when it is not given
    #[arg(long, value_name = "DIRECTORY")]
    out: Option<PathBuf>,
    /// List the experiments and run none
    #[arg(long)]
    list: bool,
    /// Discard the rows of an earlier run
    #[arg(long)]
    fresh: bool,
    /// How many cameras are drawn by lot: the seeds from 0 on; 200 when it is not given
    #[arg(long, value_name = "N")]
    seeds: Option<u32>,
    /// Copy what the README shows into `assets/charts`, and bring its figures up to date
    #[arg(long, conflicts_with = "quick")]
    publish: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let all = experiments::all();
    if arguments.list {
        for experiment in &all {
            println!("{:12} {}", experiment.name(), experiment.about());
        }
        return ExitCode::SUCCESS;
    }
    // A quick run's rows are not to be taken for a whole one's.
    let own = if arguments.quick { "target/charts/quick" } else { "target/charts" };
    let out = arguments.out.unwrap_or_else(|| root().join(own));
    let options = Options { only: arguments.only, fresh: arguments.fresh, publish: arguments.publish };
    let mut ctx = Context::new(out, arguments.quick);
    ctx.seeds = arguments.seeds.unwrap_or(ctx.seeds);
    match run(&ctx, &all, &options) {
        Ok(files) => {
            for file in files {
                println!("{}", file.display());
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
