//! The table of experiments.

pub mod anchoring;
pub mod costs;
pub mod march_gpu;
pub mod naturalness;
pub mod queries;

use crate::experiment::Experiment;

/// All experiments, in the order in which they run.
pub fn all() -> Vec<Box<dyn Experiment>> {
    vec![Box::new(march_gpu::MarchGpu), Box::new(costs::Costs), Box::new(naturalness::Naturalness), Box::new(anchoring::Anchoring), Box::new(queries::Queries)]
}
