//! Rays through holes: against a march by brute force; what is seen through a hole, from above and from below.

use super::{Anchored, Cast, Counts, Ray, Surface, Tolerance, cast};
use crate::field::arbitrary::Random;
use crate::field::{Compiled, Field, Fractal, NoImages};
use crate::place::Place;
use crate::stamp::{Disc, Edit, Mode, Placed, Rectangle, Shape, Stamps, arbitrary};

/// Hills whose waves are long against the brute force's steps.
fn hills() -> Compiled<2> {
    let hills = Fractal { wavelength: 30.0, amplitude: 20.0, octaves: 3.0, ..Fractal::default() };
    Field::Fractal(hills).compile(&NoImages).expect("a valid field")
}

fn plain(height: f64) -> Compiled<2> {
    Field::Constant(height).compile(&NoImages).expect("a valid field")
}

fn hole(shape: Shape, at: [f64; 2]) -> Placed {
    let edit = Edit { shape, mode: Mode::Hole, ..Edit::default() };
    Placed { place: Place::from_metres([at[0], 0.0, at[1]]), edit, ..Placed::default() }
}

/// The first point in steps of `step` metres, refined by bisection, at which the ray comes to the ground from above, and not in a
/// hole; and how often it went through one before.
fn brute(surface: &impl Surface, ray: &Ray, far: f64, step: f64) -> (Option<f64>, usize) {
    let over = |t: f64| {
        let [x, y, z] = ray.at(t);
        y - surface.jet([x, z]).v > 0.0
    };
    let (mut above, mut through) = (over(0.0), 0);
    for i in 0..(far / step) as usize {
        let [mut low, mut high] = [i as f64 * step, (i + 1) as f64 * step];
        let now = over(high);
        if now == above {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if over(middle) == above { &mut low } else { &mut high }) = middle;
        }
        let [x, _, z] = ray.at(high);
        if above && !surface.is_hole([x, z]) {
            return (Some(high), through);
        }
        through += usize::from(above);
        above = now;
    }
    (None, through)
}

#[test]
fn rays_through_holes_are_those_of_brute_force() {
    const FAR: f64 = 150.0;
    let (field, mut random) = (hills(), Random::new(81));
    // Hits and misses by how often the ray went through a hole; and how often a march that knows no holes is wrong.
    let (mut tally, mut naive, mut refined) = ([[0; 3]; 2], 0, 0);
    for place in [[0.0; 3], [1e9, 0.0, -1e9]].map(Place::from_metres) {
        for _ in 0..25 {
            let mut stamps: Vec<_> = (0..4).map(|_| arbitrary::stamp(&mut random, &place, 40.0, 6.0)).collect();
            stamps.extend((0..24).map(|_| arbitrary::hole(&mut random, &place, 60.0, 12.0)));
            let bare = Stamps::compile(&stamps[..4]).expect("valid stamps");
            let stamps = Stamps::compile(&stamps).expect("valid stamps");
            let surface = Anchored::stamped(&field, &stamps, &place);
            let solid = Anchored::stamped(&field, &bare, &place);
            for _ in 0..40 {
                let q = [random.within(-40.0, 40.0), random.within(-40.0, 40.0)];
                // From above, and, of a third, from below.
                let up = surface.value(q) + random.pick(&[1.0, 1.0, -0.5]) * random.magnitude(0.3, 30.0);
                let direction = [random.within(-1.0, 1.0), random.within(-0.5, 0.3), random.within(-1.0, 1.0)];
                let ray = Ray::new([q[0], up, q[1]], direction).expect("finite");
                let hit = surface.cast(&ray, FAR).hit().map(|hit| hit.t);
                let agrees = |(t, _): &(Option<f64>, usize)| match (t, hit) {
                    (Some(a), Some(b)) => (a - b).abs() < 1e-6,
                    (None, None) => true,
                    _ => false,
                };
                let mut expected = brute(&surface, &ray, FAR, 0.02);
                // What a step may have leapt through, a finer one decides.
                if !agrees(&expected) {
                    refined += 1;
                    expected = brute(&surface, &ray, FAR, 2e-4);
                }
                assert!(agrees(&expected), "{hit:?} is not {expected:?} for {ray:?}");
                tally[usize::from(hit.is_none())][expected.1.min(2)] += 1;
                naive += usize::from(solid.cast(&ray, FAR).hit().map(|hit| hit.t) != hit);
            }
        }
    }
    println!("hits through no hole, one, more: {:?}; misses: {:?}", tally[0], tally[1]);
    println!("{refined} needed finer steps; without holes {naive} answers are others");
    assert!(tally.iter().all(|of| of[0] > 30 && of[1] > 30) && tally[0][2] + tally[1][2] > 3);
    assert!(refined < 8 && naive > 200);
}

#[test]
fn what_a_hole_shows() {
    let field = plain(10.0);
    let stamps = Stamps::compile(&[hole(Shape::Disc(Disc { radius: 2.0 }), [0.0; 2])]).expect("a valid stamp");
    let surface = Anchored::stamped(&field, &stamps, &Place::ORIGIN);
    let shoot = |origin: [f64; 3], direction: [f64; 3]| surface.cast(&Ray::new(origin, direction).unwrap(), 1e4);
    // Down beside it, and into it.
    assert!((shoot([2.1, 15.0, 0.0], [0.0, -1.0, 0.0]).hit().unwrap().t - 5.0).abs() < 1e-9);
    assert_eq!(shoot([1.9, 15.0, 0.0], [0.0, -1.0, 0.0]), Cast::Miss);
    assert_eq!(shoot([-3.0, 12.0, 0.0], [1.0, -1.0, 0.2]), Cast::Miss);
    // From the cellar: out through the hole, or through the ground's underside; nothing is met on the way.
    assert_eq!(shoot([0.0, 6.0, 0.0], [0.0, 1.0, 0.0]), Cast::Miss);
    assert_eq!(shoot([9.0, 6.0, 0.0], [0.3, 1.0, 0.0]), Cast::Miss);
    assert_eq!(shoot([9.0, 6.0, 0.0], [1.0, 0.0, 0.0]), Cast::Miss);
    assert_eq!(surface.value([0.0, 0.0]), 10.0);
    // Without a hole such a ray has ended before it began.
    let solid = Anchored::new(&field, &Place::ORIGIN);
    assert_eq!(solid.cast(&Ray::new([0.0, 6.0, 0.0], [0.0, 1.0, 0.0]).unwrap(), 1e4), Cast::Inside);
    // Along the missing ground, exactly: it ends, and is no hit in the hole.
    for direction in [[1.0, 0.0, 0.0], [1.0, -1e-12, 0.0], [1.0, 1e-12, 0.0]] {
        let hit = shoot([-1.0, 10.0, 0.0], direction).hit();
        assert!(hit.is_none_or(|hit| !surface.is_hole([hit.position[0], hit.position[2]])), "{hit:?}");
    }
}

#[test]
fn what_comes_out_may_meet_the_next_hill() {
    // A ridge 6 m high and 2 m wide, with a hole in its near side; and a second one behind it.
    let wall = |x: f64| {
        let shape = Shape::Rectangle(Rectangle { size: [2.0, 60.0], corner: 0.0 });
        let edit = Edit { shape, mode: Mode::Raise(6.0), falloff: 2.0, order: 0 };
        Placed { place: Place::from_metres([x, 0.0, 0.0]), edit, ..Placed::default() }
    };
    let field = plain(0.0);
    let tunnel = hole(Shape::Rectangle(Rectangle { size: [2.0, 2.0], corner: 0.0 }), [8.0, 0.0]);
    let stamps = Stamps::compile(&[wall(10.0), wall(20.0), tunnel]).expect("valid stamps");
    let surface = Anchored::stamped(&field, &stamps, &Place::ORIGIN);
    let mut counts = Counts::default();
    let mut shoot = |z: f64| {
        let ray = Ray::new([0.0, 3.0, z], [1.0, 0.0, 0.0]).unwrap();
        cast(&surface, &ray, 1e3, Tolerance::default(), &mut counts).hit().expect("a wall").t
    };
    let [beside, through] = [shoot(5.0), shoot(0.0)];
    println!("{beside} m to the first wall, {through} m through the hole in it; {counts:?}");
    // In at 8 m, where the falloff is at its half, out at 12 m, and into the second at 18 m.
    assert!((beside - 8.0).abs() < 1e-6 && (through - 18.0).abs() < 1e-6);
}

#[test]
fn a_hole_elsewhere_costs_a_ray_a_point() {
    let field = hills();
    let stamps = Stamps::compile(&[hole(Shape::Disc(Disc { radius: 9.0 }), [9000.0, 0.0])]).expect("a valid stamp");
    let (bare, holed) = (Anchored::new(&field, &Place::ORIGIN), Anchored::stamped(&field, &stamps, &Place::ORIGIN));
    let mut counts = [Counts::default(); 2];
    for i in 0..200 {
        let turn = 0.03 * f64::from(i);
        let ray = Ray::new([5.0, 12.0, f64::from(i)], [turn.cos(), -0.1, turn.sin()]).unwrap();
        let [one, other] = [
            cast(&bare, &ray, 500.0, Tolerance::default(), &mut counts[0]),
            cast(&holed, &ray, 500.0, Tolerance::default(), &mut counts[1]),
        ];
        assert_eq!(one, other);
    }
    assert_eq!(counts[0], counts[1]);
}
