//! The scripted path: over the ground, along its valleys, not too low and not too high.

use bevy::prelude::*;
use bevy_horizon::query::Ground;
use bevy_horizon::scene::Viewpoint;

/// Between two points of the path, in metres.
const SPACING: f32 = 10.0;
/// Metres above the highest ground nearby, once the path has left the viewpoint's height.
const CLEARANCE: f32 = 45.0;
/// Metres above the ground, at least.
const LOWEST: f32 = 25.0;
/// How far ahead the camera looks, in metres.
const LOOK_AHEAD: f32 = 160.0;
/// The sharpest turn, in radians per metre.
const SHARPEST: f32 = 1.0 / 700.0;

/// A smooth path over the ground.
#[derive(Resource)]
pub struct Path {
    points: Vec<Vec3>,
    pitch: f32,
}

/// The level direction of a heading: from −z (north) towards +x (east).
pub fn direction(heading: f32) -> Vec3 {
    Vec3::new(heading.sin(), 0.0, -heading.cos())
}

impl Path {
    /// A path of this length in metres, from the viewpoint.
    pub fn plan(ground: &Ground, view: &Viewpoint, length: f32) -> Self {
        let count = (length / SPACING) as usize + 64;
        let course = course(ground, view, count);
        let floor: Vec<f32> = course.iter().map(|point| ground.height(*point)).collect();
        let heights = heights(&floor, view.above_ground);
        let points = course.iter().zip(heights).map(|(point, y)| point.with_y(y)).collect();
        Self { points, pitch: view.pitch }
    }

    /// How long the path is, in metres.
    pub fn length(&self) -> f32 {
        (self.points.len().saturating_sub(64)) as f32 * SPACING
    }

    /// The point after this many metres: a Catmull–Rom spline.
    pub fn at(&self, metres: f32) -> Vec3 {
        let s = (metres / SPACING).max(0.0);
        let (i, t) = (s as usize, s.fract());
        let p = |k: usize| self.points[(i + k).saturating_sub(1).min(self.points.len() - 1)];
        let (a, b, c, d) = (p(0), p(1), p(2), p(3));
        0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * (b - c) + d - a) * t * t * t)
    }

    /// The level direction of flight after this many metres.
    pub fn heading(&self, metres: f32) -> Vec3 {
        (self.at(metres + LOOK_AHEAD) - self.at(metres)).with_y(0.0).normalize_or(Vec3::NEG_Z)
    }

    /// The camera after this many metres, banked for this speed.
    pub fn pose(&self, metres: f32, speed: f32) -> Transform {
        let here = self.at(metres);
        // Half the climb, so that the horizon stays in sight.
        let ahead = ((self.at(metres + LOOK_AHEAD) - here) * Vec3::new(1.0, 0.5, 1.0)).normalize_or(Vec3::NEG_Z);
        let mut pose = Transform::from_translation(here).looking_to(ahead, Vec3::Y);
        pose.rotate_local_x(self.pitch);
        // A coordinated turn banks by atan(v² κ / g); a sixth of it is enough for the eye.
        let (now, then) = (self.heading(metres), self.heading(metres + SPACING));
        let curvature = now.cross(then).y / SPACING;
        pose.rotate_local_z((speed * speed * curvature / 9.81).atan() / 6.0);
        pose
    }
}

/// Points on the plane: the path bends towards lower ground, and forgets its first heading slowly.
fn course(ground: &Ground, view: &Viewpoint, count: usize) -> Vec<Vec3> {
    let [x, z] = view.position;
    let (mut point, mut heading, mut bend) = (Vec3::new(x, 0.0, z), view.heading, 0.0_f32);
    let mut course = Vec::with_capacity(count);
    for _ in 0..count {
        course.push(point);
        let aside = |angle: f32| {
            let towards = direction(heading + angle);
            [250.0, 500.0, 900.0].map(|far| ground.height(point + towards * far)).iter().sum::<f32>() / 3.0
        };
        let fall = (aside(-0.5) - aside(0.5)) / 500.0;
        let home = view.heading - heading;
        let wish = (0.004 * fall + 0.0003 * home).clamp(-SHARPEST, SHARPEST);
        bend += (wish - bend) * 0.08;
        heading += bend * SPACING;
        point += direction(heading) * SPACING;
    }
    course
}

/// The path's height over each ground height: an envelope that looks ahead, smoothed.
fn heights(floor: &[f32], start: f32) -> Vec<f32> {
    let mut heights = smoothed(envelope(floor, 4, 18));
    for (i, height) in heights.iter_mut().enumerate() {
        let left = (i as f32 * SPACING / 1500.0).min(1.0);
        *height += start.lerp(CLEARANCE, left * left * (3.0 - 2.0 * left));
    }
    // Smoothing may have cut through a sharp crest: lift the path there, just as smoothly.
    for _ in 0..8 {
        let lack: Vec<f32> = floor.iter().zip(&heights).map(|(floor, y)| (floor + LOWEST - y).max(0.0)).collect();
        if lack.iter().all(|lack| *lack <= 0.0) {
            break;
        }
        for (height, lift) in heights.iter_mut().zip(smoothed(envelope(&lack, 8, 8))) {
            *height += lift;
        }
    }
    heights
}

/// The highest value from so many places before to so many behind.
fn envelope(values: &[f32], before: usize, behind: usize) -> Vec<f32> {
    let window = |i: usize| &values[i.saturating_sub(before)..(i + behind + 1).min(values.len())];
    (0..values.len()).map(|i| window(i).iter().copied().fold(f32::MIN, f32::max)).collect()
}

/// Three running means: nearly a Gaussian.
fn smoothed(mut values: Vec<f32>) -> Vec<f32> {
    const REACH: usize = 10;
    for _ in 0..3 {
        let mean = |i: usize| {
            // The reach is the same on both sides, so that slopes at the path's start stay.
            let reach = REACH.min(i).min(values.len() - 1 - i);
            let window = &values[i - reach..=i + reach];
            window.iter().sum::<f32>() / window.len() as f32
        };
        values = (0..values.len()).map(mean).collect();
    }
    values
}
