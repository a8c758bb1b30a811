//! A value is the same, bit for bit, however it is asked for: alone, with its gradient, or among many.

use crate::field::arbitrary::{Pictures, Random, every_kind, field};
use crate::field::{Compiled, Field, Fractal, NoImages};
use crate::place::Place;
use crate::real::Jet;

/// Places near and far, and where the low words of lattice coordinates wrap, at about 2³¹ and 2³² cells.
fn places() -> impl Iterator<Item = Place> {
    [0.0, -3e5, 1e9, -7.5e11, 2_147_483_648.0 * 1000.0, -4_294_967_296.0 * 1000.0]
        .into_iter()
        .map(|metres| Place::from_metres([metres, 40.0, 0.5 * metres]))
}

/// Reaches, in metres: the last is too far for low words to tell the cells.
const REACHES: [f64; 4] = [30.0, 5000.0, 1e7, 1e14];

/// Bits; all that is no number is one.
fn bits(x: f64) -> u64 {
    if x.is_nan() { u64::MAX } else { x.to_bits() }
}

fn jet_bits<const D: usize>(jet: Jet<f64, D>) -> (u64, [u64; D]) {
    (bits(jet.v), jet.g.map(bits))
}

/// Asks in every way, and compares with the jets of one point at a time.
fn agree<const D: usize>(field: &Compiled<D>, place: &Place, q: &[[f64; D]], cutoff: f64) -> Result<(), String> {
    let at = field.anchor(place);
    let (mut values, mut jets) = (vec![f64::NAN; q.len()], vec![Jet::constant(f64::NAN); q.len()]);
    field.values_f64(&at, q, cutoff, &mut values);
    field.jets_f64(&at, q, cutoff, &mut jets);
    for ((q, value), jet) in q.iter().zip(values).zip(jets) {
        let expected = field.jet_f64(&at, *q, cutoff);
        let single = field.value_f64(&at, *q, cutoff);
        let generic = field.value(&at, *q, cutoff);
        if [single, generic, value].map(bits) != [bits(expected.v); 3] || jet_bits(jet) != jet_bits(expected) {
            return Err(format!("{expected:?}: alone {single} and {generic}, of many {value} and {jet:?}, at {q:?}"));
        }
        let q = q.map(|q| q as f32);
        let [jet, value] = [field.jet_f32(&at, q, cutoff as f32).v, field.value_f32(&at, q, cutoff as f32)];
        if jet.to_bits() != value.to_bits() && !jet.is_nan() {
            return Err(format!("{jet} and {value} in single precision, at {q:?}"));
        }
    }
    Ok(())
}

fn agree_everywhere<const D: usize>(field: &Field, random: &mut Random) {
    let compiled = field.compile::<D>(&Pictures).unwrap();
    for place in places() {
        for reach in REACHES {
            let q: Vec<[f64; D]> = (0..37).map(|_| core::array::from_fn(|_| random.within(-reach, reach))).collect();
            let cutoff = random.pick(&[0.0, 0.0, 30.0, 700.0, 1e5]);
            if let Err(error) = agree(&compiled, &place, &q, cutoff) {
                panic!("{error}, place {place:?}, cut-off {cutoff}\n{field:?}");
            }
        }
    }
}

#[test]
fn every_kind_of_node_answers_alike() {
    let mut random = Random::new(1);
    for seed in 0..3 {
        for (_, field) in every_kind(seed) {
            agree_everywhere::<2>(&field, &mut random);
            agree_everywhere::<3>(&field, &mut random);
        }
    }
}

#[test]
fn random_trees_answer_alike() {
    let mut random = Random::new(2);
    for _ in 0..120 {
        let field = field(&mut random, 4);
        agree_everywhere::<2>(&field, &mut random);
        agree_everywhere::<3>(&field, &mut random);
    }
}

/// Every number of octaves fills the lanes in another way, and so does every cut-off.
#[test]
fn any_number_of_octaves_answers_alike() {
    let mut random = Random::new(3);
    for octaves in 0..=20 {
        let fractal = Fractal { octaves: f64::from(octaves) - 0.25, seed: octaves, ..Fractal::default() };
        let field = Field::from(Fractal { octaves: fractal.octaves.max(0.0), ..fractal });
        agree_everywhere::<2>(&field, &mut random);
        let compiled = field.compile::<2>(&NoImages).unwrap();
        for step in 0..40 {
            agree(&compiled, &Place::ORIGIN, &[[3.0, 4.0]], 1.4_f64.powi(step) * 0.01).unwrap();
        }
    }
}

/// Every number of points fills the lanes in another way, and none takes a neighbour's answer.
#[test]
fn any_number_of_points_is_answered_in_order() {
    let field = Field::default().compile::<2>(&NoImages).unwrap();
    for count in (0..70).chain([1000]) {
        let q: Vec<_> = (0..count).map(|i| [f64::from(i) * 31.0, f64::from(i) * -17.0]).collect();
        agree(&field, &Place::ORIGIN, &q, 0.0).unwrap();
    }
}

#[test]
#[should_panic(expected = "as many answers as points")]
fn an_answer_too_few_is_refused() {
    let field = Field::default().compile::<2>(&NoImages).unwrap();
    field.values_f64(&field.anchor(&Place::ORIGIN), &[[0.0; 2]; 3], 0.0, &mut [0.0; 2]);
}

/// Points that are no places neither panic nor spoil what shares the lanes with them.
#[test]
fn what_is_no_place_spoils_no_neighbour() {
    for (name, field) in every_kind(9) {
        let compiled = field.compile::<3>(&Pictures).unwrap();
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -1e300] {
            let mut q = vec![[1.0, 2.0, 3.0]; 20];
            q[7][1] = bad;
            q[13] = [bad; 3];
            agree(&compiled, &Place::ORIGIN, &q, 0.0).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
}
