//! Settings are refused, shown and kept; work is counted exactly.

use core::sync::atomic::{AtomicU64, Ordering};

use super::{PIXEL, ray};
use crate::field::{Bound, Compiled, Dual, Field, Fractal, NoImages, Noise, Warp};
use crate::march::Surface;
use crate::methods::{Ground, HeightField, Method, MethodError, Setting, Work, picture};
use crate::place::Place;
use crate::real::Jet;
use crate::truth::{Projection, TruthCamera};

const METHODS: [(Method, &str); 5] = [
    (Method::FixedStep { a: 1.0, b: 0.004, c: 0.5, k: 6 }, "fixed step a=1 b=0.004 c=0.5 k=6"),
    (Method::Linear { delta: 0.01 }, "linear delta=0.01"),
    (Method::SphereTracing { omega: 1.6, pixel: 0.5 }, "sphere tracing omega=1.6 pixel=0.5"),
    (Method::Segment { pixel: 0.25 }, "segment pixel=0.25"),
    (Method::Bisection { pixel: 0.0 }, "bisection pixel=0"),
];

#[test]
fn names_and_files() {
    for (method, name) in METHODS {
        assert_eq!(method.to_string(), name);
        assert_eq!(ron::from_str::<Method>(&ron::to_string(&method).unwrap()).unwrap(), method);
        assert_eq!(method.check(), Ok(()));
    }
    assert!(ron::from_str::<Method>("Segment(pixel: 1.0, depth: 3)").unwrap_err().to_string().contains("depth"));
}

#[test]
fn settings_outside_their_range_are_refused() {
    let fixed = Method::FixedStep { a: 1.0, b: 0.004, c: 0.5, k: 65 };
    let MethodError::Range { setting, .. } = fixed.check().unwrap_err();
    assert_eq!(setting, "k");
    for (method, wanted) in [
        (Method::FixedStep { a: -1.0, b: 0.0, c: 0.0, k: 0 }, "a must be at least 0"),
        (Method::FixedStep { a: 1.0, b: f64::NAN, c: 0.0, k: 0 }, "b must be at least 0"),
        (Method::FixedStep { a: 1.0, b: 0.0, c: f64::INFINITY, k: 0 }, "c must be at least 0"),
        (Method::Linear { delta: 0.0 }, "delta must be above 0"),
        (Method::SphereTracing { omega: 2.0, pixel: 0.5 }, "omega must be in [1, 2)"),
        (Method::SphereTracing { omega: 1.0, pixel: 0.0 }, "pixel must be above 0"),
        (Method::Segment { pixel: -1.0 }, "pixel must be at least 0"),
        (Method::Bisection { pixel: f64::NAN }, "pixel must be at least 0"),
    ] {
        let message = method.check().unwrap_err().to_string();
        assert!(message.ends_with(wanted), "{message}");
    }
}

/// A field that counts what it is asked.
struct Counting<'a>(HeightField<'a>, AtomicU64, AtomicU64);

impl Surface for Counting<'_> {
    fn jet(&self, q: [f64; 2]) -> Jet<f64, 2> {
        self.0.jet(q)
    }

    fn bound(&self, centre: [f64; 2], half: [f64; 2]) -> Bound<2> {
        self.2.fetch_add(1, Ordering::Relaxed);
        self.0.bound(centre, half)
    }

    fn range(&self) -> (f64, f64) {
        self.0.range()
    }
}

impl Ground for Counting<'_> {
    fn height(&self, q: [f64; 2]) -> f64 {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.height(q)
    }

    fn height_f32(&self, q: [f32; 2]) -> f32 {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.height_f32(q)
    }

    fn slope(&self) -> f64 {
        self.0.slope()
    }

    fn octaves(&self) -> u64 {
        self.0.octaves()
    }

    fn bound_octaves(&self, half: [f64; 2]) -> u64 {
        self.0.bound_octaves(half)
    }
}

#[test]
fn work_is_counted_exactly() {
    let compiled: Compiled<2> = Field::from(Fractal { octaves: 7.5, ..Fractal::default() }).compile(&NoImages).unwrap();
    for (method, _) in METHODS {
        let ground = Counting(HeightField::new(&compiled, &Place::ORIGIN), AtomicU64::new(0), AtomicU64::new(0));
        let eye = [0.0, ground.jet([0.0; 2]).v + 20.0, 0.0];
        let wide = Projection::Perspective { fov: 0.8 };
        let camera = TruthCamera::looking_at(eye, [900.0, eye[1] - 40.0, 300.0], wide, [16, 9]);
        let (depth, work) = picture(&method, &ground, &camera, 5000.0, 2);
        let (heights, bounds) = (ground.1.into_inner(), ground.2.into_inner());
        assert_eq!((work.evaluations, work.bounds), (heights, bounds), "{method}");
        assert!(work.noise >= 8 * heights && work.noise <= 8 * (heights + bounds), "{method}: {work:?}");
        assert!(work.steps > 0 && depth.iter().any(Option::is_some) && depth.iter().any(Option::is_none));
        // Rows are marched in any order, and by any number of threads, with the same result.
        assert_eq!(picture(&method, &HeightField::new(&compiled, &Place::ORIGIN), &camera, 5000.0, 1), (depth, work));
    }
}

#[test]
fn octaves_are_those_of_all_branches() {
    let fractal = |octaves: f64| Field::from(Fractal { octaves, ..Fractal::default() });
    let noise = || Field::Noise(Noise::default());
    let warp = Warp { field: fractal(4.0).into(), x: noise().into(), z: fractal(2.5).into(), y: None };
    let dual = Dual { local: fractal(5.0).into(), global: Field::from(warp).into(), low: 0.0, high: 100.0 };
    let field = Field::Max(vec![dual.into(), Field::Constant(3.0), noise()]);
    let compiled: Compiled<2> = field.compile(&NoImages).unwrap();
    assert_eq!(compiled.value_octaves(), 5 + 4 + 1 + 3 + 1);
    assert_eq!(compiled.bound_octaves([1e-6; 2]), compiled.value_octaves());
    assert_eq!(compiled.bound_octaves([1e9; 2]), 0);
    let counts = [1.0, 30.0, 300.0, 3000.0].map(|half| compiled.bound_octaves([half; 2]));
    assert!(counts.is_sorted_by(|a, b| a >= b), "{counts:?}");
}

#[test]
fn odd_input_ends() {
    let compiled: Compiled<2> = Field::default().compile(&NoImages).unwrap();
    let ground = HeightField::new(&compiled, &Place::ORIGIN);
    for (method, _) in METHODS {
        for far in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
            for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1e-300, 0.0]] {
                let ray = ray([0.0, 5000.0, 0.0], direction);
                assert_eq!(method.cast(&Setting::new(&ground, far, PIXEL), &ray, &mut Work::default()), None);
            }
        }
    }
    // Steps of nothing run out.
    let stuck = Method::FixedStep { a: 0.0, b: 0.0, c: 0.0, k: 0 };
    let down = ray([0.0, 5000.0, 0.0], [0.0, -1.0, 0.0]);
    let mut work = Work::default();
    assert_eq!(stuck.cast(&Setting::new(&ground, 1e4, PIXEL), &down, &mut work), None);
    assert_eq!(work.steps, u64::from(crate::methods::MARCH_STEPS));
}
