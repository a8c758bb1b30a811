//! The README's figures. Between `<!-- figure:KEY -->` and `<!-- /figure -->` stands the number that the summary has under
//! KEY: names and indices, joined by points. So it reads as any text, and is never typed by hand.

use serde_json::Value;
use thiserror::Error;

use crate::run::PUBLISHED;

const OPEN: &str = "<!-- figure:";
const MIDDLE: &str = " -->";
const CLOSE: &str = "<!-- /figure -->";

/// Why a figure can't be written, or is wrong.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// The summary has no such entry.
    #[error("the summary has no figure `{key}`")]
    Unknown {
        /// The figure's key.
        key: String,
    },
    /// The summary's entry is no finite number.
    #[error("the summary's `{key}` is {found}, not a number")]
    NotANumber {
        /// The figure's key.
        key: String,
        /// What it is.
        found: String,
    },
    /// A marker does not end.
    #[error("the figure that begins with `{text}` has no end")]
    Open {
        /// The marker's beginning.
        text: String,
    },
    /// The text is not what the summary says.
    #[error("figure `{key}` reads {shown:?}, and the summary says {expected}: run `cargo charts --publish`")]
    Stale {
        /// The figure's key.
        key: String,
        /// What stands there.
        shown: String,
        /// What should.
        expected: String,
    },
}

/// A figure in a text.
struct Figure<'a> {
    /// All up to the number.
    before: &'a str,
    key: &'a str,
    shown: &'a str,
}

/// The text's figures, and what follows the last.
fn figures(mut text: &str) -> Result<(Vec<Figure<'_>>, &str), FigureError> {
    let mut figures = Vec::new();
    while let Some(start) = text.find(OPEN) {
        let open = || FigureError::Open { text: text[start..].chars().take(60).collect() };
        let key = start + OPEN.len();
        let key_end = key + text[key..].find(MIDDLE).ok_or_else(open)?;
        let number = key_end + MIDDLE.len();
        let number_end = number + text[number..].find(CLOSE).ok_or_else(open)?;
        // The end of the next figure is none of this one.
        if text[number..number_end].contains(OPEN) {
            return Err(open());
        }
        figures.push(Figure {
            before: &text[..number],
            key: text[key..key_end].trim(),
            shown: &text[number..number_end],
        });
        text = &text[number_end..];
    }
    Ok((figures, text))
}

/// The summary's number under a key, as the README shows it.
pub fn figure(summary: &Value, key: &str) -> Result<String, FigureError> {
    let found = key.split('.').try_fold(summary, |value, part| match value {
        Value::Array(items) => part.parse().ok().and_then(|index: usize| items.get(index)),
        value => value.get(part),
    });
    let found = found.ok_or_else(|| FigureError::Unknown { key: key.into() })?;
    let number = found.as_f64().filter(|number| number.is_finite());
    number.map(short).ok_or_else(|| FigureError::NotANumber { key: key.into(), found: found.to_string() })
}

/// The text with all its figures brought up to date.
pub fn update(text: &str, summary: &Value) -> Result<String, FigureError> {
    let (figures, rest) = figures(text)?;
    let mut updated = String::with_capacity(text.len());
    for Figure { before, key, .. } in figures {
        updated.push_str(before);
        updated.push_str(&figure(summary, key)?);
    }
    updated.push_str(rest);
    Ok(updated)
}

/// Whether all figures of the text are the summary's.
pub fn check(text: &str, summary: &Value) -> Result<(), FigureError> {
    for Figure { key, shown, .. } in figures(text)?.0 {
        let expected = figure(summary, key)?;
        if shown != expected {
            return Err(FigureError::Stale { key: key.into(), shown: shown.into(), expected });
        }
    }
    Ok(())
}

/// The keys of the text's figures, in order.
pub fn keys(text: &str) -> Result<Vec<String>, FigureError> {
    Ok(figures(text)?.0.into_iter().map(|figure| figure.key.to_owned()).collect())
}

/// The file names of the charts that the text shows, each once.
pub fn charts(text: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for rest in text.split(&format!("{PUBLISHED}/")).skip(1) {
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || "_-.".contains(*c)).collect();
        if name.ends_with(".svg") && !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// A number to three significant digits, without zeros that say nothing: 12.3, 1230, 0.0123, 1.2e-9.
pub fn short(number: f64) -> String {
    rounded(number, 3)
}

/// A number to so many significant digits, at least one.
pub fn rounded(number: f64, significant: usize) -> String {
    let after_first = significant.max(1) - 1;
    if !number.is_finite() {
        return "–".into();
    }
    let rounded = format!("{number:.after_first$e}");
    let (digits, exponent) = rounded.split_once('e').expect("that is how the format ends");
    let exponent: i32 = exponent.parse().expect("an integer follows the e");
    if number == 0.0 {
        return "0".into();
    }
    let trimmed = |text: String| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    };
    if !(-4..6).contains(&exponent) {
        return format!("{}e{exponent}", trimmed(digits.to_owned()));
    }
    let number: f64 = rounded.parse().expect("it was a number");
    trimmed(format!("{number:.*}", (after_first as i32 - exponent).max(0) as usize))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    const TEXT: &str = "It is <!-- figure:speedup.valley -->1<!-- /figure --> times as fast, in <!-- figure:list.1.ms -->\
                        <!-- /figure --> ms, and <!-- other -->.";

    #[test]
    fn figures_come_from_the_summary() {
        let summary = json!({ "speedup": { "valley": 12.345 }, "list": [{ "ms": 1 }, { "ms": 1234.5 }] });
        let updated = update(TEXT, &summary).unwrap();
        let expected = TEXT.replace("-->1<", "-->12.3<").replace("ms --><", "ms -->1230<");
        assert_eq!(updated, expected);
        assert_eq!(update(&updated, &summary).unwrap(), updated);
        assert_eq!(check(&updated, &summary), Ok(()));
        let stale = FigureError::Stale { key: "speedup.valley".into(), shown: "1".into(), expected: "12.3".into() };
        assert_eq!(check(TEXT, &summary), Err(stale));
        assert_eq!(keys(TEXT).unwrap(), ["speedup.valley", "list.1.ms"]);
        assert_eq!(update("none", &summary).unwrap(), "none");
    }

    #[test]
    fn what_is_wrong_is_named() {
        let error = |text: &str, summary: Value| update(text, &summary).unwrap_err();
        assert_eq!(error(TEXT, json!({ "list": [] })), FigureError::Unknown { key: "speedup.valley".into() });
        let summary = json!({ "speedup": { "valley": "fast" } });
        assert!(error(TEXT, summary).to_string().contains("`speedup.valley` is \"fast\""));
        let summary = json!({ "speedup": { "valley": 1.0 }, "list": [1] });
        assert_eq!(error(TEXT, summary), FigureError::Unknown { key: "list.1.ms".into() });
        for open in ["<!-- figure:a.b", "<!-- figure:a -->1", "<!-- figure:a -->1 <!-- figure:b -->2<!-- /figure -->"] {
            let FigureError::Open { text } = error(open, json!({ "a": 1, "b": 2 })) else { panic!("{open}") };
            assert!(open.starts_with(&text));
        }
    }

    #[test]
    fn numbers_are_short() {
        for (number, text) in [
            (12.345, "12.3"),
            (1234.5, "1230"),
            (99.96, "100"),
            (0.012345, "0.0123"),
            (0.5, "0.5"),
            (3.0, "3"),
            (-2.5, "-2.5"),
            (400.0, "400"),
            (1.2e-9, "1.2e-9"),
            (123456.0, "123000"),
            (1e9, "1e9"),
            (0.0, "0"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(short(number), text);
        }
        assert_eq!([12.345, 0.999, 1234.0].map(|number| rounded(number, 2)), ["12", "1", "1200"]);
    }

    #[test]
    fn charts_are_found_by_their_links() {
        let text = "![a](assets/charts/plane_valley.svg) <img src=\"assets/charts/b-1.svg\"> assets/charts/summary.json \
                    ![a](assets/charts/plane_valley.svg) assets/readme/c.svg";
        assert_eq!(charts(text), ["plane_valley.svg", "b-1.svg"]);
    }
}
