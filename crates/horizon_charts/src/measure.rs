//! Measures of ground: what its heights, slopes and spectrum are like.

pub mod relief;
pub mod samples;
pub mod spectrum;

pub use relief::Relief;
