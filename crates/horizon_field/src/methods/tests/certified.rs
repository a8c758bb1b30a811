//! The certified methods miss nothing on random fields of every kind, outside silhouettes.

use super::CERTIFIED;
use crate::field::Compiled;
use crate::field::arbitrary::{Pictures, Random, every_kind, field};
use crate::march::Surface;
use crate::methods::{HeightField, Method, picture};
use crate::metrics::Report;
use crate::place::Place;
use crate::truth::{Projection, TruthCamera, TruthPicture};

const FAR: f64 = 3000.0;

/// A small picture of 80 rows' pixels: from somewhere above the ground, to somewhere.
fn look(ground: &impl Surface, random: &mut Random) -> TruthCamera {
    let at = [random.within(-2e3, 2e3), random.within(-2e3, 2e3)];
    let eye = [at[0], ground.jet(at).v + random.magnitude(2.0, 400.0), at[1]];
    let turn = random.within(0.0, core::f64::consts::TAU);
    let target = [eye[0] + turn.cos(), eye[1] - random.within(-0.3, 0.4), eye[2] + turn.sin()];
    TruthCamera::looking_at(eye, target, Projection::Perspective { fov: 0.15 }, [16, 12])
}

#[test]
fn nothing_missed_and_nothing_false() {
    let mut random = Random::new(11);
    let mut fields: Vec<_> = every_kind(3).into_iter().map(|(_, field)| field).collect();
    fields.extend((0..60).map(|_| field(&mut random, 3)));
    let (mut hits, mut misses, mut worst) = (0, 0, 0.0_f64);
    for field in fields {
        let compiled: Compiled<2> = field.compile(&Pictures).unwrap();
        let place = Place::new([random.pick(&[0, 9, 1 << 30]), 0, -3], [5.0, 0.0, 7.0]);
        let ground = HeightField::new(&compiled, &place);
        let camera = look(&ground, &mut random);
        let truth = TruthPicture::compute(&ground, camera, FAR, 1);
        for method in CERTIFIED {
            let (depth, _) = picture(&method, &ground, &camera, FAR, 1);
            let report = Report::new(&ground, &truth, &depth);
            assert_eq!((report.missed, report.false_hits), (0, 0), "{method} on {field:?}\n{report}");
            hits += report.ide.count;
            misses += report.pixels - report.silhouettes - report.ide.count;
            assert!(report.ide_pixels.mean < 0.1, "{method} on {field:?}\n{report}");
            worst = worst.max(report.ide_pixels.max);
        }
        // Sphere tracing leaps through nothing either; but it may stop early.
        let sphere = Method::SphereTracing { omega: 1.6, pixel: 0.5 };
        let (depth, _) = picture(&sphere, &ground, &camera, FAR, 1);
        let report = Report::new(&ground, &truth, &depth);
        assert_eq!(report.missed, 0, "{sphere} on {field:?}\n{report}");
    }
    assert!(hits > 3000 && misses > 3000, "{hits} hits, {misses} misses");
    // A ray that is under the ground for less than a quarter of a pixel may go on to the next crossing.
    assert!(worst < 5.0, "an error of {worst} px");
}
