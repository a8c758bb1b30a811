//! From the water's own frame to the plane: what stands over each texel.
//!
//! Of x₀ + D(x₀) = x the x₀ is sought by Newton's method, over the grid: first with bilinear interpolation, which is cheap, and at
//! last with Catmull and Rom's, which is accurate; the height is taken to first order from there. Where waves fold, the
//! determinant is kept from 0, so that a step stays finite. `surface.wgsl` of the renderer does the same.

use super::GRID;

/// Steps by bilinear interpolation.
pub(super) const STEPS: usize = 3;
/// The least determinant that a step is divided by.
pub(super) const LEAST: f64 = 0.2;
/// How far a step may go, in texels.
pub(super) const FARTHEST: f64 = 8.0;

/// A function of the plane, and its slopes along x and z, per texel.
type Jet = [f64; 3];

/// Height and foam over the texel (x, z), from the grid of height and displacement. Foam is how far water is drawn together
/// there: 1 − det(1 + ∇D), from 0 to 1, which it is where waves fold.
pub(super) fn over(grid: &[[f64; 3]], texel: f64, bound: f64, x: usize, z: usize) -> [f64; 2] {
    let per = 1.0 / texel;
    let at = [x as f64, z as f64];
    let mut from = at;
    for _ in 0..STEPS {
        let [_, dx, dz] = interpolated(grid, from, linear);
        let step = newton([from[0] + dx[0] * per - at[0], from[1] + dz[0] * per - at[1]], slopes(dx, dz, per)).0;
        from = [from[0] + step[0], from[1] + step[1]];
    }
    let [h, dx, dz] = interpolated(grid, from, cubic);
    let off = [from[0] + dx[0] * per - at[0], from[1] + dz[0] * per - at[1]];
    let (step, determinant) = newton(off, slopes(dx, dz, per));
    let height = h[0] + h[1] * step[0] + h[2] * step[1];
    [height.clamp(-bound, bound), (1.0 - determinant).clamp(0.0, 1.0)]
}

/// 1 + ∇D, row by row.
fn slopes(dx: Jet, dz: Jet, per: f64) -> [f64; 4] {
    [1.0 + dx[1] * per, dx[2] * per, dz[1] * per, 1.0 + dz[2] * per]
}

/// Newton's step from where one is `off`, and the determinant.
fn newton(off: [f64; 2], [a, b, c, d]: [f64; 4]) -> ([f64; 2], f64) {
    let determinant = a * d - b * c;
    let scale = -1.0 / determinant.max(LEAST);
    let step = [scale * (d * off[0] - b * off[1]), scale * (a * off[1] - c * off[0])];
    (step.map(|step| step.clamp(-FARTHEST, FARTHEST)), determinant)
}

/// Height, D_x and D_z at a place in texels, as weights along each axis give them.
fn interpolated<const N: usize>(
    grid: &[[f64; 3]],
    at: [f64; 2],
    weights: impl Fn(f64) -> ([f64; N], [f64; N]),
) -> [Jet; 3] {
    let floor = at.map(f64::floor);
    let [(wx, sx), (wz, sz)] = [0, 1].map(|k| weights(at[k] - floor[k]));
    let first = floor.map(|floor| floor as i32 - (N as i32 / 2 - 1));
    let mask = GRID as i32 - 1;
    let mut sum = [[0.0; 3]; 3];
    for j in 0..N {
        let row = ((first[1] + j as i32) & mask) as usize * GRID;
        let mut along = [[0.0; 2]; 3];
        for i in 0..N {
            let texel = grid[row + ((first[0] + i as i32) & mask) as usize];
            for (along, value) in along.iter_mut().zip(texel) {
                along[0] += wx[i] * value;
                along[1] += sx[i] * value;
            }
        }
        for (sum, [value, slope]) in sum.iter_mut().zip(along) {
            sum[0] += wz[j] * value;
            sum[1] += wz[j] * slope;
            sum[2] += sz[j] * value;
        }
    }
    sum
}

/// Weights of two texels, and their slopes.
fn linear(t: f64) -> ([f64; 2], [f64; 2]) {
    ([1.0 - t, t], [-1.0, 1.0])
}

/// Weights of four texels (Catmull and Rom 1974), and their slopes.
fn cubic(t: f64) -> ([f64; 4], [f64; 4]) {
    let values = [
        0.5 * t * (-1.0 + t * (2.0 - t)),
        1.0 + 0.5 * t * t * (3.0 * t - 5.0),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
        0.5 * t * t * (t - 1.0),
    ];
    let slopes = [-0.5 + t * (2.0 - 1.5 * t), t * (4.5 * t - 5.0), 0.5 + t * (4.0 - 4.5 * t), t * (1.5 * t - 1.0)];
    (values, slopes)
}
