//! The march over stamped ground: what a stamp puts up is not leapt through, and what it levels is hit where it is level.

use super::tests::{fixed_step, verify};
use super::{Anchored, Cast, Counts, Ray, Surface, Tolerance, cast};
use crate::field::arbitrary::Random;
use crate::field::{Compiled, Field, Fractal, NoImages};
use crate::place::Place;
use crate::stamp::{Disc, Edit, Mode, Placed, Rectangle, Shape, Stamps, arbitrary};

fn hills() -> Compiled<2> {
    let hills = Fractal { wavelength: 900.0, amplitude: 60.0, octaves: 8.0, ..Fractal::default() };
    Field::Fractal(hills).compile(&NoImages).expect("a valid field")
}

#[test]
fn no_ray_leaps_through_what_stamps_make() {
    let (field, mut random) = (hills(), Random::new(41));
    let mut answers = [0; 3];
    for place in [[0.0; 3], [1e9, 0.0, -1e9]].map(Place::from_metres) {
        for _ in 0..12 {
            let size = random.magnitude(2.0, 60.0);
            let ground = Anchored::new(&field, &place).jet([0.0; 2]).v;
            let around = place.translated([0.0, ground, 0.0]);
            let stamps: Vec<_> = (0..20).map(|_| arbitrary::stamp(&mut random, &around, 8.0 * size, size)).collect();
            let stamps = Stamps::compile(&stamps).expect("valid stamps");
            let surface = Anchored::stamped(&field, &stamps, &place);
            for _ in 0..12 {
                let q = [random.within(-9.0, 9.0) * size, random.within(-9.0, 9.0) * size];
                let up = surface.value(q) + size * random.magnitude(0.01, 3.0);
                let direction = [random.within(-1.0, 1.0), random.within(-0.6, 0.1), random.within(-1.0, 1.0)];
                answers[match verify(&surface, [q[0], up, q[1]], direction) {
                    Cast::Hit(_) => 0,
                    Cast::Miss => 1,
                    Cast::Inside => 2,
                }] += 1;
            }
        }
    }
    println!("{answers:?} hits, misses, inside");
    assert!(answers[0] > 100 && answers[2] == 0);
}

#[test]
fn a_wall_that_a_fixed_step_leaps_through() {
    let field = hills();
    let shape = Shape::Rectangle(Rectangle { size: [400.0, 0.3], corner: 0.0 });
    let edit = Edit { shape, mode: Mode::Raise(300.0), falloff: 0.2, order: 0 };
    let place = Place::from_metres([0.0, 0.0, -700.0]);
    let stamps = Stamps::compile(&[Placed { place, edit, ..Placed::default() }]).expect("a valid stamp");
    let surface = Anchored::stamped(&field, &stamps, &Place::ORIGIN);
    let mut leapt = 0;
    for i in 0..20 {
        let (origin, direction) = ([f64::from(i) * 9.0 - 90.0, 200.0, 0.0], [0.02, 0.0, -1.0]);
        let hit = verify(&surface, origin, direction).hit().expect("the wall stands in the way");
        assert!((hit.position[2] + 700.0).abs() < 0.4, "{hit:?}");
        leapt += u32::from(!fixed_step(&surface, origin, direction, 4.0, hit.t + 4.0));
    }
    assert!(leapt >= 10, "a step of 4 m was to leap through most, and leapt through {leapt}");
}

#[test]
fn level_ground_is_hit_where_it_is_level() {
    let field = hills();
    let place = Place::from_metres([1e9 + 40.0, 77.0, -1e9]);
    let edit = Edit { shape: Shape::Disc(Disc { radius: 20.0 }), falloff: 15.0, ..Edit::default() };
    let stamps = Stamps::compile(&[Placed { place, edit, ..Placed::default() }]).expect("a valid stamp");
    let surface = Anchored::stamped(&field, &stamps, &Place::from_metres([1e9, 0.0, -1e9]));
    for i in 0..40 {
        let turn = f64::from(i);
        let ray = Ray::new([40.0 + 3.0 * turn.cos(), 90.0, 3.0 * turn.sin()], [turn.cos(), -1.0, turn.sin()]).unwrap();
        let hit = surface.cast(&ray, 1e4).hit().expect("the ground is below");
        assert!((hit.position[1] - 77.0).abs() < 1e-9 && (hit.normal[1] - 1.0).abs() < 1e-12, "{hit:?}");
    }
}

#[test]
fn a_thousand_stamps_aside_cost_a_ray_nothing() {
    let (field, mut random) = (hills(), Random::new(42));
    let aside = Place::from_metres([9000.0, 0.0, 0.0]);
    let stamps: Vec<_> = (0..1000).map(|_| arbitrary::stamp(&mut random, &aside, 1500.0, 12.0)).collect();
    let stamps = Stamps::compile(&stamps).expect("valid stamps");
    let (bare, stamped) = (Anchored::new(&field, &Place::ORIGIN), Anchored::stamped(&field, &stamps, &Place::ORIGIN));
    let mut counts = [Counts::default(); 3];
    for i in 0..200 {
        let turn = f64::from(i) * 0.03;
        let ray = |toward: f64| Ray::new([0.0, 300.0, 0.0], [toward * turn.cos(), -0.06, turn.sin()]).unwrap();
        let away = ray(-turn.cos().signum());
        let [one, other] = [0, 1].map(|k| {
            let surface = [&bare, &stamped][k];
            cast(surface, &away, 8000.0, Tolerance::default(), &mut counts[k])
        });
        // They take other steps where the range of heights is another.
        assert_eq!(one.hit().is_some(), other.hit().is_some());
        if let (Some(one), Some(other)) = (one.hit(), other.hit()) {
            assert!((one.t - other.t).abs() < 1e-9, "{one:?} and {other:?}");
        }
        cast(&stamped, &ray(turn.cos().signum()), 12_000.0, Tolerance::default(), &mut counts[2]);
    }
    println!("{:?} without, {:?} with, {:?} towards them", counts[0], counts[1], counts[2]);
    // A little more, as what may be high far away lets rays begin sooner.
    assert!(counts[1].bounds <= counts[0].bounds + counts[0].bounds / 4 + 200, "{counts:?}");
}
