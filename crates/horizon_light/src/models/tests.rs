//! What the models are held to.

use std::sync::OnceLock;

use super::air::Air;
use super::isotropic::Isotropic;
use super::moments::Moments;
use super::scatter::{Multiple, Scene};
use super::transmittance::Transmittance;
use crate::medium::Medium;
use crate::profile::Light;

mod energy;
mod finite;
mod irradiance;
mod moments;
mod planar;
mod shader;
mod sky;
mod sky_view;
mod transmittance;

/// A medium with every table made.
struct Sky<T> {
    air: Air<T>,
    transmittance: Transmittance<T>,
    moments: Moments<T>,
    isotropic: Isotropic<T>,
}

impl<T: Light> Sky<T> {
    fn new(medium: &Medium) -> Self {
        let air = Air::new(medium);
        let transmittance = Transmittance::new(&air);
        let moments = Moments::new(&air, &transmittance);
        let isotropic = Isotropic::new(&air, &transmittance);
        Self { air, transmittance, moments, isotropic }
    }

    fn scene<'a, M: Multiple<T>>(&'a self, multiple: &'a M) -> Scene<'a, T, M> {
        Scene { air: &self.air, transmittance: &self.transmittance, multiple, sunlit: true }
    }
}

/// Earth's sky as the device computes it, made once for all tests.
fn earth() -> &'static Sky<f32> {
    static EARTH: OnceLock<Sky<f32>> = OnceLock::new();
    EARTH.get_or_init(|| Sky::new(&Medium::BRUNETON))
}
