//! What light does in an implicit world. Free of any engine: mathematics in Rust, generic over `f32` and `f64`, and the
//! same in directive-free WGSL beside it.
//!
//! Notation, here and in the shaders: `h` altitude over the ground's sphere of radius `R`, `mu` the cosine of the angle
//! between the local vertical and the view ray, `mu_s` that between the vertical and the sun, `nu` that between the view ray
//! and the sun; lengths in metres, coefficients per metre.

#![warn(missing_docs)]

pub mod bows;
pub mod clouds;
pub mod geometry;
pub mod medium;
pub mod models;
pub mod night;
pub mod phase;
pub mod profile;
pub mod reference;
pub mod solar;
pub mod spectrum;
pub mod sun;
pub mod water;
