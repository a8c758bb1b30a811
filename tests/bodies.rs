//! Bodies on the ground: collider tiles and net under avian3d, and an origin that moves under both.

mod holes;

use std::time::Duration;

use avian3d::prelude::*;
use bevy::app::Plugins;
use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_horizon::HorizonWorldPlugin;
use bevy_horizon::avian::{BodyLifted, ground_collider};
use bevy_horizon::prelude::*;
use bevy_horizon::stamp::{Disc, Mode, Shape};
use big_space::prelude::{BigSpaceCommands, BigSpaceDefaultPlugins, CellCoord, FloatingOrigin, Grid};
use horizon_field::Compiled;
use horizon_field::field::arbitrary::Random;
use horizon_field::field::{Anchors, Fractal, NoImages};

/// A step of avian's default, 64 in a second.
const STEP: Duration = Duration::from_micros(15_625);
const SECOND: u32 = 64;
const RADIUS: f32 = 0.4;

/// Waves from 40 m down to 2.5 m, slopes up to 35°.
fn rough() -> Field {
    Field::Fractal(Fractal { wavelength: 40.0, amplitude: 6.0, octaves: 5.0, gain: 0.5, seed: 3, ..default() })
}

/// How bodies fared, frame by frame.
#[derive(Resource, Default)]
struct Seen {
    /// The lowest that a centre was over the ground, in metres.
    lowest: Option<f32>,
    lifted: usize,
}

fn watch(
    world: HorizonQuery,
    bodies: Query<(&RigidBody, &Position)>,
    mut lifted: MessageReader<BodyLifted>,
    mut seen: ResMut<Seen>,
) {
    let centres: Vec<Vec3> =
        bodies.iter().filter(|(body, _)| body.is_dynamic()).map(|(_, position)| position.0).collect();
    for (centre, height) in centres.iter().zip(world.heights(&centres)) {
        let over = centre.y - height;
        seen.lowest = Some(seen.lowest.map_or(over, |lowest| lowest.min(over)));
    }
    seen.lifted += lifted.read().count();
}

/// An app without a renderer, with rough ground, avian and these plugins; one update is done.
fn app<M>(origin: Place, plugins: impl Plugins<M>) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, PhysicsPlugins::default(), HorizonWorldPlugin))
        .insert_resource(WorldOrigin(origin))
        .insert_resource(TimeUpdateStrategy::ManualDuration(STEP))
        .init_resource::<Seen>()
        .add_message::<BodyLifted>()
        .add_plugins(plugins)
        .add_systems(Last, watch);
    app.finish();
    app.cleanup();
    app.world_mut().spawn(Terrain::new(rough()));
    app.update();
    app
}

fn run(app: &mut App, steps: u32) {
    (0..steps).for_each(|_| app.update());
}

/// Spheres over the ground around Bevy's origin, up to 20 m high.
fn drop_spheres(app: &mut App, count: usize) {
    let spawn = move |world: HorizonQuery, mut commands: Commands| {
        let mut random = Random::new(11);
        for _ in 0..count {
            let [x, z] = [(); 2].map(|()| random.within(-30.0, 30.0) as f32);
            let y = world.height(Vec3::new(x, 0.0, z)).unwrap() + random.within(1.0, 20.0) as f32;
            // Real ground brakes what rolls.
            let damping = (LinearDamping(0.1), AngularDamping(3.0));
            commands.spawn((RigidBody::Dynamic, Collider::sphere(RADIUS), Transform::from_xyz(x, y, z), damping));
        }
    };
    app.world_mut().run_system_once(spawn).unwrap();
}

/// The true surface.
struct Truth {
    field: Compiled<2>,
    anchors: Anchors<2>,
}

impl Truth {
    fn new(origin: &Place) -> Self {
        let field = rough().compile::<2>(&NoImages).unwrap();
        let anchors = field.anchor(origin);
        Self { field, anchors }
    }

    /// The nearest of (2n + 1)² points of the surface, by its distance.
    fn nearest(&self, centre: [f64; 3], middle: [f64; 2], half: f64, n: i32) -> (f64, [f64; 2]) {
        let at = |i: i32| half * f64::from(i) / f64::from(n);
        let points: Vec<[f64; 2]> =
            (-n..=n).flat_map(|i| (-n..=n).map(move |j| [middle[0] + at(i), middle[1] + at(j)])).collect();
        let mut heights = vec![0.0; points.len()];
        self.field.values_f64(&self.anchors, &points, 0.0, &mut heights);
        let distance = |(p, y): (&[f64; 2], &f64)| {
            let [dx, dy, dz] = [p[0] - centre[0], y - centre[1], p[1] - centre[2]];
            ((dx * dx + dy * dy + dz * dz).sqrt(), *p)
        };
        points.iter().zip(&heights).map(distance).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    }

    /// How deep a sphere is in the ground, in metres, to a tenth of a millimetre; negative over it.
    fn penetration(&self, centre: Vec3) -> f64 {
        let (centre, radius) = (centre.to_array().map(f64::from), f64::from(RADIUS));
        let half = 1.3 * radius;
        let (_, coarse) = self.nearest(centre, [centre[0], centre[2]], half, 24);
        radius - self.nearest(centre, coarse, half / 24.0, 6).0
    }
}

/// How many spheres are at rest, and how deep they are in the ground: from the least to the most.
fn at_rest(app: &mut App, truth: &Truth) -> (usize, [f64; 2]) {
    let mut spheres = app.world_mut().query::<(&RigidBody, &Position, &LinearVelocity, Has<Sleeping>)>();
    let depths: Vec<f64> = spheres
        .iter(app.world())
        .filter(|(body, _, velocity, asleep)| body.is_dynamic() && (*asleep || velocity.0.length() < 0.1))
        .map(|(_, position, ..)| truth.penetration(position.0))
        .collect();
    let extremes = depths.iter().fold([f64::MAX, f64::MIN], |[low, high], depth| [low.min(*depth), high.max(*depth)]);
    (depths.len(), extremes)
}

fn tiles(app: &mut App) -> Vec<(Entity, GroundTile, Vec3)> {
    let mut tiles = app.world_mut().query::<(Entity, &GroundTile, &Position)>();
    tiles.iter(app.world()).map(|(entity, tile, position)| (entity, *tile, position.0)).collect()
}

#[test]
fn two_hundred_spheres_come_to_rest_on_rough_ground() {
    for metres in [[0.0; 3], [1e9, 0.0, -1e9]] {
        let origin = Place::from_metres(metres);
        let mut app = app(origin, HorizonAvianPlugin::default());
        drop_spheres(&mut app, 200);
        run(&mut app, 20 * SECOND);
        let (resting, [highest, deepest]) = at_rest(&mut app, &Truth::new(&origin));
        let (laid, seen) = (tiles(&mut app).len(), app.world().resource::<Seen>());
        let lowest = seen.lowest.unwrap();
        println!(
            "at {metres:?}: {resting} of 200 rest, between {:.1} mm over and {:.1} mm in the ground; the lowest centre \
             was {lowest} m over it; {laid} tiles",
            -1e3 * highest,
            1e3 * deepest,
        );
        assert!(lowest > 0.5 * RADIUS, "a centre was {lowest} m over the ground");
        assert_eq!(seen.lifted, 0, "tiles must hold the spheres, not the net");
        assert!(resting > 150, "{resting} of 200 rest");
        assert!(deepest < 0.01, "{deepest} m deep");
        assert!(laid < 250, "{laid} tiles for spheres within some 80 m");

        // No body, no tile.
        let spheres: Vec<Entity> =
            app.world_mut().query_filtered::<Entity, With<LinearDamping>>().iter(app.world()).collect();
        spheres.into_iter().for_each(|sphere| assert!(app.world_mut().despawn(sphere)));
        run(&mut app, 2);
        assert_eq!(tiles(&mut app).len(), 0);
    }
}

#[test]
fn coarse_cells_would_not_do() {
    let mut app = app(Place::ORIGIN, HorizonAvianPlugin::default());
    app.insert_resource(TileSettings { cells: 4, ..default() });
    drop_spheres(&mut app, 60);
    run(&mut app, 10 * SECOND);
    let (resting, [highest, deepest]) = at_rest(&mut app, &Truth::new(&Place::ORIGIN));
    println!("cells of 4 m: {resting} of 60 rest, between {} m over and {deepest} m in the ground", -highest);
    assert!(deepest > 0.1 && highest < -0.1);
}

#[test]
fn one_tile_would_not_do() {
    let thrown = |ours: bool| {
        let mut app =
            if ours { app(Place::ORIGIN, HorizonAvianPlugin::default()) } else { app(Place::ORIGIN, no_tiles) };
        let spawn = move |world: HorizonQuery, mut commands: Commands| {
            let ground = world.ground(None).unwrap();
            let middle = Vec3::Y * ground.height(Vec3::ZERO);
            if !ours {
                let collider = ground_collider(&ground, middle, 64.0, 256).unwrap();
                commands.spawn((RigidBody::Static, collider, Transform::from_translation(middle)));
            }
            let velocity = LinearVelocity(Vec3::new(30.0, 6.0, 4.0));
            let at = Transform::from_translation(middle + 2.0 * Vec3::Y);
            commands.spawn((RigidBody::Dynamic, Collider::sphere(RADIUS), at, velocity));
        };
        app.world_mut().run_system_once(spawn).unwrap();
        run(&mut app, 8 * SECOND);
        let seen = app.world().resource::<Seen>();
        assert_eq!(seen.lifted, 0);
        seen.lowest.unwrap()
    };
    let (naive, ours) = (thrown(false), thrown(true));
    println!("one fixed tile: {naive} m over the ground at the lowest; tiles that follow: {ours} m");
    assert!(naive < -10.0, "a body that leaves the one tile falls");
    assert!(ours > 0.5 * RADIUS);
}

/// A plugin that does nothing.
fn no_tiles(_: &mut App) {}

#[test]
fn the_net_holds_what_no_collider_does() {
    let shot = |net: bool| {
        let mut app = app(Place::ORIGIN, HorizonAvianPlugin::default());
        app.insert_resource(TileSettings { net, ..default() });
        let spawn = |world: HorizonQuery, mut commands: Commands| {
            let mut random = Random::new(5);
            for _ in 0..40 {
                let [x, z] = [(); 2].map(|()| random.within(-30.0, 30.0) as f32);
                let y = world.height(Vec3::new(x, 0.0, z)).unwrap() + 3.0;
                // Three metres in a step, and no contact is foreseen.
                let velocity = LinearVelocity(Vec3::new(40.0, -190.0, 10.0));
                let at = Transform::from_xyz(x, y, z);
                commands.spawn((RigidBody::Dynamic, Collider::sphere(0.05), at, velocity, SpeculativeMargin(0.0)));
            }
        };
        app.world_mut().run_system_once(spawn).unwrap();
        run(&mut app, SECOND);
        let seen = app.world().resource::<Seen>();
        (seen.lowest.unwrap(), seen.lifted)
    };
    let (without, none) = shot(false);
    let (lowest, lifted) = shot(true);
    println!("without the net {without} m over the ground at the lowest, with it {lowest} m; {lifted} lifts");
    assert!(without < -1.0 && none == 0);
    assert!(lowest > -1e-3 && lifted >= 20);
}

#[test]
fn tiles_and_queries_agree_at_the_samples() {
    for metres in [[0.0; 3], [1e9 + 0.3, 0.0, -1e9]] {
        let origin = Place::from_metres(metres);
        let mut app = app(origin, HorizonAvianPlugin::default());
        drop_spheres(&mut app, 10);
        run(&mut app, 8);
        let ask = |world: HorizonQuery, tiles: Query<(&Collider, &Position), With<GroundTile>>| {
            let ground = world.ground(None).unwrap();
            let mut worst = 0.0f32;
            for (collider, position) in &tiles {
                let field = collider.shape().as_heightfield().unwrap();
                let heights = field.heights();
                for (x, z) in [(0, 0), (64, 0), (0, 64), (17, 40), (40, 17), (64, 64)] {
                    let at = position.0 + Vec3::new(field.x_at(x), heights[(z, x)], field.z_at(z));
                    worst = worst.max((at.y - ground.height(at)).abs());
                }
            }
            (tiles.iter().count(), worst)
        };
        let (count, worst) = app.world_mut().run_system_once(ask).unwrap();
        println!("at {metres:?}: {count} tiles, off by {worst:e} m at their samples");
        assert!(count > 8 && worst < 2e-5);
    }
}

#[test]
fn an_edited_field_moves_what_lies_on_it() {
    let mut app = app(Place::ORIGIN, HorizonAvianPlugin::default());
    drop_spheres(&mut app, 40);
    run(&mut app, 10 * SECOND);
    for by in [3.0, -3.0] {
        let mut terrains = app.world_mut().query::<&mut Terrain>();
        terrains.single_mut(app.world_mut()).unwrap().field = Field::Add(vec![rough(), Field::Constant(by)]);
        // One frame compiles, in the next ones bodies are lifted, or fall.
        run(&mut app, 1);
        run(&mut app, 3 * SECOND);
        *app.world_mut().resource_mut::<Seen>() = Seen::default();
        app.update();
        let lowest = app.world().resource::<Seen>().lowest.unwrap();
        let ask = |world: HorizonQuery, bodies: Query<(&RigidBody, &Position)>| {
            let dynamic = bodies.iter().filter(|(body, _)| body.is_dynamic());
            dynamic.map(|(_, at)| at.0.y - world.height(at.0).unwrap()).fold(f32::MIN, f32::max)
        };
        let highest = app.world_mut().run_system_once(ask).unwrap();
        println!("moved by {by} m: spheres between {lowest} and {highest} m over the ground");
        // Spheres may lie on spheres.
        assert!(lowest > 0.5 * RADIUS && highest < 4.0);
    }
}

#[test]
fn a_floating_origin_leaves_bodies_on_their_ground() {
    let displaced = |carry_bodies: bool| {
        let plugins = (BigSpaceDefaultPlugins, HorizonBigSpacePlugin, HorizonAvianPlugin::default());
        let mut app = app(Place::ORIGIN, plugins);
        app.insert_resource(TileSettings { carry_bodies, ..default() });
        let spawn = |mut commands: Commands| {
            commands.spawn_big_space(Grid::new(2000.0, 100.0), |root| {
                root.spawn_spatial((FloatingOrigin, CellCoord::new(500_000, 0, -500_000)));
            });
        };
        app.world_mut().run_system_once(spawn).unwrap();
        app.update();
        let origin = app.world().resource::<WorldOrigin>().0;
        assert_eq!(origin, Place::from_metres([1e9, 0.0, -1e9]));

        drop_spheres(&mut app, 20);
        run(&mut app, 10 * SECOND);
        let places = |app: &mut App| {
            let origin = *app.world().resource::<WorldOrigin>();
            let mut bodies = app.world_mut().query::<(Entity, &RigidBody, &Position)>();
            let dynamic = bodies.iter(app.world()).filter(|(_, body, _)| body.is_dynamic());
            let mut places: Vec<(Entity, Place)> =
                dynamic.map(|(entity, _, position)| (entity, origin.place(position.0))).collect();
            // Sleep and waking change their order.
            places.sort_by_key(|(entity, _)| *entity);
            places.into_iter().map(|(_, place)| place).collect::<Vec<Place>>()
        };
        let (bodies, laid) = (places(&mut app), tiles(&mut app));

        // Over the border of a cell.
        let mut origins = app.world_mut().query_filtered::<&mut Transform, With<FloatingOrigin>>();
        origins.single_mut(app.world_mut()).unwrap().translation = Vec3::new(1500.0, 0.0, 0.0);
        run(&mut app, 2);
        let now = *app.world().resource::<WorldOrigin>();
        assert_eq!(now.0, Place::from_metres([1e9 + 2000.0, 0.0, -1e9]));
        let moved = places(&mut app);
        let distance = |(a, b): (&Place, &Place)| a.minus(b).iter().map(|d| d * d).sum::<f64>().sqrt();
        let displaced = bodies.iter().zip(&moved).map(distance).fold(0.0, f64::max);
        if carry_bodies {
            // The same tiles, where they were in the world.
            let after = tiles(&mut app);
            assert!(laid.len() > 8);
            for (entity, tile, _) in &laid {
                let same = after.iter().find(|(other, ..)| other == entity);
                let (_, same, at) = same.expect("no tile is made again");
                assert_eq!(same, tile);
                assert!(distance((&now.place(*at), &tile.centre)) < 1e-3);
            }
            run(&mut app, SECOND);
            let (resting, [_, deepest]) = at_rest(&mut app, &Truth::new(&now.0));
            println!("carried: {resting} of 20 rest, {deepest} m in the ground at the most");
            assert!(resting > 10 && deepest < 0.01);
            assert_eq!(app.world().resource::<Seen>().lifted, 0);
        }
        displaced
    };
    let (naive, ours) = (displaced(false), displaced(true));
    println!("bodies are displaced by {naive} m where nobody carries them, by {ours} m where they are carried");
    assert!(naive > 1000.0);
    assert!(ours < 0.05);
}

#[test]
fn a_plate_carries_what_lies_on_it_and_only_its_tiles_are_made_again() {
    let mut app = app(Place::ORIGIN, HorizonAvianPlugin::default());
    let bare = |app: &mut App, x: f32| {
        app.world_mut().run_system_once(move |world: HorizonQuery| world.height(Vec3::X * x).unwrap()).unwrap()
    };
    let (level, aside) = (2.0 + bare(&mut app, 0.0), bare(&mut app, 400.0));
    let at = |y: f32| StampPlace { place: Place::from_metres([0.0, y.into(), 0.0]), heading: 0.0 };
    let plate = Stamp::new(Shape::Disc(Disc { radius: 8.0 }), Mode::Flatten);
    let plate = app.world_mut().spawn((plate, at(level))).id();
    app.update();
    let sphere = |app: &mut App, x: f32, y: f32| {
        let body = (RigidBody::Dynamic, Collider::sphere(RADIUS), AngularDamping(3.0));
        app.world_mut().spawn((body, Transform::from_xyz(x, y, 0.0))).id()
    };
    let body = sphere(&mut app, 0.0, level + 2.0);
    sphere(&mut app, 400.0, aside + 1.0);
    run(&mut app, 3 * SECOND);
    let height = |app: &App| app.world().get::<Position>(body).unwrap().y;
    assert!((height(&app) - level - RADIUS).abs() < 0.05, "{} over {level}", height(&app));

    let tiles = |app: &mut App| -> Vec<(Entity, [i64; 2])> {
        let mut tiles = app.world_mut().query::<(Entity, &GroundTile)>();
        tiles.iter(app.world()).map(|(entity, tile)| (entity, tile.index)).collect()
    };
    let before = tiles(&mut app);
    app.world_mut().entity_mut(plate).insert(at(level - 1.5));
    // One step to tell, and one to make the tiles.
    run(&mut app, 2);
    let after = tiles(&mut app);
    // Disc and falloff reach 18 m: two tiles of 16 m to each side.
    let near = |index: &[i64; 2]| index.iter().all(|i| (-2..2).contains(i));
    let same = |(entity, index): &(Entity, [i64; 2])| near(index) || after.contains(&(*entity, *index));
    assert!(before.iter().all(same), "tiles were made again far away");
    let again = before.iter().filter(|(entity, index)| near(index) && !after.iter().any(|(other, _)| other == entity));
    assert!(again.count() > 3, "the plate's own tiles are made again");
    run(&mut app, 3 * SECOND);
    assert!((height(&app) - level + 1.5 - RADIUS).abs() < 0.05, "{} over {}", height(&app), level - 1.5);
    assert_eq!(app.world().resource::<Seen>().lifted, 0);
}
