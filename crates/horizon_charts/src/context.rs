//! Where a run reads and writes, and how it shows how far it is.

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};
use std::{env, fs};

use indicatif::{ProgressBar, ProgressStyle};

use crate::store::{self, Row, StoreError, Table};

/// What experiments know of the run they are in.
#[derive(Clone, Debug)]
pub struct Context {
    /// The workspace's root, below which assets lie.
    pub root: PathBuf,
    /// Where tables, charts and the summary go.
    pub out: PathBuf,
    /// Small grids and few repetitions: to see that it works, not to quote.
    pub quick: bool,
    /// When the run began, in seconds since 1970: the stamp of its rows.
    pub run: u64,
    /// How many seeds the cameras drawn by lot have, from 0 on.
    pub seeds: u32,
}

impl Context {
    /// A run that begins now and writes into `out`.
    pub fn new(out: impl Into<PathBuf>, quick: bool) -> Self {
        let run = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Self { root: root(), out: out.into(), quick, run, seeds: if quick { 5 } else { 200 } }
    }

    /// One of two values: of a quick run, or of a whole one.
    pub fn pick<T>(&self, quick: T, whole: T) -> T {
        if self.quick { quick } else { whole }
    }

    /// A table's file.
    pub fn file(&self, table: &str) -> PathBuf {
        self.out.join(format!("{table}.csv"))
    }

    /// Opens a table, to measure into it.
    pub fn table<R: Row>(&self, table: &str) -> Result<Table<R>, StoreError> {
        Table::open(self.file(table))
    }

    /// A table's rows, to draw them; none where there is no file.
    pub fn rows<R: Row>(&self, table: &str) -> Result<Vec<R>, StoreError> {
        store::read(&self.file(table))
    }

    /// Removes tables, where they are.
    pub fn discard(&self, tables: &[&str]) -> io::Result<()> {
        for file in tables.iter().map(|table| self.file(table)).filter(|file| file.exists()) {
            fs::remove_file(file)?;
        }
        Ok(())
    }

    /// A bar for so many groups of rows.
    pub fn progress(&self, experiment: &str, groups: usize) -> Progress {
        let bar = ProgressBar::new(groups as u64);
        let style = ProgressStyle::with_template("{prefix:12} {bar:30} {pos}/{len} {eta:>5} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_prefix(experiment.to_owned());
        Progress { bar, experiment: experiment.to_owned() }
    }
}

/// The workspace's root. Cargo tells it at run time, so that a clone that was moved still works.
pub fn root() -> PathBuf {
    let own = env!("CARGO_MANIFEST_DIR");
    let told = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    // Another package's tests may ask: its directory is then not this crate's, but lies in the same workspace.
    let from = told.as_deref().unwrap_or(Path::new(own));
    let root = from.ancestors().find(|path| path.join("Cargo.lock").exists());
    root.unwrap_or(Path::new(own)).to_path_buf()
}

/// How far an experiment is: a bar in a terminal, elsewhere a line for each group of rows.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    experiment: String,
}

impl Progress {
    /// One more group of rows is there.
    pub fn done(&self, group: &str) {
        self.bar.set_message(group.to_owned());
        self.bar.inc(1);
        if !io::stderr().is_terminal() {
            let (at, of) = (self.bar.position(), self.bar.length().unwrap_or(0));
            // A closed pipe is no reason to stop measuring.
            let _ = writeln!(io::stderr(), "{} {at}/{of}: {group}", self.experiment);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
