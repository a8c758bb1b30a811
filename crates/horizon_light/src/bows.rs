//! Rainbows, halos, sun dogs and the circumzenithal arc: light that drops and crystals gather at certain angles. Made here, once for a
//! size of drop or an elevation of the sun, as small tables over an angle, which a host puts into textures.
//!
//! | piece | answers |
//! |---|---|
//! | [`index`] | refractive index of water and ice by wavelength |
//! | [`drop`](mod@drop) | rays through a drop: where bows lie, and how bright its rays are |
//! | [`airy`] | Airy's function, which waves make of a caustic |
//! | [`rainbow`] | the primary and the secondary bow, and Alexander's band between |
//! | [`halo`] | prisms of ice that point anywhere: the halos of 22° and 46° |
//! | [`plates`] | prisms that lie flat: sun dogs and the circumzenithal arc |
//! | [`table`] | from spectrum to colour, blurred by the sun's disc |
//!
//! A table's value is in linear sRGB against the star's own: light in a channel is the value, times the star's light in that channel.
//! A table that knows no colour is grey.

pub mod airy;
pub mod drop;
pub mod halo;
pub mod index;
pub mod plates;
pub mod rainbow;
pub mod table;
#[cfg(test)]
mod tests;

pub use table::AngleTable;
