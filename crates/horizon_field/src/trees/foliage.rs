//! The foliage: a periodic table of 3D fBm with its mips, and what is proven of each. Made once, the same everywhere.

use std::sync::LazyLock;

use crate::noise::periodic;
use crate::real::Real;

/// Texels along an edge.
pub const TEXELS: usize = 64;
/// Mips, from the table itself to its mean.
pub const MIPS: usize = 7;
/// Clumps along an edge: the wavelength of the first octave.
pub(super) const CLUMPS: f64 = 4.0;

/// Octaves, each of half the wavelength and half the weight of the one before it: the last one is 4 texels long.
const OCTAVES: u32 = 3;
const SEED: u32 = 0x1eaf;

/// A periodic table of numbers from 0 to 1, with mips.
#[derive(Debug)]
pub struct Foliage {
    /// From the finest on; x runs fastest, then y, then z.
    mips: Vec<Vec<u8>>,
    /// See [`Foliage::slope`].
    slopes: [f64; MIPS],
}

impl Foliage {
    /// The table.
    pub fn table() -> &'static Self {
        static TABLE: LazyLock<Foliage> = LazyLock::new(Foliage::new);
        &TABLE
    }

    fn new() -> Self {
        let mut mips = vec![finest()];
        while let Some(last) = mips.last().filter(|last| last.len() > 1) {
            mips.push(halved(last));
        }
        let mut slopes = core::array::from_fn(|mip| steepest(&mips[mip]));
        for mip in (1..MIPS).rev() {
            slopes[mip - 1] = f64::max(slopes[mip - 1], slopes[mip]);
        }
        Self { mips, slopes }
    }

    /// A mip's texels, from 0 at the finest to 6: x runs fastest, then y, then z. What the device's texture holds.
    pub fn texels(&self, mip: usize) -> &[u8] {
        &self.mips[mip.min(MIPS - 1)]
    }

    /// A bound of the length of the gradient, per period, of a mip and of all coarser ones, and of what is between them.
    pub fn slope(&self, mip: usize) -> f64 {
        self.slopes[mip.min(MIPS - 1)]
    }

    /// The table's mean.
    pub fn mean(&self) -> f64 {
        f64::from(self.mips[MIPS - 1][0]) / 255.0
    }

    /// A texel of a mip, whose coordinates wrap.
    #[inline(always)]
    pub(super) fn texel(&self, mip: usize, [x, y, z]: [i64; 3]) -> u8 {
        let edge = TEXELS >> mip;
        let wrapped = |x: i64| x as usize & (edge - 1);
        self.mips[mip][(wrapped(z) * edge + wrapped(y)) * edge + wrapped(x)]
    }

    /// A mip at `u` periods, linear between texels.
    fn mip<T: Real>(&self, mip: usize, u: [T; 3]) -> T {
        let edge = T::of_u32((TEXELS >> mip) as u32);
        let x = u.map(|u| u * edge - T::of(0.5));
        let whole = x.map(T::floor);
        let cell = whole.map(T::to_i64);
        let mut corners = [T::ZERO; 8];
        for (i, corner) in corners.iter_mut().enumerate() {
            let at = core::array::from_fn(|k| cell[k].wrapping_add((i >> k & 1) as i64));
            *corner = T::of_u32(u32::from(self.texel(mip, at)));
        }
        for k in 0..3 {
            let f = x[k] - whole[k];
            for i in 0..4 {
                corners[i] = corners[2 * i] + f * (corners[2 * i + 1] - corners[2 * i]);
            }
        }
        corners[0] * T::of(1.0 / 255.0)
    }

    /// The table at `u` periods, and a level between 0 and 6, of which the fraction mixes two mips.
    pub fn value<T: Real>(&self, u: [T; 3], level: T) -> T {
        let level = level.clamp(T::ZERO, T::of_u32(MIPS as u32 - 1));
        let fine = level.floor();
        let mix = level - fine;
        let mip = fine.to_i64() as usize;
        let value = self.mip(mip, u);
        if mix > T::ZERO { value + mix * (self.mip(mip + 1, u) - value) } else { value }
    }
}

/// Octaves of periodic noise, stretched to what a byte holds.
fn finest() -> Vec<u8> {
    let at = |i: usize| (i as f64 + 0.5) / TEXELS as f64;
    let mut sums = Vec::with_capacity(TEXELS * TEXELS * TEXELS);
    for z in 0..TEXELS {
        for y in 0..TEXELS {
            for x in 0..TEXELS {
                let octave = |octave: u32| {
                    let period = (CLUMPS as u32) << octave;
                    let noise = periodic([at(x), at(y), at(z)], period, SEED + octave);
                    noise / f64::from(1u32 << octave)
                };
                sums.push((0..OCTAVES).map(octave).sum::<f64>());
            }
        }
    }
    let low = sums.iter().copied().fold(f64::INFINITY, f64::min);
    let high = sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    sums.iter().map(|sum| (255.0 * (sum - low) / (high - low)).round() as u8).collect()
}

/// The means of eight texels each.
fn halved(fine: &[u8]) -> Vec<u8> {
    let edge = (fine.len() as f64).cbrt().round() as usize;
    let half = edge / 2;
    let mean = |i: usize| {
        let [x, y, z] = [i % half, i / half % half, i / (half * half)].map(|k| 2 * k);
        let sum: u32 =
            (0..8).map(|c| u32::from(fine[((z + (c >> 2)) * edge + y + (c >> 1 & 1)) * edge + x + (c & 1)])).sum();
        ((sum + 4) / 8) as u8
    };
    (0..half * half * half).map(mean).collect()
}

/// A bound of the gradient's length, per period. Between eight texels each partial derivative is a mean of four differences
/// along its axis, so it is no larger than the largest of them.
fn steepest(texels: &[u8]) -> f64 {
    let edge = (texels.len() as f64).cbrt().round() as usize;
    let at = |[x, y, z]: [usize; 3]| f64::from(texels[((z % edge) * edge + y % edge) * edge + x % edge]);
    let mut most = 0.0f64;
    for i in 0..texels.len() {
        let cell = [i % edge, i / edge % edge, i / (edge * edge)];
        let mut square = 0.0;
        for axis in 0..3 {
            let mut largest = 0.0f64;
            for corner in 0..4 {
                let mut low = cell;
                low[(axis + 1) % 3] += corner & 1;
                low[(axis + 2) % 3] += corner >> 1;
                let mut high = low;
                high[axis] += 1;
                largest = largest.max((at(high) - at(low)).abs());
            }
            square += largest * largest;
        }
        most = most.max(square);
    }
    most.sqrt() / 255.0 * edge as f64
}
