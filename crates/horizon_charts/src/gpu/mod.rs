//! Measuring on the device, through Bevy: the shipped passes, off screen.

mod rig;
mod truths;

pub use rig::{Cost, Rig, Shot};
pub use truths::truth;
