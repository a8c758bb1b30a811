use super::*;

const UP: Ray = Ray { h: 0.0, mu: 1.0, mu_s: 1.0, nu: 1.0 };
const DOWN: Ray = Ray { h: 500_000.0, mu: -1.0, mu_s: 1.0, nu: -1.0 };

fn near(value: f64, published: f64, relative: f64) {
    assert!((value / published - 1.0).abs() < relative, "{value} is not {published}");
}

#[test]
fn integrand_on_the_way_up() {
    // reference-values.md B: 0.01375088 and 0.00021319, 250 km along.
    let found = integrand(&Medium::SMALL_PLANET, &UP, 250_000.0);
    near(found[1], 0.01375088, 1e-3);
    near(found[4], 0.00021319, 1e-3);
}

#[test]
fn integrand_on_the_way_down() {
    // reference-values.md B: 0.01547504 and 0.00023992.
    let found = integrand(&Medium::SMALL_PLANET, &DOWN, 250_000.0);
    near(found[1], 0.01547504, 1e-3);
    near(found[4], 0.00023992, 1e-3);
}

#[test]
fn scattered_once_on_the_way_up() {
    // reference-values.md B: 0.05320320 and 0.03991199.
    let found = scattered(&Medium::SMALL_PLANET, &UP);
    near(found.rayleigh[1], 0.05320320, 1e-3);
    near(found.mie[1], 0.03991199, 1e-3);
}

#[test]
fn scattered_once_on_the_way_down() {
    // reference-values.md B, without Mie: 0.05652699, ± 0.2 %.
    near(scattered(&Medium::SMALL_PLANET.without_mie(), &DOWN).rayleigh[1], 0.05652699, 2e-3);
}

#[test]
fn light_begins_at_the_shadow_edge() {
    // From the night side the ray's first stretch is dark: quadrature that is split there agrees with small steps.
    let m = Medium::BRUNETON;
    let ray = Ray::of_angles(2.0, 1.2, 1.65, 0.3);
    let length = distance_to_end(m.radius, m.height, ray.h, ray.mu);
    let n = 20_000;
    let steps: f64 =
        (0..n).map(|i| integrand(&m, &ray, length * (i as f64 + 0.5) / n as f64)[1] * length / n as f64).sum();
    let found = scattered(&m, &ray).rayleigh[1] / m.rayleigh[1];
    near(found, steps, 1e-5);
    assert_eq!(integrand(&m, &ray, 1000.0), [0.0; 6]);
}

#[test]
fn a_part_of_the_way_brings_less() {
    let m = Medium::BRUNETON;
    let ray = Ray::of_angles(100.0, 1.4, 1.1, 2.0);
    let length = distance_to_end(m.radius, m.height, ray.h, ray.mu);
    let brought = [0.1, 0.5, 1.0].map(|part| scattered_within(&m, &ray, part * length).rayleigh[2]);
    assert!(0.0 < brought[0] && brought[0] < brought[1] && brought[1] < brought[2]);
    near(brought[2], scattered(&m, &ray).rayleigh[2], 1e-5);
}

#[test]
fn rays_that_miss_the_air_are_dark_and_lit_ground_is_not() {
    let m = Medium::BRUNETON;
    assert_eq!(radiance(&m, &Ray { h: 1e6, mu: 0.1, mu_s: 1.0, nu: 0.1 }), [0.0; 3]);
    // Straight down at noon: the ground shows its albedo through twice the air, and the air scatters on top.
    let seen = radiance(&m, &Ray { h: 1e6, mu: -1.0, mu_s: 1.0, nu: -1.0 });
    let through = transmittance_to_top(&m, 0.0, 1.0);
    for k in 0..3 {
        let ground = m.irradiance[k] * m.albedo[k] / core::f64::consts::PI * through[k] * through[k];
        assert!(seen[k] > ground && seen[k] < 5.0 * ground);
    }
}
