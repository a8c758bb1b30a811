//! The path tracer against what is known in closed form, and against its own quadrature.

use super::scenes::{Scene, Scenes, sun};
use super::*;
use std::sync::LazyLock;

static SCENES: LazyLock<Scenes> = LazyLock::new(Scenes::new);

/// An even slab in which light is scattered evenly.
struct Even {
    top: f64,
}

impl Matter for Even {
    fn extinction(&self, _: [f64; 3]) -> f64 {
        1.0
    }
    fn most(&self) -> f64 {
        // More than there is, so that some events are none.
        1.7
    }
    fn span(&self, from: [f64; 3], toward: [f64; 3]) -> [f64; 2] {
        crate::clouds::span::spans(0.0, 0.0, self.top, from[1], toward[1])[0]
    }
}

/// Chandrasekhar's half space with albedo 1, isotropic: L(µ) = µ₀ H(µ) H(µ₀)/(4π (µ + µ₀)) per irradiance across the beam, with
/// H(1) = 2.9078 and H(0.5) = 2.0128 (*Radiative Transfer*, table XI).
#[test]
fn a_half_space_reflects_what_chandrasekhar_says() {
    let phase = Phase { forward: 0.0, other: 0.0, alpha: 0.0, share: 0.0 };
    // Deep, but not endless: beyond 300 mean paths 0.5 % is missing.
    let matter = Even { top: 300.0 };
    for (mu, mu_s, h) in [(1.0_f64, 1.0_f64, 2.9078 * 2.9078), (1.0, 0.5, 2.9078 * 2.0128), (0.5, 0.5, 2.0128 * 2.0128)]
    {
        let lit = Lit { matter: &matter, phase, sun: [(1.0 - mu_s * mu_s).sqrt(), mu_s, 0.0] };
        let found = lit.radiance([0.0, 400.0, 0.0], [0.0, -mu, (1.0 - mu * mu).sqrt()], 12_000, 1);
        let truth = mu_s * h / (4.0 * core::f64::consts::PI * (mu + mu_s));
        let off = (found.mean - 0.997 * truth).abs();
        assert!(off < 4.0 * found.standard_error + 0.004 * truth, "{mu} {mu_s}: {found:?}, not {truth}");
        assert!(found.standard_error < 0.02 * truth);
    }
}

/// In an even slab light scattered once is known: (1 − e^{−τ(1/µ + 1/µ₀)}) p µ₀/(µ + µ₀), seen from the sun's side.
#[test]
fn single_scattering_in_closed_form() {
    let phase = SCENES.phase();
    let matter = Even { top: 3.0 };
    let lit = Lit { matter: &matter, phase, sun: sun(50.0) };
    let (mu, mu_s) = (0.7_f64, 50.0_f64.to_radians().cos());
    let toward = [0.0, -mu, (1.0 - mu * mu).sqrt()];
    let truth =
        lit.phase.at(dot(toward, lit.sun)) * mu_s / (mu + mu_s) * (1.0 - (-3.0 * (1.0 / mu + 1.0 / mu_s)).exp());
    let ours = lit.once([0.0, 5.0, 0.0], toward, 200);
    assert!((ours / truth - 1.0).abs() < 1e-4, "{ours} {truth}");
}

/// Transmittance by ratio tracking is that by quadrature, and what no cloud is in the way of is whole.
#[test]
fn ratio_tracking_has_no_bias() {
    let matter = SCENES.matter(Scene::Cumulus);
    let lit = SCENES.lit(&matter, 60.0);
    let mut random = Random::new(6, 0);
    for at in [[500.0, 1_200.0, 100.0], [600.0, 1_500.0, 0.0], [350.0, 1_700.0, 100.0], [0.0, 1_840.0, 0.0]] {
        let n = 20_000;
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let one = lit.sunlit(&mut random, at);
            sum += one;
            squares += one * one;
        }
        let mean = sum / f64::from(n);
        let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
        let truth = lit.sun_transmittance(at, 2_000);
        assert!((mean - truth).abs() < 4.0 * error + 1e-4, "{at:?}: {mean} ± {error}, not {truth}");
    }
}

/// A furnace: in even light from all round, a cloud that takes nothing away is as bright as its surroundings. By reciprocity that
/// is the flight of paths: all leave.
#[test]
fn all_light_leaves() {
    let matter = SCENES.matter(Scene::Sphere);
    let lit = SCENES.lit(&matter, 0.0);
    let mut random = Random::new(2, 0);
    let mut events = 0_u64;
    for _ in 0..300 {
        let (mut from, mut toward) = ([0.0, 1_500.0, -5_000.0], [0.0, 0.0, 1.0]);
        while let Some(at) = lit.met(&mut random, from, toward) {
            toward = turned(toward, lit.phase.draw(|| random.uniform()), random.angle());
            from = at;
            events += 1;
            assert!(events < 1_000_000);
        }
        assert!((dot(toward, toward) - 1.0).abs() < 1e-12);
    }
    // Some 18 mean paths across, turned a little by each event.
    assert!(events > 300 * 10, "{events}");
}
