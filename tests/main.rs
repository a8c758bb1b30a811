//! The integration tests: one binary.

mod anchoring;
mod bodies;
mod compose;
mod device;
mod editing;
mod engine;
mod figures;
mod golden;
mod heat;
mod lighting;
mod march;
mod material;
mod motion;
mod moving;
mod parity;
mod picking;
mod queries;
mod rivals;
mod scaling;
mod shaders;
mod shadows;
mod sky;
mod stability;
mod stamps;
mod trees;
mod worlds;
