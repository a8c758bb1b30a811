//! A sea without end, and without ground: it reaches the horizon, which lies on the eye's level.

use bevy::prelude::*;
use bevy_horizon::prelude::*;
use horizon_field::waves::Sines;

use super::{Eye, finite, settle, stage, still};

const SIZE: [u32; 2] = [160, 120];
/// How far down the camera looks, in radians.
const PITCH: f32 = 0.1;

fn eye(above: f32) -> Eye {
    let down = Quat::from_euler(EulerRot::YXZ, 0.7, -PITCH, 0.0);
    Eye::new(Transform::from_xyz(12.0, above, -3.0).with_rotation(down), SIZE)
}

#[test]
fn the_horizon_lies_on_the_eye_s_level() {
    // Level rays have one row, for the camera does not roll: tan(pitch) over tan(fov/2), of half the height, over the middle.
    let expected = 0.5 * SIZE[1] as f32 * (1.0 - PITCH.tan() / eye(1.0).half().y);
    // One wave, all of whose crests are as high as any may be.
    let sine = Waves::Sines(Sines { count: 1, ..default() });
    let cases = [
        (None, Waves::Still),
        (None, sine),
        (None, Waves::breeze()),
        (Some(SkyModel::Gradient), Waves::breeze()),
        (Some(SkyModel::Full), Waves::Still),
        (Some(SkyModel::Full), Waves::breeze()),
    ];
    for (air, waves) in cases {
        let mut stage = stage(SIZE, Water { waves: waves.clone(), ..still() });
        stage.light();
        if let Some(model) = air {
            stage.world().spawn(Atmosphere { model, ..default() });
        }
        for above in [2.0, 2000.0] {
            eye(above).put(&mut stage);
            settle(&mut stage);
            let depth = stage.depth();
            let width = SIZE[0] as usize;
            let mut worst = 0.0f32;
            for x in 0..width {
                let column = || (0..SIZE[1] as usize).map(|y| depth[y * width + x]);
                let first = column().position(|depth| depth > 0.0).expect("there is sea");
                assert!(column().skip(first).all(|depth| depth > 0.0), "column {x} has holes");
                // The border lies over the first row of water.
                worst = worst.max((first as f32 - expected).abs());
            }
            println!("{air:?}, {}, from {above} m: the horizon is {worst:.2} px off row {expected:.2}", waves.name());
            assert!(worst <= 1.0, "{air:?}, {}, from {above} m: {worst} px", waves.name());
            assert!(finite(&stage.colour()));
            // A square of 60 km would end this far below.
            let naive = above / 60_000.0 * 0.5 * SIZE[1] as f32 / eye(above).half().y;
            assert!(above < 100.0 || naive > 3.0, "{naive} px");
        }
    }
}
