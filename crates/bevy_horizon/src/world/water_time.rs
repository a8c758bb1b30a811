//! The time of the waves.

use bevy::prelude::*;

/// The time of all waves, in seconds: what is drawn, and what to ask for to get what is drawn. It goes on with Bevy's virtual time,
/// in `PreUpdate`. A game may set it, each frame if it likes: a server's clients to the server's time, a replay to its own. No
/// value is too large.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Deref, DerefMut, Reflect)]
#[reflect(Resource, Default, Clone, PartialEq)]
pub struct WaterTime(pub f64);

pub(crate) fn advance_water(time: Res<Time<Virtual>>, mut water: ResMut<WaterTime>) {
    water.0 += time.delta_secs_f64();
}
