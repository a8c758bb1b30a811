//! Bevy's clustered decals: they lie on meshes, and leave the ground and its light alone.

use bevy::asset::RenderAssetUsages;
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
use bevy::light::ClusteredDecal;
use bevy::pbr::{DefaultOpaqueRendererMethod, MeshPipeline};
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_resource::{CachedPipelineState, Extent3d, PipelineCache, TextureDimension, TextureFormat};
use bevy_horizon::prelude::*;
use bevy_horizon::world::Surface;
use bevy_horizon_workspace::stage::Stage;

const SIZE: [u32; 2] = [192, 108];

/// A field with a mesh plane over its right half, each under a light of its own.
fn stage(deferred: bool) -> Stage {
    let mut stage = Stage::new(SIZE[0], SIZE[1]);
    stage.light();
    let camera = stage.camera;
    let world = stage.world();
    if deferred {
        world.insert_resource(DefaultOpaqueRendererMethod::deferred());
        world.entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    }
    let base = Surface { colour: [0.3; 3], second: None, roughness: 1.0, reflectance: 0.0, ..default() };
    let material = TerrainMaterial { base, layers: Vec::new(), ..default() };
    world.spawn(Terrain { material, ..Terrain::new(Field::Constant(0.0)) });
    let plane = world.resource_mut::<Assets<Mesh>>().add(Plane3d::default().mesh().size(6.0, 6.0));
    let grey = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: LinearRgba::rgb(0.3, 0.3, 0.3).into(),
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..default()
    });
    world.spawn((Mesh3d(plane), MeshMaterial3d(grey), Transform::from_xyz(3.0, 0.1, 0.0)));
    for x in [-2.0, 2.0] {
        world.spawn((PointLight { intensity: 1e6, range: 30.0, ..default() }, Transform::from_xyz(x, 1.5, 1.0)));
    }
    stage.look(Transform::from_xyz(0.0, 5.0, 5.0).looking_at(Vec3::ZERO, Vec3::Y));
    stage.settle();
    stage
}

/// A decal of one square metre around a place, downwards.
fn decal(stage: &mut Stage, at: Vec3) {
    let size = Extent3d { width: 4, height: 4, depth_or_array_layers: 1 };
    let (format, usage) = (TextureFormat::Rgba8UnormSrgb, RenderAssetUsages::RENDER_WORLD);
    let red = Image::new_fill(size, TextureDimension::D2, &[255, 0, 0, 255], format, usage);
    let red = stage.world().resource_mut::<Assets<Image>>().add(red);
    let place = Transform::from_translation(at).looking_to(Vec3::NEG_Y, Vec3::NEG_Z);
    stage.world().spawn((ClusteredDecal { base_color_texture: Some(red), ..default() }, place));
}

/// The pixel in which a place is seen.
fn pixel(stage: &mut Stage, at: Vec3) -> usize {
    let camera = stage.camera;
    let world = stage.world();
    let (lens, place) = (world.get::<Camera>(camera).unwrap(), world.get::<GlobalTransform>(camera).unwrap());
    let [x, y] = lens.world_to_viewport(place, at).expect("it is in view").to_array().map(|c| c as usize);
    y * SIZE[0] as usize + x
}

#[test]
fn decals_lie_on_meshes_and_leave_the_ground_alone() {
    // Bevy mixes decals into the surfaces of its own materials, in the forward route.
    for deferred in [false, true] {
        let mut stage = stage(deferred);
        let render = stage.off.app.sub_app(RenderApp).world();
        assert!(render.resource::<MeshPipeline>().clustered_decals_are_usable, "the device must have decals");
        let plain = stage.colour();
        let places = [Vec3::new(2.0, 0.1, 0.0), Vec3::new(-2.0, 0.0, 0.0)];
        places.into_iter().for_each(|place| decal(&mut stage, place));
        // Bevy learns from the device how large its lists must be.
        (0..12).for_each(|_| stage.off.update());
        let decked = stage.colour();
        for pipeline in stage.off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines() {
            assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{:?}", pipeline.descriptor);
        }
        let [mesh, ground] = places.map(|at| pixel(&mut stage, at)).map(|i| [plain[i], decked[i]]);
        println!("deferred {deferred}: mesh {:?}, with the decal {:?}; ground {ground:?}", mesh[0], mesh[1]);
        assert!(mesh[0][1] > 0.05 && mesh[0][1] > 0.7 * mesh[0][0], "a grey mesh that is lit: {mesh:?}");
        // Bevy's deferred prepass has no decals.
        if !deferred {
            assert!(mesh[1][0] > 0.05 && mesh[1][1] < 0.4 * mesh[1][0], "with a red decal on it: {mesh:?}");
        }
        assert!(ground[0][1] > 0.05, "the ground is lit: {ground:?}");
        // The left half is ground.
        let left = (0..plain.len()).filter(|i| i % (SIZE[0] as usize) < SIZE[0] as usize / 2 - 4);
        let apart = |i: usize| (0..3).map(|k| (plain[i][k] - decked[i][k]).abs()).fold(0.0, f32::max);
        let worst = left.map(apart).fold(0.0, f32::max);
        assert!(worst <= 1.0 / 255.0, "deferred {deferred}: the ground differs by {worst}");
    }
}
