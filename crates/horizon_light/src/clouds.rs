//! Clouds: droplets or crystals in a layer between two altitudes. Rust is the reference of the WGSL twins beside it, which a host
//! joins: [`WGSL`] after `geometry.wgsl`.
//!
//! | piece | answers |
//! |---|---|
//! | [`layer`] | what a layer is: its numbers, each with its range |
//! | [`presets`] | cumulus, stratus, storm, cirrus |
//! | [`volume`] | the noise that all models share, made once, and what bounds it |
//! | [`density`] | how dense the cloud is at a place, from 0 to 1, and at most within a block |
//! | [`span`] | where a ray is in the layer |
//! | [`march`] | what a ray meets there: light and transmittance |
//! | [`phase`] | where a droplet scatters light to |
//! | [`light`] | the sun's light in the cloud, scattered once and often |
//!
//! Optical depth is extinction times length: the layer's [`extinction`](layer::CloudLayer::extinction) where density is 1. Clouds
//! of water take nothing away: what meets a droplet is scattered.

pub mod density;
pub mod layer;
pub mod light;
pub mod march;
pub mod phase;
pub mod presets;
pub mod span;
#[cfg(test)]
mod tests;
pub mod volume;

pub use density::{Cloud, CloudPoint, Weather};
pub use layer::{CloudError, CloudLayer, CloudModel, CloudPhase};
pub use volume::CloudVolume;

/// How many layers a sky has at most.
pub const LAYERS: usize = 4;

/// The model in WGSL: density, march and light. Needs `geometry.wgsl`, and of the host `cloud_volume`, `cloud_volume_most` and
/// `cloud_weather`, which `density.wgsl` describes. Its names start with `cloud_`, `Cloud` or `CLOUD_`.
pub const WGSL: &str = concat!(
    include_str!("clouds/density.wgsl"),
    include_str!("clouds/phase.wgsl"),
    include_str!("clouds/march.wgsl"),
    include_str!("clouds/light.wgsl")
);
