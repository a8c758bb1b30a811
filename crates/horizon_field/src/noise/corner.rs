//! What the bases share: what a corner's hash gives, and the quintic fade.

use crate::real::{Real, axes};

/// A number in [−1, 1), from the hash's top 24 bits: exact in f32.
#[inline(always)]
pub(super) fn signed<T: Real>(hash: u32) -> T {
    T::of_u32(hash >> 8) * T::of(1.0 / 8_388_608.0) - T::ONE
}

/// A vector in (−1, 1)², from 16 bits for each axis: symmetric about 0 and exact in f32.
#[inline(always)]
pub(super) fn vector2<T: Real>(hash: u32) -> [T; 2] {
    let [centre, unit] = [T::of(32_767.5), T::of(1.0 / 32_768.0)];
    [(T::of_u32(hash & 0xffff) - centre) * unit, (T::of_u32(hash >> 16) - centre) * unit]
}

/// A vector in (−1, 1)³, from 11, 11 and 10 bits: symmetric about 0 and exact in f32.
#[inline(always)]
pub(super) fn vector3<T: Real>(hash: u32) -> [T; 3] {
    let [centre, unit] = [T::of(1023.5), T::of(1.0 / 1024.0)];
    [
        (T::of_u32(hash & 0x7ff) - centre) * unit,
        (T::of_u32((hash >> 11) & 0x7ff) - centre) * unit,
        (T::of_u32(hash >> 22) - T::of(511.5)) * T::of(1.0 / 512.0),
    ]
}

/// Perlin's quintic 6t⁵ − 15t⁴ + 10t³ and its derivative 30t²(1 − t)²: C² from cell to cell.
#[inline(always)]
pub(super) fn quintic<T: Real>(t: T) -> (T, T) {
    let rest = t - T::ONE;
    let value = t * t * t * (t * (t * T::of(6.0) - T::of(15.0)) + T::of(10.0));
    (value, T::of(30.0) * t * t * rest * rest)
}

/// From `a` to `b`, linearly.
#[inline(always)]
pub(super) fn mix<T: Real, const N: usize>(a: [T; N], b: [T; N], t: T) -> [T; N] {
    axes(|k| a[k] + t * (b[k] - a[k]))
}
