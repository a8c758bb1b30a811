//! Random numbers for paths, the same on every platform.

/// The golden ratio's bits, the counter's step.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// SplitMix64 (Steele, Lea and Flood 2014): a counter and a mixing function, period 2⁶⁴.
pub struct Random(u64);

impl Random {
    /// The `stream`th sequence of a `seed`.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self(mix(mix(seed ^ GOLDEN) ^ stream))
    }

    /// A number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        (mix(self.0) >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A number of mean 1 from the exponential distribution.
    pub fn exponential(&mut self) -> f64 {
        -libm::log1p(-self.uniform())
    }

    /// An angle in [0, 2π).
    pub fn angle(&mut self) -> f64 {
        core::f64::consts::TAU * self.uniform()
    }
}

/// SplitMix64's mixing: every bit of the result depends on every bit of `z`, and no two are alike.
pub fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
