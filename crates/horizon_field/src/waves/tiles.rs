//! Tiles at a time: heights and slopes over the plane.
//!
//! The transform gives the water's own frame at once. What stands over a texel is found when it is first asked for, and kept: a
//! game asks for few of the texels.

use core::sync::atomic::{AtomicU64, Ordering};
use std::sync::OnceLock;

use super::moments::Chains;
use super::transform::grid;
use super::{Cascade, GRID, PERIOD, Sea, resolve};

/// Slopes beyond this are cut, so that squares fit into half floats: 89.5° of steepness.
pub const STEEPEST: f64 = 128.0;
/// A texel that nobody has asked for. No height is such a number.
const UNKNOWN: u64 = u64::MAX;

/// The device's clock: the time in 2⁻³² of a [`PERIOD`], which no game is too old for. A time that is no number is 0.
pub fn tick(time: f64) -> u32 {
    (time.rem_euclid(PERIOD) / PERIOD * 4_294_967_296.0) as u32
}

/// One tile at a time.
#[derive(Debug)]
pub struct Tile {
    side: f64,
    bound: f64,
    /// Height and displacement in the water's own frame.
    grid: Vec<[f64; 3]>,
    /// Height and foam over the plane, as two f32, as far as they are known. Whoever finds them finds the same.
    over: Vec<AtomicU64>,
    chains: OnceLock<Chains>,
}

/// All tiles of a sea at a time.
#[derive(Debug, Default)]
pub struct Tiles {
    /// The tiles, from the largest on.
    pub tiles: Vec<Tile>,
}

impl Sea {
    /// All tiles at a time in seconds. About a millisecond: [`SeaSurface`](super::SeaSurface) keeps them for many questions.
    pub fn tiles(&self, time: f64) -> Tiles {
        Tiles { tiles: self.cascades.iter().map(|cascade| Tile::new(cascade, tick(time))).collect() }
    }
}

impl Tile {
    fn new(cascade: &Cascade, tick: u32) -> Self {
        Self {
            side: cascade.side,
            bound: f64::from(cascade.bound),
            grid: grid(cascade, tick),
            over: (0..GRID * GRID).map(|_| AtomicU64::new(UNKNOWN)).collect(),
            chains: OnceLock::new(),
        }
    }

    /// The side, in metres.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// What is read at many sizes.
    pub fn chains(&self) -> &Chains {
        self.chains.get_or_init(|| Chains::new(self))
    }

    /// Height and foam over a texel, counted on across the tile's edge.
    fn over(&self, x: usize, z: usize) -> [f32; 2] {
        let [x, z] = [x % GRID, z % GRID];
        let slot = &self.over[z * GRID + x];
        let bits = slot.load(Ordering::Relaxed);
        if bits != UNKNOWN {
            return [f32::from_bits((bits >> 32) as u32), f32::from_bits(bits as u32)];
        }
        let found = resolve::over(&self.grid, self.side / GRID as f64, self.bound, x, z).map(|value| value as f32);
        let [height, foam] = found.map(|value| u64::from(value.to_bits()));
        slot.store((height << 32) | foam, Ordering::Relaxed);
        found
    }

    /// Height, slopes along x and z by central differences of the fourth order, and foam, over a texel.
    pub(super) fn texel(&self, x: usize, z: usize) -> [f64; 4] {
        let per = GRID as f64 / (12.0 * self.side);
        let slope = |at: &dyn Fn(usize) -> [f32; 2]| {
            let [before, last, next, after] = [GRID - 2, GRID - 1, 1, 2].map(|off| f64::from(at(off)[0]));
            ((8.0 * (next - last) - (after - before)) * per).clamp(-STEEPEST, STEEPEST)
        };
        let [height, foam] = self.over(x, z).map(f64::from);
        [height, slope(&|off| self.over(x + off, z)), slope(&|off| self.over(x, z + off)), foam]
    }
}

impl Tiles {
    /// The height over a place (x, z), in metres above the water's level.
    pub fn height(&self, place: [f64; 2]) -> f64 {
        let height = |tile: &Tile| bilinear(GRID, place.map(|x| x / tile.side), |x, z| [f64::from(tile.over(x, z)[0])]);
        self.tiles.iter().map(|tile| height(tile)[0]).sum()
    }

    /// The slopes along x and z over a place (x, z).
    pub fn slope(&self, place: [f64; 2]) -> [f64; 2] {
        self.tiles.iter().fold([0.0; 2], |sum, tile| {
            let [_, x, z, _] = bilinear(GRID, place.map(|x| x / tile.side), |x, z| tile.texel(x, z));
            [sum[0] + x, sum[1] + z]
        })
    }

    /// The unit normal over a place (x, z).
    pub fn normal(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, z] = self.slope(place);
        let per = 1.0 / (1.0 + x * x + z * z).sqrt();
        [-x * per, per, -z * per]
    }
}

/// Between the centres of texels, at a place in tiles; the grid goes on across its edge. A place that is no number is 0.
pub(super) fn bilinear<const N: usize>(
    side: usize,
    place: [f64; 2],
    texel: impl Fn(usize, usize) -> [f64; N],
) -> [f64; N] {
    let at = place.map(|x| if x.is_finite() { (x - x.floor()) * side as f64 - 0.5 } else { -0.5 });
    let floor = at.map(f64::floor);
    let [x, z] = floor.map(|x| (x as i64).rem_euclid(side as i64) as usize);
    let [next_x, next_z] = [(x + 1) % side, (z + 1) % side];
    let [tx, tz] = [at[0] - floor[0], at[1] - floor[1]];
    let mix = |a: [f64; N], b: [f64; N], t: f64| core::array::from_fn(|k| a[k] + t * (b[k] - a[k]));
    let row = |z| mix(texel(x, z), texel(next_x, z), tx);
    mix(row(z), row(next_z), tz)
}
