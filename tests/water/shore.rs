//! The shore: where the ground goes through the level.

use bevy::ecs::system::RunSystemOnce;
use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::field::{HeightImage, ImageField, Remap};

use super::{Eye, FOV, Stage, finite, settle, stage, still};

/// How steeply the ground rises towards +x.
const SLOPE: f64 = 0.1;

/// A plane that is 0 m high near x = 0.
fn beach() -> Terrain {
    let mut png = std::io::Cursor::new(Vec::new());
    let image = image::ImageBuffer::<image::Luma<u16>, _>::from_fn(256, 4, |x, _| image::Luma([x as u16 * 257]));
    image::DynamicImage::ImageLuma16(image).write_to(&mut png, image::ImageFormat::Png).expect("it is an image");
    let (path, size) = ("beach".to_string(), 65_536.0);
    let image = ImageField { path: path.clone(), size: [size; 2], low: 0.0, high: size * SLOPE, ..default() };
    let to = [-0.5 * size * SLOPE, 1.0 - 0.5 * size * SLOPE];
    let mut terrain = Terrain::new(Field::Remap(Remap { field: Field::Image(image).into(), from: [0.0, 1.0], to }));
    let heights = HeightImage::from_png(png.get_ref()).expect("it is an image");
    terrain.images = [(path, heights)].into_iter().collect();
    terrain
}

/// Where the ground is 0 m high, by its own answers.
fn line(stage: &mut Stage) -> f32 {
    let ask = |ground: HorizonQuery| {
        let height = |x: f32, z: f32| ground.height(Vec3::new(x, 0.0, z)).expect("there is ground");
        let (mut wet, mut dry) = (-1000.0, 1000.0);
        for _ in 0..40 {
            let middle = 0.5 * (wet + dry);
            if height(middle, 0.0) < 0.0 { wet = middle } else { dry = middle }
        }
        let far = [-900.0, 900.0].map(|z| height(wet, z).abs());
        assert!(far.into_iter().all(|off| off < 1e-3), "the plane must be one: {far:?}");
        wet
    };
    stage.world().run_system_once(ask).expect("the query's resources are there")
}

#[test]
fn the_waterline_lies_where_the_plane_goes_through_the_level() {
    const SIZE: [u32; 2] = [160, 90];
    let slant = Transform::from_xyz(20.0, 15.0, 30.0).looking_to(Vec3::new(-0.5, -0.4, -1.0), Vec3::Y);
    let flat = Transform::from_xyz(30.0, 6.0, 0.0).looking_to(Vec3::new(-0.3, -0.05, -1.0), Vec3::Y);
    let eyes = [
        ("from above", Eye::down(Vec3::Y * 40.0, FOV, SIZE)),
        ("at a slant", Eye::new(slant, SIZE)),
        ("along the shore", Eye::new(flat, SIZE)),
    ];
    let mut stage = stage(SIZE, still());
    stage.light();
    stage.world().spawn(beach());
    let water = stage.world().query_filtered::<Entity, With<Water>>().single(stage.world()).expect("one water");
    stage.off.update();
    let line = line(&mut stage);
    for (name, eye) in eyes {
        eye.put(&mut stage);
        let [dry, wet] = [Visibility::Hidden, Visibility::Visible].map(|visibility| {
            stage.world().entity_mut(water).insert(visibility);
            settle(&mut stage);
            assert!(finite(&stage.colour()), "{name}");
            stage.depth()
        });
        let drawn = |i: usize| wet[i] > dry[i];
        let truth = |pixel: Vec2| eye.on_plane(pixel, 0.0).is_some_and(|point| point.x < line);
        let count = (0..eye.pixels()).filter(|i| drawn(*i)).count();
        let wrong = eye.misplaced(drawn, truth);
        println!("{name}: {count} pixels of water, {wrong} more than a pixel off");
        assert!(count > 1000 && count < eye.pixels() - 1000, "{name}: both must show: {count}");
        assert_eq!(wrong, 0, "{name}");
    }
}
