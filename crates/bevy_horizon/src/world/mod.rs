//! What the world is: components on an entity, in SI units, apart from how a camera draws them.

mod air_light;
mod atmosphere;
mod compiled;
mod origin;
mod param;
#[cfg(feature = "render")]
mod shine;
mod stamp;
mod sun;
mod sunlight;
mod terrain;
mod trees;
mod water;
mod water_mask;
mod water_time;
mod woods;

pub use air_light::{AtmosphereRejected, CompiledAtmosphere};
pub(crate) use air_light::{brighten, compile_atmospheres, forget_atmosphere};
pub(crate) use atmosphere::check_atmosphere;
pub use atmosphere::{Atmosphere, SkyGradient, SkyModel};
pub(crate) use compiled::TerrainFields;
pub use compiled::{CompiledTerrain, TerrainError, TerrainRejected};
pub(crate) use compiled::{compile_terrain, forget_terrain};
pub use horizon_field::material::{
    CurvatureRule, HeightRule, MaskRule, MaterialError, MaterialLayer, NoiseLayer, NoiseRule, SlopeRule, StrataRule,
    Surface, TerrainMaterial,
};
pub use origin::WorldOrigin;
pub use param::{ParamError, check_params};
#[cfg(feature = "render")]
pub use shine::illuminance;
#[cfg(feature = "render")]
pub(crate) use shine::{altitude, shine};
pub(crate) use stamp::compile_stamps;
pub use stamp::{CompiledStamps, GroundChanged, Stamp, StampPlace, StampRejected};
pub use sun::Sun;
pub(crate) use sunlight::turn_suns;
pub use sunlight::{Sunlight, TimeOfDay, towards_sun};
pub use terrain::{HeightImages, Terrain};
pub use trees::{CompiledTrees, Felled, Trees, TreesError, TreesRejected};
pub(crate) use trees::{compile_trees, forget_grown, forget_trees};
pub use water::{CompiledWater, Water, WaterDisc, WaterError, WaterOutline, WaterPlace, WaterRectangle, WaterRejected};
pub(crate) use water::{compile_waters, forget_water};
pub use water_mask::WaterMask;
#[cfg(feature = "render")]
pub(crate) use water_mask::{MASK_TEXELS, MaskTable};
pub use water_time::WaterTime;
pub(crate) use water_time::advance_water;
#[cfg(feature = "render")]
pub(crate) use woods::{Woods, WoodsChange};
