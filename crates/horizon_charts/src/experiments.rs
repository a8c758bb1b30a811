//! The table of experiments.

pub mod anchoring;
pub mod cameras;
pub mod costs;
pub mod march_cpu;
pub mod march_gpu;
pub mod naturalness;
pub mod queries;
pub mod seed_000;
pub mod sky;
pub mod trees;
pub mod water;

use crate::experiment::Experiment;

/// All experiments, in the order in which they run.
pub fn all() -> Vec<Box<dyn Experiment>> {
    vec![
        Box::new(march_gpu::MarchGpu),
        Box::new(costs::Costs),
        Box::new(queries::Queries),
        Box::new(seed_000::Seed000),
        Box::new(march_cpu::MarchCpu),
        Box::new(anchoring::Anchoring),
        Box::new(naturalness::Naturalness),
        Box::new(cameras::Cameras),
        Box::new(sky::Sky),
        Box::new(trees::Trees),
        Box::new(water::Water),
    ]
}
