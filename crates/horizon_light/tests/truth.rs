//! The committed truth about Earth's sky is what the Monte Carlo reference computes: 64 of its rows, by lot, with other seeds.

use horizon_light::medium::{Medium, WAVELENGTHS};
use horizon_light::reference::Ray;
use horizon_light::reference::monte_carlo::Sky;

#[test]
fn sixty_four_rows_are_computed_again() {
    let text = include_str!("../../../assets/truth/sky.csv");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), 6 * 81 * 3);
    let sky = Sky::new(&Medium::BRUNETON);
    let mut squares = 0.0;
    for i in 0..64 {
        let [_, sun_zenith, h, mu, nu, nm, mean, error] = rows[(i * 1009 + 17) % rows.len()][..] else { panic!() };
        assert!(error <= 0.003 * mean, "a standard error of {error} for {mean}");
        let wavelength = WAVELENGTHS.iter().position(|known| *known == nm).expect("one of the three");
        let ray = Ray { h, mu, mu_s: sun_zenith.to_radians().cos(), nu };
        let again = sky.radiance(&ray, wavelength, 16_000, 1000 + i as u64);
        let off = (again.mean - mean) / again.standard_error.hypot(error);
        assert!(off.abs() < 5.0, "sun {sun_zenith}°, mu {mu}, {nm} nm: {again:?}, not {mean}");
        squares += off * off;
    }
    // Chi square of 64: a bias as large as the errors would double it.
    println!("chi² {squares:.1} of 64");
    assert!(squares < 2.0 * 64.0, "{squares}");
}
