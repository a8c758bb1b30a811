//! Surfaces whose bounds are known by hand, so that the march is tested apart from the field tree.

use super::Surface;
use crate::field::Bound;
use crate::real::Jet;

/// A plane: height plus slope times place.
pub struct Plane {
    pub height: f64,
    pub slope: [f64; 2],
}

impl Surface for Plane {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        Jet { v: self.height + self.slope[0] * q[0] + self.slope[1] * q[1], g: self.slope }
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        taylor(self.jet(centre), half, 0.0, self.slope.map(|g| [g, g]))
    }

    fn range(&self) -> (f64, f64) {
        if self.slope == [0.0; 2] { (self.height, self.height) } else { (f64::NEG_INFINITY, f64::INFINITY) }
    }
}

/// Sums of sin(kx) · sin(kz) at octaves of halved wavelength: amplitudes aᵢ and wave numbers kᵢ.
pub struct Waves(pub Vec<(f64, f64)>);

impl Waves {
    /// Twelve octaves from 2 km and 300 m on, with gain ½.
    pub fn hills() -> Self {
        Self((0..12).map(|i| 0.5f64.powi(i)).map(|s| (300.0 * s, core::f64::consts::TAU / 2000.0 / s)).collect())
    }
}

impl Surface for Waves {
    fn jet(&self, [x, z]: [f64; 2]) -> Jet<f64, 2> {
        self.0.iter().fold(Jet::constant(0.0), |sum, &(a, k)| {
            let ((sx, cx), (sz, cz)) = ((k * x).sin_cos(), (k * z).sin_cos());
            Jet { v: sum.v + a * sx * sz, g: [sum.g[0] + a * k * cx * sz, sum.g[1] + a * k * sx * cz] }
        })
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        // Each octave by its Taylor model, the Hessian's norm being at most a·k², or by its amplitude alone.
        let square = half[0] * half[0] + half[1] * half[1];
        let mut jet = Jet::constant(0.0);
        let (mut rest, mut slope) = (0.0, [[0.0; 2]; 2]);
        for &(a, k) in &self.0 {
            let taylor = 0.5 * a * k * k * square;
            if taylor < a {
                let octave = Self(vec![(a, k)]).jet(centre);
                jet.v += octave.v;
                rest += taylor;
                let swing = a * k * k * square.sqrt();
                jet.g = [jet.g[0] + octave.g[0], jet.g[1] + octave.g[1]];
                for (slope, g) in slope.iter_mut().zip(octave.g) {
                    *slope = [slope[0] + g - swing, slope[1] + g + swing];
                }
            } else {
                rest += a;
                slope = slope.map(|[low, high]| [low - a * k, high + a * k]);
            }
        }
        taylor(jet, half, rest, slope)
    }

    fn range(&self) -> (f64, f64) {
        let sum = self.0.iter().map(|(a, _)| a).sum::<f64>();
        (-sum, sum)
    }
}

/// Pillars h·(1 − r²/w²)² on flat ground, one in each square of a lattice: thinner than any step that a march in
/// proportion to the distance would take.
pub struct Pillars {
    pub height: f64,
    pub radius: f64,
    pub spacing: f64,
}

impl Pillars {
    fn nearest(&self, q: [f64; 2]) -> [f64; 2] {
        q.map(|x| (x / self.spacing).round() * self.spacing)
    }
}

impl Surface for Pillars {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        let centre = self.nearest(q);
        let d = [q[0] - centre[0], q[1] - centre[1]];
        let w2 = self.radius * self.radius;
        let inside = (1.0 - (d[0] * d[0] + d[1] * d[1]) / w2).max(0.0);
        Jet { v: self.height * inside * inside, g: d.map(|d| -4.0 * self.height * inside * d / w2) }
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        let touched = (0..2).all(|axis| {
            let (low, high) = (centre[axis] - half[axis] - self.radius, centre[axis] + half[axis] + self.radius);
            (low / self.spacing).ceil() <= (high / self.spacing).floor()
        });
        if !touched {
            return taylor(Jet::constant(0.0), half, 0.0, [[0.0; 2]; 2]);
        }
        // |∇| ≤ 1.54 h/w, the Hessian's norm ≤ 8 h/w², both rounded up.
        let (slope, curvature) = (1.6 * self.height / self.radius, 8.1 * self.height / (self.radius * self.radius));
        let radius = (half[0] * half[0] + half[1] * half[1]).sqrt();
        let rest = 0.5 * curvature * radius * radius;
        if rest < self.height {
            let jet = self.jet(centre);
            taylor(jet, half, rest, jet.g.map(|g| [g - curvature * radius, g + curvature * radius]))
        } else {
            let middle = 0.5 * self.height;
            taylor(Jet::constant(middle), half, middle, [[-slope, slope]; 2])
        }
    }

    fn range(&self) -> (f64, f64) {
        (0.0, self.height)
    }
}

fn taylor(jet: Jet<f64, 2>, half: [f64; 2], rest: f64, slope: [[f64; 2]; 2]) -> Bound<2> {
    let rest = rest + 1e-12 * (jet.v.abs() + rest);
    let reach = jet.g[0].abs() * half[0] + jet.g[1].abs() * half[1] + rest;
    Bound { v: jet.v, g: jet.g, rest, low: jet.v - reach, high: jet.v + reach, slope }
}
