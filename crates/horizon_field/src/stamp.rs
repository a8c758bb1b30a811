//! Stamps: local edits of the ground, so that a house stands level and a road lies smooth.
//!
//! A stamp is a shape in plan, what it does to the ground there, and how far outside of the shape that fades out. Data
//! flows through the files in this order: `edit` (parameters) → `ready` (one stamp, checked, as rounded boxes with their
//! heights) → `set` (all of them, in a stable order, with an `index`) → `part` (value and gradient) and `bound` (what is
//! proven over a box) → `view` (the stamps around a place). `stamp.wgsl` is `part`'s twin.
//!
//! With h the ground before a stamp, W from 0 to 1 how whole the stamp is at a point, and Y its height there, levelling makes
//! h + W (Y − h) of it, and raising h + W Y. W is 1 within the shape and falls off as 1 − smoothstep of the fifth degree
//! outside: the ground keeps a continuous gradient, and its curvature stays bounded. A path is cut into straight parts:
//! W is that of the nearest one, and Y the mean of the parts' planes, by how whole each is, so that no two of them meet
//! in a step.
//!
//! A hole has no part in that: the height is what it would be without, and within the shape there is no ground. What comes from
//! above goes in there, and what is under the ground does not meet it until it has come out, there or elsewhere.

mod bound;
mod edit;
mod index;
mod part;
mod path;
mod ready;
mod set;
mod view;

#[doc(hidden)]
pub mod arbitrary;
#[cfg(test)]
mod tests;

pub use edit::{Disc, Edit, Mode, Path, Placed, Rectangle, Shape, StampError, heading_of};
pub use ready::Ready;
pub use set::{Area, Stamps};
pub use view::StampsAt;

/// The WGSL twin. It calls `stamp_part(i: u32) -> StampPart`, which says where the parts lie that
/// [`StampsAt::append_bytes`] wrote.
pub const WGSL: &str = include_str!("stamp/stamp.wgsl");

/// Bytes of a part, as [`StampsAt::append_bytes`] writes it.
pub const PART_BYTES: usize = 56;
