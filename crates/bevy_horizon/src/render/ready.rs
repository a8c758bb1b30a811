//! How far the picture is: for loading screens and teleports.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use bevy::prelude::*;

/// Every tile that the cameras need is filled and lit, and no kernel is being compiled. Sent once each time that it becomes so.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorldReady;

/// How much of what the cameras need is up to date; sent when it changes.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorldProgress {
    /// Tiles that are up to date, and one for light and kernel of each cache, and one for each air.
    pub done: u32,
    /// Tiles in all, and one for each cache, and one for each air.
    pub total: u32,
}

/// What the renderer last counted. It has no say in what is drawn.
#[derive(Resource, Clone, Debug, Default)]
pub struct Progress(Arc<AtomicU64>);

impl Progress {
    pub(crate) fn set(&self, done: usize, total: usize) {
        self.0.store(((done as u64) << 32) | total as u64, Ordering::Relaxed);
    }

    /// More of the same frame.
    pub(crate) fn add(&self, done: usize, total: usize) {
        let WorldProgress { done: before, total: of } = self.get();
        self.set(before as usize + done, of as usize + total);
    }

    /// The counts of the last frame that was drawn.
    pub fn get(&self) -> WorldProgress {
        let both = self.0.load(Ordering::Relaxed);
        WorldProgress { done: (both >> 32) as u32, total: both as u32 }
    }
}

pub(crate) fn report(
    progress: Res<Progress>,
    mut last: Local<Option<WorldProgress>>,
    mut progressed: MessageWriter<WorldProgress>,
    mut ready: MessageWriter<WorldReady>,
) {
    let now = progress.get();
    if now.total == 0 || *last == Some(now) {
        return;
    }
    progressed.write(now);
    let was_done = last.is_some_and(|last| last.done == last.total);
    if now.done == now.total && !was_done {
        ready.write(WorldReady);
    }
    *last = Some(now);
}
