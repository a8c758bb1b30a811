//! Simplex noise after Perlin (2001), with the kernel (½ − d²)⁴, which ends inside the simplices around a corner and so
//! keeps the noise C³. Points come in skewed coordinates, where simplices fill cubes; only the fraction, which is small,
//! is unskewed. `simplex.wgsl` is the twin.

use super::axes::Axes;
use super::bounds::BasisBounds;
use super::corner::{vector2, vector3};
use crate::fractal::Algebra;
use crate::hash::{mix2, mix3};
use crate::real::{Jet, Real, axes};

/// n = scale · Σ_c (½ − d_c²)₊⁴ (g_c · d_c), with |g_ck| ≤ 1. Range: the scale is 1 / sup Σ_ck (½ − d_c²)₊⁴ |d_ck|.
/// Slope: sup over x and unit e of Σ_ck |e·∇((½ − d_c²)₊⁴ d_ck)|, curvature likewise with eᵀ∇²e.
/// Both as found, plus 1 %, by `tests/suprema.rs`; the scale a little below what is found there.
pub(super) const PLANE: BasisBounds = BasisBounds::unit(7.41, 56.3);
/// As in the plane.
pub(super) const SPACE: BasisBounds = BasisBounds::unit(7.8, 54.1);

/// What brings the plane's range into [−1, 1].
pub(super) const PLANE_SCALE: f64 = 70.0;
/// What brings space's range into [−1, 1].
pub(super) const SPACE_SCALE: f64 = 61.5;

/// (3 − √3)/6: the unskew of the plane is I − G·1.
pub(super) const PLANE_UNSKEW: f64 = 0.211_324_865_405_187_1;
/// 1/6: the unskew of space.
pub(super) const SPACE_UNSKEW: f64 = 1.0 / 6.0;

/// The noise in the plane.
#[inline(always)]
pub(super) fn plane<T: Real>(cell: &impl Axes<2>, fraction: [T; 2]) -> Jet<T, 2> {
    let [hx, hy] = cell.ends();
    let [x, y] = fraction;
    let g = T::of(PLANE_UNSKEW);
    // From corner (0, 0) to the second corner the path takes the longer axis first.
    let right = x >= y;
    let up = !right;
    let t = (x + y) * g;
    let d = [x - t, y - t];
    let near = kernel(d, vector2(mix2(hx[0], hy[0])));
    let side = kernel(beyond(d, [right, up], g), vector2(mix2(end(hx, right), end(hy, up))));
    let far = kernel(beyond(d, [true; 2], g + g), vector2(mix2(hx[1], hy[1])));
    combined([near, side, far], T::of(PLANE_SCALE), g)
}

/// The noise in space.
#[inline(always)]
pub(super) fn space<T: Real>(cell: &impl Axes<3>, fraction: [T; 3]) -> Jet<T, 3> {
    let [hx, hy, hz] = cell.ends();
    let [x, y, z] = fraction;
    let g = T::of(SPACE_UNSKEW);
    // The path from (0, 0, 0) to (1, 1, 1) takes the axes in falling order of the fraction; `first` and `second` are
    // its corners between.
    let (xy, yz, zx) = (x >= y, y >= z, z > x);
    let first = [xy & !zx, yz & !xy, zx & !yz];
    let second = [xy | !zx, yz | !xy, zx | !yz];
    let t = (x + y + z) * g;
    let d = [x - t, y - t, z - t];
    let vector = |i: [bool; 3]| vector3(mix3(end(hx, i[0]), end(hy, i[1]), end(hz, i[2])));
    let corners = [
        kernel(d, vector([false; 3])),
        kernel(beyond(d, first, g), vector(first)),
        kernel(beyond(d, second, g + g), vector(second)),
        kernel(beyond(d, [true; 3], g + g + g), vector([true; 3])),
    ];
    combined(corners, T::of(SPACE_SCALE), g)
}

/// An axis' hash at its near or its far end; by a choice, not an index, so that lanes need no gather.
#[inline(always)]
fn end(hashes: [u32; 2], far: bool) -> u32 {
    if far { hashes[1] } else { hashes[0] }
}

/// The distance to the corner at the `far` end of some axes, whose coordinates' sum unskews by `g`.
#[inline(always)]
fn beyond<T: Real, const D: usize>(d: [T; D], far: [bool; D], g: T) -> [T; D] {
    axes(|k| {
        let step = if far[k] { T::ONE } else { T::ZERO };
        d[k] - step + g
    })
}

/// One corner's share at the distance `d`, k⁴ (g·d) with k = (½ − d²)₊; its gradient is
/// k⁴g − 8k³(g·d)d.
#[inline(always)]
fn kernel<T: Real, const D: usize>(d: [T; D], g: [T; D]) -> Jet<T, D> {
    let (mut square, mut dot) = (d[0] * d[0], g[0] * d[0]);
    for k in 1..D {
        square += d[k] * d[k];
        dot += g[k] * d[k];
    }
    let k1 = (T::of(0.5) - square).max(T::ZERO);
    let k3 = k1 * k1 * k1;
    let k4 = k3 * k1;
    let inward = T::of(8.0) * k3 * dot;
    Jet { v: k4 * dot, g: axes(|k| k4 * g[k] - inward * d[k]) }
}

/// The sum of the corners' shares, scaled; the gradient brought to skewed coordinates by the unskew I − g·1, which is
/// its own transpose.
#[inline(always)]
fn combined<T: Real, const D: usize, const N: usize>(corners: [Jet<T, D>; N], scale: T, unskew: T) -> Jet<T, D> {
    let mut n = corners[0];
    for corner in &corners[1..] {
        n = n.plus(*corner);
    }
    n = n.scaled(scale);
    let mut sum = n.g[0];
    for g in &n.g[1..] {
        sum += *g;
    }
    Jet { v: n.v, g: n.g.map(|g| g - sum * unskew) }
}
