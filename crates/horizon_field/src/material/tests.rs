//! The material: what is refused, what filters, what the shader is made of.

mod filter;
#[cfg(feature = "reflect")]
mod reflection;
mod refusal;
mod shader;
