//! The ladder of sky models, from the cheapest to the default; [`reference`](crate::reference) is what they answer to.
//!
//! | model | light | tables |
//! |---|---|---|
//! | [`gradient`] | two colours | none |
//! | [`planar`] | sunlight scattered once over flat ground | none |
//! | [`Scene`](scatter::Scene) with [`Once`](scatter::Once) | sunlight scattered once | transmittance |
//! | … with [`Isotropic`](isotropic::Isotropic) | all orders, isotropic from the second on (Hillaire 2020) | and 32 × 32 |
//! | … with [`Moments`](moments::Moments), the default | all orders, by spherical moments | and 32 × 12 of six colours |
//!
//! The precomputed four-dimensional tables of Bruneton and Neyret (2008) are not here: moments come within 1.2 % RMS of the Monte Carlo on
//! Earth, from a table of 384 texels where those have 2²⁰. Dust as on Mars is beyond them: see [`moments`].

pub mod air;
pub mod directions;
pub mod gradient;
pub mod isotropic;
pub mod moments;
pub mod planar;
pub mod scatter;
pub mod shaders;
pub mod sky_view;
pub mod steps;
pub mod table;
pub mod transmittance;

#[cfg(test)]
mod tests;
