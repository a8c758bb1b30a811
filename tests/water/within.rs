//! From under water, from its level, and from both sides at once.

use bevy::prelude::*;
use bevy_horizon::prelude::*;

use super::{Eye, NEAR, Stage, finite, settle, stage, still};

/// The sky's light alone, from all sides alike.
fn ambient(stage: &mut Stage) {
    stage.world().insert_resource(GlobalAmbientLight { brightness: 5000.0, ..default() });
}

/// Green at a point of a picture, between the centres of pixels.
fn green(eye: &Eye, colours: &[[f32; 4]], at: Vec2) -> f32 {
    let width = eye.size[0] as usize;
    let (floor, t) = ((at - 0.5).floor(), (at - 0.5).fract());
    let texel = |x: f32, y: f32| colours[(floor.y + y) as usize * width + (floor.x + x) as usize][1];
    let row = |y: f32| texel(0.0, y) + t.x * (texel(1.0, y) - texel(0.0, y));
    row(0.0) + t.y * (row(1.0) - row(0.0))
}

#[test]
fn snell_s_window_is_97_degrees_wide() {
    const SIZE: [u32; 2] = [160, 160];
    let water = still();
    let index = water.optics.index;
    let mut stage = stage(SIZE, water);
    ambient(&mut stage);
    for under in [1.0, 4.0] {
        let up = Transform::from_xyz(2.0, -under, 1.0).looking_to(Vec3::Y, Vec3::NEG_Z);
        let eye = Eye { pose: up, fov: 2.2, size: SIZE };
        eye.put(&mut stage);
        settle(&mut stage);
        let colours = stage.colour();
        assert!(finite(&colours));
        // The angle of total reflection, on the picture.
        let angle = (1.0 / index).asin();
        let expected = angle.tan() / eye.half().y * 0.5 * SIZE[1] as f32;
        let middle = 0.5 * eye.extent();
        let mut worst = 0.0f32;
        for turn in 0..16 {
            let along = Vec2::from_angle(turn as f32 * std::f32::consts::TAU / 16.0);
            let at = |radius: f32| green(&eye, &colours, middle + along * radius);
            let (bright, dark) = (at(expected - 3.0), at(expected + 5.0));
            assert!(bright > 4.0 * dark, "{under} m under: {bright} inside, {dark} outside");
            let radius = (0..320).map(|i| expected + 8.0 - 0.05 * i as f32).find(|r| at(*r) > 0.5 * (bright + dark));
            worst = worst.max((radius.expect("there is a step") - expected).abs());
        }
        println!("{under} m under: {:.1}° from the vertical, {worst:.2} px off {expected:.1}", angle.to_degrees());
        assert!((angle.to_degrees() - 48.6).abs() < 0.1 && worst <= 1.0, "{under} m under: {worst} px");
    }
}

/// The sky is brighter in the window than over the water: its cone is narrower there.
#[test]
fn the_zenith_is_brighter_from_within_by_the_square_of_the_index() {
    const SIZE: [u32; 2] = [33, 33];
    let mut stage = stage(SIZE, Water { optics: WaterOptics::PURE, ..still() });
    ambient(&mut stage);
    let at = Transform::from_xyz(0.0, -0.2, 0.0).looking_to(Vec3::Y, Vec3::NEG_Z);
    Eye::new(at, SIZE).put(&mut stage);
    settle(&mut stage);
    let zenith = stage.colour()[33 * 16 + 16][1];
    let sky = 5000.0 * bevy::camera::Exposure { ev100: 13.5 }.exposure();
    let index = WaterOptics::PURE.index;
    let expected = sky * index * index * (1.0 - ((index - 1.0) / (index + 1.0)).powi(2));
    println!("{zenith:.4}, should be {expected:.4}");
    // Over 10 cm and more of water.
    assert!((zenith / expected - 1.0).abs() < 0.02, "{zenith}, should be {expected}");
}

#[test]
fn every_pixel_is_finite_wherever_the_eye_is() {
    // Odd, so that a row and a column of rays are level and straight.
    const SIZE: [u32; 2] = [81, 45];
    let towards = [Vec3::NEG_Z, Vec3::NEG_Y, Vec3::Y, Vec3::new(0.3, -0.2, -1.0), Vec3::new(0.3, 0.2, -1.0)];
    for air in [false, true] {
        for waves in [Waves::Still, Waves::breeze()] {
            let mut stage = stage(SIZE, Water { waves: waves.clone(), ..default() });
            stage.light();
            if air {
                stage.world().spawn(Atmosphere::default());
            }
            for y in [0.0, 1e-4, -1e-4, 0.05, -0.05, 0.5, -0.5, -30.0, -3000.0, 3000.0] {
                for forward in towards {
                    let up = if forward.y.abs() > 0.9 { Vec3::NEG_Z } else { Vec3::Y };
                    Eye::new(Transform::from_xyz(0.0, y, 0.0).looking_to(forward, up), SIZE).put(&mut stage);
                    if y == 0.0 {
                        settle(&mut stage);
                    }
                    let (colour, depth) = (stage.colour(), stage.depth());
                    let name = || format!("air {air}, {}, at {y} m towards {forward}", waves.name());
                    assert!(finite(&colour), "{}", name());
                    assert!(depth.iter().all(|depth| depth.is_finite() && (0.0..=1.0).contains(depth)), "{}", name());
                    // Down there is only water, and what is deep in it is dark in itself.
                    assert!(forward != Vec3::NEG_Y || depth.iter().all(|depth| *depth > 0.0), "{}: a hole", name());
                }
            }
        }
    }
}

/// Deep down no light is left.
#[test]
fn far_under_it_is_dark() {
    const SIZE: [u32; 2] = [48, 48];
    let mut stage = stage(SIZE, still());
    ambient(&mut stage);
    let mut brightest = |y: f32| {
        Eye::new(Transform::from_xyz(0.0, y, 0.0).looking_to(Vec3::Y, Vec3::NEG_Z), SIZE).put(&mut stage);
        settle(&mut stage);
        stage.colour().iter().map(|c| c[1]).fold(0.0, f32::max)
    };
    let all: Vec<f32> = [-1.0, -20.0, -80.0, -600.0].map(&mut brightest).to_vec();
    println!("{all:?}");
    assert!(all.windows(2).all(|pair| pair[1] < 0.7 * pair[0]), "{all:?}");
    assert!(all[3] < 1e-4, "{all:?}");
}

/// The near plane goes through the surface: its upper part is over water, its lower part under.
#[test]
fn a_waterline_crosses_the_lens() {
    const SIZE: [u32; 2] = [80, 91];
    const OVER: f32 = 0.02;
    let mut stage = stage(SIZE, still());
    stage.light();
    let eye = Eye::new(Transform::from_xyz(0.0, OVER, 0.0), SIZE);
    eye.put(&mut stage);
    settle(&mut stage);
    let (colour, depth) = (stage.colour(), stage.depth());
    assert!(finite(&colour));
    // From over it one sees the level; from within, no surface any more.
    let seen = |i: usize| (depth[i] > 0.0).then(|| -eye.point(i, depth[i]).z);
    let line = |pixel: Vec2| OVER + NEAR * eye.ahead(pixel).y < 0.0;
    let sky = |pixel: Vec2| eye.ahead(pixel).y > 0.0;
    let within = |i: usize| {
        let level = eye.on_plane(eye.centre(i), 0.0).map(|p| -p.z);
        seen(i).is_some_and(|z| level.is_none_or(|level| (z - level).abs() > 0.01 * level))
    };
    let count = (0..eye.pixels()).filter(|i| within(*i)).count();
    assert!(count > eye.pixels() / 8 && count < eye.pixels() / 2, "{count} pixels are under water");
    assert_eq!(eye.misplaced(within, line), 0);
    assert_eq!(eye.misplaced(|i| seen(i).is_none(), sky), 0);
}
