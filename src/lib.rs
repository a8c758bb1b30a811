//! The workspace package: it owns the examples, the tests and the assets, and what the two share.

pub mod example;
pub mod judge;
pub mod offscreen;
pub mod stage;
pub mod views;
