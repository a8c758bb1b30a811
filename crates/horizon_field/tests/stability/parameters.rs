//! Section 4: the parameters of fBm. Each bad one does something bad to the naive loop; ours refuses it by name.

use horizon_field::field::arbitrary::{BASES, RULES};
use horizon_field::field::{FieldError, Fractal, NoImages, Noise};
use horizon_field::fractal::Rule;
use horizon_field::noise::Basis;
use horizon_field::{Compiled, Field, LatticePoint, Place};

use super::statistics::largest;

/// Turns after which a loop counts as endless: a frame is long over.
const ENDLESS: f32 = 1e6;

/// The noise at a plain coordinate, in single precision.
fn noise(x: [f32; 2]) -> f32 {
    let cell = x.map(|x| x.floor() as i64);
    let fraction = x.map(|x| x - x.floor());
    Basis::Gradient.jet(&LatticePoint { cell, fraction }, 1).v
}

/// The loop of every tutorial; and the sum of the weights, for those who divide by it. `None` if it does not end.
fn naive(f: &Fractal, [x, z]: [f32; 2]) -> Option<[f32; 2]> {
    let [mut sum, mut weights, mut i] = [0.0f32; 3];
    let (mut weight, mut frequency) = (f.amplitude as f32, 1.0 / f.wavelength as f32);
    while i < f.octaves as f32 {
        sum += weight * noise([x * frequency, z * frequency]);
        weights += weight;
        weight *= f.gain as f32;
        frequency *= f.lacunarity as f32;
        i += 1.0;
        if i >= ENDLESS {
            return None;
        }
    }
    Some([sum, weights])
}

/// The harm that a number does to the naive loop.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Harm {
    /// It does not end.
    Endless,
    /// Its height is NaN or infinite.
    NoNumber,
    /// It is level, and nobody is told.
    Level,
    /// It is the first octave, times a number: there is no detail.
    NoDetail,
    /// Within a thousandth of the wavelength it rises by more than a quarter of the amplitude.
    Spikes,
    /// None that shows. The range is a matter of sense, or the loop has no such parameter.
    None,
}

impl Harm {
    fn to_naive(fractal: &Fractal) -> Self {
        let points = [[1234.5, 678.9], [-321.0, 55.5], [-321.4, 55.5], [-321.0, 55.9]];
        let first = points.map(|at| naive(&Fractal { octaves: 1.0, ..fractal.clone() }, at).unwrap()[0]);
        let heights = points.map(|at| naive(fractal, at).map(|[sum, _]| sum));
        let [Some(a), Some(b), Some(east), Some(south)] = heights else { return Self::Endless };
        if ![a, b].iter().all(|h| h.is_finite()) {
            Self::NoNumber
        } else if [a, b] == [0.0; 2] {
            Self::Level
        } else if (a / first[0] - b / first[1]).abs() < 1e-3 {
            Self::NoDetail
        } else if (east - b).abs().max((south - b).abs()) > 0.25 * fractal.amplitude as f32 {
            Self::Spikes
        } else {
            Self::None
        }
    }
}

/// What must not be, with the parameter's name, and the harm that it does.
fn bad() -> Vec<(Fractal, &'static str, Harm)> {
    let f = Fractal { wavelength: 400.0, amplitude: 100.0, rotation: 0.0, ..Fractal::default() };
    let octaves = |octaves| Fractal { octaves, ..f.clone() };
    let lacunarity = |lacunarity| Fractal { lacunarity, ..f.clone() };
    let gain = |gain| Fractal { gain, octaves: 16.0, ..f.clone() };
    let amplitude = |amplitude| Fractal { amplitude, ..f.clone() };
    let wavelength = |wavelength| Fractal { wavelength, ..f.clone() };
    let offset = |offset| Fractal { offset, ..f.clone() };
    let rotation = |rotation| Fractal { rotation, ..f.clone() };
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    vec![
        (octaves(nan), "octaves", Harm::Level),
        (octaves(inf), "octaves", Harm::Endless),
        (octaves(1e300), "octaves", Harm::Endless),
        (octaves(-3.0), "octaves", Harm::Level),
        (octaves(-inf), "octaves", Harm::Level),
        (octaves(24.5), "octaves", Harm::None),
        (lacunarity(nan), "lacunarity", Harm::NoNumber),
        (lacunarity(inf), "lacunarity", Harm::NoNumber),
        (lacunarity(1e30), "lacunarity", Harm::NoNumber),
        (lacunarity(16.5), "lacunarity", Harm::None),
        (lacunarity(1.0), "lacunarity", Harm::NoDetail),
        (lacunarity(0.0), "lacunarity", Harm::NoDetail),
        (lacunarity(-2.0), "lacunarity", Harm::None),
        (gain(nan), "gain", Harm::NoNumber),
        (gain(inf), "gain", Harm::NoNumber),
        (gain(1e5), "gain", Harm::NoNumber),
        (gain(1.5), "gain", Harm::Spikes),
        (gain(1.0), "gain", Harm::Spikes),
        (gain(0.0), "gain", Harm::NoDetail),
        (gain(-0.5), "gain", Harm::None),
        (amplitude(nan), "amplitude", Harm::NoNumber),
        (amplitude(-inf), "amplitude", Harm::NoNumber),
        (amplitude(1e39), "amplitude", Harm::NoNumber),
        (wavelength(0.0), "wavelength", Harm::NoNumber),
        (wavelength(nan), "wavelength", Harm::NoNumber),
        (wavelength(1e-40), "wavelength", Harm::NoNumber),
        (wavelength(inf), "wavelength", Harm::Level),
        (wavelength(-400.0), "wavelength", Harm::None),
        (offset(-1.0), "offset", Harm::None),
        (offset(nan), "offset", Harm::None),
        (rotation(nan), "rotation", Harm::None),
        (rotation(inf), "rotation", Harm::None),
    ]
}

/// The error of a field, from Rust and from a file alike.
fn refusal(field: &Field) -> FieldError {
    let error = field.compile::<2>(&NoImages).expect_err("it must be refused");
    let text = ron::to_string(field).unwrap();
    let read: Field = ron::from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    // By text: NaN is not equal to itself.
    assert_eq!(read.compile::<2>(&NoImages).unwrap_err().to_string(), error.to_string(), "{text}");
    assert_eq!(read.compile::<3>(&NoImages).unwrap_err().to_string(), error.to_string(), "{text}");
    error
}

#[test]
fn bad_numbers_are_refused_by_name() {
    for (fractal, name, expected) in bad() {
        assert_eq!(Harm::to_naive(&fractal), expected, "{fractal:?}");
        for rule in RULES {
            let error = refusal(&Fractal { rule, ..fractal.clone() }.into());
            let expected = format!("field.Fractal.{name}");
            let (FieldError::NotFinite { path, value } | FieldError::OutOfRange { path, value, .. }) = &error else {
                panic!("{error}");
            };
            assert_eq!((path, matches!(error, FieldError::OutOfRange { .. })), (&expected, value.is_finite()));
            assert!(error.to_string().contains(&format!("{expected} is {value}")), "{error}");
        }
        let noise = Noise { wavelength: fractal.wavelength, amplitude: fractal.amplitude, ..Noise::default() };
        if ["wavelength", "amplitude"].contains(&name) {
            assert!(refusal(&noise.into()).to_string().starts_with(&format!("field.Noise.{name} is ")));
        }
    }
}

#[test]
fn an_offset_below_0_divides_by_0() {
    // Musgrave's heterogeneous terrain over its mean, a product of 1 + w o: 0 for o = −1.
    let step = |offset: f64| {
        let state = Rule::Heterogeneous.start::<f64>(offset);
        Rule::Heterogeneous.step(state, 0.3, 1.0, offset, 1.0).result
    };
    assert!(!step(-1.0).is_finite());
    // From 0 on, the divisor is at least 1.
    assert!([0.0, 1.0, 16.0].into_iter().all(|offset| (step(offset) - offset - 0.3).abs() < 1e-12));
}

#[test]
fn words_that_are_no_numbers_are_refused_where_they_stand() {
    for (text, parts) in [
        ("Fractal((seed: -1))", ["1:17", "Integer"]),
        ("Fractal((seed: 4294967296))", ["1:16", "Integer"]),
        ("Fractal((octaves: many))", ["1:19", ""]),
        ("Fractal((gain: ))", ["1:16", ""]),
        ("Fractal((lacunarity: 2.0, lacunarity: 3.0))", ["1:", "lacunarity"]),
    ] {
        let error = ron::from_str::<Field>(text).expect_err(text).to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{text}: {error}");
    }
}

#[test]
fn no_octaves_and_no_amplitude_are_level() {
    let f = Fractal { wavelength: 400.0, amplitude: 100.0, ..Fractal::default() };
    for fractal in [Fractal { octaves: 0.0, ..f.clone() }, Fractal { amplitude: 0.0, ..f.clone() }] {
        // Who brings the sum into [−1, 1] divides by the sum of the weights: 0/0.
        let [sum, weights] = naive(&fractal, [1234.5, 678.9]).unwrap();
        assert!((sum / weights).is_nan(), "the naive way must have no number");
        let level: Compiled<2> = Field::from(fractal.clone()).compile(&NoImages).unwrap();
        let jet = level.jet_f32(&level.anchor(&Place::ORIGIN), [1234.5, 678.9], 0.0);
        assert_eq!((jet.v, jet.g), (0.0, [0.0; 2]));
        // The multifractals are as level, at a height of their own.
        for rule in RULES {
            let field = Field::from(Fractal { rule, ..fractal.clone() }).compile::<2>(&NoImages).unwrap();
            let at = field.anchor(&Place::ORIGIN);
            let heights = (0..100).map(|i| field.value_f64(&at, [f64::from(i) * 77.0, 3.0], 0.0));
            let first = field.value_f64(&at, [0.0, 3.0], 0.0);
            assert!(largest(heights.map(|h| h - first)) == 0.0 && first.is_finite(), "{rule:?}");
        }
    }
}

#[test]
fn fractional_octaves_come_in_gradually() {
    // A slider from 3 to 8 octaves in steps of a hundredth. The naive way has whole octaves.
    for rule in RULES {
        let height = |octaves: f64, q: [f64; 2]| {
            let fractal = Fractal { rule, wavelength: 400.0, amplitude: 100.0, octaves, ..Fractal::default() };
            let field = Field::from(fractal).compile::<2>(&NoImages).unwrap();
            field.value_f64(&field.anchor(&Place::ORIGIN), q, 0.0)
        };
        let [mut naive, mut ours] = [0.0f64; 2];
        for q in [[10.0, 20.0], [333.0, -70.0], [-1234.5, 678.9]] {
            let steps = |f: &dyn Fn(f64) -> f64| {
                largest((300..800).map(|i| f(f64::from(i + 1) / 100.0) - f(f64::from(i) / 100.0)))
            };
            naive = naive.max(steps(&|octaves| height(octaves.floor(), q)));
            ours = ours.max(steps(&|octaves| height(octaves, q)));
        }
        println!("{rule:?}: steps of {naive:.2} m and {ours:.3} m");
        assert!(naive > 1.0, "{rule:?}: whole octaves must pop: {naive}");
        // A hundredth of an octave each; a multifractal's later octaves weigh on it, too.
        assert!(ours < 0.02 * naive, "{rule:?}: {ours}");
    }
}

#[test]
fn limits_themselves_are_numbers() {
    let (mut taken, mut high) = (0, 0);
    for corner in 0..1 << 6 {
        let pick = |bit: u32, ends: [f64; 2]| ends[(corner >> bit & 1) as usize];
        for (rule, basis) in RULES.into_iter().flat_map(|rule| BASES.map(|basis| (rule, basis))) {
            let fractal = Fractal {
                rule,
                basis,
                wavelength: pick(0, [1e-3, 1e8]),
                amplitude: pick(1, [-1e6, 1e6]),
                octaves: pick(2, [0.0, 24.0]),
                lacunarity: pick(3, [1.01, 16.0]),
                gain: pick(4, [1e-3, 0.999]),
                offset: pick(5, [0.0, 16.0]),
                ..Fractal::default()
            };
            match Field::from(fractal.clone()).compile::<2>(&NoImages) {
                Ok(field) => {
                    taken += 1;
                    super::random_parameters::assert_finite(&field, &format!("{fractal:?}"));
                }
                Err(FieldError::TooHigh { .. }) if rule != Rule::Fbm => high += 1,
                Err(error) => panic!("{error}: {fractal:?}"),
            }
        }
    }
    assert!(taken > 500 && high > 0, "{taken} taken, {high} too high");
}
