//! Shadows of meshes on water and on its bed.

use std::f32::consts::FRAC_PI_2;

use bevy::light::CascadeShadowConfigBuilder;
use bevy::prelude::*;
use bevy_horizon::prelude::*;

use super::{Eye, Stage, finite, settle, stage, still};

const SIZE: [u32; 2] = [160, 90];
/// How high over the water the plate hangs, whose shadow falls as far to +x.
const OVER: f32 = 3.0;

/// A sun in the west, 45° high, and the sky's light.
fn shine(stage: &mut Stage) {
    let sun = Sun { azimuth: -FRAC_PI_2, elevation: 0.5 * FRAC_PI_2, ..default() };
    let light = DirectionalLight { illuminance: 80_000.0, shadow_maps_enabled: true, ..default() };
    let cascades = CascadeShadowConfigBuilder { num_cascades: 1, maximum_distance: 60.0, ..default() }.build();
    stage.world().spawn((light, cascades, sun.transform()));
    stage.world().insert_resource(GlobalAmbientLight { brightness: 4000.0, ..default() });
}

fn mesh(stage: &mut Stage, mesh: impl Into<Mesh>, colour: f32, at: Vec3) -> Entity {
    let world = stage.world();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let base_color = LinearRgba::rgb(colour, colour, colour).into();
    let plain = StandardMaterial { base_color, perceptual_roughness: 1.0, reflectance: 0.0, ..default() };
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(plain);
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_translation(at))).id()
}

fn plate(stage: &mut Stage) -> Entity {
    mesh(stage, Cuboid::new(6.0, 0.2, 6.0), 0.4, Vec3::Y * OVER)
}

/// The plate is neither before the middle of its shadow, nor mirrored there.
fn eye() -> Eye {
    Eye::new(Transform::from_xyz(0.0, 8.0, 14.0).looking_at(Vec3::new(2.0, 0.0, 0.0), Vec3::Y), SIZE)
}

/// In the shadow on the water, and in its bed's as well; and in the sun.
const SHADED: Vec3 = Vec3::new(3.6, 0.0, 0.0);
const SUNNY: Vec3 = Vec3::new(-6.0, 0.0, 1.0);

fn at(colours: &[[f32; 4]], place: Vec3) -> Vec3 {
    Vec3::from_slice(&colours[eye().pixel(place)])
}

#[test]
fn a_mesh_s_shadow_darkens_the_light_in_murky_water() {
    let mut stage = stage(SIZE, Water { optics: WaterOptics::GLACIER_MILK, ..still() });
    shine(&mut stage);
    eye().put(&mut stage);
    settle(&mut stage);
    let open = stage.colour();
    let plate = plate(&mut stage);
    (0..4).for_each(|_| stage.off.update());
    settle(&mut stage);
    let under = stage.colour();
    assert!(finite(&open) && finite(&under));
    let [shaded, sunny] = [SHADED, SUNNY].map(|place| at(&under, place) / at(&open, place));
    println!("under the plate's shadow {shaded:.3} of the light is left, in the sun {sunny:.3}");
    assert!(shaded.max_element() < 0.6 && shaded.min_element() > 0.02, "{shaded}");
    assert!((sunny - 1.0).abs().max_element() < 0.02, "{sunny}");
    // A light that casts no shadows casts none on water.
    let light =
        stage.world().query_filtered::<Entity, With<DirectionalLight>>().single(stage.world()).expect("one sun");
    stage.world().get_mut::<DirectionalLight>(light).expect("a light").shadow_maps_enabled = false;
    settle(&mut stage);
    let without = at(&stage.colour(), SHADED) / at(&open, SHADED);
    assert!((without - 1.0).abs().max_element() < 0.02, "{without}");
    stage.world().entity_mut(plate).despawn();
}

/// The bed's colour knows the shadow already: it must not be taken twice.
#[test]
fn a_shadow_on_the_bed_is_as_dark_as_in_air() {
    let mut stage = stage(SIZE, Water { optics: WaterOptics::PURE, foam: 0.0, ..still() });
    let water = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
    shine(&mut stage);
    mesh(&mut stage, Plane3d::default().mesh().size(80.0, 80.0), 0.7, Vec3::Y * -0.5);
    eye().put(&mut stage);
    let left = |stage: &mut Stage| {
        settle(stage);
        let open = at(&stage.colour(), SHADED);
        let plate = plate(stage);
        (0..4).for_each(|_| stage.off.update());
        settle(stage);
        let shaded = at(&stage.colour(), SHADED);
        stage.world().entity_mut(plate).despawn();
        shaded / open
    };
    let wet = left(&mut stage);
    stage.world().entity_mut(water).despawn();
    let dry = left(&mut stage);
    println!("in the shadow {wet:.3} is left under water, {dry:.3} in air; taken twice {:.3}", dry * dry);
    assert!(dry.max_element() < 0.4, "the bed must be in shadow: {dry}");
    assert!(wet.min_element() > 0.8 * dry.max_element(), "{wet} under water, {dry} in air");
    assert!(wet.max_element() < 0.5, "{wet}");
}
