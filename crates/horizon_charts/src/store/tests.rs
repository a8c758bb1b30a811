use serde::Deserialize;

use super::*;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Sample {
    run: u64,
    method: String,
    step: f64,
    ms: Option<f64>,
}

impl Row for Sample {
    type Key = (String, f64);

    fn key(&self) -> Self::Key {
        (self.method.clone(), self.step)
    }

    fn run(&self) -> u64 {
        self.run
    }
}

fn sample(run: u64, method: &str, step: f64) -> Sample {
    Sample { run, method: method.into(), step, ms: Some(step * 2.0) }
}

fn key(step: f64) -> (String, f64) {
    ("fixed, \"a\"".into(), step)
}

fn table_of(directory: &Path, steps: &[f64]) -> PathBuf {
    let path = directory.join("deeper/sample.csv");
    let mut table = Table::open(&path).unwrap();
    for step in steps {
        table.push(sample(1, &key(0.0).0, *step)).unwrap();
    }
    path
}

#[test]
fn an_interrupted_run_goes_on() {
    let directory = tempfile::tempdir().unwrap();
    let path = table_of(directory.path(), &[0.1, 0.25]);
    let mut table: Table<Sample> = Table::open(&path).unwrap();
    assert_eq!((table.has(&key(0.25)), table.has(&key(0.3))), (true, false));
    let none = Sample { ms: None, ..sample(2, "b", 0.3) };
    table.push(none.clone()).unwrap();
    drop(table);
    let rows: Vec<Sample> = read(&path).unwrap();
    assert_eq!(rows.len(), 3);
    assert_eq!((&rows[1].key(), &rows[2]), (&key(0.25), &none));
}

#[test]
fn a_truncated_line_is_dropped_and_measured_again() {
    let directory = tempfile::tempdir().unwrap();
    let path = table_of(directory.path(), &[0.1, 0.25]);
    let whole = fs::read(&path).unwrap();
    let rows_after = |cut: usize| {
        fs::write(&path, &whole[..cut]).unwrap();
        let mut table = Table::open(&path).unwrap();
        let left = table.rows().len();
        for step in [0.1, 0.25] {
            if !table.has(&key(step)) {
                table.push(sample(1, &key(0.0).0, step)).unwrap();
            }
        }
        drop(table);
        assert_eq!(fs::read(&path).unwrap(), whole, "cut at {cut}");
        left
    };
    assert_eq!(rows_after(whole.len() - 1), 1);
    // Wherever the cut is: in the header as well.
    for cut in 0..whole.len() {
        assert!(rows_after(cut) < 2);
    }
}

#[test]
fn another_header_is_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("sample.csv");
    for (header, named) in [
        ("run,method,stride,ms", ["column 3", "`stride`", "`step`"]),
        ("run,method,step", ["column 4", "``", "`ms`"]),
        ("run,method,step,ms,px", ["column 5", "`px`", "``"]),
    ] {
        fs::write(&path, format!("{header}\n")).unwrap();
        for error in [Table::<Sample>::open(&path).unwrap_err(), read::<Sample>(&path).unwrap_err()] {
            assert!(matches!(error, StoreError::Columns { .. }));
            let said = error.to_string();
            for part in named.into_iter().chain(["sample.csv", "--fresh"]) {
                assert!(said.contains(part), "{said} lacks {part}");
            }
        }
    }
    fs::write(&path, "run,method,step,ms\n1,a,wide,\n").unwrap();
    let said = read::<Sample>(&path).unwrap_err().to_string();
    assert!(said.contains("field 2") && said.contains("line: 2"), "{said}");
}

#[test]
fn a_line_break_never_reaches_the_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = table_of(directory.path(), &[0.1]);
    let mut table = Table::open(&path).unwrap();
    assert!(matches!(table.push(sample(1, "two\nlines", 1.0)), Err(StoreError::LineBreak { .. })));
    assert_eq!(read::<Sample>(&path).unwrap().len(), 1);
}

#[test]
fn times_are_taken_from_one_run() {
    let directory = tempfile::tempdir().unwrap();
    let mut table = Table::open(directory.path().join("sample.csv")).unwrap();
    let keys = [0.1, 0.2].map(|step| ("a".to_owned(), step));
    table.push(sample(1, "a", 0.1)).unwrap();
    table.push(sample(2, "a", 0.2)).unwrap();
    assert!(keys.iter().all(|key| table.has(key)) && !table.has_together(&keys));
    table.push(sample(2, "a", 0.1)).unwrap();
    assert!(table.has_together(&keys));
    assert_eq!(of_one_run(table.rows()).iter().map(|row| row.run).collect::<Vec<_>>(), [2, 2]);
    table.push(sample(3, "a", 0.1)).unwrap();
    table.push(sample(3, "a", 0.2)).unwrap();
    assert_eq!(of_one_run(table.rows())[0].run, 3, "the last one of equals");
    assert!(of_one_run::<Sample>([]).is_empty());
}
