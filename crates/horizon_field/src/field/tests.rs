//! Tests of the field, over every kind of node and over random trees.

mod batches;
mod bounds;
mod kernels;
#[cfg(feature = "reflect")]
mod reflection;
mod trees;
mod values;
