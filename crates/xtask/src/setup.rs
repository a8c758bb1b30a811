//! Puts a Vulkan driver on a Linux machine that has none; does nothing anywhere else.
//!
//! The driver is Mesa's lavapipe, which draws on the processor. Debian 12 has Mesa 22, on which Bevy's own atmosphere crashes;
//! its backports have 25, so these are preferred, from the mirror that the machine already trusts. The plugin runs on both.

use std::io::{self, BufRead, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::apt::{self, Backports, Source};
use crate::run::{Failure, Tool};

const DRIVER: &str = "mesa-vulkan-drivers";
const LOADER: &str = "libvulkan1";

/// What winit loads at run time to open a window under X11. Nothing but a C linker is needed to build: the features of Bevy
/// that want ALSA's, udev's or Wayland's headers are off.
const WINDOW_LIBRARIES: [&str; 7] =
    ["libx11-6", "libx11-xcb1", "libxcursor1", "libxi6", "libxrandr2", "libxkbcommon0", "libxkbcommon-x11-0"];

/// A display in memory, for the tests that open a window; wanted only where there is no display.
const VIRTUAL_DISPLAY: &str = "xvfb";

/// Makes sure that programs can draw, as far as that is ours to do.
pub fn run() -> Result<(), Failure> {
    if !cfg!(target_os = "linux") {
        println!("setup: nothing to install on this system");
        return Ok(());
    }
    let (driver, loader) = (has_driver(), has_loader());
    if driver && loader {
        println!("setup: a Vulkan driver is there, nothing to install");
        return Ok(());
    }
    if !Path::new("/usr/bin/apt-get").exists() {
        return Err(Failure::new(
            "there is no Vulkan driver, and no apt to install one",
            "install Mesa's Vulkan drivers (lavapipe draws on the processor) and the Vulkan loader with your package manager",
        ));
    }
    let script = if driver { install(&[LOADER]) } else { driver_script()? };
    println!("setup: no Vulkan {} found; what installs it:\n  {script}", if driver { "loader" } else { "driver" });
    if is_root()? {
        shell(Tool::new("sh"), &script)
    } else if io::stdin().is_terminal() && agreed()? {
        shell(Tool::new("sudo").arg("sh"), &script)
    } else {
        let line = script.replace('\'', r"'\''");
        Err(Failure::new("there is no Vulkan driver", format!("run this once:\n  sudo sh -ec '{line}'")))
    }
}

/// The one line of shell that installs the driver and what goes with it.
fn driver_script() -> Result<String, Failure> {
    let display = ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| is_set(name));
    let others = [LOADER].into_iter().chain(WINDOW_LIBRARIES).chain((!display).then_some(VIRTUAL_DISPLAY));
    let others: Vec<_> = others.collect();
    let stable = install(&[&[DRIVER], &others[..]].concat());
    if release("ID") != "debian" || release("VERSION_CODENAME") != "bookworm" {
        return Ok(stable);
    }
    // `package/suite` takes this package, and of its dependencies only what it needs, from the backports.
    let pinned = format!("{DRIVER}/bookworm-backports");
    let backported = install(&[&[pinned.as_str()], &others[..]].concat());
    Ok(match apt::backports(Path::new("/etc/apt"), "bookworm")? {
        Backports::Configured => format!("{{ {backported}; }} || {{ {stable}; }}"),
        Backports::Derivable(source) => {
            let file = format!("/etc/apt/sources.list.d/{}", source.file_name);
            // A mirror without backports must not be left as a source that breaks every later update.
            format!("{{ {}; {backported}; }} || {{ rm -f {file}; {stable}; }}", write(&file, &source))
        }
        Backports::Unknown => stable,
    })
}

fn install(packages: &[&str]) -> String {
    let install = "DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends";
    // One broken source fails the update, but need not be one of ours: the install tells.
    format!("apt-get update || true; {install} {}", packages.join(" "))
}

fn write(file: &str, source: &Source) -> String {
    let lines: Vec<_> = source.lines.iter().map(|line| format!("'{}'", line.replace('\'', r"'\''"))).collect();
    format!(r"printf '%s\n' {} > {file}", lines.join(" "))
}

fn shell(tool: Tool, script: &str) -> Result<(), Failure> {
    tool.arg("-ec").arg(script).run().map(drop)?;
    if has_driver() && has_loader() {
        return Ok(());
    }
    Err(Failure::new("the packages are installed, but no Vulkan driver came with them", "look at apt's messages above"))
}

fn agreed() -> io::Result<bool> {
    print!("Run it now with sudo? [y/N] ");
    io::stdout().flush()?;
    let mut answer = String::new();
    io::stdin().lock().read_line(&mut answer)?;
    Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
}

fn is_root() -> Result<bool, Failure> {
    Ok(Tool::new("id").arg("-u").text()?.trim() == "0")
}

/// Whether the loader would find a driver's manifest, in the directories that the Vulkan loader documents for Linux.
fn has_driver() -> bool {
    let named = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().any(|name| is_set(name));
    let home = env::var_os("HOME").map(|home| PathBuf::from(home).join(".local/share"));
    let roots = ["/etc", "/usr/share", "/usr/local/share", "/usr/local/etc"].map(PathBuf::from);
    named || roots.into_iter().chain(home).any(|root| holds(&root.join("vulkan/icd.d"), |name| name.ends_with(".json")))
}

/// Whether the dynamic linker would find the Vulkan loader.
fn has_loader() -> bool {
    let is_loader = |name: &str| name == "libvulkan.so.1";
    let variable = env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    let roots = ["/usr/lib", "/usr/lib64", "/lib", "/usr/local/lib"].map(PathBuf::from);
    // Debian keeps libraries one level down, under the name of the architecture.
    let nested = fs::read_dir("/usr/lib").into_iter().flatten().flatten().map(|entry| entry.path());
    roots.into_iter().chain(nested).chain(env::split_paths(&variable)).any(|root| holds(&root, is_loader))
}

fn is_set(variable: &str) -> bool {
    env::var_os(variable).is_some_and(|value| !value.is_empty())
}

fn holds(directory: &Path, wanted: impl Fn(&str) -> bool) -> bool {
    fs::read_dir(directory).is_ok_and(|entries| entries.flatten().any(|e| e.file_name().to_str().is_some_and(&wanted)))
}

/// A value of `os-release(5)`, empty where there is none.
fn release(key: &str) -> String {
    let text = fs::read_to_string("/etc/os-release").unwrap_or_default();
    let value = text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
    value.unwrap_or_default().trim_matches('"').to_owned()
}
