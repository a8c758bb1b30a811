//! Runs the commands that the README shows, so that it can't promise one that fails.

use std::fs;

use crate::examples::{unattended, without_display};
use crate::run::{Failure, Tool, root};

/// These aren't run: the first is what runs now, and the others change files.
const LEFT_OUT: [&str; 4] = ["verify", "bless", "add", "install"];

/// Runs each `cargo` command of the README's shell blocks; what draws, draws a few frames off screen.
pub fn run() -> Result<(), Failure> {
    let readme = fs::read_to_string(root().join("README.md"))
        .map_err(|error| Failure::new(format!("README.md: {error}"), "write it, with its commands in `sh` blocks"))?;
    for command in commands(&readme) {
        let shown = command.join(" ");
        let Some(arguments) = arguments(&command) else {
            println!("left out: cargo {shown}");
            continue;
        };
        println!("README: cargo {shown}");
        without_display(Tool::cargo()).args(arguments).run()?;
    }
    Ok(())
}

/// The words after `cargo` of every command in the `sh` blocks of a Markdown text.
fn commands(text: &str) -> Vec<Vec<String>> {
    let mut commands = Vec::new();
    let mut shell = false;
    for line in text.lines().map(str::trim) {
        if let Some(language) = line.strip_prefix("```") {
            shell = language == "sh";
        } else if shell && let Some(rest) = line.strip_prefix("cargo ") {
            commands.push(rest.split_whitespace().take_while(|word| *word != "#").map(str::to_owned).collect());
        }
    }
    commands
}

/// What to call Cargo with, so that the command ends by itself; `None` for one that is left out.
fn arguments(command: &[String]) -> Option<Vec<String>> {
    let (first, rest) = command.split_first()?;
    if LEFT_OUT.contains(&first.as_str()) {
        return None;
    }
    if first == "demo" {
        return Some([vec![first.clone()], unattended("fly_through", rest)].concat());
    }
    let split = command.iter().position(|word| word == "--").unwrap_or(command.len());
    let (own, options) = (&command[..split], command.get(split + 1..).unwrap_or_default());
    let example = own.iter().position(|word| word == "--example").and_then(|at| own.get(at + 1));
    Some(match example {
        Some(example) => [own.to_vec(), vec!["--".to_owned()], unattended(example, options)].concat(),
        None => command.to_vec(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shell_blocks_alone_hold_commands() {
        let text = "```sh\ncargo demo --world a.ron  # flies\ncargo verify\n```\n```rust\ncargo no\n```\ncargo no\n\
                    ```sh\ncargo run --example minimal\n```\n";
        let found: Vec<_> = commands(text).iter().map(|command| arguments(command).map(|a| a.join(" "))).collect();
        let expected = [
            Some("demo --world a.ron --frames 3 --size 160x90".to_owned()),
            None,
            Some("run --example minimal -- --frames 3".to_owned()),
        ];
        assert_eq!(found, expected);
    }
}
