use super::{Sky, earth};
use crate::geometry::{distance_to_top, horizon_cosine};
use crate::medium::Medium;
use crate::models::air::Air;
use crate::models::transmittance::Transmittance;
use crate::reference::transmittance::{transmittance, transmittance_to_top};

/// Altitudes in metres, and cosines from straight up to the horizon, which [`largest_error`] looks at.
const ALTITUDES: [f64; 6] = [0.0, 2.0, 100.0, 3e3, 2e4, 5.9e4];
const CLIMBS: [f64; 9] = [1.0, 0.9, 0.5, 0.2, 0.1, 0.03, 1e-2, 1e-3, 0.0];

/// The largest error of f32 tables against quadrature in f64, in units of the light that comes in.
fn largest_error(table: impl Fn(f32, f32) -> [f32; 3], medium: &Medium) -> f64 {
    let mut worst = 0.0_f64;
    for h in ALTITUDES {
        for climb in CLIMBS {
            let horizon = horizon_cosine(medium.radius, h);
            let mu = horizon + (1.0 - horizon) * climb;
            // Past the horizon by rounding there is ground: the truth goes on as the table does.
            let mu = mu.min(1.0);
            let distance = distance_to_top(medium.radius, medium.height, h, mu);
            let (ours, truth) = (table(h as f32, mu as f32), transmittance(medium, h, mu, distance));
            for k in 0..3 {
                worst = worst.max((ours[k] as f64 - truth[k]).abs());
            }
        }
    }
    worst
}

#[test]
fn the_table_agrees_with_quadrature() {
    let Sky { air, transmittance, .. } = earth();
    let error = largest_error(|h, mu| transmittance.to_top(air, h, mu), &Medium::BRUNETON);
    assert!(error < 1.5e-3, "{error}");
}

/// A table whose rows and columns are even in altitude and cosine, of the same size, is what ours is better than.
#[test]
fn an_even_table_misses_the_horizon() {
    let air = Air::<f32>::new(&Medium::BRUNETON);
    let ours = Transmittance::sized(&air, 64, 16);
    let even = crate::models::table::Table::of(64, 16, |x, y| {
        let h = 6e4 * y as f64 / 15.0;
        [transmittance_to_top(&Medium::BRUNETON, h, 2.0 * x as f64 / 63.0 - 1.0).map(|t| t as f32)]
    });
    let ours = largest_error(|h, mu| ours.to_top(&air, h, mu), &Medium::BRUNETON);
    let even = largest_error(|h, mu| even.at(0.5 * mu + 0.5, h / 6e4)[0], &Medium::BRUNETON);
    assert!(ours < 0.01 && even > 0.05, "{ours} {even}");
}

#[test]
fn the_sun_behind_the_ground_gives_nothing() {
    let Sky { air, transmittance, .. } = earth();
    assert_eq!(transmittance.of_sun(air, 2.0, -0.01), [0.0; 3]);
    assert!(transmittance.of_sun(air, 2.0, 0.0)[0] > 0.05);
}
