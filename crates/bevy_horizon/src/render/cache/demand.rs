//! What a view asks of its cache: how large its levels must be, and which of them a pixel can resolve.

use bevy::render::camera::ExtractedCamera;
use bevy::render::renderer::RenderDevice;
use bevy::render::view::ExtractedView;
use horizon_field::march::Anchored;
use horizon_field::{CELL, Place};

use super::super::extract::{ExtractedHorizonCamera, ExtractedTerrain};
use super::buffers::{LOOK_BYTES, TILE_BYTES};
use super::clipmap::{COARSEST, FINEST, MAX_LEVELS, TILE};

/// A clipmap for a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// Tiles along a level's side.
    pub side: u32,
    /// How many levels are stored.
    pub capacity: usize,
    /// The exponents of the finest and the coarsest level's texel.
    pub finest: i32,
    pub coarsest: i32,
}

/// The field of view for which a level's size is chosen, in radians: with the target's height it makes the size, so that
/// zooming does not rebuild the cache.
const NOMINAL_FOV: f32 = std::f32::consts::FRAC_PI_3;

/// Radians per pixel, or metres per pixel of an orthographic view.
pub fn pixel_size(view: &ExtractedView, height_px: u32) -> f32 {
    2.0 / (view.clip_from_view.y_axis.y.abs().max(1e-9) * height_px.max(1) as f32)
}

impl Demand {
    /// What a view at `eye` (relative to the terrain) asks for, within `share` MiB.
    pub fn new(
        camera: &ExtractedHorizonCamera,
        view: &ExtractedView,
        extracted: &ExtractedCamera,
        eye: &Place,
        terrain: &ExtractedTerrain,
        share: u32,
        device: &RenderDevice,
    ) -> Self {
        let height_px = extracted.physical_viewport_size.map_or(1, |size| size.y).max(1);
        let budget = camera.camera.error_budget.clamp(0.1, 16.0);
        // At the inner side of a level's ring, 0.4 · (n / 2 − 34) texels from the centre, a texel may be as large as √2 times
        // the budget in pixels: its bow and the octaves left out are some hundredth of it (tests/march.rs). At twice the budget
        // ridges three pixels wide go missing: 2 of 2 036 800 rays of cameras drawn by lot.
        let nominal = 2.0 * (NOMINAL_FOV / 2.0).tan() / height_px as f32;
        let texels = 2.0 * (std::f32::consts::SQRT_2 / (0.8 * nominal * budget) + 34.0);
        let mut side = ((texels / (2 * TILE) as f32).ceil() as u32 * 2).max(4);
        // Of a stamp's falloff an eighth is enough; of a colour, a quarter of the finest wave.
        let wave = (terrain.stamps.finest_wavelength() / 8.0).min(terrain.fields.material.finest_wavelength() / 4.0);
        let detail = (wave.log2().floor().clamp(FINEST.into(), COARSEST.into()) as i32).min(terrain.kernel.grain);
        let far = camera.camera.far.clamp(1.0, 1e6);
        let binding = device.limits().max_storage_buffer_binding_size;
        loop {
            let reach = (i64::from(side) * TILE / 2 - 34) as f32;
            let coarsest = ((far / reach).log2().ceil() as i32).clamp(FINEST, COARSEST);
            let detail = detail.min(coarsest);
            // Stamps come and go, and a cache of another capacity is another cache: down to falloffs of a metre there is room.
            let stored = if terrain.stamps.is_empty() { detail } else { detail.min(-2) };
            let wanted = (coarsest - stored + 1).clamp(1, MAX_LEVELS as i32) as u64;
            let tiles = u64::from(side).pow(2);
            let affordable = ((u64::from(share) << 20) / (tiles * TILE_BYTES)).min(binding / (tiles * LOOK_BYTES));
            if affordable >= wanted || side <= 6 {
                let capacity = wanted.min(affordable.max(1)) as usize;
                let nearest =
                    f64::from(pixel_size(view, height_px)) * 2.0 * f64::from(budget) * distance(view, eye, terrain);
                let finest = (nearest.log2().floor() as i32).clamp(detail, coarsest);
                return Self { side, capacity, finest, coarsest };
            }
            side -= 2;
        }
    }
}

/// About how near the ground is, in metres: half the height above it, as cliffs beside the camera may be nearer than
/// what lies below. An orthographic view's pixels are as large anywhere.
fn distance(view: &ExtractedView, eye: &Place, terrain: &ExtractedTerrain) -> f64 {
    if view.clip_from_view.w_axis.w == 1.0 {
        return 1.0;
    }
    let ground = Anchored::stamped(&terrain.fields.height, &terrain.stamps, eye).value([0.0, 0.0]);
    (0.5 * (eye.cell[1] as f64 * CELL + eye.offset[1] - ground).abs()).max(1.0)
}
