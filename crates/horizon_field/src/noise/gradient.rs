//! Gradient noise after Perlin, *Improving Noise* (2002): a random linear function at each lattice point, interpolated
//! by the quintic. `gradient.wgsl` is the twin.

use super::axes::Axes;
use super::bounds::BasisBounds;
use super::corner::{mix, quintic, vector2, vector3};
use crate::hash::{mix2, mix3};
use crate::real::{Jet, Real};

/// n = Σ_c W_c (g_c · d_c), with |g_ck| ≤ 1. Range: |n| ≤ Σ_c W_c Σ_k |d_ck|. Along one axis Σ W |d| =
/// (1 − s)t + s(1 − t) ≤ ½, so |n| ≤ D/2: 1 in the plane, and 3/2 in space, hence [`SPACE_SCALE`].
/// Slope: sup over x and unit e of Σ_ck |e·∇(W_c d_ck)|. Curvature: sup of Σ_ck |eᵀ∇²(W_c d_ck)e|. Both as
/// found, plus 1 %, by `tests/suprema.rs`.
pub(super) const PLANE: BasisBounds = BasisBounds::unit(2.78, 12.69);
/// As in the plane, scaled.
pub(super) const SPACE: BasisBounds = BasisBounds::unit(3.12, 11.68);

/// What brings space's range into [−1, 1].
const SPACE_SCALE: f64 = 2.0 / 3.0;

/// The noise in the plane.
#[inline(always)]
pub(super) fn plane<T: Real>(cell: &impl Axes<2>, fraction: [T; 2]) -> Jet<T, 2> {
    let [[x0, x1], [y0, y1]] = cell.ends();
    let [x, y] = fraction;
    let (rx, ry) = (x - T::ONE, y - T::ONE);
    let [u, v] = [quintic(x), quintic(y)];
    let row = blend(linear2(mix2(x0, y0), [x, y]), linear2(mix2(x1, y0), [rx, y]), u, 1);
    let next = blend(linear2(mix2(x0, y1), [x, ry]), linear2(mix2(x1, y1), [rx, ry]), u, 1);
    let [value, gx, gy] = blend(row, next, v, 2);
    Jet { v: value, g: [gx, gy] }
}

/// The noise in space.
#[inline(always)]
pub(super) fn space<T: Real>(cell: &impl Axes<3>, fraction: [T; 3]) -> Jet<T, 3> {
    let [[x0, x1], [y0, y1], [z0, z1]] = cell.ends();
    let [x, y, z] = fraction;
    let (rx, ry, rz) = (x - T::ONE, y - T::ONE, z - T::ONE);
    let [u, v, w] = [quintic(x), quintic(y), quintic(z)];
    let layer = |hz: u32, z: T| {
        let row = blend(linear3(mix3(x0, y0, hz), [x, y, z]), linear3(mix3(x1, y0, hz), [rx, y, z]), u, 1);
        let next = blend(linear3(mix3(x0, y1, hz), [x, ry, z]), linear3(mix3(x1, y1, hz), [rx, ry, z]), u, 1);
        blend(row, next, v, 2)
    };
    let scale = T::of(SPACE_SCALE);
    let [value, gx, gy, gz] = blend(layer(z0, z), layer(z1, rz), w, 3);
    Jet { v: value * scale, g: [gx * scale, gy * scale, gz * scale] }
}

/// A corner's linear function at the distance `d`: its value, then its gradient.
#[inline(always)]
fn linear2<T: Real>(hash: u32, d: [T; 2]) -> [T; 3] {
    let [gx, gy] = vector2(hash);
    [gx * d[0] + gy * d[1], gx, gy]
}

/// The same in space.
#[inline(always)]
fn linear3<T: Real>(hash: u32, d: [T; 3]) -> [T; 4] {
    let [gx, gy, gz] = vector3(hash);
    [gx * d[0] + gy * d[1] + gz * d[2], gx, gy, gz]
}

/// From `a` to `b`, both (value, gradient), by a factor t that itself has the slope dt along the axis at `slot`.
#[inline(always)]
fn blend<T: Real, const N: usize>(a: [T; N], b: [T; N], (t, dt): (T, T), slot: usize) -> [T; N] {
    let mut blended = mix(a, b, t);
    blended[slot] += (b[0] - a[0]) * dt;
    blended
}
