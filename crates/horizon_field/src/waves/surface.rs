//! Answers: where the water stands, for games and servers.

use std::sync::{Arc, Mutex, PoisonError};

use super::{Sea, Tiles, tick};

/// A sea with the tiles of the last time that was asked for, so that thousands of questions a frame cost one transform.
#[derive(Debug)]
pub struct SeaSurface {
    sea: Arc<Sea>,
    last: Mutex<Option<(u32, Arc<Tiles>)>>,
}

impl SeaSurface {
    /// Answers for a sea.
    pub fn new(sea: Arc<Sea>) -> Self {
        Self { sea, last: Mutex::default() }
    }

    /// The sea.
    pub fn sea(&self) -> &Arc<Sea> {
        &self.sea
    }

    /// The tiles at a time in seconds. Who asks while they are made waits.
    pub fn tiles(&self, time: f64) -> Arc<Tiles> {
        let now = tick(time);
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((then, tiles)) if *then == now => tiles.clone(),
            _ => last.insert((now, Arc::new(self.sea.tiles(time)))).1.clone(),
        }
    }

    /// The height over a place (x, z), in metres above the water's level, at a time in seconds.
    pub fn height(&self, place: [f64; 2], time: f64) -> f64 {
        if self.sea.is_still() { 0.0 } else { self.tiles(time).height(place) }
    }

    /// The unit normal over a place (x, z), at a time in seconds.
    pub fn normal(&self, place: [f64; 2], time: f64) -> [f64; 3] {
        if self.sea.is_still() { [0.0, 1.0, 0.0] } else { self.tiles(time).normal(place) }
    }
}
