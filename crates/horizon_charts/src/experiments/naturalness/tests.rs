use super::*;

/// assets/heights: mean slope 13.3°, 95th percentile 24.9°, steepest 36.1°, exponent of the rows −3.19 and hypsometric
/// integral 0.351, computed independently of this code.
#[test]
fn real_ground_has_its_known_figures() {
    let ctx = Context::new("unused", false);
    let ground = real(&ctx).unwrap();
    assert_eq!((ground.size, ground.range()), ([403, 344], [236.0, 1076.0]));
    let found = measured(&ctx, REAL, 0, &ground).figures;
    for (value, expected, off) in [
        (found.slope_mean_deg, 13.3, 0.05),
        (found.slope_p95_deg, 24.9, 0.05),
        (found.slope_max_deg, 36.1, 0.05),
        (found.hypsometric_integral, 0.351, 0.0005),
        (found.beta_rows, -3.19, 0.02),
    ] {
        assert!((value - expected).abs() <= off, "{value} for {expected}");
    }
}

#[test]
fn real_ground_is_no_distance_from_itself() {
    let ctx = Context::new("unused", true);
    let ground = real(&ctx).unwrap();
    let truth = measured(&ctx, REAL, 0, &ground);
    let same = measured(&ctx, "same", 1, &ground).held_against(&truth).figures;
    assert_eq!((same.beta_distance, same.slope_distance_deg, same.height_distance_m), (0.0, 0.0, 0.0));
    let lower = Relief { heights: ground.heights.iter().map(|h| 0.5 * h).collect(), ..ground };
    let lower = measured(&ctx, "lower", 1, &lower).held_against(&truth).figures;
    assert!(lower.beta_distance < 1e-9 && lower.slope_distance_deg > 1.0 && lower.height_distance_m > 100.0);
}

#[test]
fn generators_compile_and_are_different() {
    let mut seen: Vec<f64> = Vec::new();
    for (generator, seed) in generators::ALL.iter().flat_map(|g| [(g, 0), (g, 1)]) {
        let field = (generator.field)(seed).compile::<2>(&NoImages).unwrap();
        let value = field.value_f64(&field.anchor(&Place::ORIGIN), [123.0, 456.0], 90.0);
        assert!(!seen.contains(&value), "{}", generator.name);
        seen.push(value);
    }
}
