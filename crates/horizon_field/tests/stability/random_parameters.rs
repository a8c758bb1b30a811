//! Section 4, by lot: any numbers at all are taken or refused by name, and what is taken has finite heights within its
//! bounds, soon.

use std::time::{Duration, Instant};

use horizon_field::field::arbitrary::{BASES, RULES};
use horizon_field::field::{FieldError, Fractal, NoImages};
use horizon_field::fractal::Rule;
use horizon_field::{Compiled, Field, Place};
use proptest::prelude::*;

/// What the documentation says of the numbers, in the order of their declaration.
const RANGES: [(&str, f64, f64); 7] = [
    ("wavelength", 1e-3, 1e8),
    ("amplitude", -1e6, 1e6),
    ("octaves", 0.0, 24.0),
    ("lacunarity", 1.01, 16.0),
    ("gain", 1e-3, 0.999),
    ("offset", 0.0, 16.0),
    ("rotation", -1e3, 1e3),
];

/// A height in metres that counts as none: below it numbers are subnormal, and rounding is no share of them.
const TINY: f64 = 1e-290;

/// Heights, slopes and bounds are numbers, and the former lie within the latter, wherever one asks.
pub fn assert_finite(field: &Compiled<2>, context: &str) {
    let (low, high) = field.range();
    assert!(low.is_finite() && high.is_finite() && low <= high, "{low} to {high}: {context}");
    for metres in [0.0, -1e6, 1e9, 1e15] {
        let at = field.anchor(&Place::from_metres([metres, 0.0, -metres]));
        for q in [[0.0, 0.0], [-0.3, 1e-3], [777.7, -1234.5]] {
            for cutoff in [0.0, 0.1, 1e4, f64::NAN, f64::INFINITY, -1.0] {
                let jet = field.jet_f64(&at, q, cutoff);
                assert!(jet.v >= low - TINY && jet.v <= high + TINY, "{} outside {low} to {high}: {context}", jet.v);
                assert!(jet.g.iter().all(|g| g.is_finite()), "{:?}: {context}", jet.g);
                let single = field.jet_f32(&at, q.map(|q| q as f32), cutoff as f32);
                assert!(single.v.is_finite() && single.g.iter().all(|g| g.is_finite()), "{single:?}: {context}");
            }
            let bound = field.bound(&at, q, [0.5, 2.0]);
            let height = field.value_f64(&at, q, 0.0);
            assert!(bound.low <= height + TINY && height <= bound.high + TINY, "{height} outside {bound:?}: {context}");
            // Waves shorter than an f64's last digit of the place have no bound of their own.
            assert!(bound.rest.is_finite() || field.finest_wavelength() < 1e-9, "{bound:?}: {context}");
        }
    }
}

/// A number for a parameter: mostly a good one, else one at its limits, else any at all.
fn number((_, min, max): (&'static str, f64, f64)) -> BoxedStrategy<f64> {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN_POSITIVE, 5e-324];
    let edges = vec![min, max, min.next_down(), max.next_up()];
    // Magnitudes, too, are equally likely.
    let [small, large] = [min.max(1e-3), max].map(f64::ln);
    prop_oneof![
        10 => min..=max,
        10 => (small..=large).prop_map(move |x| x.exp().clamp(min, max)),
        2 => prop::sample::select(edges),
        1 => prop::sample::select(odd.to_vec()),
        1 => prop::num::f64::ANY,
    ]
    .boxed()
}

fn fractal() -> impl Strategy<Value = Fractal> {
    let choice = (prop::sample::select(RULES.to_vec()), prop::sample::select(BASES.to_vec()), any::<u32>());
    (RANGES.map(number), choice).prop_map(|(numbers, (rule, basis, seed))| {
        let [wavelength, amplitude, octaves, lacunarity, gain, offset, rotation] = numbers;
        Fractal { rule, basis, wavelength, amplitude, octaves, lacunarity, gain, offset, rotation, seed }
    })
}

/// The numbers, in the order of their declaration.
fn numbers(f: &Fractal) -> [f64; 7] {
    [f.wavelength, f.amplitude, f.octaves, f.lacunarity, f.gain, f.offset, f.rotation]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_numbers_are_taken_or_named(fractal in fractal()) {
        let start = Instant::now();
        let text = ron::to_string(&fractal).unwrap();
        let read: Fractal = ron::from_str(&text).unwrap();
        prop_assert_eq!(numbers(&read).map(f64::is_nan), numbers(&fractal).map(f64::is_nan));
        let outside = RANGES.into_iter().zip(numbers(&fractal)).find(|((_, min, max), x)| !(min..=max).contains(&x));
        match (Field::from(read).compile::<2>(&NoImages), outside) {
            (Ok(field), None) => assert_finite(&field, &text),
            (Err(FieldError::TooHigh { .. }), None) => prop_assert!(fractal.rule != Rule::Fbm),
            (Err(FieldError::OutOfRange { path, value, .. }), Some(((name, ..), x))) => {
                prop_assert_eq!((path, value), (format!("field.Fractal.{name}"), x));
            }
            (Err(FieldError::NotFinite { path, .. }), Some(((name, ..), x))) => {
                prop_assert_eq!((path, x.is_finite()), (format!("field.Fractal.{name}"), false));
            }
            (other, outside) => prop_assert!(false, "{:?} for {:?}: {}", other.map(|_| ()), outside, text),
        }
        prop_assert!(start.elapsed() < Duration::from_secs(5), "{text} took {:?}", start.elapsed());
    }
}
