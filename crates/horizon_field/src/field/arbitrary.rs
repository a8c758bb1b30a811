//! Arbitrary fields for tests, here and of the shader: every kind of node, and random trees of all of them.

use super::{
    Clamp, Dual, Edge, Field, Fractal, HeightImage, ImageField, ImageSource, Mask, Noise, Remap, SmoothMin, Terrace,
    Triplanar, Warp,
};
use crate::fractal::Rule;
use crate::hash::pcg;
use crate::noise::Basis;

/// All rules.
pub const RULES: [Rule; 4] = [Rule::Fbm, Rule::Heterogeneous, Rule::Hybrid, Rule::Ridged];
/// All bases.
pub const BASES: [Basis; 4] = [Basis::Value, Basis::Gradient, Basis::Simplex, Basis::Worley];
/// All edges.
pub const EDGES: [Edge; 3] = [Edge::Clamp, Edge::Mirror, Edge::Repeat];

/// A sequence of random numbers, the same for the same seed everywhere.
#[derive(Clone, Debug)]
pub struct Random(u32);

impl Random {
    /// The sequence of a seed.
    pub const fn new(seed: u32) -> Self {
        Self(pcg(seed))
    }

    /// The next 32 bits.
    pub const fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        pcg(self.0)
    }

    /// A number in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.bits()) / 4_294_967_296.0
    }

    /// A number in `[low, high)`, its magnitudes equally likely.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
    }

    /// One of a slice.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.bits() as usize % of.len()]
    }
}

/// Two images, `small` and `large`, computed: hills with noise, of odd sizes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pictures;

impl ImageSource for Pictures {
    fn load(&self, path: &str) -> Result<HeightImage, String> {
        let (width, height) = match path {
            "small" => (5, 3),
            "large" => (77, 131),
            _ => return Err("no such picture".into()),
        };
        let texel = |x: u32, z: u32| {
            let hill = 20_000.0 * (2.0 + libm::sin(f64::from(x) * 0.21) + libm::cos(f64::from(z) * 0.13)) / 2.0;
            (hill + f64::from(pcg(x + 1000 * z) >> 18)) as u16
        };
        let texels = (0..height).flat_map(|z| (0..width).map(move |x| texel(x, z))).collect();
        Ok(HeightImage { width, height, texels })
    }
}

/// A random noise.
fn noise(random: &mut Random) -> Field {
    let wavelength = random.magnitude(20.0, 4000.0);
    let amplitude = wavelength * random.within(-0.3, 0.3);
    let rotation = random.within(-4.0, 4.0);
    Noise { basis: random.pick(&BASES), wavelength, amplitude, rotation, seed: random.bits() }.into()
}

/// A random sum of octaves.
fn fractal(random: &mut Random) -> Field {
    let wavelength = random.magnitude(50.0, 8000.0);
    Fractal {
        rule: random.pick(&RULES),
        basis: random.pick(&BASES),
        wavelength,
        amplitude: wavelength * random.within(-0.2, 0.2),
        octaves: random.within(0.0, 7.0),
        lacunarity: random.within(1.7, 2.3),
        gain: random.within(0.3, 0.6),
        offset: random.within(0.0, 1.2),
        rotation: random.within(-1.0, 1.0),
        seed: random.bits(),
    }
    .into()
}

/// A random image.
fn image(random: &mut Random) -> Field {
    ImageField {
        path: random.pick(&["small", "large"]).into(),
        centre: [random.within(-900.0, 900.0), random.within(-900.0, 900.0)],
        size: [random.within(500.0, 5000.0), random.within(500.0, 5000.0)],
        low: random.within(-100.0, 100.0),
        high: random.within(-300.0, 600.0),
        edge: random.pick(&EDGES),
    }
    .into()
}

/// A field, mapped into about 0 to 1: a factor.
fn factor(random: &mut Random) -> Field {
    let noise = Noise {
        basis: random.pick(&BASES),
        amplitude: 1.0,
        wavelength: random.magnitude(100.0, 4000.0),
        seed: random.bits(),
        rotation: 0.3,
    };
    Remap { field: Field::from(noise).into(), from: [-1.0, 1.0], to: [-0.2, 1.2] }.into()
}

/// A node of this kind, one of [`KINDS`], whose children are random trees of less than `depth`.
pub fn node(kind: &str, random: &mut Random, depth: u32) -> Field {
    let below = depth.saturating_sub(1);
    let child = |random: &mut Random| field(random, below);
    let low = random.within(-200.0, 100.0);
    let high = low + random.magnitude(5.0, 400.0);
    match kind {
        "Constant" => Field::Constant(random.within(-500.0, 500.0)),
        "Image" => image(random),
        "Noise" => noise(random),
        "Fractal" => fractal(random),
        "Warp" => {
            let [x, z, y] = core::array::from_fn(|_| noise(random));
            Warp { field: child(random).into(), x: x.into(), z: z.into(), y: Some(y.into()) }.into()
        }
        "Dual" => Dual { local: child(random).into(), global: child(random).into(), low, high }.into(),
        "Triplanar" => Triplanar { field: child(random).into(), sharpness: random.pick(&[1, 2, 4, 8, 16]) }.into(),
        "Add" => Field::Add(vec![child(random), child(random), child(random)]),
        "Multiply" => Field::Multiply(vec![child(random), factor(random)]),
        "Min" => Field::Min(vec![child(random), child(random)]),
        "Max" => Field::Max(vec![child(random), child(random), Field::Constant(low)]),
        "SmoothMin" => {
            let radius = random.magnitude(1.0, 300.0);
            SmoothMin { a: child(random).into(), b: child(random).into(), radius }.into()
        }
        "Clamp" => Clamp { field: child(random).into(), low, high }.into(),
        "Remap" => {
            let to = [random.within(-300.0, 300.0), random.within(-300.0, 300.0)];
            Remap { field: child(random).into(), from: [-300.0, 300.0], to }.into()
        }
        "Terrace" => {
            let (step, sharpness) = (random.magnitude(5.0, 200.0), random.within(0.0, 1.0));
            Terrace { field: child(random).into(), step, sharpness }.into()
        }
        _ => {
            let [mask, outside, inside] = core::array::from_fn(|_| child(random).into());
            Mask { mask, low, high, outside, inside }.into()
        }
    }
}

/// The names of all kinds of nodes, leaves first.
pub const KINDS: [&str; 16] = [
    "Constant",
    "Image",
    "Noise",
    "Fractal",
    "Warp",
    "Dual",
    "Triplanar",
    "Add",
    "Multiply",
    "Min",
    "Max",
    "SmoothMin",
    "Clamp",
    "Remap",
    "Terrace",
    "Mask",
];

/// A random tree, of at most this depth.
pub fn field(random: &mut Random, depth: u32) -> Field {
    let kinds = if depth <= 1 { &KINDS[..4] } else { &KINDS[..] };
    node(random.pick(kinds), random, depth)
}

/// One field of every kind of node, and of every rule and basis, with names: what a test of each should go through.
pub fn every_kind(seed: u32) -> Vec<(String, Field)> {
    let mut random = Random::new(seed);
    let mut fields: Vec<_> = KINDS.iter().map(|kind| ((*kind).to_owned(), node(kind, &mut random, 2))).collect();
    for rule in RULES {
        for basis in BASES {
            let wavelength = random.magnitude(500.0, 5000.0);
            let seed = random.bits();
            let octaves = 5.4;
            let node =
                Fractal { rule, basis, wavelength, amplitude: 0.1 * wavelength, octaves, seed, ..Fractal::default() };
            fields.push((format!("{rule:?} of {basis:?}"), node.into()));
        }
    }
    fields
}
