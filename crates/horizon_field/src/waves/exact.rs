//! The truth: the sum of all waves itself, in double precision, with no grid between.

use core::f64::consts::TAU;

use super::{Cascade, PERIOD, Sea};

/// A point of the surface over a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exact {
    /// The height, in metres.
    pub height: f64,
    /// The slopes along x and z.
    pub slope: [f64; 2],
    /// The least determinant of 1 + ∇D that a tile has there: where it is below 0, waves fold, and there are several heights.
    pub determinant: f64,
}

/// The water that rests at a place: height and displacement, and their slopes.
struct Parcel {
    h: f64,
    slope: [f64; 2],
    d: [f64; 2],
    /// ∇D: along x, across, along z.
    gradient: [f64; 3],
}

impl Cascade {
    fn parcel(&self, at: [f64; 2], time: f64) -> Parcel {
        let mut sum = Parcel { h: 0.0, slope: [0.0; 2], d: [0.0; 2], gradient: [0.0; 3] };
        for wave in &self.waves {
            let n = wave.n.map(f64::from);
            let turns = (n[0] * at[0] + n[1] * at[1]) / self.side - f64::from(wave.beats) * time / PERIOD;
            let phase = TAU * (turns - turns.floor()) + wave.phase;
            let (a, c) = (wave.amplitude, self.choppiness);
            let (sine, cosine) = (a * libm::sin(phase), a * libm::cos(phase));
            let unit = n.map(|n| n / wave.length());
            let k = n.map(|n| TAU * n / self.side);
            sum.h += cosine;
            for axis in 0..2 {
                sum.slope[axis] -= k[axis] * sine;
                sum.d[axis] -= c * unit[axis] * sine;
            }
            sum.gradient[0] -= c * unit[0] * k[0] * cosine;
            sum.gradient[1] -= c * unit[0] * k[1] * cosine;
            sum.gradient[2] -= c * unit[1] * k[1] * cosine;
        }
        sum
    }

    /// Newton's method until nothing changes, each step halved until it helps.
    fn exact(&self, place: [f64; 2], time: f64) -> Exact {
        let place = place.map(|x| x.rem_euclid(self.side));
        let off = |at: [f64; 2], parcel: &Parcel| [0, 1].map(|k| at[k] + parcel.d[k] - place[k]);
        let size = |off: [f64; 2]| off[0] * off[0] + off[1] * off[1];
        let mut at = place;
        let mut parcel = self.parcel(at, time);
        for _ in 0..200 {
            let [a, b, d] = [1.0 + parcel.gradient[0], parcel.gradient[1], 1.0 + parcel.gradient[2]];
            let r = off(at, &parcel);
            if size(r) <= 1e-26 * self.side * self.side {
                break;
            }
            let scale = 1.0 / (a * d - b * b).max(1e-3);
            let step = [scale * (d * r[0] - b * r[1]), scale * (a * r[1] - b * r[0])];
            let shorter = core::iter::successors(Some(1.0), |share| Some(0.5 * share)).take(40);
            let found = shorter.map(|share| [at[0] - share * step[0], at[1] - share * step[1]]).find_map(|to| {
                let there = self.parcel(to, time);
                (size(off(to, &there)) < size(r)).then_some((to, there))
            });
            let Some((to, there)) = found else { break };
            (at, parcel) = (to, there);
        }
        let [a, b, d] = [1.0 + parcel.gradient[0], parcel.gradient[1], 1.0 + parcel.gradient[2]];
        let determinant = a * d - b * b;
        let [x, z] = parcel.slope;
        Exact { height: parcel.h, slope: [(d * x - b * z) / determinant, (a * z - b * x) / determinant], determinant }
    }
}

impl Sea {
    /// The surface over a place (x, z), in metres, at a time in seconds: what [`Sea::tiles`] approximates. Slow, for tests and
    /// measurements. Where waves fold, one of several points.
    pub fn exact(&self, place: [f64; 2], time: f64) -> Exact {
        let time = time.rem_euclid(PERIOD);
        let start = Exact { determinant: 1.0, ..Exact::default() };
        self.cascades.iter().map(|cascade| cascade.exact(place, time)).fold(start, |sum, one| Exact {
            height: sum.height + one.height,
            slope: [sum.slope[0] + one.slope[0], sum.slope[1] + one.slope[1]],
            determinant: sum.determinant.min(one.determinant),
        })
    }

    /// The height of [`Sea::exact`].
    pub fn height_exact(&self, place: [f64; 2], time: f64) -> f64 {
        self.exact(place, time).height
    }
}
