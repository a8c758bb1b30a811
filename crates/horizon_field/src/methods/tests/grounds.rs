//! Grounds whose slope is known by hand.

use crate::field::Bound;
use crate::march::Surface;
use crate::march::fixtures::{Pillars, Plane, Waves};
use crate::methods::Ground;
use crate::real::Jet;

/// Walls with a triangle as their profile, along z: one every `spacing` metres of x, on flat ground.
pub struct Ridges {
    pub height: f64,
    pub slope: f64,
    pub spacing: f64,
}

impl Ridges {
    /// How far the nearest wall's crest is, along x.
    fn offset(&self, x: f64) -> f64 {
        x - (x / self.spacing).round() * self.spacing
    }
}

impl Surface for Ridges {
    fn jet(&self, [x, _]: [f64; 2]) -> Jet<f64, 2> {
        let offset = self.offset(x);
        let v = self.height - self.slope * offset.abs();
        if v > 0.0 { Jet { v, g: [-self.slope * offset.signum(), 0.0] } } else { Jet::constant(0.0) }
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        // The crest is where the offset is least, which may be inside.
        let ends = [centre[0] - half[0], centre[0] + half[0]];
        let crest = (ends[0] / self.spacing).ceil() <= (ends[1] / self.spacing).floor();
        let [a, b] = ends.map(|x| self.jet([x, 0.0]).v);
        let high = if crest { self.height } else { a.max(b) } + 1e-9;
        let low = (self.jet([centre[0], 0.0]).v - self.slope * half[0]).max(0.0) - 1e-9;
        let slope = [[-self.slope, self.slope], [0.0; 2]];
        Bound { v: 0.5 * (low + high), g: [0.0; 2], rest: 0.5 * (high - low), low, high, slope }
    }

    fn range(&self) -> (f64, f64) {
        (0.0, self.height)
    }
}

/// Grounds of known slope; all count as one octave.
macro_rules! ground {
    ($of:ty, $slope:expr) => {
        impl Ground for $of {
            fn height(&self, q: [f64; 2]) -> f64 {
                self.jet(q).v
            }

            fn height_f32(&self, q: [f32; 2]) -> f32 {
                self.jet(q.map(f64::from)).v as f32
            }

            fn slope(&self) -> f64 {
                let slope: fn(&Self) -> f64 = $slope;
                slope(self)
            }

            fn octaves(&self) -> u64 {
                1
            }

            fn bound_octaves(&self, _: [f64; 2]) -> u64 {
                1
            }
        }
    };
}

ground!(Ridges, |ridges| ridges.slope);
ground!(Pillars, |pillars| 1.6 * pillars.height / pillars.radius);
ground!(Plane, |plane| plane.slope[0].hypot(plane.slope[1]));
ground!(Waves, |waves| waves.0.iter().map(|(a, k)| a * k).sum());
