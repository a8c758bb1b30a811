//! The views by which the march is judged: worlds and cameras where marches of height fields go wrong.

use bevy::math::{DVec3, Vec3};
use bevy::prelude::Transform;
use horizon_field::field::{Anchors, Clamp, Compiled, Field, Fractal, NoImages};
use horizon_field::fractal::Rule;
use horizon_field::truth::{Projection, TruthCamera};
use horizon_field::{Place, field::FieldError};

/// Alpine ground of so many octaves, usually 13: waves from 6 km down to 1.5 m.
pub fn mountains(octaves: f64) -> Field {
    Field::Fractal(Fractal {
        wavelength: 6000.0,
        amplitude: 1500.0,
        octaves,
        gain: 0.47,
        seed: 5,
        ..Fractal::default()
    })
}

/// A canyon with pillars some 20 m wide, cut off at the top: thinner than a usual fixed step (5 m + 0.4 % of the distance)
/// beyond 4 km, and than three pixels.
pub fn canyon() -> Field {
    Field::Add(vec![
        Field::Fractal(Fractal {
            rule: Rule::Fbm,
            wavelength: 900.0,
            amplitude: 260.0,
            octaves: 10.0,
            gain: 0.42,
            seed: 9,
            ..Fractal::default()
        }),
        Field::Clamp(Clamp {
            field: Field::Fractal(Fractal {
                wavelength: 60.0,
                amplitude: 330.0,
                octaves: 1.0,
                seed: 3,
                ..Fractal::default()
            })
            .into(),
            low: 105.0,
            high: 160.0,
        }),
    ])
}

/// A world and a camera in it.
#[derive(Clone, Debug)]
pub struct View {
    /// Its name.
    pub name: &'static str,
    /// The ground.
    pub field: Field,
    /// Where the camera stands: x and z, in metres from Bevy's origin.
    pub at: [f64; 2],
    /// How far above the ground, in metres.
    pub above: f64,
    /// Where it looks, before it is normalised.
    pub forward: [f32; 3],
    /// How far the ground is drawn, in metres.
    pub far: f32,
}

/// The four views of the charts: along a valley floor and level with it, over ridges, from the air, between pillars.
pub fn four() -> [View; 4] {
    [
        // Level, and along the lattice: the middle column's rays have x = 0, the middle row's y = 0.
        View {
            name: "valley",
            field: mountains(13.0),
            at: [120.0, 40.0],
            above: 1.7,
            forward: [0.0, 0.0, -1.0],
            far: 30_000.0,
        },
        View {
            name: "ridge",
            field: mountains(13.0),
            at: [900.5, -340.25],
            above: 60.0,
            forward: [1.0, -0.05, 0.0],
            far: 30_000.0,
        },
        View {
            name: "aerial",
            field: mountains(13.0),
            at: [0.0, 0.0],
            above: 1500.0,
            forward: [0.6, -0.5, -0.7],
            far: 30_000.0,
        },
        View {
            name: "canyon",
            field: canyon(),
            at: [10.0, 25.0],
            above: 12.0,
            forward: [0.3, -0.02, -1.0],
            far: 4_000.0,
        },
    ]
}

/// A view whose ground is compiled, at a place of the world.
pub struct Seen {
    /// The view.
    pub view: View,
    /// Its ground.
    pub ground: Compiled<2>,
    /// What Bevy's origin stands for.
    pub place: Place,
    anchors: Anchors<2>,
}

impl Seen {
    /// The view with Bevy's origin at `place`.
    pub fn new(view: View, place: Place) -> Result<Self, FieldError> {
        let ground = view.field.compile::<2>(&NoImages)?;
        let anchors = ground.anchor(&place);
        Ok(Self { view, ground, place, anchors })
    }

    /// The camera after it went so many metres along its way, always as far above the ground.
    pub fn pose(&self, travelled: f64) -> Transform {
        let forward = Vec3::from_array(self.view.forward).normalize();
        let level = DVec3::new(f64::from(forward.x), 0.0, f64::from(forward.z)).normalize_or(DVec3::NEG_Z);
        let at = [self.view.at[0] + travelled * level.x, self.view.at[1] + travelled * level.z];
        let y = self.ground.value_f64(&self.anchors, at, 0.0) + self.view.above;
        let up = if forward.y.abs() > 0.99 { Vec3::NEG_Z } else { Vec3::Y };
        Transform::from_xyz(at[0] as f32, y as f32, at[1] as f32).looking_to(forward, up)
    }
}

/// The camera of a truth picture for this pose, with a vertical field of view of `fov` radians.
pub fn truth_camera(pose: &Transform, fov: f32, [width, height]: [usize; 2]) -> TruthCamera {
    let axis = |v: Vec3| v.as_dvec3().normalize().to_array();
    TruthCamera {
        position: pose.translation.as_dvec3().to_array(),
        right: axis(*pose.right()),
        up: axis(*pose.up()),
        forward: axis(*pose.forward()),
        projection: Projection::Perspective { fov: f64::from(fov) },
        width,
        height,
    }
}

/// Distances along the rays, from a picture of reverse-z depth with an infinite far plane.
pub fn distances(depth: &[f32], camera: &TruthCamera, near: f32) -> Vec<Option<f64>> {
    let forward = DVec3::from_array(camera.forward);
    let distance = |(i, depth): (usize, &f32)| {
        let cosine = DVec3::from_array(camera.pixel_ray(i).direction()).dot(forward);
        (*depth > 0.0).then(|| f64::from(near) / f64::from(*depth) / cosine)
    };
    depth.iter().enumerate().map(distance).collect()
}
