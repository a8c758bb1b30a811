//! The integration tests: one binary.

mod anchoring;
mod compose;
mod device;
mod editing;
mod engine;
mod golden;
mod march;
mod parity;
mod queries;
mod shaders;
mod stability;
mod worlds;
