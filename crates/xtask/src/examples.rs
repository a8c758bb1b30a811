//! Runs the examples unattended: off screen, and where Xvfb is there, once more in a window.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::{env, fs};

use crate::run::{Failure, Tool, root};

/// Each example, with the options that make it end by itself after a few frames.
const UNATTENDED: [(&str, &[(&str, &str)]); 10] = [
    ("balls", &[("--frames", "3")]),
    ("bench", &[("--frames", "2"), ("--size", "160x90")]),
    ("far_away", &[("--frames", "3")]),
    ("fly_through", &[("--frames", "3"), ("--size", "160x90")]),
    // The world file comes with the third frame or so.
    ("forest", &[("--frames", "8")]),
    ("lake", &[("--frames", "3")]),
    ("lights", &[("--frames", "3")]),
    ("minimal", &[("--frames", "3")]),
    // A pretended pointer clicks every three frames.
    ("plant", &[("--frames", "8")]),
    ("time_of_day", &[("--frames", "3"), ("--size", "160x90")]),
];

/// The options of `command` with those of the example that it runs put in, in place of its own values where it has them.
pub fn unattended(example: &str, options: &[String]) -> Vec<String> {
    let mut options = options.to_vec();
    let row = UNATTENDED.iter().find(|(name, _)| *name == example);
    for (flag, value) in row.map_or(&[][..], |(_, short)| short) {
        match options.iter().position(|option| option == flag) {
            Some(at) if at + 1 < options.len() => options[at + 1] = (*value).to_owned(),
            _ => options.extend([(*flag).to_owned(), (*value).to_owned()]),
        }
    }
    options
}

/// Every example without a display.
pub fn off_screen() -> Result<(), Failure> {
    for name in names()? {
        without_display(Tool::cargo()).args(["run", "--example", &name, "--"]).args(unattended(&name, &[])).run()?;
    }
    Ok(())
}

/// Every example in a window, on a display in memory. Without Xvfb, and on other systems, it says that it did nothing.
pub fn in_window() -> Result<(), Failure> {
    let Some(display) = Display::start()? else {
        println!("Xvfb is not installed: the examples did not run in a window");
        return Ok(());
    };
    for name in names()? {
        let run = Tool::cargo().env_remove("WAYLAND_DISPLAY").env("DISPLAY", &display.name);
        run.args(["run", "--example", &name, "--"]).args(unattended(&name, &[])).run()?;
    }
    Ok(())
}

/// A program that finds no display, even on a desktop.
pub fn without_display(tool: Tool) -> Tool {
    tool.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY")
}

/// The names of all examples. One that nobody told how to end by itself fails, so that none goes untested.
fn names() -> Result<Vec<String>, Failure> {
    let mut names = Vec::new();
    for entry in fs::read_dir(root().join("examples"))? {
        let path = entry?.path();
        // A directory with a `main.rs` is an example too; any other file belongs to one.
        if path.extension() == Some(OsStr::new("rs")) || path.join("main.rs").exists() {
            names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    names.sort();
    match names.iter().find(|name| UNATTENDED.iter().all(|(known, _)| known != name)) {
        Some(name) => Err(Failure::new(
            format!("the example `{name}` is never run"),
            "add it, with options that end it after a few frames, to UNATTENDED in crates/xtask/src/examples.rs",
        )),
        None => Ok(names),
    }
}

/// A running X server that draws into memory.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// Starts a server on a free display, `None` where Xvfb isn't installed.
    fn start() -> Result<Option<Self>, Failure> {
        let path = env::var_os("PATH").unwrap_or_default();
        if !env::split_paths(&path).any(|directory| directory.join("Xvfb").is_file()) {
            return Ok(None);
        }
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp"]);
        let mut server = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
        let output = server.stdout.take().expect("piped above");
        let mut display = Self { server, name: String::new() };
        // The server writes its number once it takes connections.
        let mut number = String::new();
        BufReader::new(output).read_line(&mut number)?;
        if number.trim().is_empty() {
            return Err(Failure::new("Xvfb did not start", "run `Xvfb -displayfd 1` by hand to see why"));
        }
        display.name = format!(":{}", number.trim());
        Ok(Some(display))
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It may have died by itself; nothing is left to do then.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_values_give_way_to_short_ones() {
        let given = ["--world", "alpine.ron", "--frames", "240"].map(str::to_owned);
        let short = ["--world", "alpine.ron", "--frames", "3", "--size", "160x90"].map(str::to_owned);
        assert_eq!(unattended("fly_through", &given), short);
        assert_eq!(unattended("unknown", &given), given);
    }
}
