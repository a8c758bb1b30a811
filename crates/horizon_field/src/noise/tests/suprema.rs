//! The bounds of value, gradient and simplex noise, found again from their definition.
//!
//! Each of them is n(x) = Σ_j h_j c_j(x) with independent h_j in [−1, 1]. So sup |n| = sup Σ|c_j|, the steepest slope is
//! the sup over places and unit vectors e of Σ|e·∇c_j|, and the largest curvature that of Σ|eᵀ∇²c_j e|. All three are
//! maxima over sign patterns of smooth functions. At a maximum their gradient along the cell vanishes, so a grid that
//! includes the cell's faces misses it by second order only, which is what the bounds' margin is for. For the
//! value itself the second order is known: half the curvature times the square of the distance to the grid.

use super::super::{Basis, simplex};

/// A function with its gradient and Hessian at one place: enough calculus to differentiate a product twice.
#[derive(Clone, Copy)]
struct Second<const D: usize> {
    v: f64,
    g: [f64; D],
    h: [[f64; D]; D],
}

impl<const D: usize> Second<D> {
    fn constant(v: f64) -> Self {
        Self { v, g: [0.0; D], h: [[0.0; D]; D] }
    }

    fn coordinate(v: f64, axis: usize) -> Self {
        let mut x = Self::constant(v);
        x.g[axis] = 1.0;
        x
    }

    fn plus(self, other: Self, times: f64) -> Self {
        Self {
            v: self.v + times * other.v,
            g: core::array::from_fn(|i| self.g[i] + times * other.g[i]),
            h: core::array::from_fn(|i| core::array::from_fn(|j| self.h[i][j] + times * other.h[i][j])),
        }
    }

    fn times(self, o: Self) -> Self {
        Self {
            v: self.v * o.v,
            g: core::array::from_fn(|i| self.v * o.g[i] + o.v * self.g[i]),
            h: core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    self.v * o.h[i][j] + self.g[i] * o.g[j] + o.g[i] * self.g[j] + o.v * self.h[i][j]
                })
            }),
        }
    }

    fn quintic(self) -> Self {
        let c = Self::constant;
        let inner = self.times(c(6.0)).plus(c(15.0), -1.0).times(self).plus(c(10.0), 1.0);
        self.times(self).times(self).times(inner)
    }
}

/// The c_j of value noise (one for each corner) and of gradient noise (D for each corner).
fn cubic<const D: usize>(basis: Basis, x: [f64; D]) -> Vec<Second<D>> {
    let mut all = Vec::new();
    for corner in 0..1_usize << D {
        let mut weight = Second::constant(1.0);
        let mut d = [Second::constant(0.0); D];
        for k in 0..D {
            let t = Second::coordinate(x[k], k);
            let high = (corner >> k) & 1 == 1;
            let s = t.quintic();
            weight = weight.times(if high { s } else { Second::constant(1.0).plus(s, -1.0) });
            d[k] = t.plus(Second::constant(if high { 1.0 } else { 0.0 }), -1.0);
        }
        match basis {
            Basis::Value => all.push(weight),
            _ => all.extend(d.map(|d| d.times(weight).times(Second::constant(if D == 3 { 2.0 / 3.0 } else { 1.0 })))),
        }
    }
    all
}

/// The c_j of simplex noise, D for each corner, at an unskewed place of the simplex whose path takes the axes in order.
fn simplices<const D: usize>(x: [f64; D]) -> Vec<Second<D>> {
    let (unskew, scale) = if D == 2 {
        (simplex::PLANE_UNSKEW, simplex::PLANE_SCALE)
    } else {
        (simplex::SPACE_UNSKEW, simplex::SPACE_SCALE)
    };
    let mut all = Vec::new();
    for corner in 0..=D {
        let d: [Second<D>; D] = core::array::from_fn(|k| {
            let at = if k < corner { 1.0 } else { 0.0 } - unskew * corner as f64;
            Second::coordinate(x[k] - at, k)
        });
        let mut k = Second::constant(0.5);
        for d in d {
            k = k.plus(d.times(d), -1.0);
        }
        if k.v > 0.0 {
            let k2 = k.times(k);
            all.extend(d.map(|d| d.times(k2).times(k2).times(Second::constant(scale))));
        }
    }
    all
}

/// Unit vectors over half of the circle or the sphere, some 180/n degrees apart.
fn directions<const D: usize>(n: usize) -> Vec<[f64; D]> {
    let angle = |i: usize| core::f64::consts::PI * i as f64 / n as f64;
    if D == 2 {
        return (0..n)
            .map(|i| core::array::from_fn(|k| if k == 0 { angle(i).cos() } else { angle(i).sin() }))
            .collect();
    }
    let mut all = Vec::new();
    for i in 0..=n / 2 {
        let (sin, cos) = angle(i).sin_cos();
        for j in 0..2 * n {
            let (s, c) = angle(j).sin_cos();
            all.push(core::array::from_fn(|k| [sin * c, sin * s, cos][k]));
        }
    }
    all
}

/// The three suprema at one place.
fn at_place<const D: usize>(c: &[Second<D>], directions: &[[f64; D]]) -> [f64; 3] {
    let value = c.iter().map(|c| c.v.abs()).sum();
    let (mut slope, mut curvature) = (0.0_f64, 0.0_f64);
    for e in directions {
        let (mut first, mut second) = (0.0, 0.0);
        for c in c {
            let (mut along, mut bend) = (0.0, 0.0);
            for i in 0..D {
                along += e[i] * c.g[i];
                for j in 0..D {
                    bend += e[i] * e[j] * c.h[i][j];
                }
            }
            first += along.abs();
            second += bend.abs();
        }
        slope = slope.max(first);
        curvature = curvature.max(second);
    }
    [value, slope, curvature]
}

/// The suprema over a basis' cell. By the symmetry of its axes, and of a cell's halves, an ordered part is enough.
fn suprema<const D: usize>(basis: Basis, n: usize, angles: usize) -> [f64; 3] {
    let directions = directions::<D>(angles);
    let mut most = [0.0_f64; 3];
    let total = (n + 1).pow(D as u32);
    for index in 0..total {
        let steps: [usize; D] = core::array::from_fn(|k| index / (n + 1).pow(k as u32) % (n + 1));
        if !steps.is_sorted_by(|a, b| a >= b) {
            continue;
        }
        let x = steps.map(|i| i as f64 / n as f64);
        let c = if basis == Basis::Simplex {
            let unskew = if D == 2 { simplex::PLANE_UNSKEW } else { simplex::SPACE_UNSKEW };
            let t = x.iter().sum::<f64>() * unskew;
            simplices(x.map(|x| x - t))
        } else {
            cubic(basis, x.map(|x| x * 0.5))
        };
        let here = at_place(&c, &directions);
        for (most, here) in most.iter_mut().zip(here) {
            *most = most.max(here);
        }
    }
    most
}

#[track_caller]
fn found<const D: usize>(basis: Basis, n: usize, angles: usize) {
    let bounds = basis.bounds::<D>();
    let [value, slope, curvature] = suprema::<D>(basis, n, angles);
    // The others have their maximum, which is exact, on the grid.
    let distance = (D as f64).sqrt() * 0.5 / n as f64;
    let missed = if basis == Basis::Simplex { 0.5 * bounds.curvature * distance * distance } else { 0.0 };
    assert!(value + missed < bounds.high + 1e-12 && value > 0.98, "value {value} + {missed}");
    for (found, bound) in [(slope, bounds.slope), (curvature, bounds.curvature)] {
        assert!(found * 1.008 < bound && bound < found * 1.02, "found {found}, bound {bound}");
    }
}

#[test]
fn bounds_of_value() {
    found::<2>(Basis::Value, 100, 90);
    found::<3>(Basis::Value, 20, 36);
}

#[test]
fn bounds_of_gradient() {
    found::<2>(Basis::Gradient, 100, 90);
    found::<3>(Basis::Gradient, 20, 36);
}

#[test]
fn bounds_of_simplex() {
    found::<2>(Basis::Simplex, 100, 90);
    found::<3>(Basis::Simplex, 48, 24);
}
