//! Tables of measured rows: one CSV file each, appended to and flushed row by row. Rows that are there are not measured
//! again, so that a run that was interrupted goes on where it stopped.

use std::collections::{BTreeMap, HashMap};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

use crate::columns::columns;

/// A row of a table: a plain struct, whose fields are the columns.
pub trait Row: Serialize + DeserializeOwned {
    /// The settings: what was measured, apart from what came of it.
    type Key: Serialize;

    /// This row's settings.
    fn key(&self) -> Self::Key;

    /// When the run that measured it began ([`Context::run`](crate::Context::run)). Times of different runs are
    /// not to be divided by one another: the machine may have been busy in one of them.
    fn run(&self) -> u64;
}

/// Why a table can't be read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The file system refused.
    #[error("{}: {source}", file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file's columns are not the row type's: it was written by another version.
    #[error(
        "{}: its column {position} is `{found}` where this version has `{expected}`; `--fresh` discards the old rows",
        file.display()
    )]
    Columns {
        /// The file.
        file: PathBuf,
        /// Which column, from 1.
        position: usize,
        /// The file's name for it; empty where the file has fewer columns.
        found: String,
        /// The row type's name for it; empty where it has fewer columns.
        expected: String,
    },
    /// A row can't be read or written.
    #[error("{}: {source}; `--fresh` discards the old rows", file.display())]
    Row {
        /// The file.
        file: PathBuf,
        /// Why, with the line and the field.
        source: csv::Error,
    },
    /// A value holds a line break, which a line of the file can't.
    #[error("{}: a value holds a line break: {line:?}", file.display())]
    LineBreak {
        /// The file.
        file: PathBuf,
        /// The row as it would have been written.
        line: String,
    },
}

/// A table, open for measuring.
#[derive(Debug)]
pub struct Table<R> {
    path: PathBuf,
    file: File,
    rows: Vec<R>,
    /// The runs in which each key was measured.
    runs: HashMap<String, Vec<u64>>,
}

/// Keys are compared as they are written: floats included, which neither hash nor equal themselves always.
fn text(key: &impl Serialize) -> String {
    serde_json::to_string(key).expect("settings are plain data")
}

impl<R: Row> Table<R> {
    /// Opens or creates the file. A last line that a crash cut short is dropped.
    pub fn open(path: impl Into<PathBuf>) -> Result<Self, StoreError> {
        let path = path.into();
        let fail = |source| StoreError::Io { file: path.clone(), source };
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(fail)?;
        }
        let mut file = OpenOptions::new().read(true).append(true).create(true).open(&path).map_err(fail)?;
        let whole = whole_lines(&path)?;
        file.set_len(whole.len() as u64).map_err(fail)?;
        if whole.is_empty() {
            let header = line(&path, |writer| writer.write_record(columns::<R>()))?;
            file.write_all(&header).map_err(fail)?;
        }
        let rows: Vec<R> = parse(&path, &whole)?;
        let mut runs: HashMap<_, Vec<u64>> = HashMap::new();
        for row in &rows {
            runs.entry(text(&row.key())).or_default().push(row.run());
        }
        Ok(Self { path, file, rows, runs })
    }

    /// The rows, in the order in which they were measured.
    pub fn rows(&self) -> &[R] {
        &self.rows
    }

    /// Whether there is a row of these settings, of whichever run. For what does not depend on the hour: errors, counts.
    pub fn has(&self, key: &R::Key) -> bool {
        self.runs.contains_key(&text(key))
    }

    /// Whether a single run has rows of all these settings. For times, which are only compared within one run.
    pub fn has_together<'a>(&self, keys: impl IntoIterator<Item = &'a R::Key>) -> bool
    where
        R::Key: 'a,
    {
        let mut common: Option<Vec<u64>> = None;
        for key in keys {
            let Some(runs) = self.runs.get(&text(key)) else { return false };
            common = Some(common.map_or(runs.clone(), |c| c.into_iter().filter(|run| runs.contains(run)).collect()));
        }
        common.is_none_or(|runs| !runs.is_empty())
    }

    /// Appends a row, and sees it to the file before it returns.
    pub fn push(&mut self, row: R) -> Result<(), StoreError> {
        let bytes = line(&self.path, |writer| writer.serialize(&row))?;
        if bytes.iter().filter(|byte| **byte == b'\n').count() != 1 {
            let line = String::from_utf8_lossy(&bytes).into_owned();
            return Err(StoreError::LineBreak { file: self.path.clone(), line });
        }
        // One write, so that a crash leaves a row or a line without its end.
        let written = self.file.write_all(&bytes).and_then(|()| self.file.flush());
        written.map_err(|source| StoreError::Io { file: self.path.clone(), source })?;
        self.runs.entry(text(&row.key())).or_default().push(row.run());
        self.rows.push(row);
        Ok(())
    }
}

/// The rows of a file, which it leaves as it is; none where there is no file.
pub fn read<R: Row>(path: &Path) -> Result<Vec<R>, StoreError> {
    if path.exists() { parse(path, &whole_lines(path)?) } else { Ok(Vec::new()) }
}

/// The rows of the run that has most of them; of runs with as many, the last. So no two runs are compared.
pub fn of_one_run<'a, R: Row + 'a>(rows: impl IntoIterator<Item = &'a R>) -> Vec<&'a R> {
    let mut runs: BTreeMap<u64, Vec<&R>> = BTreeMap::new();
    for row in rows {
        runs.entry(row.run()).or_default().push(row);
    }
    // `max_by_key` returns the last of equals.
    runs.into_values().max_by_key(Vec::len).unwrap_or_default()
}

/// The file up to its last line break.
fn whole_lines(path: &Path) -> Result<Vec<u8>, StoreError> {
    let mut bytes = fs::read(path).map_err(|source| StoreError::Io { file: path.into(), source })?;
    bytes.truncate(bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1));
    Ok(bytes)
}

fn parse<R: Row>(path: &Path, bytes: &[u8]) -> Result<Vec<R>, StoreError> {
    if bytes.is_empty() {
        return Ok(Vec::new());
    }
    let fail = |source| StoreError::Row { file: path.into(), source };
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader.headers().map_err(fail)?;
    let expected = columns::<R>();
    for position in 0..header.len().max(expected.len()) {
        let (found, expected) = (header.get(position), expected.get(position).copied());
        if found != expected {
            let owned = |name: Option<&str>| name.unwrap_or_default().to_owned();
            let (found, expected) = (owned(found), owned(expected));
            return Err(StoreError::Columns { file: path.into(), position: position + 1, found, expected });
        }
    }
    reader.deserialize().collect::<Result<_, _>>().map_err(fail)
}

/// A line of CSV, with its end and without a header.
fn line(
    path: &Path,
    write: impl FnOnce(&mut csv::Writer<Vec<u8>>) -> Result<(), csv::Error>,
) -> Result<Vec<u8>, StoreError> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    write(&mut writer).map_err(|source| StoreError::Row { file: path.into(), source })?;
    Ok(writer.into_inner().expect("a Vec takes every byte"))
}

#[cfg(test)]
mod tests;
