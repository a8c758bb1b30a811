//! The march over the field tree: its bounds, and the places where a plain march fails.

use super::tests::{fixed_step, verify};
use super::{Anchored, Cast, Surface};
use crate::field::{Clamp, Compiled, Field, Fractal, NoImages, Noise, Remap};
use crate::fractal::Rule;
use crate::noise::Basis;
use crate::place::Place;

const PLACES: [[f64; 3]; 3] = [[0.0; 3], [1e6, 0.0, -1e6], [-1e9, 0.0, 1e9]];

fn compiled(field: &Field) -> Compiled<2> {
    field.compile(&NoImages).expect("a valid field")
}

/// Rays of every kind around a place: level, down, along lattice lines, grazing; hits and misses among them.
fn sweep(surface: &impl Surface) -> [usize; 3] {
    let mut answers = [0; 3];
    for i in 0..40u32 {
        let turn = f64::from(i) * 2.399_963;
        let ground = surface.jet([0.0, 0.0]).v;
        let height = ground + [1.7, 20.0, 150.0, 800.0][i as usize % 4];
        let fall = [0.0, -0.02, 0.03, -0.3, -1.0][i as usize % 5];
        let direction = match i % 10 {
            0 => [1.0, 0.0, 0.0],
            5 => [0.0, fall, -1.0],
            9 => [0.0, -1.0, 0.0],
            _ => [turn.cos(), fall, turn.sin()],
        };
        match verify(surface, [0.0, height, 0.0], direction) {
            Cast::Hit(_) => answers[0] += 1,
            Cast::Miss => answers[1] += 1,
            Cast::Inside => answers[2] += 1,
        }
    }
    answers
}

#[test]
fn every_rule_and_basis_here_and_far_away() {
    for rule in [Rule::Fbm, Rule::Heterogeneous, Rule::Hybrid, Rule::Ridged] {
        for basis in [Basis::Value, Basis::Gradient, Basis::Simplex, Basis::Worley] {
            let field = compiled(&Field::Fractal(Fractal { rule, basis, octaves: 7.5, ..Fractal::default() }));
            for place in PLACES {
                let surface = Anchored::new(&field, &Place::from_metres(place));
                let [hits, _, inside] = sweep(&surface);
                assert!(hits >= 8 && inside == 0, "{rule:?} of {basis:?} at {place:?}: {hits} hits, {inside} inside");
            }
        }
    }
}

#[test]
fn fourteen_octaves() {
    let field = compiled(&Field::Fractal(Fractal { octaves: 14.0, ..Fractal::default() }));
    for place in PLACES {
        sweep(&Anchored::new(&field, &Place::from_metres(place)));
    }
}

#[test]
fn needles_that_a_fixed_step_leaps_through() {
    // The peaks of a noise, stretched to 60 m: needles a metre thick, some twenty metres apart.
    let peaks = Field::Noise(Noise { wavelength: 12.0, amplitude: 1.0, ..Noise::default() });
    let stretched = Field::Remap(Remap { field: peaks.into(), from: [0.45, 0.6], to: [0.0, 60.0] });
    let needles = compiled(&Field::Clamp(Clamp { field: stretched.into(), low: 0.0, high: 60.0 }));
    let surface = Anchored::new(&needles, &Place::from_metres([3e5, 0.0, 7e5]));
    let (mut hits, mut leapt) = (0, 0);
    for i in 0..60 {
        let turn = f64::from(i) * 0.1;
        let (origin, direction) = ([0.0, 50.0, 0.0], [turn.cos(), -0.005, turn.sin()]);
        if let Cast::Hit(hit) = verify(&surface, origin, direction) {
            hits += 1;
            // Would samples 4 m apart have seen this needle?
            let seen = fixed_step(&surface, origin, direction, 4.0, hit.t + 4.0);
            leapt += u32::from(!seen);
        }
    }
    assert!(hits >= 50 && leapt >= hits / 4, "{hits} hits, {leapt} of them leapt over");
}
