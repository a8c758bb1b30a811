use super::*;
use crate::columns::columns;
use crate::plot::Chart;

fn row(method: &str, settings: &str, ms: f64, missed: u64, error: f64) -> MarchRow {
    MarchRow {
        run: 1,
        device: Device::Gpu,
        view: "valley".into(),
        method: method.into(),
        settings: settings.into(),
        frames: 20,
        ms,
        fill_ms: if method == OURS { 1.0 } else { 0.0 },
        evals_per_ray: 0.0,
        loads_per_ray: 0.0,
        missed,
        false_hits: 0,
        silhouette_share: 0.01,
        ide_px_mean: error,
        normal_px_p99: 3.0 * error,
        hde_px_mean: error,
    }
}

fn rows() -> Vec<MarchRow> {
    vec![
        row(OURS, "budget 0.5", 9.0, 0, 0.1),
        row(OURS, "budget 1", 4.0, 0, 0.3),
        row(OURS, "budget 2", 2.0, 0, 0.8),
        row("fixed", "a 1", 100.0, 2, 0.05),
        row("fixed", "a 0.1", 1000.0, 0, 0.1),
        row("segment", "", 300.0, 0, 0.02),
    ]
}

#[test]
fn the_fastest_rival_that_is_no_worse_is_compared() {
    let found = speedup_at_equal_error(&rows()).unwrap();
    assert_eq!((found.ratio, found.loosened), (30.0, false));
    assert_eq!((found.ours.as_str(), found.rival.as_str()), ("budget 0.5", "segment "));
    assert_eq!((found.ours_ms, found.rival_ms), (10.0, 300.0));
    // A rival that is worse in one error alone does not count, whatever it is.
    let mut other = rows();
    other[5].false_hits = 1;
    assert_eq!(speedup_at_equal_error(&other).unwrap().ratio, 100.0);
    other[5] = MarchRow { normal_px_p99: 1.0, ..rows()[5].clone() };
    assert_eq!(speedup_at_equal_error(&other).unwrap().ratio, 100.0);
    other[5] = MarchRow { ms: f64::NAN, ..rows()[5].clone() };
    assert_eq!(speedup_at_equal_error(&other).unwrap().ratio, 100.0);
}

#[test]
fn ours_is_loosened_to_the_most_exact_rival() {
    let mut rows = rows();
    rows.truncate(4);
    rows.push(row("fixed", "a 2", 50.0, 0, 0.5));
    rows.push(row("fixed", "a 4", 10.0, 0, 0.9));
    let found = speedup_at_equal_error(&rows).unwrap();
    // The rival without wrong pixels is the most exact one, though another has the smaller mean.
    assert_eq!((found.rival.as_str(), found.ours.as_str(), found.loosened), ("fixed a 2", "budget 1", true));
    assert_eq!(found.ratio, 10.0);
}

#[test]
fn where_nothing_compares_there_is_no_ratio() {
    let all = rows();
    assert_eq!(speedup_at_equal_error(&all[..3]), None);
    assert_eq!(speedup_at_equal_error(&all[3..]), None);
    // Wrong pixels of ours that the best rival has not.
    let ours = row(OURS, "", 1.0, 1, 0.4);
    let rival = row("fixed", "", 1.0, 0, 0.5);
    assert_eq!(speedup_at_equal_error([&ours, &rival]), None);
    // Worse in the mean and in the percentile than a rival that has wrong pixels.
    let ours = row(OURS, "", 1.0, 0, 0.6);
    let rival = row("fixed", "", 1.0, 1, 0.5);
    assert_eq!(speedup_at_equal_error([&ours, &rival]), None);
}

#[test]
fn what_ours_never_reaches_is_left_out_of_the_comparison() {
    // Bisected well on the surface, but farther along the ray than ours.
    let rival = MarchRow { normal_px_p99: 0.01, ..row("fixed", "k=10", 500.0, 0, 0.5) };
    let exact = row(OURS, "budget 0.5", 9.0, 0, 0.1);
    let loose = row(OURS, "budget 1", 4.0, 0, 0.4);
    let looser = row(OURS, "budget 2", 2.0, 0, 0.7);
    let found = speedup_at_equal_error([&exact, &loose, &looser, &rival]).unwrap();
    assert_eq!((found.ratio, found.ours.as_str(), found.loosened), (100.0, "budget 1", true));
    assert_eq!(found.normal_px_p99, [3.0 * 0.4, 0.01]);
    // More wrong pixels are never left out.
    let wrong = MarchRow { missed: 1, ..exact.clone() };
    assert_eq!(speedup_at_equal_error([&wrong, &rival]), None);
}

#[test]
fn runs_and_devices_are_not_mixed() {
    let mut all = rows();
    // Another run, in which the machine was slow, and a row of the CPU.
    all.insert(0, MarchRow { run: 2, ..row("fixed", "a 0.1", 1.0, 0, 0.01) });
    all.push(MarchRow { device: Device::Cpu, ..row("fixed", "a 0.1", 2.0, 0, 0.01) });
    all.push(MarchRow { view: "ridge".into(), ..row(OURS, "", 2.0, 0, 0.01) });
    let summary = summary(&all, Device::Gpu);
    assert_eq!(summary["march_speedup_at_equal_error"], json!({ "valley": 30.0 }));
    assert_eq!(summary["march"].as_array().unwrap().len(), 7);
    assert_eq!(summary["march"][0]["false"], json!(0));
    assert_eq!(summary["march_compared"]["valley"]["rival_ms"], json!(300.0));
    let cpu = super::summary(&all, Device::Cpu);
    assert_eq!(cpu["march_cpu"].as_array().unwrap().len(), 1);
}

#[test]
fn of_a_setting_tried_twice_the_longer_measurement_counts() {
    let mut all = rows();
    all.insert(4, MarchRow { frames: 1, ..row("segment", "", 10.0, 0, 0.02) });
    all.push(MarchRow { frames: 1, ..row("segment", "", 20.0, 0, 0.02) });
    let summary = summary(&all, Device::Gpu);
    assert_eq!(summary["march_speedup_at_equal_error"], json!({ "valley": 30.0 }));
    assert_eq!(summary["march"].as_array().unwrap().len(), 6);
    assert_eq!(most_exact(&all).unwrap().method, "segment");
}

#[test]
fn the_plane_has_a_chart_for_each_view() {
    let charts = charts(&rows(), Device::Gpu);
    assert_eq!(charts.len(), 1);
    assert_eq!(charts[0].name, "march_valley");
    let Chart::Scatter(scatter) = &charts[0].chart else { panic!() };
    assert_eq!(scatter.groups[0].name, OURS);
    assert!(scatter.groups[1].dots[0].missed);
    let svg = charts[0].chart.svg().unwrap();
    assert!(svg.contains("cached is 30 times as fast at equal error") && svg.contains("has wrong pixels"));
    assert!(columns::<MarchRow>().contains(&"false"));
}
