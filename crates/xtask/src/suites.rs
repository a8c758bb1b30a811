//! The test suites, and the count of what passed.

use crate::run::{Failure, Tool};

/// How many tests passed and failed, summed over all test programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub passed: u32,
    pub failed: u32,
}

impl Tally {
    /// Adds what a line says, if it is the last line of a test program: `test result: ok. 3 passed; 0 failed; …`.
    fn see(&mut self, line: &str) {
        let Some((_, counts)) = line.strip_prefix("test result: ").and_then(|rest| rest.split_once(". ")) else {
            return;
        };
        for count in counts.split(';') {
            match count.trim().split_once(' ') {
                Some((number, "passed")) => self.passed += number.parse().unwrap_or(0),
                Some((number, "failed")) => self.failed += number.parse().unwrap_or(0),
                _ => {}
            }
        }
    }
}

/// All unit, property and integration tests. Runs on after a failure, so that one run tells all.
pub fn all(tally: &mut Tally) -> Result<(), Failure> {
    let test = Tool::cargo().args(["test", "--workspace", "--all-targets", "--no-fail-fast"]);
    test.watch(|line| tally.see(line))
}

/// The examples in the documentation.
pub fn documentation(tally: &mut Tally) -> Result<(), Failure> {
    Tool::cargo().args(["test", "--workspace", "--doc", "--no-fail-fast"]).watch(|line| tally.see(line))
}

/// Runs the golden tests with `BLESS` set to the names, joined by commas, or to `all`: the one way to write a golden image.
pub fn bless(names: &[String]) -> Result<(), Failure> {
    let names = if names.is_empty() { "all".to_owned() } else { names.join(",") };
    Tool::cargo().env("BLESS", names).args(["test", "--test", "main", "--", "golden"]).run()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_results_are_counted() {
        let mut tally = Tally::default();
        for line in [
            "running 3 tests",
            "test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.10s",
            "test a::b ... ok",
            "test result: FAILED. 1 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.10s",
        ] {
            tally.see(line);
        }
        assert_eq!(tally, Tally { passed: 4, failed: 2 });
    }
}
