//! Charts are looked at by eye; what can be told without: that they are SVG, and say what they should.

use super::*;

fn lines() -> Lines {
    let curve = |k: f64| (1..50).map(|i| (f64::from(i), k * f64::from(i).powi(2))).collect::<Vec<_>>();
    let band = curve(2.0).iter().map(|(x, y)| (*x, y * 0.5, y * 2.0)).collect();
    Lines {
        title: "Errors grow with the square of the step, and times fall".into(),
        note: "made up".into(),
        x: Axis::log("step a, m"),
        panels: vec![
            Panel {
                y: Axis::log("error, px"),
                series: vec![
                    Series::new("fixed <step>", curve(2.0)).with_band(band),
                    Series::new("truth & all", curve(1.0)).as_reference(),
                ],
            },
            Panel { y: Axis::linear("time, ms"), series: vec![Series::new("total", curve(-0.1)).marked()] },
        ],
    }
}

fn scatter() -> Scatter {
    let dot = |x: f64, y: f64, missed: bool| Dot { x, y, missed, label: format!("a {x}") };
    Scatter {
        title: "Ours is on the front".into(),
        note: String::new(),
        x: Axis::log("time, ms"),
        y: Axis::log("error, px"),
        groups: vec![
            Group { name: "ours".into(), dots: vec![dot(1.0, 0.1, false), dot(2.0, 0.05, false)] },
            Group { name: "naive".into(), dots: vec![dot(10.0, 0.2, true), dot(f64::NAN, 1.0, false)] },
        ],
        missed: "missed pixels".into(),
    }
}

fn bars() -> Bars {
    Bars {
        title: "Twice as fast".into(),
        note: String::new(),
        x: "octaves".into(),
        y: Axis::linear("queries a second, millions"),
        categories: vec!["4".into(), "two words".into()],
        series: vec![
            BarSeries { name: "ours".into(), values: vec![2.0, 4.0] },
            BarSeries { name: "theirs".into(), values: vec![1.0, f64::NAN] },
        ],
    }
}

/// The tags' names, with their depth; panics where the text is no well-formed XML.
fn tags(svg: &str) -> Vec<(usize, String)> {
    let mut open: Vec<String> = Vec::new();
    let mut tags = Vec::new();
    for part in svg.split('<').skip(1) {
        let (tag, text) = part.split_once('>').expect("every tag ends");
        assert!(!text.contains('>'), "{text}");
        for entity in text.split('&').skip(1) {
            assert!(["lt;", "gt;", "amp;", "quot;", "apos;", "#"].iter().any(|e| entity.starts_with(e)), "{entity}");
        }
        assert!(tag.matches('"').count() % 2 == 0, "{tag}");
        let name: String = tag.trim_start_matches('/').chars().take_while(|c| c.is_alphanumeric()).collect();
        if tag.starts_with('/') {
            assert_eq!(open.pop().as_ref(), Some(&name));
        } else {
            tags.push((open.len(), name.clone()));
            if !tag.ends_with('/') {
                open.push(name);
            }
        }
    }
    assert!(open.is_empty(), "{open:?} are left open");
    tags
}

#[test]
fn charts_are_svg_and_hold_their_words() {
    let charts: [(Chart, &[&str]); 3] = [
        (
            lines().into(),
            &[
                "Errors grow with the square",
                "step a, m",
                "error, px",
                "time, ms",
                "fixed &lt;step&gt;",
                "truth &amp; all",
                "total",
            ],
        ),
        (
            scatter().into(),
            &["Ours is on the front", "time, ms", "ours", "naive", "Pareto front", "missed pixels", "a 10"],
        ),
        (bars().into(), &["Twice as fast", "octaves", "theirs", "two words"]),
    ];
    for (chart, words) in charts {
        let svg = chart.svg().unwrap();
        let tags = tags(&svg);
        assert_eq!(tags[0], (0, "svg".to_owned()));
        assert!(tags.len() > 20 && tags[1..].iter().all(|(depth, _)| *depth > 0));
        assert!(svg.contains("width=\"860\" height=\"520\" viewBox=\"0 0 3440 2080\""));
        for words in words {
            assert!(svg.contains(words), "{words:?} is not in the chart");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
}

#[test]
fn marks_stand_where_values_are() {
    // Two crosses: the point's own, and the one that the column of names explains.
    let svg = Chart::from(scatter()).svg().unwrap();
    let mut without = scatter();
    without.groups[1].dots[0].missed = false;
    let crosses = |svg: &str| svg.matches("<polyline").count();
    assert_eq!(crosses(&svg) - crosses(&Chart::from(without).svg().unwrap()), 4);
    // Twice the value, twice the height.
    let svg = Chart::from(bars()).svg().unwrap();
    let heights: Vec<f64> = svg
        .split("<rect ")
        .filter(|rect| rect.contains("#0072B2"))
        .filter_map(|rect| rect.split("height=\"").nth(1)?.split('"').next()?.parse().ok())
        .collect();
    assert!(heights.iter().any(|a| heights.iter().any(|b| (a - 2.0 * b).abs() <= 2.0)), "{heights:?}");
}

#[test]
fn nothing_is_no_chart() {
    let mut empty = lines();
    empty.panels[1].series[0].points = vec![(1.0, f64::NAN)];
    assert!(matches!(Chart::from(empty).svg(), Err(PlotError::Empty)));
    let empty = Bars { categories: vec![], ..bars() };
    assert!(matches!(Chart::from(empty).svg(), Err(PlotError::Empty)));
    let empty = Scatter { groups: vec![], ..scatter() };
    assert!(matches!(Chart::from(empty).svg(), Err(PlotError::Empty)));
}

#[test]
fn names_keep_apart_and_inside() {
    let placed = sheet::spread(&[10, 11, 12, 95, 96], 10, [0, 100]);
    assert_eq!(placed, [10, 20, 30, 90, 100]);
    assert_eq!(sheet::wrap("one two  three", 7), ["one two", "three"]);
}
