//! Noise at several lattice points at once, laid out axis by axis, so that a loop over the lanes becomes vector
//! instructions. The lanes are points of one octave, or octaves at one point. Each does exactly what a single evaluation
//! does: bits don't depend on who shares the lanes.

// Loops over an index, and conditions without a branch, are what the vectoriser takes.
#![allow(clippy::needless_range_loop, clippy::manual_range_contains)]

use super::Basis;
use super::axes::{NearCell, Words};
use crate::lattice::{LatticePoint, Layer};
use crate::real::{Jet, axes};

/// Brings an integer of less than 2⁵¹ into the low bits of the sum: 1.5 · 2⁵².
const ALIGN: f64 = 6_755_399_441_055_744.0;
/// Signed low words lie between: their neighbours must not wrap.
const LOWEST: f64 = -2_147_483_647.0;
/// The same, above.
const HIGHEST: f64 = 2_147_483_646.0;

/// Lattice points, one for each lane: their cells' low words, and fractions.
pub(crate) struct Lanes<const D: usize, const N: usize> {
    low: [[u32; N]; D],
    fraction: [[f64; N]; D],
}

impl<const D: usize, const N: usize> Lanes<D, N> {
    /// No points yet.
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self { low: [[0; N]; D], fraction: [[0.0; N]; D] }
    }

    /// Takes the points `q` metres from the anchor of one layer. Returns whether the low words tell the cells, as
    /// they do within about 2³¹ cells of the anchor; where they don't, the lanes hold nothing of use.
    #[inline(always)]
    #[must_use]
    pub(crate) fn points(&mut self, layer: &Layer<D>, anchor: &LatticePoint<f64, D>, q: &[[f64; N]; D]) -> bool {
        let mut near = true;
        for row in 0..D {
            let base = f64::from(Words::of(anchor.cell[row]).low);
            for i in 0..N {
                near &= self.take(i, row, base, layer.parts(anchor, axes(|k| q[k][i]), row));
            }
        }
        near
    }

    /// Takes one point, `q` metres from the anchors of as many layers as there are lanes, or fewer, and the layers' high
    /// words. Returns as above.
    #[inline(always)]
    #[must_use]
    pub(crate) fn layers(
        &mut self,
        layers: &[Layer<D>],
        anchors: &[LatticePoint<f64, D>],
        q: [f64; D],
        high: &mut HighWords<D, N>,
    ) -> bool {
        let count = layers.len().min(N);
        let (layers, anchors) = (&layers[..count], &anchors[..count]);
        let mut near = true;
        for i in 0..count {
            for row in 0..D {
                let words = Words::of(anchors[i].cell[row]);
                high.word[row][i] = words.high;
                high.seed[row][i] = layers[i].axis_seeds[row];
                near &= self.take(i, row, f64::from(words.low), layers[i].parts(&anchors[i], q, row));
            }
        }
        near
    }

    #[inline(always)]
    fn take(&mut self, i: usize, row: usize, base: f64, [whole, fraction]: [f64; 2]) -> bool {
        let low = base + whole;
        self.low[row][i] = (low + ALIGN).to_bits() as u32;
        self.fraction[row][i] = fraction;
        (low >= LOWEST) & (low <= HIGHEST)
    }

    /// The noise of every lane, whose high words hash to `high`; `each` takes it.
    #[inline(always)]
    pub(crate) fn noise(
        &self,
        basis: Basis,
        high: impl Fn(usize) -> [[u32; 2]; D],
        each: impl FnMut(usize, Jet<f64, D>),
    ) {
        // The match is outside of the loop over the lanes.
        match basis {
            Basis::Value => self.noise_of(Basis::Value, high, each),
            Basis::Gradient => self.noise_of(Basis::Gradient, high, each),
            Basis::Simplex => self.noise_of(Basis::Simplex, high, each),
            Basis::Worley => self.noise_of(Basis::Worley, high, each),
        }
    }

    #[inline(always)]
    fn noise_of(&self, basis: Basis, high: impl Fn(usize) -> [[u32; 2]; D], mut each: impl FnMut(usize, Jet<f64, D>)) {
        for i in 0..N {
            let cell = NearCell { low: axes(|k| self.low[k][i]), high: high(i) };
            each(i, basis.of_axes(&cell, axes(|k| self.fraction[k][i])));
        }
    }
}

/// The high words of layers' anchors, lane by lane, with the axes' seeds.
pub(crate) struct HighWords<const D: usize, const N: usize> {
    word: [[u32; N]; D],
    seed: [[u32; N]; D],
}

impl<const D: usize, const N: usize> HighWords<D, N> {
    /// None yet.
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self { word: [[0; N]; D], seed: [[0; N]; D] }
    }

    /// [`high_hashes`] of a lane.
    #[inline(always)]
    pub(crate) fn hashes(&self, i: usize) -> [[u32; 2]; D] {
        axes(|k| Words { high: self.word[k][i], low: 0 }.hashes(self.seed[k][i]))
    }
}

/// What the high words of cells near an anchor's hash to: see [`NearCell::high`].
#[inline(always)]
pub(crate) fn high_hashes<const D: usize>(layer: &Layer<D>, anchor: &LatticePoint<f64, D>) -> [[u32; 2]; D] {
    axes(|k| Words::of(anchor.cell[k]).hashes(layer.axis_seeds[k]))
}
