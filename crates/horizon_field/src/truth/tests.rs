//! Truth pictures of surfaces that can be reasoned about.

use super::{Projection, TruthCamera, TruthPicture};
use crate::march::fixtures::{Pillars, Plane, Waves};
use crate::march::{Cast, Counts, Surface, Tolerance, cast};

const SIZE: [usize; 2] = [48, 27];
const WIDE: Projection = Projection::Perspective { fov: 0.8 };

#[test]
fn a_flat_plane_has_silhouettes_only_at_its_edge() {
    let plane = Plane { height: 0.0, slope: [0.0; 2] };
    let camera = TruthCamera::looking_at([0.0, 100.0, 0.0], [1000.0, 100.0, 0.0], WIDE, SIZE);
    let picture = TruthPicture::compute(&plane, camera, 2000.0, 2);
    for (i, pixel) in picture.pixels.iter().enumerate() {
        let fall = -camera.pixel_ray(i).direction()[1];
        assert_eq!(pixel.is_hit(), fall > 0.05);
        if pixel.is_hit() {
            assert!((pixel.t - 100.0 / fall).abs() < 1e-9 * pixel.t);
        }
    }
    // The far plane's edge crosses each column once, within at most two of its pixels.
    let silhouettes = picture.pixels.iter().filter(|pixel| pixel.silhouette).count();
    assert!((1..=2 * SIZE[0]).contains(&silhouettes), "{silhouettes}");
}

#[test]
fn parallel_rays_see_a_plane_at_one_depth() {
    let plane = Plane { height: 3.0, slope: [0.0; 2] };
    let window = Projection::Orthographic { height: 90.0 };
    let camera = TruthCamera::looking_at([7.0, 103.0, -9.0], [7.0, 0.0, -9.0], window, SIZE);
    let picture = TruthPicture::compute(&plane, camera, 1000.0, 1);
    assert!(picture.pixels.iter().all(|pixel| (pixel.t - 100.0).abs() < 1e-9 && !pixel.silhouette));
    assert_eq!(camera.footprint(1.0), 90.0 / 27.0);
    // The top left pixel's centre lies up, −z, and left, −x.
    let corner = camera.pixel_ray(0).origin();
    assert!((corner[0] - (7.0 - 47.0 / 2.0 * 90.0 / 27.0)).abs() < 1e-9, "{corner:?}");
    assert!((corner[2] - (-9.0 - 26.0 / 2.0 * 90.0 / 27.0)).abs() < 1e-9, "{corner:?}");
}

#[test]
fn pillars_stand_out_as_silhouettes() {
    let pillars = Pillars { height: 80.0, radius: 40.0, spacing: 500.0 };
    let camera = TruthCamera::looking_at([250.0, 30.0, 250.0], [1000.0, 30.0, 1000.0], WIDE, SIZE);
    let picture = TruthPicture::compute(&pillars, camera, 5000.0, 2);
    let sky = SIZE[0] * SIZE[1] / 2;
    let standing = picture.pixels[..sky].iter().filter(|pixel| pixel.is_hit()).count();
    assert!(standing > 5, "{standing} pixels of pillars above the horizon");
    for (i, pixel) in picture.pixels.iter().enumerate().filter(|(i, _)| i % SIZE[0] + 1 < SIZE[0]) {
        assert!(pixel.range[0] <= pixel.t && pixel.t <= pixel.range[1]);
        if picture.pixels[i + 1].is_hit() != pixel.is_hit() {
            assert!(pixel.silhouette || picture.pixels[i + 1].silhouette, "an edge at pixel {i} without a silhouette");
        }
    }
}

#[test]
fn a_camera_under_the_ground_sees_it_at_once() {
    let camera = TruthCamera::looking_at([0.0, -700.0, 0.0], [1.0, -700.0, 0.0], WIDE, SIZE);
    let picture = TruthPicture::compute(&Waves::hills(), camera, 5000.0, 2);
    assert!(picture.pixels.iter().all(|pixel| pixel.t == 0.0 && !pixel.silhouette));
}

#[test]
fn beams_change_nothing() {
    let hills = Waves::hills();
    let pillars = Pillars { height: 80.0, radius: 0.5, spacing: 100.0 };
    fn compare(surface: &(impl Surface + Sync), camera: TruthCamera) {
        let picture = TruthPicture::compute(surface, camera, 30_000.0, 2);
        for (i, pixel) in picture.pixels.iter().enumerate() {
            let ray = camera.pixel_ray(i);
            match cast(surface, &ray, 30_000.0, Tolerance::default(), &mut Counts::default()) {
                Cast::Hit(hit) => assert!((hit.t - pixel.t).abs() < 1e-6, "{hit:?} and {pixel:?}"),
                Cast::Miss => assert_eq!(pixel.t, f64::INFINITY),
                Cast::Inside => assert_eq!(pixel.t, 0.0),
            }
        }
    }
    for projection in [WIDE, Projection::Orthographic { height: 300.0 }] {
        for (eye, target) in [
            ([30.0, 360.0, 10.0], [3000.0, 300.0, 1000.0]),
            ([250.0, 1500.0, 0.0], [250.0, 0.0, 0.0]),
            ([20.0, 40.0, 20.0], [500.0, 30.0, 700.0]),
        ] {
            compare(&hills, TruthCamera::looking_at(eye, target, projection, SIZE));
            compare(&pillars, TruthCamera::looking_at(eye, target, projection, SIZE));
        }
    }
}

#[test]
fn threads_change_nothing() {
    let camera = TruthCamera::looking_at([0.0, 500.0, 0.0], [3000.0, 0.0, 1000.0], WIDE, SIZE);
    let one = TruthPicture::compute(&Waves::hills(), camera, 30_000.0, 1);
    let three = TruthPicture::compute(&Waves::hills(), camera, 30_000.0, 3);
    assert_eq!(one.pixels, three.pixels);
    assert_eq!(one.counts, three.counts);
    assert!(one.silhouette_share() < 0.5);
}
