//! Tiles at a time: heights and slopes over the plane, and the moments that keep roughness where waves are too small to be seen.
//!
//! Both kinds of data have the layout of the renderer's textures, and as these a chain of means, each of 2 × 2 texels of the one before.
//! Slopes have second moments of their own: the variance E[s²] − E[s]² is right at every size (Olano and Baker, *LEAN Mapping*,
//! 2010; Bruneton et al. 2010).

use super::transform::grid;
use super::{Cascade, GRID, PERIOD, Sea, resolve};

/// Slopes beyond this are cut, so that squares fit into half floats: 89.5° of steepness.
pub const STEEPEST: f64 = 128.0;

/// The device's clock: the time in 2⁻³² of a [`PERIOD`], which no game is too old for. A time that is no number is 0.
pub fn tick(time: f64) -> u32 {
    (time.rem_euclid(PERIOD) / PERIOD * 4_294_967_296.0) as u32
}

/// Texels of a tile and of its means: side after side, 128 to 1.
type Chain = Vec<Vec<[f32; 4]>>;

/// One tile.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// The side, in metres.
    pub side: f64,
    /// Height, slopes along x and z, foam.
    pub surface: Chain,
    /// Means of the slopes' squares, of their product, and of the height's square.
    pub moments: Chain,
}

/// All tiles of a sea at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tiles {
    /// The tiles, from the largest on.
    pub tiles: Vec<Tile>,
}

/// The surface, as seen through a filter.
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

impl Sea {
    /// All tiles at a time in seconds. Some milliseconds: [`SeaSurface`](super::SeaSurface) keeps them for many questions.
    pub fn tiles(&self, time: f64) -> Tiles {
        Tiles { tiles: self.cascades.iter().map(|cascade| Tile::new(cascade, tick(time))).collect() }
    }
}

impl Tile {
    fn new(cascade: &Cascade, tick: u32) -> Self {
        let (grid, bound) = (grid(cascade, tick), f64::from(cascade.bound));
        let resolved: Vec<[f64; 2]> =
            (0..GRID * GRID).map(|i| resolve::over(&grid, cascade.texel(), bound, i % GRID, i / GRID)).collect();
        let wrapped = |x: usize, z: usize| resolved[(z % GRID) * GRID + x % GRID][0];
        let per = 1.0 / (12.0 * cascade.texel());
        // Central differences of the fourth order.
        let slope = |ends: [f64; 4]| {
            let [before, last, next, after] = ends;
            ((8.0 * (next - last) - (after - before)) * per).clamp(-STEEPEST, STEEPEST)
        };
        let (mut surface, mut moments) = (Vec::with_capacity(GRID * GRID), Vec::with_capacity(GRID * GRID));
        for (z, x) in (0..GRID).flat_map(|z| (0..GRID).map(move |x| (z, x))) {
            let off = [GRID - 2, GRID - 1, 1, 2];
            let [sx, sz] = [slope(off.map(|off| wrapped(x + off, z))), slope(off.map(|off| wrapped(x, z + off)))];
            let [height, foam] = resolved[z * GRID + x];
            surface.push([height, sx, sz, foam].map(|value| value as f32));
            moments.push([sx * sx, sz * sz, sx * sz, height * height].map(|value| value as f32));
        }
        Self { side: cascade.side, surface: chain(surface), moments: chain(moments) }
    }

    /// Values between the texels of a mean, and of two of them.
    fn read(&self, of: &Chain, place: [f64; 2], level: f64) -> [f64; 4] {
        let level = level.clamp(0.0, (of.len() - 1) as f64);
        let (first, share) = (level as usize, level - level.floor());
        let one = bilinear(&of[first], place.map(|x| x / self.side));
        if share == 0.0 {
            return one;
        }
        let other = bilinear(&of[first + 1], place.map(|x| x / self.side));
        core::array::from_fn(|k| one[k] + share * (other[k] - one[k]))
    }
}

impl Tiles {
    /// The height over a place (x, z), in metres above the water's level.
    pub fn height(&self, place: [f64; 2]) -> f64 {
        self.tiles.iter().map(|tile| tile.read(&tile.surface, place, 0.0)[0]).sum()
    }

    /// The unit normal over a place (x, z).
    pub fn normal(&self, place: [f64; 2]) -> [f64; 3] {
        let Moments { slope: [x, z], .. } = self.moments(place, 0.0);
        let per = 1.0 / (1.0 + x * x + z * z).sqrt();
        [-x * per, per, -z * per]
    }

    /// The mean of the surface over a square of side `footprint` about a place (x, z), both in metres, as a device's trilinear filter
    /// has it. Waves of different tiles are taken as independent.
    pub fn moments(&self, place: [f64; 2], footprint: f64) -> Moments {
        let mut sum = Moments::default();
        for tile in &self.tiles {
            let level = libm::log2((footprint * GRID as f64 / tile.side).max(1.0));
            let [height, sx, sz, foam] = tile.read(&tile.surface, place, level);
            let [xx, zz, xz, _] = tile.read(&tile.moments, place, level);
            sum.height += height;
            sum.slope = [sum.slope[0] + sx, sum.slope[1] + sz];
            sum.variance[0] += (xx - sx * sx).max(0.0);
            sum.variance[1] += (zz - sz * sz).max(0.0);
            sum.variance[2] += xz - sx * sz;
            sum.foam = sum.foam.max(foam);
        }
        sum
    }
}

/// Texels, and their means.
fn chain(texels: Vec<[f32; 4]>) -> Chain {
    let mut chain = vec![texels];
    let mut side = GRID;
    while side > 1 {
        let last = &chain[chain.len() - 1];
        let mean = |x: usize, z: usize| {
            let at = 2 * z * side + 2 * x;
            let four = [last[at], last[at + 1], last[at + side], last[at + side + 1]];
            core::array::from_fn(|k| 0.25 * ((four[0][k] + four[1][k]) + (four[2][k] + four[3][k])))
        };
        let half = side / 2;
        let next = (0..half * half).map(|i| mean(i % half, i / half)).collect();
        chain.push(next);
        side = half;
    }
    chain
}

/// Between the centres of texels, at a place in tiles. A place that is no number is the first texel.
fn bilinear(texels: &[[f32; 4]], place: [f64; 2]) -> [f64; 4] {
    let side = texels.len().isqrt();
    let at = place.map(|x| (x - x.floor()) * side as f64 - 0.5);
    let floor = at.map(f64::floor);
    let [x, z] = floor.map(|x| (x as i64).rem_euclid(side as i64) as usize);
    let [next_x, next_z] = [(x + 1) % side, (z + 1) % side];
    let [tx, tz] = [at[0] - floor[0], at[1] - floor[1]];
    let row = |z: usize, k: usize| {
        let [a, b] = [x, next_x].map(|x| f64::from(texels[z * side + x][k]));
        a + tx * (b - a)
    };
    core::array::from_fn(|k| {
        let (a, b) = (row(z, k), row(next_z, k));
        a + tz * (b - a)
    })
}
