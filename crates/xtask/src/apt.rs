//! Debian's package sources: finds the machine's own mirror, and derives from it the source of its backports.
//!
//! The format is that of `sources.list(5)`: one line per source in `*.list`, a deb822 stanza per source in `*.sources`.

use std::path::Path;
use std::{fs, io};

/// A source to be added: the file's name below `sources.list.d`, and its lines.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    pub file_name: String,
    pub lines: Vec<String>,
}

/// What the machine's sources say of a suite's backports.
#[derive(Debug, PartialEq, Eq)]
pub enum Backports {
    /// They are among the sources.
    Configured,
    /// They can be had from the mirror that the suite itself comes from.
    Derivable(Source),
    /// The suite itself is in no source.
    Unknown,
}

/// Reads the sources under `directory` (in use: `/etc/apt`), and answers for the backports of `suite`.
pub fn backports(directory: &Path, suite: &str) -> io::Result<Backports> {
    let wanted = format!("{suite}-backports");
    let mut derived = None;
    for (text, deb822) in source_files(directory)? {
        for source in if deb822 { stanzas(&text) } else { one_liners(&text) } {
            let suites = source.suites();
            if suites.contains(&wanted.as_str()) {
                return Ok(Backports::Configured);
            }
            if suites.contains(&suite) && derived.is_none() {
                derived = Some(source.with_suite(&wanted));
            }
        }
    }
    Ok(derived.map_or(Backports::Unknown, Backports::Derivable))
}

/// The texts of all source files in apt's order of reading, each with whether it is in deb822 format.
fn source_files(directory: &Path) -> io::Result<Vec<(String, bool)>> {
    let mut paths = vec![directory.join("sources.list")];
    if let Ok(entries) = fs::read_dir(directory.join("sources.list.d")) {
        let mut parts = entries.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
        parts.sort();
        paths.extend(parts);
    }
    let mut texts = Vec::new();
    for path in paths.iter().filter(|path| path.is_file()) {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("list") => texts.push((fs::read_to_string(path)?, false)),
            Some("sources") => texts.push((fs::read_to_string(path)?, true)),
            // apt ignores every other ending, and so do we.
            _ => {}
        }
    }
    Ok(texts)
}

/// One enabled source of binary packages, kept as written: its options and keys pass on to what is derived from it.
enum Entry {
    /// `deb [options] uri suite components…`, split so that `suite` can be replaced.
    Line { head: String, suite: String },
    /// Fields of a deb822 stanza with their continuation lines; comments are dropped.
    Stanza(Vec<(String, String)>),
}

impl Entry {
    fn suites(&self) -> Vec<&str> {
        match self {
            Self::Line { suite, .. } => vec![suite],
            Self::Stanza(fields) => fields
                .iter()
                .filter(|(name, _)| name.eq_ignore_ascii_case("Suites"))
                .flat_map(|(_, value)| value.split_whitespace())
                .collect(),
        }
    }

    /// The same mirror, options and keys with another suite, of which only `main` is taken.
    fn with_suite(&self, suite: &str) -> Source {
        match self {
            Self::Line { head, .. } => {
                Source { file_name: format!("{suite}.list"), lines: vec![format!("{head} {suite} main")] }
            }
            Self::Stanza(fields) => {
                let lines = fields.iter().flat_map(|(name, value)| {
                    let value = match name.to_ascii_lowercase().as_str() {
                        "types" => "deb",
                        "suites" => suite,
                        "components" => "main",
                        _ => value,
                    };
                    format!("{name}: {value}").lines().map(str::to_owned).collect::<Vec<_>>()
                });
                Source { file_name: format!("{suite}.sources"), lines: lines.collect() }
            }
        }
    }
}

fn one_liners(text: &str) -> Vec<Entry> {
    text.lines().filter_map(one_liner).collect()
}

fn one_liner(line: &str) -> Option<Entry> {
    let line = line.split('#').next()?.trim();
    let rest = line.strip_prefix("deb")?;
    // Also turns `deb-src` away.
    if !rest.starts_with(char::is_whitespace) {
        return None;
    }
    let rest = rest.trim_start();
    let (options, rest) = match rest.strip_prefix('[') {
        Some(inner) => {
            let (options, rest) = inner.split_once(']')?;
            (format!("[{options}] "), rest)
        }
        None => (String::new(), rest),
    };
    let mut words = rest.split_whitespace();
    let (uri, suite) = (words.next()?, words.next()?);
    Some(Entry::Line { head: format!("deb {options}{uri}"), suite: suite.to_owned() })
}

fn stanzas(text: &str) -> Vec<Entry> {
    let mut stanzas = vec![Vec::<(String, String)>::new()];
    for line in text.lines() {
        let fields = stanzas.last_mut().expect("never empty");
        if line.trim().is_empty() {
            stanzas.push(Vec::new());
        } else if line.starts_with('#') {
            // A comment ends neither a stanza nor a field.
        } else if line.starts_with([' ', '\t']) {
            if let Some((_, value)) = fields.last_mut() {
                value.push('\n');
                value.push_str(line);
            }
        } else if let Some((name, value)) = line.split_once(':') {
            fields.push((name.trim().to_owned(), value.trim().to_owned()));
        }
    }
    let field = |fields: &[(String, String)], name: &str| {
        fields.iter().find(|(key, _)| key.eq_ignore_ascii_case(name)).map(|(_, value)| value.clone())
    };
    stanzas
        .into_iter()
        .filter(|fields| {
            let binary = field(fields, "Types").is_some_and(|types| types.split_whitespace().any(|word| word == "deb"));
            let enabled = field(fields, "Enabled").is_none_or(|value| !value.eq_ignore_ascii_case("no"));
            binary && enabled
        })
        .map(Entry::Stanza)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn derived(entries: Vec<Entry>) -> Vec<Source> {
        entries
            .iter()
            .filter(|entry| entry.suites().contains(&"bookworm"))
            .map(|entry| entry.with_suite("bookworm-backports"))
            .collect()
    }

    #[test]
    fn a_line_keeps_its_options_and_mirror() {
        let text = "# deb file:/off bookworm main\n\
                    deb-src file:/src bookworm main\n\
                    deb file:/security bookworm-security main\n\
                    deb [arch=amd64 signed-by=/k.gpg] file:/mirror bookworm main contrib # own\n";
        let expected = Source {
            file_name: "bookworm-backports.list".into(),
            lines: vec!["deb [arch=amd64 signed-by=/k.gpg] file:/mirror bookworm-backports main".into()],
        };
        assert_eq!(derived(one_liners(text)), [expected]);
    }

    #[test]
    fn a_stanza_keeps_its_key_and_mirror() {
        let text = "Types: deb deb-src\n# a note\nURIs: file:/mirror\nSuites: bookworm bookworm-updates\n\
                    Components: main contrib\nSigned-By:\n -----BEGIN\n .\n -----END\n\n\
                    Types: deb\nEnabled: no\nURIs: file:/off\nSuites: bookworm\nComponents: main\n\n\
                    Types: deb-src\nURIs: file:/src\nSuites: bookworm\nComponents: main\n";
        let lines = [
            "Types: deb",
            "URIs: file:/mirror",
            "Suites: bookworm-backports",
            "Components: main",
            "Signed-By: ",
            " -----BEGIN",
            " .",
            " -----END",
        ];
        let expected = Source {
            file_name: "bookworm-backports.sources".into(),
            lines: lines.iter().map(|line| (*line).to_owned()).collect(),
        };
        assert_eq!(derived(stanzas(text)), [expected]);
    }
}
