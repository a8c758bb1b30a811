//! What an implicit world is: hash, lattice, noise, fractals, the field tree, its bounds, its shader, the ground's
//! material, and the certified march that answers for all of them. There is no rendering in here: a server builds it as it is.
#![deny(missing_docs)]

pub mod field;
pub mod fractal;
pub mod hash;
pub mod lattice;
pub mod march;
pub mod material;
#[cfg(feature = "baselines")]
pub mod methods;
pub mod metrics;
pub mod noise;
pub mod place;
pub mod real;
pub mod stamp;
pub mod trees;
pub mod truth;
pub mod waves;

pub use field::{Bound, Compiled, Field, FieldError};
pub use lattice::{LatticePoint, Layer};
pub use place::{CELL, Place};
pub use real::{Jet, Real};
pub use stamp::Stamps;
pub use waves::{Sea, Waves};
