//! Questions to the ground: finite, consistent with each other, the same everywhere and on every machine.

use bevy::ecs::system::RunSystemOnce;
use bevy::math::DVec3;
use bevy::prelude::*;
use bevy_horizon::HorizonWorldPlugin;
use bevy_horizon::prelude::*;
use bevy_horizon::world::CompiledTerrain;
use horizon_field::field::arbitrary::Random;
use horizon_field::field::{Fractal, Mask, NoImages, Noise, Terrace, Warp};
use horizon_field::fractal::Rule;
use horizon_field::noise::Basis;

const ORIGINS: [[f64; 3]; 3] = [[0.0; 3], [1e6, 0.0, -1e6], [1e9, 0.0, 1e9]];

fn hills() -> Field {
    Field::Fractal(Fractal { wavelength: 1500.0, amplitude: 300.0, octaves: 9.0, seed: 77, ..default() })
}

/// An app without a renderer, with this ground.
fn app(field: Field, origin: Place) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, HorizonWorldPlugin)).insert_resource(WorldOrigin(origin));
    app.world_mut().spawn(Terrain::new(field));
    app.update();
    app
}

fn positions(seed: u32, count: usize) -> Vec<Vec3> {
    let mut random = Random::new(seed);
    // Eighths of a metre: f32 holds them exactly.
    let mut metres = || (random.bits() % 65_536) as f32 / 8.0 - 4096.0;
    (0..count).map(|_| Vec3::new(metres(), 0.0, metres())).collect()
}

#[test]
fn heights_and_normals_are_those_of_the_field() {
    for metres in ORIGINS {
        let origin = Place::from_metres(metres);
        let mut app = app(hills(), origin);
        let ask = move |world: HorizonQuery, terrains: Query<&CompiledTerrain>| {
            let field = terrains.single().unwrap().height();
            let anchors = field.anchor(&origin);
            let (mut worst, mut low, mut high) = (0.0f32, f32::MAX, f32::MIN);
            for at in positions(1, 4000) {
                let q = [f64::from(at.x), f64::from(at.z)];
                let height = world.height(at).unwrap();
                assert_eq!(height, field.value_f64(&anchors, q, 0.0) as f32);
                (low, high) = (low.min(height), high.max(height));
                let h = 1e-4;
                let value = |x: f64, z: f64| field.value_f64(&anchors, [q[0] + x, q[1] + z], 0.0);
                let slope = [(h, 0.0), (0.0, h)].map(|(x, z)| (value(x, z) - value(-x, -z)) / (2.0 * h));
                let normal = DVec3::new(-slope[0], 1.0, -slope[1]).normalize().as_vec3();
                worst = worst.max((world.normal(at).unwrap() - normal).length());
                assert!((world.slope(at).unwrap() - slope[0].hypot(slope[1]) as f32).abs() < 1e-4);
            }
            println!("at {metres:?}: heights from {low} to {high}; normals off by {worst:e} at most");
            assert!(worst < 1e-5 && high - low > 100.0);
        };
        app.world_mut().run_system_once(ask).unwrap();
    }
}

#[test]
fn rays_end_on_the_ground() {
    for metres in ORIGINS {
        let mut app = app(hills(), Place::from_metres(metres));
        let ask = move |world: HorizonQuery| {
            let mut random = Random::new(2);
            let (mut hits, mut worst) = (0, 0.0f32);
            for at in positions(3, 400) {
                let from = at.with_y(world.height(at).unwrap() + random.within(1.0, 300.0) as f32);
                let [x, y, z] = [(); 3].map(|()| random.within(-1.0, 1.0) as f32);
                let Ok(direction) = Dir3::new(Vec3::new(x, 0.5 * y - 0.2, z)) else { continue };
                let Some(hit) = world.ray_cast(from, direction, 20_000.0) else { continue };
                hits += 1;
                let ground = world.ground(None).unwrap();
                // Single precision carries positions 20 km away to a millimetre or two, and a slope raises that.
                let off = (hit.position.y - ground.height(hit.position)).abs() / (1.0 + ground.slope(hit.position));
                worst = worst.max(off);
                assert!((hit.position - from).length() - hit.distance < 0.01);
                assert!(hit.normal.dot(*direction) < 0.0, "the ray comes from above: {hit:?}");
                // Nothing before it is under ground.
                for i in 0..200 {
                    let point = from + direction * (hit.distance * i as f32 / 200.0);
                    assert!(point.y > ground.height(point) - 0.01, "{point} lies before the hit {hit:?}");
                }
            }
            println!("at {metres:?}: {hits} hits, off the ground by {worst} m at most");
            assert!(hits > 200 && worst < 4e-3);
        };
        app.world_mut().run_system_once(ask).unwrap();
    }
}

#[test]
fn batches_answer_as_single_questions_do() {
    let mut app = app(hills(), Place::from_metres(ORIGINS[1]));
    let ask = |world: HorizonQuery| {
        let positions = positions(4, 1000);
        let single: Vec<f32> = positions.iter().map(|at| world.height(*at).unwrap()).collect();
        assert_eq!(world.heights(&positions), single);
        let mut random = Random::new(5);
        let rays: Vec<(Vec3, Dir3)> = positions[..100]
            .iter()
            .map(|at| {
                let across = [(); 2].map(|()| random.within(-1.0, 1.0) as f32);
                (at.with_y(400.0), Dir3::new(Vec3::new(across[0], -0.3, across[1])).unwrap())
            })
            .collect();
        let single: Vec<_> = rays.iter().map(|(from, to)| world.ray_cast(*from, *to, 5000.0)).collect();
        assert_eq!(world.ray_casts(&rays, 5000.0), single);
        assert!(single.iter().flatten().count() > 50);
    };
    app.world_mut().run_system_once(ask).unwrap();
}

#[test]
fn numbers_that_are_none_are_survived() {
    for field in [hills(), Field::Constant(0.0), steps()] {
        let mut app = app(field, Place::ORIGIN);
        let ask = |world: HorizonQuery| {
            let wild = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e20, 0.0];
            for x in wild {
                for y in wild {
                    for at in [Vec3::new(x, 0.0, y), Vec3::new(0.0, x, y), Vec3::new(y, y, x)] {
                        let finite = at.is_finite() && at.abs().max_element() < 1e18;
                        assert!(!finite || world.height(at).unwrap().is_finite(), "at {at}");
                        assert!(world.normal(at).is_some() && world.slope(at).is_some());
                        for direction in [Dir3::X, Dir3::NEG_Y, Dir3::NEG_Z] {
                            let hit = world.ray_cast(at, direction, y);
                            assert!(at.is_finite() || hit.is_none(), "{at} {direction:?}: {hit:?}");
                        }
                    }
                    assert_eq!(world.heights(&[Vec3::splat(x); 3]).len(), 3);
                }
            }
        };
        app.world_mut().run_system_once(ask).unwrap();
    }
}

#[test]
fn no_ground_is_an_answer() {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, HorizonWorldPlugin));
    app.update();
    let ask = |world: HorizonQuery| {
        assert_eq!(world.height(Vec3::ZERO), None);
        assert_eq!(world.heights(&[Vec3::ZERO]), Vec::<f32>::new());
        assert_eq!(world.ray_cast(Vec3::Y, Dir3::NEG_Y, 10.0), None);
        assert_eq!(world.ray_casts(&[(Vec3::Y, Dir3::NEG_Y)], 10.0), vec![None]);
    };
    app.world_mut().run_system_once(ask).unwrap();
}

#[test]
fn a_shifted_origin_leaves_heights_where_they_are() {
    let field = hills().compile::<2>(&NoImages).unwrap();
    for metres in ORIGINS {
        let origin = Place::from_metres(metres);
        let shifts = [DVec3::new(4096.0, 0.0, -8192.0), DVec3::new(17.0, 0.0, 40_000.0), DVec3::new(0.125, 0.0, -3.75)];
        for shift in shifts {
            let shifted = origin.translated((-shift).to_array());
            let (here, there) = (field.anchor(&origin), field.anchor(&shifted));
            let mut worst = 0.0f64;
            for at in positions(6, 2000) {
                let q = [f64::from(at.x), f64::from(at.z)];
                let moved = [q[0] + shift.x, q[1] + shift.z];
                worst = worst.max((field.value_f64(&here, q, 0.0) - field.value_f64(&there, moved, 0.0)).abs());
            }
            println!("at {metres:?}, shifted by {shift}: heights off by {worst:e} m");
            assert!(worst < 1e-6);

            // And through the query, which answers in single precision: to its last bit.
            let heights = |origin: Place, shift: DVec3| {
                let positions: Vec<Vec3> = positions(6, 500).iter().map(|at| *at + shift.as_vec3()).collect();
                app(hills(), origin).world_mut().run_system_once(move |world: HorizonQuery| world.heights(&positions))
            };
            let (here, there) = (heights(origin, DVec3::ZERO).unwrap(), heights(shifted, shift).unwrap());
            for (a, b) in here.into_iter().zip(there) {
                assert!((a - b).abs() <= a.abs() * f32::EPSILON, "{a} and {b}");
            }
        }
        // Origins may be higher or lower, too: heights are Bevy's.
        let mut raised = app(hills(), origin.translated([0.0, 1000.5, 0.0]));
        let mut level = app(hills(), origin);
        let ask = |world: HorizonQuery| world.heights(&positions(7, 200));
        let (raised, level) =
            (raised.world_mut().run_system_once(ask).unwrap(), level.world_mut().run_system_once(ask).unwrap());
        assert!(raised.iter().zip(&level).all(|(raised, level)| (level - raised - 1000.5).abs() < 2e-4));
    }
}

/// Some of everything that shapes heights: multifractals, a warp, cells, terraces, a mask.
fn steps() -> Field {
    let fractal = |rule, basis, wavelength: f64, octaves, seed| {
        let amplitude = 0.15 * wavelength;
        Field::from(Fractal { rule, basis, wavelength, amplitude, octaves, seed, ..default() })
    };
    let noise =
        |basis, wavelength, amplitude, seed| Field::from(Noise { basis, wavelength, amplitude, rotation: 0.7, seed });
    let warp = Warp {
        field: fractal(Rule::Ridged, Basis::Simplex, 2000.0, 5.5, 1).into(),
        x: noise(Basis::Value, 700.0, 150.0, 2).into(),
        z: noise(Basis::Gradient, 900.0, 150.0, 3).into(),
        y: None,
    };
    let terrace =
        Terrace { field: fractal(Rule::Hybrid, Basis::Gradient, 3000.0, 4.0, 4).into(), step: 40.0, sharpness: 0.9 };
    Mask {
        mask: noise(Basis::Worley, 1200.0, 100.0, 5).into(),
        low: -30.0,
        high: 30.0,
        outside: Field::from(warp).into(),
        inside: Field::from(terrace).into(),
    }
    .into()
}

#[test]
fn a_million_answers_are_the_same_on_every_machine() {
    // Only exactly rounded operations make them, so every bit is fixed. A change of this number is a change of every
    // world: it needs a new version of world files.
    const ANSWERS: u64 = 0xa6a7_3726_6b3e_1976;
    const EACH: usize = 250_000;
    let field = steps().compile::<2>(&NoImages).unwrap();
    let places = [[0.0; 3], [-1e6, 0.0, 3e5], [1e9, 0.0, -1e9], [-7.5e11, 0.0, 2.5e12]];
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for (seed, metres) in places.into_iter().enumerate() {
        let anchors = field.anchor(&Place::from_metres(metres));
        let mut random = Random::new(seed as u32);
        for _ in 0..EACH {
            let q = [(); 2].map(|()| random.within(-5000.0, 5000.0));
            for byte in field.value_f64(&anchors, q, 0.0).to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    println!("{} answers hash to {hash:#018x}", places.len() * EACH);
    assert_eq!(hash, ANSWERS, "{hash:#018x}");
}
