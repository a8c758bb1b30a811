//! What is left when neither sun nor moon lights the sky.

/// Luminance of a sky of so many V magnitudes per square second of arc, in cd/m²: a zero magnitude is 10.8e4 cd/m², the
/// conversion usual with sky quality meters.
pub fn luminance_of_magnitude(magnitude: f64) -> f64 {
    10.8e4 * libm::pow(10.0, -0.4 * magnitude)
}

/// Airglow, zodiacal light and stars together, in cd/m²: a floor under any model's sky, without which a moonless night is
/// black. Dark sites measure 21.6 (Paranal near the solar maximum, Patat 2003) to 22 magnitudes at the zenith, that is
/// 2.5e-4 to 1.7e-4 cd/m².
pub const MOONLESS_NIGHT: f64 = 2e-4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_between_the_darkest_sites() {
        assert!((luminance_of_magnitude(22.0)..luminance_of_magnitude(21.6)).contains(&MOONLESS_NIGHT));
    }

    /// A lit sky, 17 magnitudes, is a hundred times as bright as one of 22.
    #[test]
    fn five_magnitudes_are_a_hundredfold() {
        assert!((luminance_of_magnitude(17.0) / luminance_of_magnitude(22.0) - 100.0).abs() < 1e-9);
    }
}
