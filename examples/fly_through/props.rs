//! Meshes along the path, each put on the ground by a height query: standing, half buried, floating, behind ridges.

use std::f32::consts::PI;

use bevy::color::palettes::css;
use bevy::prelude::*;
use bevy_horizon::query::Ground;

use crate::flight::Path;
use Rest::{Floating, HalfBuried, Standing};
use Shape::{Arch, Column, Cube, Obelisk, Ring};

/// A mesh that this example put into the world.
#[derive(Component)]
pub struct Prop;

#[derive(Clone, Copy)]
enum Shape {
    Sphere,
    Cube,
    Column,
    Ring,
    Obelisk,
    Arch,
}

#[derive(Clone, Copy)]
enum Rest {
    Standing,
    HalfBuried,
    Floating,
}

/// Metres along the path, metres to the right of it, shape, size in metres, how it rests, colour.
const SITES: [(f32, f32, Shape, f32, Rest, Srgba); 18] = [
    (150.0, -38.0, Shape::Sphere, 14.0, HalfBuried, css::TOMATO),
    (190.0, 46.0, Cube, 12.0, Standing, css::GOLD),
    (240.0, -85.0, Obelisk, 34.0, Standing, css::GHOST_WHITE),
    (270.0, 22.0, Shape::Sphere, 6.0, Floating, css::DEEP_SKY_BLUE),
    (310.0, -30.0, Cube, 16.0, HalfBuried, css::ORANGE_RED),
    (350.0, 75.0, Column, 30.0, Standing, css::IVORY),
    (400.0, -60.0, Ring, 18.0, Floating, css::MEDIUM_ORCHID),
    (430.0, 40.0, Shape::Sphere, 20.0, HalfBuried, css::TURQUOISE),
    (480.0, -130.0, Arch, 36.0, Standing, css::ANTIQUE_WHITE),
    (520.0, 110.0, Obelisk, 40.0, Standing, css::CRIMSON),
    (560.0, -25.0, Column, 24.0, HalfBuried, css::LIMEGREEN),
    (600.0, 60.0, Ring, 24.0, HalfBuried, css::GOLD),
    (660.0, -90.0, Shape::Sphere, 30.0, HalfBuried, css::ROYAL_BLUE),
    (700.0, 150.0, Cube, 28.0, Floating, css::HOT_PINK),
    (740.0, 20.0, Arch, 40.0, Standing, css::SILVER),
    (800.0, -45.0, Cube, 20.0, HalfBuried, css::DARK_ORANGE),
    (860.0, 80.0, Shape::Sphere, 26.0, Floating, css::WHITE),
    (930.0, -120.0, Column, 40.0, Standing, css::TOMATO),
];
/// After so many metres the sites come again, on the other side of the path.
const PERIOD: f32 = 900.0;
/// Obelisks whose feet a ridge hides from the path's start, and their height in metres.
const BEHIND_RIDGES: usize = 4;
const TALL: f32 = 40.0;

/// Puts the meshes along the path.
pub fn spawn(
    commands: &mut Commands,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<StandardMaterial>,
    ground: &Ground,
    path: &Path,
) {
    let mut put = |shape: Shape, size: f32, place: Transform, colour: Srgba| {
        let material =
            materials.add(StandardMaterial { base_color: colour.into(), perceptual_roughness: 0.6, ..default() });
        let prop = commands.spawn((Prop, place, Visibility::default())).id();
        for (mesh, part) in parts(shape, size) {
            commands.spawn((Mesh3d(meshes.add(mesh)), MeshMaterial3d(material.clone()), part, ChildOf(prop)));
        }
    };
    for round in 0..((path.length() / PERIOD) as u32).max(1) {
        let side = if round.is_multiple_of(2) { 1.0 } else { -1.0 };
        for (along, aside, shape, size, rest, colour) in SITES {
            let along = along + round as f32 * PERIOD;
            put(shape, size, site(ground, path, along, aside * side, shape, size, rest), colour);
        }
    }
    for foot in behind_ridges(ground, path) {
        put(Obelisk, TALL, Transform::from_translation(foot), css::ORANGE);
    }
}

/// Where a shape stands, whose own origin is its middle.
fn site(ground: &Ground, path: &Path, along: f32, aside: f32, shape: Shape, size: f32, rest: Rest) -> Transform {
    let heading = path.heading(along);
    let right = heading.cross(Vec3::Y);
    let middle = path.at(along) + right * aside;
    // The lowest ground under it, so that nothing hovers over a slope.
    let reach = 0.35 * size;
    let under = [Vec3::ZERO, right * reach, -right * reach, heading * reach, -heading * reach];
    let lowest = under.map(|offset| ground.height(middle + offset)).into_iter().fold(f32::MAX, f32::min);
    let y = match rest {
        Standing => lowest + 0.5 * size,
        HalfBuried => ground.height(middle),
        Floating => ground.height(middle) + 0.5 * size + 8.0,
    };
    let turn = match shape {
        Arch | Ring => 0.0,
        _ => 0.013 * along,
    };
    Transform::from_translation(middle.with_y(y)).looking_to(heading, Vec3::Y)
        * Transform::from_rotation(Quat::from_rotation_y(turn))
}

/// The meshes of a shape of this height, about its middle.
fn parts(shape: Shape, size: f32) -> Vec<(Mesh, Transform)> {
    let alone = |mesh: Mesh| vec![(mesh, Transform::IDENTITY)];
    match shape {
        Shape::Sphere => alone(Sphere::new(0.5 * size).mesh().uv(48, 24)),
        Cube => alone(Cuboid::from_length(size).into()),
        Column => alone(Cylinder::new(0.12 * size, size).into()),
        Ring => vec![(
            Torus { minor_radius: 0.1 * size, major_radius: 0.4 * size }.into(),
            Transform::from_rotation(Quat::from_rotation_x(0.5 * PI)),
        )],
        Obelisk => alone(
            ConicalFrustum { radius_top: 0.02 * size, radius_bottom: 0.11 * size, height: size }
                .mesh()
                .resolution(4)
                .into(),
        ),
        Arch => {
            let pillar = Cuboid::new(0.18 * size, 0.8 * size, 0.2 * size);
            let lintel = Cuboid::new(size, 0.2 * size, 0.24 * size);
            let at = |x: f32, y: f32| Transform::from_xyz(x * size, y * size, 0.0);
            vec![(pillar.into(), at(-0.36, -0.1)), (pillar.into(), at(0.36, -0.1)), (lintel.into(), at(0.0, 0.4))]
        }
    }
}

/// The middles of obelisks that show over a ridge: seen from the path's start, their heads are in sight, their feet not.
fn behind_ridges(ground: &Ground, path: &Path) -> Vec<Vec3> {
    let eye = path.at(0.0);
    let hidden = |point: Vec3| {
        let (Ok(towards), far) = (Dir3::new(point - eye), point.distance(eye)) else { return true };
        ground.ray_cast(eye, towards, far).is_some()
    };
    let mut found = Vec::new();
    // Away from the middle, in turn to both sides: those that are found stand apart.
    for angle in [0.06, -0.12, 0.2, -0.28, 0.36, -0.44_f32] {
        let towards = Quat::from_rotation_y(angle) * path.heading(0.0);
        let place = (20..120).map(|step| {
            let foot = eye + towards * 15.0 * step as f32;
            foot.with_y(ground.height(foot))
        });
        let mut over_ridge =
            place.filter(|foot| hidden(*foot + Vec3::Y * 0.35 * TALL) && !hidden(*foot + Vec3::Y * 0.75 * TALL));
        found.extend(over_ridge.next().map(|foot| foot + Vec3::Y * 0.5 * TALL));
    }
    found.truncate(BEHIND_RIDGES);
    found
}
