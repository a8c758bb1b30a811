use super::*;
use crate::geometry::distance_to_end;

/// A plain midpoint sum, with steps that are small against every layer.
fn by_small_steps(medium: &Medium, h: f64, mu: f64, length: f64) -> [f64; 3] {
    let n = 400_000;
    let mut sum = [0.0; 3];
    for i in 0..n {
        let d = length * (i as f64 + 0.5) / n as f64;
        let densities = medium.densities(advance(medium.radius, h, mu, d).0);
        for k in 0..3 {
            sum[k] += densities[k] * length / n as f64;
        }
    }
    sum
}

#[test]
fn columns_are_those_of_small_steps() {
    let m = Medium::BRUNETON;
    for (h, mu) in
        [(0.0, 1.0), (2.0, 0.0), (2.0, horizon_cosine(m.radius, 2.0) + 1e-9), (30_000.0, -0.05), (60_000.0, -0.1)]
    {
        let length = distance_to_end(m.radius, m.height, h, mu);
        let (ours, theirs) = (columns(&m, h, mu, length), by_small_steps(&m, h, mu, length));
        for k in 0..3 {
            // The sum's own error goes with the square of its step: 2 m against 1200 m.
            assert!((ours[k] - theirs[k]).abs() <= 3e-7 * theirs[k] + 1e-9, "{h} {mu} {k}: {} {}", ours[k], theirs[k]);
        }
    }
}

#[test]
fn vertical_depth_of_molecules() {
    // reference-values.md A, derived: 0.046393, 0.108404, 0.264654 over 60 km.
    let m = Medium { absorption: [0.0; 3], ..Medium::BRUNETON.without_mie() };
    let depths = optical_depth(&m, 0.0, 1.0, 60_000.0);
    let through = transmittance_to_top(&m, 0.0, 1.0);
    for (k, (depth, left)) in [(0.046393, 0.9547), (0.108404, 0.8973), (0.264654, 0.7675)].into_iter().enumerate() {
        assert!((depths[k] - depth).abs() < 2e-6, "{k}: {}", depths[k]);
        assert!((through[k] - left).abs() < 6e-5, "{k}: {}", through[k]);
    }
}

#[test]
fn a_column_above_most_of_the_air() {
    // reference-values.md B: from r = 1400 km straight up, 0.06193586 km and 0.99993797.
    let m = Medium { radius: 1e6, ..Medium::SMALL_PLANET.without_mie() };
    let length = columns(&m, 4e5, 1.0, 1e5)[0];
    assert!((length / 61.93586 - 1.0).abs() < 1e-3, "{length}");
    let left = transmittance_to_top(&m, 4e5, 1.0)[1];
    assert!((left - 0.99993797).abs() < 1e-7, "{left}");
}

#[test]
fn an_absorbing_layer_alone() {
    // reference-values.md B: vertical transmittance 0.74081822 of a tent from 10 to 40 km with 0.02 per km at its peak.
    let m = Medium { rayleigh: [0.0; 3], absorption: [2e-5; 3], ..Medium::SMALL_PLANET.without_mie() };
    let left = transmittance_to_top(&m, 0.0, 1.0)[1];
    assert!((left / 0.74081822 - 1.0).abs() < 1e-7, "{left}");
}

#[test]
fn a_uniform_medium() {
    // reference-values.md B: horizontal transmittance 0.58361341 from r = 1400 km, 0.95122942 over 50 km, at 0.001 per
    // km.
    let m = Medium { rayleigh_height: 1e15, ..Medium::SMALL_PLANET.without_mie() };
    let whole = transmittance_to_top(&m, 4e5, 0.0)[1];
    let part = transmittance(&m, 4e5, 0.0, 5e4)[1];
    assert!((whole / 0.58361341 - 1.0).abs() < 1e-7 && (part / 0.95122942 - 1.0).abs() < 1e-7, "{whole} {part}");
}

#[test]
fn the_ground_hides_the_sun() {
    let m = Medium::BRUNETON;
    let horizon = horizon_cosine(m.radius, 1000.0);
    assert_eq!(transmittance_to_top(&m, 1000.0, horizon - 1e-9), [0.0; 3]);
    assert!(transmittance_to_top(&m, 1000.0, horizon + 1e-9).iter().all(|&t| t > 0.0));
}

#[test]
fn the_table_interpolates() {
    let m = Medium::BRUNETON;
    let tables = DepthTable::all(&m);
    let mut random = crate::reference::random::Random::new(7, 0);
    let (mut errors, mut worst_depth) = (Vec::new(), 0.0_f64);
    for i in 0..4000 {
        // Two in three near the ground, and two in three near the horizon, where depths vary most.
        let h = m.height * random.uniform().powi(1 + 2 * (i % 3));
        let horizon = horizon_cosine(m.radius, h);
        let mu = horizon + (1.0 - horizon) * random.uniform().powi(1 + 4 * (i / 3 % 3)) + 1e-12;
        let truth = optical_depth(&m, h, mu, distance_to_top(m.radius, m.height, h, mu));
        for k in 0..3 {
            let error = (tables[k].depth(h, mu) - truth[k]).abs();
            errors.push(error * (-truth[k]).exp());
            worst_depth = worst_depth.max(error);
        }
    }
    errors.sort_by(f64::total_cmp);
    let [most, worst] = [errors.len() * 995 / 1000, errors.len() - 1].map(|i| errors[i]);
    println!(
        "table: 99.5 % of transmittances within {most:e}, all within {worst:e}, all depths within {worst_depth:e}"
    );
    // The worst belong to rays that graze the absorbing layer's edges, where the depth has a kink. Paths use
    // differences of depths, however large both are: so the depth's own error counts too.
    assert!(most < 1e-5 && worst < 1e-4 && worst_depth < 2e-4, "{most:e} {worst:e} {worst_depth:e}");
}
