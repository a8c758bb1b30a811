//! How long one height takes on the CPU, in nanoseconds, beside the `noise` crate's fBm of Perlin noise with as many
//! octaves: `cargo run -p horizon_field --example heights`.

use std::hint::black_box;
use std::time::Instant;

use horizon_field::field::arbitrary::Random;
use horizon_field::field::{Anchors, Fractal, NoImages};
use horizon_field::{Compiled, Field, Jet, Place};
use noise::{Fbm, MultiFractal, NoiseFn, Perlin};

/// Points per round.
const POINTS: usize = 4096;
/// Rounds, of which the median counts. All take turns in each of them, so that all see the same machine.
const ROUNDS: usize = 101;
/// The first octave's wavelength, in metres.
const WAVELENGTH: f64 = 6000.0;

/// What takes turns.
struct Contest {
    field: Compiled<2>,
    anchors: Anchors<2>,
    theirs: Fbm<Perlin>,
    points: Vec<[f64; 2]>,
    values: Vec<f64>,
    jets: Vec<Jet<f64, 2>>,
}

impl Contest {
    fn new(octaves: usize, points: Vec<[f64; 2]>) -> Self {
        let fractal = Fractal { octaves: octaves as f64, wavelength: WAVELENGTH, ..Fractal::default() };
        let field = Field::from(fractal).compile::<2>(&NoImages).expect("a plain fractal compiles");
        Self {
            anchors: field.anchor(&Place::ORIGIN),
            field,
            theirs: Fbm::new(1).set_octaves(octaves),
            values: vec![0.0; points.len()],
            jets: vec![Jet::constant(0.0); points.len()],
            points,
        }
    }

    /// One round of one contestant; nanoseconds per point.
    fn round(&mut self, contestant: usize) -> f64 {
        let start = Instant::now();
        match contestant {
            0 => {
                for (value, q) in self.values.iter_mut().zip(&self.points) {
                    *value = self.field.value_f64(&self.anchors, *q, 0.0);
                }
            }
            1 => {
                for (jet, q) in self.jets.iter_mut().zip(&self.points) {
                    *jet = self.field.jet_f64(&self.anchors, *q, 0.0);
                }
            }
            2 => self.field.values_f64(&self.anchors, &self.points, 0.0, &mut self.values),
            3 => self.field.jets_f64(&self.anchors, &self.points, 0.0, &mut self.jets),
            _ => {
                for (value, q) in self.values.iter_mut().zip(&self.points) {
                    *value = self.theirs.get(q.map(|x| x / WAVELENGTH));
                }
            }
        }
        black_box((&self.values, &self.jets));
        start.elapsed().as_nanos() as f64 / self.points.len() as f64
    }
}

fn main() {
    let mut random = Random::new(1);
    let scattered: Vec<_> = (0..POINTS).map(|_| [(); 2].map(|()| random.within(-5e4, 5e4))).collect();
    let path: Vec<_> = (0..POINTS).map(|i| [i as f64 * 0.7, i as f64 * 0.3]).collect();
    println!("ns per point        | value | jet   | values | jets  | noise | single | batched");
    for (name, points) in [("scattered", scattered), ("along a path", path)] {
        for octaves in [8, 10, 12] {
            let mut contest = Contest::new(octaves, points.clone());
            let mut times = [const { Vec::new() }; 5];
            for _ in 0..ROUNDS {
                for (contestant, times) in times.iter_mut().enumerate() {
                    times.push(contest.round(contestant));
                }
            }
            let [value, jet, values, jets, theirs] = times.map(|mut times| {
                times.sort_by(f64::total_cmp);
                times[ROUNDS / 2]
            });
            println!(
                "{name:12}, {octaves:2} oct | {value:5.1} | {jet:5.1} | {values:6.1} | {jets:5.1} | {theirs:5.1} | {:5.2}× | {:5.2}×",
                theirs / value,
                theirs / values
            );
        }
    }
}
