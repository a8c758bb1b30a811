//! Starts other programs, and says what went wrong with them.

use std::ffi::OsStr;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::{env, fmt};

/// What failed, and what to do about it.
#[derive(Debug)]
pub struct Failure {
    what: String,
    advice: String,
}

impl Failure {
    pub fn new(what: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { what: what.into(), advice: advice.into() }
    }

    /// The same failure with better advice.
    pub fn advise(self, advice: impl Into<String>) -> Self {
        Self { advice: advice.into(), ..self }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\nwhat to do: {}", self.what, self.advice)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::new(error.to_string(), "check that the file or program named is there and may be used")
    }
}

/// A program about to run in the workspace's root.
pub struct Tool(Command);

impl Tool {
    pub fn new(program: impl AsRef<OsStr>) -> Self {
        let mut command = Command::new(program);
        command.current_dir(root());
        Self(command)
    }

    /// Cargo, as if called from a shell: what `cargo run` tells the program it runs would otherwise leak into the inner
    /// build, and crates that look at it would be built again.
    pub fn cargo() -> Self {
        Self::program(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
    }

    /// A program, as if called from a shell.
    pub fn program(program: impl AsRef<OsStr>) -> Self {
        let mut tool = Self::new(program);
        for (name, _) in env::vars_os() {
            let leaks = name.to_str().is_some_and(|name| {
                ["CARGO_PKG_", "CARGO_MANIFEST_", "CARGO_BIN_", "CARGO_CRATE_"].iter().any(|p| name.starts_with(p))
                    || name == "OUT_DIR"
            });
            if leaks {
                tool.0.env_remove(name);
            }
        }
        // The graphics backend that the tests compare by; a choice already made by the caller stands.
        if cfg!(target_os = "linux") && env::var_os("WGPU_BACKEND").is_none() {
            tool.0.env("WGPU_BACKEND", "vulkan");
        }
        tool
    }

    pub fn arg(mut self, arg: impl AsRef<OsStr>) -> Self {
        self.0.arg(arg);
        self
    }

    pub fn args(mut self, args: impl IntoIterator<Item: AsRef<OsStr>>) -> Self {
        self.0.args(args);
        self
    }

    pub fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        self.0.env(name, value);
        self
    }

    pub fn env_remove(mut self, name: &str) -> Self {
        self.0.env_remove(name);
        self
    }

    /// Runs with the terminal as it is.
    pub fn run(mut self) -> Result<(), Failure> {
        let status = self.0.status().map_err(|error| self.not_started(&error))?;
        self.judge(status)
    }

    /// Runs while every line of its standard output is shown and also handed to `see`.
    pub fn watch(mut self, mut see: impl FnMut(&str)) -> Result<(), Failure> {
        let mut child = self.0.stdout(Stdio::piped()).spawn().map_err(|error| self.not_started(&error))?;
        let output = child.stdout.take().expect("piped above");
        for line in BufReader::new(output).lines() {
            let line = line?;
            see(&line);
            writeln!(io::stdout(), "{line}")?;
        }
        let status = child.wait()?;
        self.judge(status)
    }

    /// Runs quietly, and returns its standard output.
    pub fn text(mut self) -> Result<String, Failure> {
        let output = self.0.stderr(Stdio::inherit()).output().map_err(|error| self.not_started(&error))?;
        self.judge(output.status)?;
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }

    fn line(&self) -> String {
        let words = [self.0.get_program()].into_iter().chain(self.0.get_args());
        words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
    }

    fn not_started(&self, error: &io::Error) -> Failure {
        Failure::new(format!("`{}` did not start: {error}", self.line()), "check that the program is installed")
    }

    fn judge(&self, status: ExitStatus) -> Result<(), Failure> {
        if status.success() {
            return Ok(());
        }
        Err(Failure::new(format!("`{}` failed ({status})", self.line()), "look at its messages above"))
    }
}

/// Where cargo builds.
pub fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into)
}

/// The workspace's root. Cargo tells it at run time, so that a clone that was moved still works.
pub fn root() -> PathBuf {
    let told = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let own = told.unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    own.ancestors().nth(2).map(Path::to_path_buf).expect("this crate lies two levels below the root")
}
