//! The passes that fill a sea's tiles on the device.

use bevy::prelude::{Transform, Vec3, default};
use bevy_horizon::prelude::{Water, WaterTime, Waves};
use bevy_horizon_workspace::stage::Stage;

use crate::context::Context;
use crate::measure::samples::median;

/// What the passes are called.
const PASS: &str = "horizon_sea";
/// Seconds of the waves from one frame to the next: in each the tiles are filled.
const STEP: f64 = 1.0 / 60.0;

/// What filling all tiles at all sizes takes, in milliseconds of the device: the median over frames.
pub fn fill_ms(ctx: &Context, waves: &Waves) -> f64 {
    let mut stage = Stage::new(64, 36);
    stage.world().spawn(Water { waves: waves.clone(), ..default() });
    stage.look(Transform::from_xyz(0.0, 10.0, 0.0).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y));
    stage.settle();
    // What went before is not counted.
    stage.spent(PASS);
    let mut times = Vec::new();
    for _ in 0..ctx.pick(5, 40) {
        stage.world().resource_mut::<WaterTime>().0 += STEP;
        stage.frame();
        times.extend(stage.spent(PASS));
    }
    median(times)
}
