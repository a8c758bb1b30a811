//! A run: measure, draw, sum up, publish.

use std::fs;
use std::path::{Path, PathBuf};

use crate::context::Context;
use crate::experiment::{ChartsError, Experiment};
use crate::{readme, summary};

/// Where published charts and the summary lie, below the root.
pub const PUBLISHED: &str = "assets/charts";

/// What to run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The experiments' names; all of them when none is named.
    pub only: Vec<String>,
    /// Discard the rows of these experiments first.
    pub fresh: bool,
    /// Copy what the README shows into [`PUBLISHED`], and bring its figures up to date.
    pub publish: bool,
}

/// Runs the chosen ones of `experiments`; returns the files that were written.
pub fn run(ctx: &Context, experiments: &[Box<dyn Experiment>], options: &Options) -> Result<Vec<PathBuf>, ChartsError> {
    if options.publish && ctx.quick {
        return Err(ChartsError::QuickPublished);
    }
    fs::create_dir_all(&ctx.out).map_err(ChartsError::io(&ctx.out))?;
    let mut files = Vec::new();
    for experiment in chosen(experiments, &options.only)? {
        if options.fresh {
            ctx.discard(experiment.tables()).map_err(ChartsError::io(&ctx.out))?;
        }
        experiment.measure(ctx)?;
        for drawn in experiment.draw(ctx)? {
            let file = ctx.out.join(format!("{}.svg", drawn.name));
            let svg = drawn.chart.svg().map_err(|source| ChartsError::Plot { chart: drawn.name, source })?;
            fs::write(&file, svg).map_err(ChartsError::io(&file))?;
            files.push(file);
        }
    }
    files.push(summary::write(ctx, experiments)?);
    if options.publish {
        files.extend(publish(ctx)?);
    }
    Ok(files)
}

/// The experiments of these names, in the order of the table.
fn chosen<'a>(experiments: &'a [Box<dyn Experiment>], only: &[String]) -> Result<Vec<&'a dyn Experiment>, ChartsError> {
    if let Some(name) = only.iter().find(|name| experiments.iter().all(|e| e.name() != **name)) {
        let known: Vec<_> = experiments.iter().map(|experiment| experiment.name()).collect();
        return Err(ChartsError::Unknown { name: name.clone(), known: known.join(", ") });
    }
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    Ok(experiments.iter().map(AsRef::as_ref).filter(|e| wanted(e.name())).collect())
}

/// Copies the summary and the charts that the README shows, and writes the summary's figures into the README.
fn publish(ctx: &Context) -> Result<Vec<PathBuf>, ChartsError> {
    let target = ctx.root.join(PUBLISHED);
    fs::create_dir_all(&target).map_err(ChartsError::io(&target))?;
    let page = ctx.root.join("README.md");
    let text = fs::read_to_string(&page).map_err(ChartsError::io(&page))?;
    let mut names = readme::charts(&text);
    for name in &names {
        if !ctx.out.join(name).exists() {
            return Err(ChartsError::NotDrawn { name: name.clone() });
        }
    }
    names.push(summary::FILE.to_owned());
    let mut files = Vec::new();
    for name in names {
        let (from, to) = (ctx.out.join(&name), target.join(&name));
        fs::copy(&from, &to).map_err(ChartsError::io(from))?;
        files.push(to);
    }
    let updated = readme::update(&text, &summary::read(&ctx.out)?)?;
    if updated != text {
        fs::write(&page, updated).map_err(ChartsError::io(&page))?;
        files.push(page);
    }
    Ok(files)
}

/// Whether every figure of the README below `root` is the published summary's, and every chart that it shows is there. For
/// tests.
pub fn check_readme(root: &Path) -> Result<(), ChartsError> {
    let page = root.join("README.md");
    let text = fs::read_to_string(&page).map_err(ChartsError::io(&page))?;
    let published = root.join(PUBLISHED);
    for name in readme::charts(&text) {
        if !published.join(&name).exists() {
            return Err(ChartsError::NotDrawn { name });
        }
    }
    if readme::keys(&text)?.is_empty() {
        return Ok(());
    }
    Ok(readme::check(&text, &summary::read(&published)?)?)
}

#[cfg(test)]
mod tests;
