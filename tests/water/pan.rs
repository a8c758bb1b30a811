//! A slow pan over a sea whose waves stand: what is too small to be seen is filtered, and does not sparkle.

use std::sync::Arc;

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::waves::{Sea, SeaSurface};
use horizon_light::water::surface::fresnel;

use super::{Eye, settle, stage};

const SIZE: [u32; 2] = [256, 144];
const FRAMES: usize = 60;
/// How far a frame turns, in pixels at the picture's middle.
const STEP: f32 = 0.25;
/// The eye over the level, in metres.
const ABOVE: f32 = 2.5;

/// What a pan looks at: a field of view, how far down, and where to, in radians.
#[derive(Clone, Copy)]
struct Pan {
    name: &'static str,
    fov: f32,
    pitch: f32,
    heading: f32,
}

impl Pan {
    fn eye(&self, frame: usize) -> Eye {
        let step = STEP * 2.0 * (0.5 * self.fov).tan() / SIZE[1] as f32;
        let turned = Quat::from_euler(EulerRot::YXZ, self.heading + step * frame as f32, -self.pitch, 0.0);
        Eye { pose: Transform::from_xyz(0.0, ABOVE, 0.0).with_rotation(turned), fov: self.fov, size: SIZE }
    }
}

/// Towards the sun and away from it, at all distances and, through a long lens, far away.
fn pans() -> [Pan; 3] {
    let towards = -Sun::default().azimuth;
    [
        Pan { name: "towards the sun", fov: 1.0, pitch: 0.2, heading: towards },
        Pan { name: "away from it", fov: 1.0, pitch: 0.2, heading: towards + 3.0 },
        Pan { name: "through a long lens", fov: 0.15, pitch: 0.04, heading: towards + 0.4 },
    ]
}

/// A picture in 255ths, as an eye would have it.
type Picture = Vec<[f32; 3]>;

fn shown(colour: f32) -> f32 {
    255.0 * colour.clamp(0.0, 1.0).sqrt()
}

/// What a picture has at a point, between its pixels.
fn between(picture: &[[f32; 3]], at: Vec2) -> Option<[f32; 3]> {
    let (floor, t) = ((at - 0.5).floor(), (at - 0.5) - (at - 0.5).floor());
    let [width, height] = SIZE.map(|side| side as i32);
    let (x, y) = (floor.x as i32, floor.y as i32);
    if x < 0 || y < 0 || x + 1 >= width || y + 1 >= height {
        return None;
    }
    let of = |x: i32, y: i32| picture[(y * width + x) as usize];
    let [a, b, c, d] = [of(x, y), of(x + 1, y), of(x, y + 1), of(x + 1, y + 1)];
    Some([0, 1, 2].map(|k| {
        let [row, next] = [a[k] + t.x * (b[k] - a[k]), c[k] + t.x * (d[k] - c[k])];
        row + t.y * (next - row)
    }))
}

/// How far pictures of a pan are from the ones before them, brought to their places: on average, and at the 99.9th percentile.
fn difference(pan: &Pan, mut picture: impl FnMut(&Eye) -> Picture) -> [f32; 2] {
    let mut all = Vec::new();
    let mut last: Option<(Eye, Picture)> = None;
    for frame in 0..FRAMES {
        let eye = pan.eye(frame);
        let now = picture(&eye);
        if let Some((before, last)) = &last {
            for (i, now) in now.iter().enumerate() {
                let Some(was) = between(last, before.towards(eye.ahead(eye.centre(i)))) else { continue };
                all.extend([0, 1, 2].map(|k| (now[k] - was[k]).abs()));
            }
        }
        last = Some((eye, now));
    }
    let mean = all.iter().map(|x| f64::from(*x)).sum::<f64>() / all.len() as f64;
    let at = (all.len() - 1) * 999 / 1000;
    let (_, p999, _) = all.select_nth_unstable_by(at, f32::total_cmp);
    [mean as f32, *p999]
}

/// Light without a filter: the surface's own normal where a pixel's ray meets the level, which mirrors a sky that darkens upward.
fn unfiltered(surface: &SeaSurface, eye: &Eye) -> Picture {
    let sky = |direction: Vec3| 0.7 - 0.6 * direction.y.clamp(0.0, 1.0).sqrt();
    let light = |i: usize| {
        let pixel = eye.centre(i);
        let ahead = eye.ahead(pixel).normalize();
        let Some(point) = eye.on_plane(pixel, 0.0) else { return sky(ahead) };
        let normal = surface.normal([point.x.into(), point.z.into()], 0.0).map(|x| x as f32);
        let normal = Vec3::from_array(normal);
        let mirrored = ahead - 2.0 * ahead.dot(normal) * normal;
        fresnel(ahead.dot(normal).abs(), 1.333) * sky(mirrored.with_y(mirrored.y.abs()))
    };
    (0..eye.pixels()).map(|i| [shown(light(i)); 3]).collect()
}

#[test]
fn a_slow_pan_does_not_sparkle() {
    let sea = Sea::new(&Waves::breeze()).expect("in range");
    let surface = SeaSurface::new(Arc::new(sea));
    let mut failed = Vec::new();
    for pan in pans() {
        let mut stage = stage(SIZE, Water::default());
        stage.light();
        stage.world().spawn(Atmosphere::default());
        pan.eye(0).put(&mut stage);
        settle(&mut stage);
        let ours = difference(&pan, |eye| {
            eye.put(&mut stage);
            stage.colour().iter().map(|c| [0, 1, 2].map(|k| shown(c[k]))).collect()
        });
        let naive = difference(&pan, |eye| unfiltered(&surface, eye));
        println!(
            "{}: mean {:.3}, p99.9 {:.2} of 255; unfiltered {:.3}, {:.2}",
            pan.name, ours[0], ours[1], naive[0], naive[1]
        );
        assert!(naive[0] > 1.0 && naive[1] > 8.0, "{}: an unfiltered sea must sparkle: {naive:?}", pan.name);
        if ours[0] > 1.0 || ours[1] > 8.0 {
            failed.push(format!("{}: mean {}, p99.9 {}", pan.name, ours[0], ours[1]));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
