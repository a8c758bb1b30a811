//! `summary.json`: what all tables say, in figures. It is made from all tables that are there, so that a run of one
//! experiment keeps the figures of the others.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment};

/// The file's name.
pub const FILE: &str = "summary.json";

/// The summary of all experiments that were ever measured into the run's directory.
pub fn assemble(ctx: &Context, experiments: &[Box<dyn Experiment>]) -> Result<Value, ChartsError> {
    let mut all = Map::new();
    for experiment in experiments {
        if experiment.tables().first().is_some_and(|table| ctx.file(table).exists()) {
            all.extend(experiment.summary(ctx)?);
        }
    }
    Ok(Value::Object(all))
}

/// Writes the summary; returns its file.
pub fn write(ctx: &Context, experiments: &[Box<dyn Experiment>]) -> Result<PathBuf, ChartsError> {
    let file = ctx.out.join(FILE);
    let mut text = serde_json::to_string_pretty(&assemble(ctx, experiments)?).expect("a JSON value is writable");
    text.push('\n');
    fs::write(&file, text).map_err(ChartsError::io(&file))?;
    Ok(file)
}

/// Reads the summary of a directory.
pub fn read(directory: &Path) -> Result<Value, ChartsError> {
    let file = directory.join(FILE);
    let text = fs::read_to_string(&file).map_err(ChartsError::io(&file))?;
    serde_json::from_str(&text).map_err(|source| ChartsError::Summary { file, source })
}
