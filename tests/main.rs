//! The integration tests: one binary.

mod anchoring;
mod compose;
mod engine;
mod first;
mod golden;
mod march;
mod stability;
mod stage;
