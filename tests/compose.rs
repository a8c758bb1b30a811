//! Meshes and ground in one picture: at every pixel the nearer of the two.

use bevy::camera::visibility::RenderLayers;
use bevy::prelude::*;
use bevy_horizon::prelude::*;

use bevy_horizon_workspace::stage::Stage;

const SIZE: [u32; 2] = [320, 180];
const EYE: Vec3 = Vec3::new(0.0, 260.0, 0.0);

fn hills() -> Terrain {
    Terrain::new(Field::Fractal(horizon_field::field::Fractal {
        wavelength: 900.0,
        amplitude: 220.0,
        octaves: 9.0,
        ..default()
    }))
}

/// Spheres and blocks: half buried, floating, behind ridges.
fn meshes(world: &mut World) -> Vec<Entity> {
    let sphere = world.resource_mut::<Assets<Mesh>>().add(Sphere::new(30.0));
    let block = world.resource_mut::<Assets<Mesh>>().add(Cuboid::new(20.0, 160.0, 20.0));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(Color::srgb(0.8, 0.2, 0.1));
    let compiled = hills().field.compile::<2>(&horizon_field::field::NoImages).unwrap();
    let anchors = compiled.anchor(&Place::ORIGIN);
    (0..14)
        .map(|i| {
            let (x, z) = (f64::from(i % 5) * 130.0 - 280.0, -120.0 - 170.0 * f64::from(i / 2));
            let ground = compiled.value_f64(&anchors, [x, z], 0.0);
            let above = [0.0, 20.0, -22.0, 55.0][i as usize % 4];
            let mesh = if i % 3 == 0 { block.clone() } else { sphere.clone() };
            let at = Transform::from_xyz(x as f32, (ground + above) as f32, z as f32);
            world.spawn((Mesh3d(mesh), MeshMaterial3d(material.clone()), at)).id()
        })
        .collect()
}

fn stage(with_terrain: bool, with_meshes: bool, projection: Option<Projection>) -> Vec<f32> {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    stage.light();
    if with_terrain {
        stage.world().spawn(hills());
    }
    if with_meshes {
        meshes(stage.world());
    }
    stage.look(Transform::from_translation(EYE).looking_to(Vec3::new(0.1, -0.25, -1.0), Vec3::Y));
    if let Some(projection) = projection {
        let camera = stage.camera;
        stage.world().entity_mut(camera).insert(projection);
    }
    if with_terrain {
        stage.settle();
    } else {
        (0..8).for_each(|_| stage.off.update());
    }
    stage.depth()
}

fn assert_nearer(projection: Option<Projection>) {
    let [both, ground, meshes] =
        [(true, true), (true, false), (false, true)].map(|(t, m)| stage(t, m, projection.clone()));
    let mut of = [0; 3];
    for ((both, ground), meshes) in both.iter().zip(&ground).zip(&meshes) {
        // Reverse z: the nearer is the larger; what is drawn is one or the other, to the bit.
        assert_eq!(*both, ground.max(*meshes));
        of[if *both == 0.0 {
            0
        } else if ground >= meshes {
            1
        } else {
            2
        }] += 1;
    }
    println!("sky {}, ground {}, meshes {}", of[0], of[1], of[2]);
    assert!(of[1] > 10_000 && of[2] > 1_000, "both must show: {of:?}");
    let hidden = meshes.iter().zip(&ground).filter(|(mesh, ground)| **mesh > 0.0 && ground > mesh).count();
    assert!(hidden > 300, "ground must hide meshes too: {hidden}");
}

#[test]
fn the_nearer_of_mesh_and_ground_shows() {
    assert_nearer(None);
}

#[test]
fn the_nearer_shows_in_an_orthographic_view() {
    assert_nearer(Some(Projection::Orthographic(OrthographicProjection {
        scaling_mode: bevy::camera::ScalingMode::FixedVertical { viewport_height: 500.0 },
        far: 4000.0,
        ..OrthographicProjection::default_3d()
    })));
}

#[test]
fn layers_visibility_and_transforms_are_honoured() {
    let shown = |change: fn(&mut World, Entity, Entity)| {
        let mut stage = Stage::new(SIZE[0], SIZE[1]);
        let terrain = stage.world().spawn(hills()).id();
        stage.look(Transform::from_translation(EYE).looking_to(Vec3::new(0.1, -0.25, -1.0), Vec3::Y));
        stage.settle();
        let camera = stage.camera;
        change(stage.world(), terrain, camera);
        (0..40).for_each(|_| stage.off.update());
        stage.depth()
    };
    let count = |depth: &[f32]| depth.iter().filter(|depth| **depth > 0.0).count();
    let plain = shown(|_, _, _| {});
    assert!(count(&plain) > 10_000);
    assert_eq!(
        count(&shown(|world, terrain, _| {
            world.entity_mut(terrain).insert(Visibility::Hidden);
        })),
        0
    );
    assert_eq!(
        count(&shown(|world, terrain, _| {
            world.entity_mut(terrain).insert(RenderLayers::layer(3));
        })),
        0
    );
    assert_eq!(
        count(&shown(|world, _, camera| {
            world.entity_mut(camera).remove::<HorizonCamera>();
        })),
        0
    );
    assert_eq!(
        count(&shown(|world, terrain, _| {
            world.despawn(terrain);
        })),
        0
    );
    // Ground and camera moved alike: the same picture.
    let moved = shown(|world, terrain, camera| {
        let by = Vec3::new(512.0, 64.0, -256.0);
        world.entity_mut(terrain).insert(Transform::from_translation(by));
        world.get_mut::<Transform>(camera).unwrap().translation += by;
    });
    assert_eq!(moved, plain);
}
