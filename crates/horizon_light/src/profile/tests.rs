use super::*;
use crate::medium::Medium;

#[test]
fn layers_thin_as_they_should() {
    assert_eq!(exponential_density(0.0, 8_000.0), 1.0);
    assert!((exponential_density(8_000.0_f32, 8_000.0) - 0.367_879_44).abs() < 1e-7);
    assert_eq!(
        [0.0, 10e3, 17.5e3, 25e3, 32.5e3, 40e3, 60e3].map(|h| tent_density(h, 25e3, 15e3)),
        [0.0, 0.0, 0.5, 1.0, 0.5, 0.0, 0.0]
    );
}

#[test]
fn extinction_sums_the_layers() {
    let m = Medium::BRUNETON;
    let at_ground = m.extinction(m.densities(0.0));
    for (found, molecules) in at_ground.into_iter().zip(m.rayleigh) {
        assert!((found - (molecules + 4.44e-6)).abs() < 1e-18);
    }
    let single = extinction([0.5_f32, 0.25, 1.0], [1.0; 3], [2.0; 3], [0.0, 1.0, 2.0]);
    assert_eq!(single, [1.0, 2.0, 3.0]);
}
