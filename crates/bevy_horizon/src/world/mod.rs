//! What the world is: components on an entity, in SI units, apart from how a camera draws them.

mod atmosphere;
mod compiled;
mod material;
mod origin;
mod param;
mod sun;
mod terrain;

pub use atmosphere::Atmosphere;
#[cfg(feature = "render")]
pub(crate) use compiled::TerrainFields;
pub use compiled::{CompiledTerrain, TerrainError, TerrainRejected};
pub(crate) use compiled::{compile_terrain, forget_terrain};
pub use material::{NoiseLayer, TerrainMaterial};
pub use origin::WorldOrigin;
pub use param::{ParamError, check_params};
pub use sun::Sun;
pub use terrain::{HeightImages, Terrain};
