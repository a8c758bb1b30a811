//! Value noise: random values at lattice points, interpolated by the quintic. `value.wgsl` is the twin.

use super::axes::Axes;
use super::bounds::BasisBounds;
use super::corner::{mix, quintic, signed};
use crate::hash::{mix2, mix3};
use crate::real::{Jet, Real};

/// n = Σ h_c W_c, where |h_c| ≤ 1 and the W_c ≥ 0 sum to 1: within [−1, 1].
/// Slope: sup over x and unit e of Σ |e·∇W_c|: 2 max s' = 15/4, on an axis at ½.
/// Curvature: sup of Σ |eᵀ∇²W_c e|: 4 (max s')² = 225/16, on a diagonal at ½. Both as found, plus 1 %, by
/// `tests/suprema.rs`.
pub(super) const PLANE: BasisBounds = BasisBounds::unit(3.79, 14.21);
/// As in the plane.
pub(super) const SPACE: BasisBounds = BasisBounds::unit(3.79, 14.21);

/// The noise in the plane.
#[inline(always)]
pub(super) fn plane<T: Real>(cell: &impl Axes<2>, fraction: [T; 2]) -> Jet<T, 2> {
    let [[x0, x1], [y0, y1]] = cell.ends();
    let [u, (v, dv)] = [quintic(fraction[0]), quintic(fraction[1])];
    let row = edge(signed(mix2(x0, y0)), signed(mix2(x1, y0)), u);
    let next = edge(signed(mix2(x0, y1)), signed(mix2(x1, y1)), u);
    let [value, gx] = mix(row, next, v);
    Jet { v: value, g: [gx, (next[0] - row[0]) * dv] }
}

/// The noise in space.
#[inline(always)]
pub(super) fn space<T: Real>(cell: &impl Axes<3>, fraction: [T; 3]) -> Jet<T, 3> {
    let [[x0, x1], [y0, y1], [z0, z1]] = cell.ends();
    let [u, (v, dv), (w, dw)] = [quintic(fraction[0]), quintic(fraction[1]), quintic(fraction[2])];
    // Each layer as (value, ∂x, ∂y).
    let layer = |z: u32| {
        let row = edge(signed(mix3(x0, y0, z)), signed(mix3(x1, y0, z)), u);
        let next = edge(signed(mix3(x0, y1, z)), signed(mix3(x1, y1, z)), u);
        let [value, gx] = mix(row, next, v);
        [value, gx, (next[0] - row[0]) * dv]
    };
    let (near, far) = (layer(z0), layer(z1));
    let [value, gx, gy] = mix(near, far, w);
    Jet { v: value, g: [gx, gy, (far[0] - near[0]) * dw] }
}

/// Along an edge from `a` to `b`: the value and its derivative.
#[inline(always)]
fn edge<T: Real>(a: T, b: T, (t, dt): (T, T)) -> [T; 2] {
    [a + t * (b - a), (b - a) * dt]
}
