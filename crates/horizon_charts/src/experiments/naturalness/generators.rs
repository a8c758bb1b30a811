//! The generators: the four height maps of seed 000 (Table 4.1) and Musgrave's multifractals. All have the same octaves,
//! lacunarity, gain (one apart) and first wavelength, so that only how octaves combine differs.

use horizon_field::field::{Dual, Field, Fractal, Warp};
use horizon_field::fractal::Rule;

/// A way to make ground.
pub(super) struct Generator {
    /// What tables call it.
    pub name: &'static str,
    /// What charts call it.
    pub title: &'static str,
    /// The field of a seed.
    pub field: fn(u32) -> Field,
}

pub(super) const ALL: [Generator; 7] = [
    Generator { name: "single", title: "fBm", field: |seed| Field::Fractal(fbm(seed, Rule::Fbm)) },
    Generator { name: "single_distorted", title: "fBm, distorted", field: |seed| distorted(fbm(seed, Rule::Fbm)) },
    Generator { name: "dual", title: "dual", field: |seed| dual(seed, Field::Fractal(local(seed))) },
    Generator { name: "dual_distorted", title: "dual, distorted", field: |seed| dual(seed, distorted(local(seed))) },
    Generator {
        name: "heterogeneous",
        title: "heterogeneous",
        field: |seed| Field::Fractal(fbm(seed, Rule::Heterogeneous)),
    },
    // Musgrave's own offset and H = 0.25: the hybrid's weights are products of the ones before them, and with the common
    // gain nothing would be left of its higher octaves.
    Generator {
        name: "hybrid",
        title: "hybrid",
        field: |seed| Field::Fractal(Fractal { offset: 0.7, gain: 0.84, ..fbm(seed, Rule::Hybrid) }),
    },
    Generator { name: "ridged", title: "ridged", field: |seed| Field::Fractal(fbm(seed, Rule::Ridged)) },
];

/// Seeds of one generator's parts are far apart.
const PART: u32 = 1000;

fn fbm(seed: u32, rule: Rule) -> Fractal {
    Fractal { rule, wavelength: 8000.0, amplitude: 600.0, octaves: 11.0, seed, ..Fractal::default() }
}

/// The dual map's detail: higher frequencies (§3.2.1).
fn local(seed: u32) -> Fractal {
    Fractal { wavelength: 4000.0, amplitude: 450.0, octaves: 10.0, seed: seed + PART, ..fbm(seed, Rule::Fbm) }
}

/// The dual map (eq. 3.2): low frequencies say where it is rugged. The clamp takes seed 000's `normalize`, over the heights
/// between which the global map mostly lies.
fn dual(seed: u32, local: Field) -> Field {
    let global = Fractal { octaves: 4.0, seed: seed + 2 * PART, ..fbm(seed, Rule::Fbm) };
    Dual { local: local.into(), global: Field::Fractal(global).into(), low: -300.0, high: 300.0 }.into()
}

/// Domain distortion (eq. 3.3), as weak as seed 000 had to keep it: a tenth of the wavelength.
fn distorted(fractal: Fractal) -> Field {
    let by = |part: u32| Fractal {
        wavelength: fractal.wavelength / 2.0,
        amplitude: fractal.wavelength / 10.0,
        octaves: 4.0,
        seed: fractal.seed + part * PART,
        ..Fractal::default()
    };
    let (x, z) = (Field::Fractal(by(3)).into(), Field::Fractal(by(4)).into());
    Warp { field: Field::Fractal(fractal).into(), x, z, y: None }.into()
}
