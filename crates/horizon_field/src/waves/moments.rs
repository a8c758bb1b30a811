//! The surface through a filter: means of a tile, and the moments that keep roughness where waves are too small to be seen.
//!
//! Slopes have second moments of their own, which filter linearly: the variance E[s²] − E[s]² is right at every size (Olano and
//! Baker, *LEAN Mapping*, 2010; Bruneton et al. 2010).

use super::GRID;
use super::tiles::{Tile, Tiles, bilinear};

/// Texels, x first, and their means: of sides 128, 64, … 1.
pub type Chain = Vec<Vec<[f32; 4]>>;

/// A tile at all sizes, as the renderer's textures have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Chains {
    /// Height, slopes along x and z, foam.
    pub surface: Chain,
    /// The slopes' squares, their product, the height's square.
    pub moments: Chain,
}

/// The surface through a filter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// The mean height, in metres.
    pub height: f64,
    /// The mean slopes along x and z.
    pub slope: [f64; 2],
    /// What the filter hides: the variances of the slopes along x and z, and their covariance.
    pub variance: [f64; 3],
    /// How far water is drawn together, from 0 to 1, in the tile where it is most.
    pub foam: f64,
}

impl Chains {
    pub(super) fn new(tile: &Tile) -> Self {
        let texels: Vec<[f64; 4]> = (0..GRID * GRID).map(|i| tile.texel(i % GRID, i / GRID)).collect();
        let moments = texels.iter().map(|[height, x, z, _]| [x * x, z * z, x * z, height * height].map(|m| m as f32));
        Self {
            moments: chain(moments.collect()),
            surface: chain(texels.iter().map(|texel| texel.map(|value| value as f32)).collect()),
        }
    }
}

/// Texels, and the means of 2 × 2 of them, of these, and so on.
fn chain(texels: Vec<[f32; 4]>) -> Chain {
    let mut chain = vec![texels];
    let mut side = GRID;
    while side > 1 {
        let last = &chain[chain.len() - 1];
        let half = side / 2;
        let mean = |i: usize| {
            let at = 2 * (i / half) * side + 2 * (i % half);
            let four = [last[at], last[at + 1], last[at + side], last[at + side + 1]];
            core::array::from_fn(|k| 0.25 * ((four[0][k] + four[1][k]) + (four[2][k] + four[3][k])))
        };
        let next = (0..half * half).map(mean).collect();
        chain.push(next);
        side = half;
    }
    chain
}

/// Between the texels of two means.
fn trilinear(chain: &Chain, place: [f64; 2], level: f64) -> [f64; 4] {
    let last = chain.len() - 1;
    let first = (level as usize).min(last);
    let at = |level: usize| {
        let side = GRID >> level;
        bilinear(side, place, |x, z| chain[level][z * side + x].map(f64::from))
    };
    let (one, other) = (at(first), at((first + 1).min(last)));
    let share = (level - first as f64).clamp(0.0, 1.0);
    core::array::from_fn(|k| one[k] + share * (other[k] - one[k]))
}

impl Tiles {
    /// The mean of the surface over a square of side `footprint` about a place (x, z), both in metres, as a device's trilinear filter
    /// has it. Waves of different tiles are taken as independent.
    pub fn moments(&self, place: [f64; 2], footprint: f64) -> Moments {
        let mut sum = Moments::default();
        for tile in &self.tiles {
            let level = libm::log2((footprint * GRID as f64 / tile.side()).max(1.0));
            let at = place.map(|x| x / tile.side());
            let [height, sx, sz, foam] = trilinear(&tile.chains().surface, at, level);
            let [xx, zz, xz, _] = trilinear(&tile.chains().moments, at, level);
            sum.height += height;
            sum.slope = [sum.slope[0] + sx, sum.slope[1] + sz];
            let hidden = [xx - sx * sx, zz - sz * sz, xz - sx * sz];
            let hidden = [hidden[0].max(0.0), hidden[1].max(0.0), hidden[2]];
            sum.variance = core::array::from_fn(|k| sum.variance[k] + hidden[k]);
            sum.foam = sum.foam.max(foam);
        }
        sum
    }
}
