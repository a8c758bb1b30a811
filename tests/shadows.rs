//! Shadows both ways: where their edges lie, and that what a ridge hides from the sun is dark however far away it is, ground and
//! meshes alike. The truth is the certified ray cast of the full field.

use bevy::camera::ScalingMode;
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
use bevy::ecs::system::SystemState;
use bevy::light::CascadeShadowConfigBuilder;
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use bevy_horizon::world::Surface;
use bevy_horizon_workspace::stage::Stage;
use horizon_field::field::{Fractal, Noise};

const ALBEDO: f32 = 0.3;

fn terrain(field: Field) -> Terrain {
    let base = Surface { colour: [f64::from(ALBEDO); 3], roughness: 1.0, reflectance: 0.0, ..default() };
    let material = TerrainMaterial { base, layers: Vec::new(), ..default() };
    Terrain { material, ..Terrain::new(field) }
}

fn grey(stage: &mut Stage) -> Handle<StandardMaterial> {
    stage.world().resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: LinearRgba::rgb(ALBEDO, ALBEDO, ALBEDO).into(),
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..default()
    })
}

/// A stage over a field, under a sun.
fn stage(field: Field, towards_sun: Vec3, size: [u32; 2], reach: f32, deferred: bool) -> Stage {
    let mut stage = Stage::new(size[0], size[1]);
    let camera = stage.camera;
    let world = stage.world();
    if deferred {
        world.insert_resource(DefaultOpaqueRendererMethod::deferred());
        world.entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    }
    world.spawn(terrain(field));
    world.insert_resource(GlobalAmbientLight { brightness: 500.0, ..default() });
    let cascades = CascadeShadowConfigBuilder { num_cascades: 1, maximum_distance: reach, ..default() }.build();
    // Bevy's bias moves every edge by itself.
    let light = DirectionalLight {
        illuminance: 60_000.0,
        shadow_maps_enabled: true,
        shadow_depth_bias: 0.0,
        shadow_normal_bias: 0.0,
        ..default()
    };
    world.spawn((light, cascades, Transform::default().looking_to(-towards_sun, Vec3::Y)));
    (0..2).for_each(|_| stage.off.update());
    stage
}

/// Whether the ground hides the sun's centre from a point.
fn hidden(stage: &mut Stage, point: Vec3, towards_sun: Vec3) -> bool {
    let mut system = SystemState::<HorizonQuery>::new(stage.world());
    let query = system.get(stage.world()).expect("the query's resources are there");
    query.ray_cast(point, Dir3::new(towards_sun).expect("a direction"), 5000.0).is_some()
}

fn height(stage: &mut Stage, x: f32, z: f32) -> f32 {
    let mut system = SystemState::<HorizonQuery>::new(stage.world());
    system
        .get(stage.world())
        .expect("the query's resources are there")
        .height(Vec3::new(x, 0.0, z))
        .expect("there is ground")
}

/// Straight down on a square of so many metres, `above` metres over its middle.
fn look_down(stage: &mut Stage, middle: Vec3, metres: f32, above: f32) {
    let camera = stage.camera;
    let scaling_mode = ScalingMode::FixedVertical { viewport_height: metres };
    let lens = OrthographicProjection { scaling_mode, near: 0.1, ..OrthographicProjection::default_3d() };
    stage.world().entity_mut(camera).insert(Projection::Orthographic(lens));
    // x to the right, z down.
    stage.look(Transform::from_translation(middle + Vec3::Y * above).looking_to(Vec3::NEG_Y, Vec3::NEG_Z));
}

/// Where in a row, in pixels, it turns from dark to light or from light to dark; the middle between its extremes.
fn edge(row: &[[f32; 4]]) -> Option<f32> {
    let low = row.iter().map(|p| p[1]).fold(f32::INFINITY, f32::min);
    let high = row.iter().map(|p| p[1]).fold(0.0, f32::max);
    let middle = 0.5 * (low + high);
    let at = row.windows(2).position(|pair| (pair[0][1] < middle) != (pair[1][1] < middle))?;
    let [a, b] = [row[at][1], row[at + 1][1]];
    (high > 3.0 * low).then(|| at as f32 + 0.5 + (middle - a) / (b - a))
}

/// Between two points of a line, the first in shadow and the last in light, the point where that changes.
fn bisect(mut hidden: impl FnMut(f32) -> bool, mut dark: f32, mut light: f32) -> f32 {
    assert!(hidden(dark) && !hidden(light), "the edge must lie between {dark} and {light}");
    for _ in 0..24 {
        let middle = 0.5 * (dark + light);
        if hidden(middle) { dark = middle } else { light = middle }
    }
    0.5 * (dark + light)
}

/// A smooth hill, steeper than the sun stands high over it: metres along x of its crest.
fn hill() -> (Field, f32) {
    let hill = Fractal { wavelength: 80.0, amplitude: 40.0, octaves: 4.0, gain: 0.2, seed: 4, ..default() };
    let field = Field::Fractal(hill);
    let compiled = field.compile::<2>(&horizon_field::field::NoImages).expect("the field is good");
    let anchors = compiled.anchor(&Place::ORIGIN);
    let at = |x: f32| compiled.value_f64(&anchors, [f64::from(x), 20.0], 0.0) as f32;
    let crest = (-400..400).map(|x| x as f32).max_by(|a, b| at(*a).total_cmp(&at(*b))).expect("a range");
    (field, crest)
}

#[test]
fn the_shadow_of_a_hill_on_a_mesh_ends_where_it_should() {
    const SIZE: u32 = 160;
    const METRES: f32 = 8.0;
    /// The tangent of the sun's elevation.
    const RISE: f32 = 0.25;
    let mut measured = Vec::new();
    for deferred in [false, true] {
        let (field, crest) = hill();
        // The sun stands over −x.
        let towards_sun = Vec3::new(-1.0, RISE, 0.0).normalize();
        let mut stage = stage(field, towards_sun, [SIZE, SIZE], 24.0, deferred);
        // Some way down the lee, as high as the shadow is over the ground there: it ends on what is level at that height.
        let lee = crest + 30.0;
        let ridge = (0..100).map(|i| crest - 5.0 + 0.25 * i as f32);
        let rays: Vec<f32> = ridge.map(|x| height(&mut stage, x, 20.0) - RISE * (lee - x)).collect();
        let level = rays.into_iter().fold(f32::NEG_INFINITY, f32::max);
        let edge_at = bisect(|x| hidden(&mut stage, Vec3::new(x, level, 20.0), towards_sun), lee - 3.0, lee + 3.0);
        let middle = Vec3::new(edge_at, level, 20.0);
        for k in 0..9 {
            let [x, z] = [k % 3 - 1, k / 3 - 1].map(|i| i as f32 * 0.5 * METRES);
            let below = level - height(&mut stage, middle.x + x, middle.z + z);
            assert!(below > 1.0, "the mesh must lie over the ground, not in it: by {below} m");
        }
        let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Plane3d::default().mesh().size(12.0, 12.0));
        let material = grey(&mut stage);
        stage.world().spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_translation(middle)));
        look_down(&mut stage, middle, METRES, 8.0);
        stage.settle();
        let picture = stage.colour();
        let mut errors = Vec::new();
        for row in (8..SIZE as usize - 8).step_by(8) {
            let z = middle.z + (row as f32 + 0.5 - SIZE as f32 / 2.0) * METRES / SIZE as f32;
            let truth =
                bisect(|x| hidden(&mut stage, Vec3::new(x, level, z), towards_sun), edge_at - 3.0, edge_at + 3.0);
            let truth = (truth - middle.x) * SIZE as f32 / METRES + SIZE as f32 / 2.0;
            let drawn =
                edge(&picture[row * SIZE as usize..(row + 1) * SIZE as usize]).expect("the shadow ends in the row");
            errors.push((drawn - truth).abs());
        }
        let mean = errors.iter().sum::<f32>() / errors.len() as f32;
        let worst = errors.iter().copied().fold(0.0, f32::max);
        println!(
            "deferred {deferred}: the edge is off by {mean:.2} px, at most {worst:.2}, at {} m a pixel",
            METRES / SIZE as f32
        );
        measured.push((deferred, mean, worst));
    }
    for (deferred, mean, worst) in measured {
        // A pixel is 5 cm. Where the ray grazes, patches bow by some millimetres, which the sun throws four times as far. The table
        // knows the shadow's height to half a percent; the map has the ground in quads of several texels.
        let [few, most] = if deferred { [0.6, 1.1] } else { [0.95, 1.5] };
        assert!(mean < few && worst < most, "deferred {deferred}: {mean}, {worst}");
    }
}

#[test]
fn the_shadow_of_a_box_on_a_field_ends_where_it_should() {
    const SIZE: u32 = 160;
    const METRES: f32 = 6.0;
    for deferred in [false, true] {
        let towards_sun = Vec3::new(-1.0, 0.8, 0.0).normalize();
        let mut stage = stage(Field::Constant(0.0), towards_sun, [SIZE, SIZE], 24.0, deferred);
        let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Cuboid::new(1.0, 2.0, 30.0));
        let material = grey(&mut stage);
        stage.world().spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_xyz(-0.5, 1.0, 0.0)));
        // From the box's upper far edge, over x = 0.
        let edge_at = 2.0 / 0.8;
        look_down(&mut stage, Vec3::new(edge_at, 0.0, 0.0), METRES, 8.0);
        stage.settle();
        let picture = stage.colour();
        let half = SIZE as usize / 2;
        // Right of the box itself.
        let first = ((0.2 - edge_at) * SIZE as f32 / METRES) as i32 + half as i32;
        let row = &picture[half * SIZE as usize + first as usize..(half + 1) * SIZE as usize];
        let drawn = edge(row).expect("the shadow ends in the row") + first as f32;
        println!("deferred {deferred}: the edge is at pixel {drawn:.2}, and should be at {half}");
        assert!((drawn - half as f32).abs() < 1.0, "deferred {deferred}: {drawn}");
    }
}

/// Flat ground between ridges.
fn ridges() -> Field {
    let range = Fractal { wavelength: 1400.0, amplitude: 520.0, octaves: 3.0, seed: 8, ..default() };
    Field::Max(vec![Field::Constant(0.0), Field::Add(vec![Field::Fractal(range), Field::Constant(-60.0)])])
}

#[test]
fn a_mesh_two_kilometres_away_lies_in_the_shadow_that_the_ground_lies_in() {
    let towards_sun = Vec3::new(-0.8, 0.25, 0.5).normalize();
    let mut stage = stage(ridges(), towards_sun, [160, 90], 150.0, true);
    // Level ground in the shadow, and in the light, and a place 2 km away from which it is seen.
    let mut found = [None, None];
    for i in 0..4000 {
        let at = Vec3::new((i % 64) as f32 * 90.0 - 2800.0, 0.0, (i / 64) as f32 * 90.0 - 2800.0);
        let flat = (0..9)
            .all(|k| height(&mut stage, at.x + (k % 3 - 1) as f32 * 40.0, at.z + (k / 3 - 1) as f32 * 40.0) == 0.0);
        if !flat {
            continue;
        }
        let around = [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z].map(|d| at + d * 45.0 + Vec3::Y * 0.3);
        let dark = around.iter().filter(|p| hidden(&mut stage, **p, towards_sun)).count();
        let eye = at + Vec3::new(1400.0, 1000.0, 1000.0);
        if (dark == 0 || dark == around.len()) && !hidden(&mut stage, at + Vec3::Y, eye - at) {
            found[usize::from(dark == 0)].get_or_insert((at, eye));
        }
    }
    let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Plane3d::default().mesh().size(30.0, 30.0));
    let material = grey(&mut stage);
    let camera = stage.camera;
    stage.world().entity_mut(camera).insert(Projection::Perspective(PerspectiveProjection {
        fov: 0.03,
        near: 0.1,
        far: 5000.0,
        ..default()
    }));
    let mut brightness = [0.0; 2];
    for (i, place) in found.into_iter().enumerate() {
        let (at, eye) = place.expect("there is such a place");
        let transform = Transform::from_translation(at + Vec3::Y * 0.5);
        let plane = stage.world().spawn((Mesh3d(mesh.clone()), MeshMaterial3d(material.clone()), transform)).id();
        stage.look(Transform::from_translation(eye).looking_at(at, Vec3::Y));
        stage.settle();
        let picture = stage.off.screenshot();
        let mean = |from: [u32; 2]| {
            let pixels = (0..64).map(|k| picture.get_pixel(from[0] + k % 8, from[1] + k / 8)[1]);
            pixels.map(f64::from).sum::<f64>() / 64.0
        };
        let (on_mesh, beside) = (mean([76, 41]), mean([10, 41]));
        println!("{}: mesh {on_mesh:.2}, ground beside it {beside:.2}", ["shadow", "light"][i]);
        assert!((on_mesh - beside).abs() < 2.0, "{on_mesh} on the mesh, {beside} on the ground");
        brightness[i] = on_mesh;
        stage.world().entity_mut(plane).despawn();
    }
    assert!(brightness[1] > 3.0 * brightness[0], "shadow and light must differ: {brightness:?}");
}

#[test]
fn a_sun_below_the_horizon_lights_nothing() {
    for deferred in [false, true] {
        // Slopes face it all the same.
        let field = Field::Noise(Noise { wavelength: 300.0, amplitude: 120.0, seed: 2, ..default() });
        let mut stage = stage(field, Vec3::new(-1.0, -0.18, 0.0).normalize(), [96, 54], 150.0, deferred);
        stage.world().insert_resource(GlobalAmbientLight { brightness: 0.0, ..default() });
        let ground = height(&mut stage, 0.0, 0.0);
        let eye = Vec3::new(0.0, ground + 120.0, 0.0);
        stage.look(Transform::from_translation(eye).looking_to(Vec3::new(0.7, -0.4, -0.7), Vec3::Y));
        stage.settle();
        let brightest = stage.colour().iter().map(|pixel| pixel[1]).fold(0.0, f32::max);
        println!("deferred {deferred}: the brightest pixel is {brightest}");
        // That of the colour to which the view was cleared.
        assert!(brightest < 0.026, "deferred {deferred}: {brightest}");
    }
}

#[test]
fn a_camera_without_worlds_has_none_of_their_shadows() {
    // A mesh under the ground, seen by a camera that does not see the ground.
    let mut stage = stage(Field::Constant(0.0), Vec3::new(-0.5, 1.0, 0.2).normalize(), [64, 64], 60.0, false);
    let mesh = stage.world().resource_mut::<Assets<Mesh>>().add(Plane3d::default().mesh().size(20.0, 20.0));
    let material = grey(&mut stage);
    stage.world().spawn((Mesh3d(mesh), MeshMaterial3d(material), Transform::from_xyz(0.0, -25.0, 0.0)));
    look_down(&mut stage, Vec3::new(0.0, -25.0, 0.0), 8.0, 6.0);
    let middle = |stage: &mut Stage| {
        (0..6).for_each(|_| stage.off.update());
        stage.colour()[32 * 64 + 32][1]
    };
    let camera = stage.camera;
    let under_ground = middle(&mut stage);
    stage.world().entity_mut(camera).remove::<HorizonCamera>();
    // Somebody else looks at the world.
    let target = stage.off.target();
    stage.world().spawn((
        Camera3d::default(),
        Camera { order: -1, ..default() },
        target,
        HorizonCamera::default(),
        Transform::from_xyz(0.0, 30.0, 0.0).looking_to(Vec3::new(0.0, -0.5, -1.0), Vec3::Y),
    ));
    let alone = middle(&mut stage);
    println!("{under_ground} for a camera that sees worlds, {alone} for one that does not");
    assert!(alone > 0.05, "{alone}");
}
