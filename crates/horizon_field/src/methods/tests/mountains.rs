//! Every method on alpine ground, seen from a valley.

use std::time::Instant;

use crate::field::{Compiled, Field, Fractal, NoImages};
use crate::march::Surface;
use crate::methods::{HeightField, Method, Work, picture};
use crate::metrics::Report;
use crate::place::Place;
use crate::truth::{Projection, TruthCamera, TruthPicture};

const FAR: f64 = 30_000.0;

const METHODS: [Method; 10] = [
    Method::FixedStep { a: 1.0, b: 0.004, c: 0.5, k: 6 },
    Method::FixedStep { a: 10.0, b: 0.01, c: 0.5, k: 6 },
    Method::Linear { delta: 0.01 },
    Method::SphereTracing { omega: 1.0, pixel: 0.5 },
    Method::SphereTracing { omega: 1.6, pixel: 0.5 },
    Method::SphereTracing { omega: 1.6, pixel: 0.05 },
    Method::Segment { pixel: 0.25 },
    Method::Segment { pixel: 0.0 },
    Method::Bisection { pixel: 0.25 },
    Method::Bisection { pixel: 0.0 },
];

/// What each method costs and gets, in a picture of this size and vertical field of view.
fn reports(size: [usize; 2], fov: f64) -> Vec<(Method, Work, Report)> {
    let mountains =
        Fractal { wavelength: 6000.0, amplitude: 1500.0, octaves: 13.0, gain: 0.47, seed: 5, ..Fractal::default() };
    let compiled: Compiled<2> = Field::from(mountains).compile(&NoImages).unwrap();
    let ground = HeightField::new(&compiled, &Place::ORIGIN);
    let eye = [120.0, ground.jet([120.0, 40.0]).v + 1.7, 40.0];
    let camera = TruthCamera::looking_at(eye, [120.0, eye[1], -960.0], Projection::Perspective { fov }, size);
    let truth = TruthPicture::compute(&ground, camera, FAR, 2);
    let rays = truth.pixels.len() as f64;
    let report = |method: Method| {
        let start = Instant::now();
        let (depth, work) = picture(&method, &ground, &camera, FAR, 2);
        let time = start.elapsed().as_secs_f64();
        let report = Report::new(&ground, &truth, &depth);
        let [evaluations, noise, bounds, steps] =
            [work.evaluations, work.noise, work.bounds, work.steps].map(|count| count as f64 / rays);
        let Report { missed, false_hits, stray, ide_pixels, surface, .. } = report;
        println!(
            "{:38} {evaluations:7.1} heights {noise:7.0} octaves {bounds:6.1} bounds {steps:6.1} steps  {missed:4} missed \
             {false_hits:4} false {stray:4} stray  IDE {:8.4} px, p99 {:8.3}  surface {:7.4} px  {:6.0} ms",
            method.to_string(),
            ide_pixels.mean,
            ide_pixels.p99,
            surface.mean,
            1e3 * time,
        );
        (method, work, report)
    };
    println!("{size:?}, {fov} rad: silhouettes {:.1} %", 100.0 * truth.silhouette_share());
    METHODS.map(report).into()
}

#[test]
fn certified_methods_hold_on_mountains() {
    let reports = reports([48, 27], core::f64::consts::FRAC_PI_3);
    let noise = |wanted: Method| reports.iter().find(|(method, ..)| *method == wanted).map(|(_, work, _)| work.noise);
    for (method, _, report) in &reports {
        assert_eq!(report.missed, 0, "{method}\n{report}");
        if matches!(method, Method::Segment { .. } | Method::Bisection { .. }) {
            assert_eq!((report.false_hits, report.stray), (0, 0), "{method}\n{report}");
            assert!(report.ide_pixels.mean < 0.1, "{method}\n{report}");
        }
    }
    // What the certified methods save: steps of a hundredth of the distance cost more than ten times as much.
    let [segment, linear] =
        [Method::Segment { pixel: 0.25 }, Method::Linear { delta: 0.01 }].map(|m| noise(m).unwrap());
    assert!(10 * segment < linear, "{segment} and {linear} octaves");
}
