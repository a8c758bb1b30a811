//! Refractive indices in visible light, by wavelength in nanometres.

/// Of fresh water at 20 °C (Quan and Fry 1995, for no salt): 1.3330 in the sodium line.
pub fn water(nm: f64) -> f64 {
    1.314_05 - 2.02e-6 * 400.0 + (15.868 - 0.004_23 * 20.0) / nm - 4_382.0 / (nm * nm) + 1.1455e6 / (nm * nm * nm)
}

/// Of ice: Cauchy's law through 1.3194 at 400 nm and 1.3069 at 700 nm (Warren 1984).
pub fn ice(nm: f64) -> f64 {
    const SLOPE: f64 = (1.3194 - 1.3069) / (1.0 / 160_000.0 - 1.0 / 490_000.0);
    1.3069 + SLOPE * (1.0 / (nm * nm) - 1.0 / 490_000.0)
}

/// Reflectances of a face, across and within the plane of incidence, for a cosine of incidence and the index beyond over the one
/// before; 1 where reflection is total.
pub fn reflectances(cosine: f64, index: f64) -> [f64; 2] {
    let squared = (index - 1.0) * (index + 1.0) + cosine * cosine;
    if squared <= 0.0 {
        return [1.0; 2];
    }
    let g = squared.sqrt();
    let (across, within) = ((cosine - g) / (cosine + g), (index * index * cosine - g) / (index * index * cosine + g));
    [across * across, within * within]
}

/// What of unpolarised light a face lets through.
pub fn through(cosine: f64, index: f64) -> f64 {
    let [across, within] = reflectances(cosine, index);
    1.0 - 0.5 * (across + within)
}
