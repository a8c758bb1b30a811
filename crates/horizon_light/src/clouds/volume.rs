//! The noise that all models share: a periodic volume, made once, the same for every world. WGSL twin: `volume_compute.wgsl`.
//!
//! | channel | holds |
//! |---|---|
//! | red | Perlin–Worley: gradient noise whose lower boundary is lifted to Worley's billows, w + p(1 − w) |
//! | green | fBm of gradient noise |
//! | blue | fBm of Worley's noise, 1 at the feature points |
//! | alpha | 1 |
//!
//! Schneider's remap as printed takes Worley's noise for the *old* lower boundary, (p − w)/(1 − w), and has no lower bound: the report
//! of seed 001 (section 8.2.2.6) met −280. With w as the *new* one the value lies in [w, 1] by construction.
//!
//! Each channel is spread so that its values are about evenly distributed, `spread`: a threshold of 1 − c then leaves about the
//! part c of the volume.
//!
//! Mips hold maxima, not means: a texel of mip m is at least what interpolation finds anywhere in its block of 2ᵐ texels.

use horizon_field::Real;
use horizon_field::hash;
use horizon_field::lattice;
use horizon_field::noise::{Basis, PERIODIC_WGSL, periodic, periodic_worley};

/// Texels along each axis.
pub const TEXELS: usize = 64;
/// Mips: from 64³ texels to one.
pub const MIPS: usize = 7;
/// Cells of the coarsest octave along each axis.
pub const CELLS: u32 = 4;
/// Octaves of each fBm, each twice as fine as the last.
pub const OCTAVES: u32 = 3;
/// Weights of gradient noise's octaves.
pub const GRADIENT: [f64; 3] = [0.572, 0.286, 0.142];
/// Weights of Worley noise's octaves (Schneider 2015).
pub const WORLEY: [f64; 3] = [0.625, 0.25, 0.125];
/// Between which values each channel is spread: mean ∓ √5 standard deviations, of which a smoothstep is nearly the distribution.
pub const SPREAD: [[f64; 2]; 3] = [[0.714, 0.907], [0.412, 0.588], [0.447, 0.796]];
/// Seeds of the two noises; octave i adds i.
pub const SEEDS: [u32; 2] = [0x00c1_00d5, 0x00b1_110e];

/// The noise and the mips of its maxima.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CloudVolume {
    /// `mips[m]` has (64 ≫ m)³ texels, x running fastest, in linear 8 bits.
    pub mips: [Vec<[u8; 4]>; MIPS],
}

/// In WGSL: `cloud_texel(texel)` makes one of the finest mip, `cloud_border_most` one of mip 1 and `cloud_most` one of those
/// after. The host stores them, and gives `cloud_finer(texel: vec3<u32>) -> vec4<f32>`, a texel of the mip before.
pub fn compute_wgsl() -> String {
    let bases = [Basis::Gradient.wgsl(), Basis::Worley.wgsl()];
    [hash::WGSL, lattice::WGSL, bases[0], bases[1], PERIODIC_WGSL, include_str!("volume_compute.wgsl")].concat()
}

/// Brings a value between `low` and `high` to 0 … 1, smoothly.
fn spread(value: f64, [low, high]: [f64; 2]) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The three noises at `u` periods, before they are spread; each from 0 to 1.
pub fn raw(u: [f64; 3]) -> [f64; 3] {
    let (mut gradient, mut billows) = (0.0, 0.0);
    for octave in 0..OCTAVES {
        let (period, i) = (CELLS << octave, octave as usize);
        gradient += GRADIENT[i] * periodic(u, period, SEEDS[0] + octave);
        billows += WORLEY[i] * (0.5 - 0.5 * periodic_worley(u, period, SEEDS[1] + octave));
    }
    let gradient = 0.5 + 0.5 * gradient;
    [billows + gradient * (1.0 - billows), gradient, billows]
}

/// A texel of the finest mip.
fn texel(x: usize, y: usize, z: usize) -> [u8; 4] {
    let raw = raw([x, y, z].map(|i| (i as f64 + 0.5) / TEXELS as f64));
    let byte = |k: usize| (255.0 * spread(raw[k], SPREAD[k])).round() as u8;
    [byte(0), byte(1), byte(2), 255]
}

impl CloudVolume {
    /// Makes it: under a second.
    pub fn new() -> Self {
        let all = |edge: usize, make: &dyn Fn([usize; 3]) -> [u8; 4]| -> Vec<[u8; 4]> {
            (0..edge * edge * edge).map(|i| make([i % edge, i / edge % edge, i / (edge * edge)])).collect()
        };
        let mut mips: [Vec<[u8; 4]>; MIPS] = core::array::from_fn(|_| Vec::new());
        mips[0] = all(TEXELS, &|[x, y, z]| texel(x, y, z));
        for m in 1..MIPS {
            let (edge, finer) = (TEXELS >> m, TEXELS >> (m - 1));
            // Interpolation reaches a texel beyond the block; from mip 1 on that is contained.
            let (before, after) = if m == 1 { (1, 2) } else { (0, 1) };
            let from = &mips[m - 1];
            mips[m] = all(edge, &|block| {
                let mut most = [0; 4];
                for z in 0..=before + after {
                    for y in 0..=before + after {
                        for x in 0..=before + after {
                            let [x, y, z] = [(0, x), (1, y), (2, z)]
                                .map(|(axis, i): (usize, usize)| (2 * block[axis] + i + finer - before) % finer);
                            let texel = from[(z * finer + y) * finer + x];
                            (0..4).for_each(|k| most[k] = texel[k].max(most[k]));
                        }
                    }
                }
                most
            });
        }
        Self { mips }
    }

    /// Red, green and blue at `u` periods, interpolated as a sampler does that repeats.
    pub fn sample<T: Real>(&self, u: [T; 3]) -> [T; 3] {
        let mut low = [0usize; 3];
        let mut part = [T::ZERO; 3];
        for k in 0..3 {
            let x = u[k] * T::of_u32(TEXELS as u32) - T::of(0.5);
            low[k] = x.floor().to_i64().rem_euclid(TEXELS as i64) as usize;
            part[k] = x - x.floor();
        }
        let next = low.map(|i| (i + 1) % TEXELS);
        let texel = |x: usize, y: usize, z: usize| {
            let [r, g, b, _] = self.mips[0][(z * TEXELS + y) * TEXELS + x];
            [r, g, b].map(|byte| T::of_u32(u32::from(byte)))
        };
        let mix = |a: [T; 3], b: [T; 3], t: T| -> [T; 3] { core::array::from_fn(|k| a[k] + t * (b[k] - a[k])) };
        let row = |y: usize, z: usize| mix(texel(low[0], y, z), texel(next[0], y, z), part[0]);
        let plane = |z: usize| mix(row(low[1], z), row(next[1], z), part[1]);
        mix(plane(low[2]), plane(next[2]), part[2]).map(|x| x * T::of(1.0 / 255.0))
    }

    /// The most that [`sample`](Self::sample) finds in a block of mip `mip`, of (64 ≫ mip)³ blocks in a period; any block's index.
    pub fn most<T: Real>(&self, block: [i64; 3], mip: usize) -> [T; 3] {
        let mip = mip.clamp(1, MIPS - 1);
        let edge = TEXELS >> mip;
        let [x, y, z] = block.map(|i| i.rem_euclid(edge as i64) as usize);
        let [r, g, b, _] = self.mips[mip][(z * edge + y) * edge + x];
        [r, g, b].map(|byte| T::of_u32(u32::from(byte)) * T::of(1.0 / 255.0))
    }
}

impl Default for CloudVolume {
    fn default() -> Self {
        Self::new()
    }
}
