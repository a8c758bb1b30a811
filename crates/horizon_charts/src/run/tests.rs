use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::*;
use crate::experiment::NamedChart;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::readme::FigureError;
use crate::store::Row;

#[derive(Serialize, Deserialize)]
struct Count {
    run: u64,
    at: u32,
    squared: u32,
}

impl Row for Count {
    type Key = u32;

    fn key(&self) -> u32 {
        self.at
    }

    fn run(&self) -> u64 {
        self.run
    }
}

struct Squares(&'static str);

impl Experiment for Squares {
    fn name(&self) -> &'static str {
        self.0
    }

    fn about(&self) -> &'static str {
        "squares"
    }

    fn tables(&self) -> &'static [&'static str] {
        if self.0 == "first" { &["first"] } else { &["second"] }
    }

    fn measure(&self, ctx: &Context) -> Result<(), ChartsError> {
        let mut table = ctx.table::<Count>(self.0)?;
        let progress = ctx.progress(self.0, 4);
        for at in 1..5 {
            if !table.has(&at) {
                table.push(Count { run: ctx.run, at, squared: at * at })?;
            }
            progress.done(&at.to_string());
        }
        Ok(())
    }

    fn draw(&self, ctx: &Context) -> Result<Vec<NamedChart>, ChartsError> {
        let points = ctx.rows::<Count>(self.0)?.iter().map(|row| (f64::from(row.at), f64::from(row.squared))).collect();
        let panels = vec![Panel { y: Axis::linear("square"), series: vec![Series::new("squares", points)] }];
        let chart = Lines { title: "Squares".into(), note: String::new(), x: Axis::linear("number"), panels };
        Ok(vec![NamedChart::new(self.0, chart)])
    }

    fn summary(&self, ctx: &Context) -> Result<Map<String, Value>, ChartsError> {
        let largest = ctx.rows::<Count>(self.0)?.iter().map(|row| row.squared).max();
        Ok(Map::from_iter([(self.0.to_owned(), json!({ "largest": largest }))]))
    }
}

fn both() -> Vec<Box<dyn Experiment>> {
    vec![Box::new(Squares("first")), Box::new(Squares("second"))]
}

fn only(name: &str) -> Options {
    Options { only: vec![name.into()], ..Options::default() }
}

fn context(directory: &Path) -> Context {
    Context { root: directory.into(), ..Context::new(directory.join("out"), false) }
}

#[test]
fn a_run_of_one_keeps_the_figures_of_the_others() {
    let directory = tempfile::tempdir().unwrap();
    let ctx = context(directory.path());
    let files = run(&ctx, &both(), &only("first")).unwrap();
    assert_eq!(files, ["first.svg", "summary.json"].map(|name| ctx.out.join(name)));
    assert_eq!(summary::read(&ctx.out).unwrap(), json!({ "first": { "largest": 16 } }));
    run(&ctx, &both(), &only("second")).unwrap();
    let whole = json!({ "first": { "largest": 16 }, "second": { "largest": 16 } });
    assert_eq!(summary::read(&ctx.out).unwrap(), whole);
    // What is there is not measured again; `--fresh` does.
    fs::write(ctx.file("first"), "run,at,squared\n0,1,1\n0,9,81\n").unwrap();
    run(&ctx, &both(), &only("first")).unwrap();
    assert_eq!(summary::read(&ctx.out).unwrap()["first"]["largest"], 81);
    assert_eq!(ctx.rows::<Count>("first").unwrap().len(), 5);
    run(&ctx, &both(), &Options { fresh: true, ..only("first") }).unwrap();
    assert_eq!(summary::read(&ctx.out).unwrap(), whole);
}

#[test]
fn what_there_is_not_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let error = run(&context(directory.path()), &both(), &only("third")).unwrap_err().to_string();
    assert!(error.contains("`third`") && error.contains("first, second"), "{error}");
}

#[test]
fn publishing_copies_what_the_readme_shows() {
    let directory = tempfile::tempdir().unwrap();
    let (root, ctx) = (directory.path(), context(directory.path()));
    let page = root.join("README.md");
    let text = "![squares](assets/charts/first.svg): <!-- figure:first.largest -->0<!-- /figure -->.";
    fs::write(&page, text).unwrap();
    let publish = Options { publish: true, ..Options::default() };
    assert!(matches!(check_readme(root), Err(ChartsError::NotDrawn { name }) if name == "first.svg"));
    run(&ctx, &both(), &publish).unwrap();
    assert!(check_readme(root).is_ok());
    assert_eq!(fs::read_to_string(&page).unwrap(), text.replace(">0<", ">16<"));
    assert!(root.join(PUBLISHED).join("first.svg").exists() && !root.join(PUBLISHED).join("second.svg").exists());
    fs::write(&page, text).unwrap();
    assert!(matches!(check_readme(root), Err(ChartsError::Figure(FigureError::Stale { .. }))));
    fs::write(&page, text.replace("first.svg", "third.svg")).unwrap();
    assert!(matches!(run(&ctx, &both(), &publish), Err(ChartsError::NotDrawn { name }) if name == "third.svg"));
    let quick = Context { quick: true, ..ctx };
    assert!(matches!(run(&quick, &both(), &publish), Err(ChartsError::QuickPublished)));
}
