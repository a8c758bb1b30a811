//! What water is held to.

mod body;
mod optics;
mod rough;
mod shader;
mod surface;
mod waves;
