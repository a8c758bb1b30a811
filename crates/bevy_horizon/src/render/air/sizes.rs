//! How large the air's tables are. The shaders say it again, and a test holds them to it.

use horizon_light::models::{isotropic, moments, sky_view, transmittance};

use crate::world::SkyModel;

/// Bytes of a texel of the tables in buffers: a colour and a number that is free.
pub const TEXEL: u64 = 16;
/// Bytes of a texel of aerial perspective, four half floats.
const AERIAL_TEXEL: u64 = 8;
/// Orders of scattering that are kept while the moments are made.
pub const ORDERS: u64 = 3;
/// Volumes of aerial perspective: light, and transmittance.
pub const VOLUMES: usize = 2;

/// Directions and altitudes.
pub const TRANSMITTANCE: [u32; 2] = [transmittance::DIRECTIONS as u32, transmittance::ALTITUDES as u32];
/// Suns and altitudes.
pub const MOMENTS: [u32; 2] = [moments::Resolution::DEFAULT.suns as u32, moments::Resolution::DEFAULT.altitudes as u32];
/// Suns and altitudes.
pub const ISOTROPIC: [u32; 2] = [isotropic::SIZE as u32; 2];
/// The sky all round: azimuths, and rows above and below the horizon.
pub const SKY: [u32; 2] = [sky_view::AZIMUTHS as u32, (sky_view::ABOVE + sky_view::BELOW) as u32];
/// Aerial perspective: azimuths, rows above and below the horizon, slices.
pub const AERIAL: [u32; 3] = [32, AERIAL_ABOVE + AERIAL_BELOW, 24];
const AERIAL_ABOVE: u32 = 16;
const AERIAL_BELOW: u32 = 20;

/// Texels of a table.
pub const fn texels([width, height]: [u32; 2]) -> u64 {
    width as u64 * height as u64
}

/// Texels of a model's diffuse light.
pub const fn multiple_texels(model: SkyModel) -> u64 {
    match model {
        SkyModel::Full => texels(MOMENTS) * moments::HARMONICS as u64,
        SkyModel::Fast => texels(ISOTROPIC),
        // What a model does not have is bound all the same, at its least size.
        SkyModel::Single | SkyModel::Gradient => 1,
    }
}

/// Texels of the orders that a model's diffuse light is summed from.
pub const fn order_texels(model: SkyModel) -> u64 {
    match model {
        SkyModel::Full => ORDERS * multiple_texels(model),
        SkyModel::Fast | SkyModel::Single | SkyModel::Gradient => 1,
    }
}

/// Bytes on the device of all tables that a sky of this model has: those of its medium, and those of one camera.
pub const fn sky_table_bytes(model: SkyModel) -> u64 {
    if matches!(model, SkyModel::Gradient) {
        return 0;
    }
    let [width, height, slices] = AERIAL;
    let medium = texels(TRANSMITTANCE) + multiple_texels(model) + order_texels(model);
    let aerial = texels([width, height]) * slices as u64 * VOLUMES as u64;
    (medium + texels(SKY)) * TEXEL + aerial * AERIAL_TEXEL
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shaders_have_these_sizes() {
        let has = |source: &str, line: String| assert!(source.contains(&line), "{line}");
        let aerial = include_str!("aerial.wgsl");
        has(aerial, format!("const AERIAL_AZIMUTHS: u32 = {}u;", AERIAL[0]));
        has(aerial, format!("const AERIAL_ABOVE: u32 = {AERIAL_ABOVE}u;"));
        has(aerial, format!("const AERIAL_BELOW: u32 = {AERIAL_BELOW}u;"));
        has(aerial, format!("const AERIAL_SLICES: u32 = {}u;", AERIAL[2]));
        let (suns, harmonics) = (MOMENTS[0], moments::HARMONICS);
        let made = include_str!("moments_table.wgsl");
        has(made, format!("const ORDER_TEXELS: u32 = {}u;", multiple_texels(SkyModel::Full)));
        has(made, format!("(y * MOMENTS_SIZE.x + x) * {harmonics}u + harmonic"));
        let read = include_str!("read_tables.wgsl");
        has(read, format!("multiple[(y * {suns}u + x) * {harmonics}u + harmonic]"));
        has(read, format!("multiple[y * {}u + x]", ISOTROPIC[0]));
        has(horizon_light::models::shaders::SKY_VIEW, format!("const SKY_VIEW_AZIMUTHS: u32 = {}u;", SKY[0]));
    }

    #[test]
    fn work_groups_fill_the_tables() {
        let view = include_str!("view_tables.wgsl");
        assert!(view.contains("@compute @workgroup_size(8, 8, 1)\nfn sky_table"));
        assert!(view.contains("@compute @workgroup_size(8, 4, 1)\nfn aerial_table"));
        assert!([TRANSMITTANCE, ISOTROPIC, SKY].as_flattened().iter().all(|side| side.is_multiple_of(8)));
        assert!(AERIAL[0].is_multiple_of(8) && AERIAL[1].is_multiple_of(4));
    }

    /// 28 kB of colours in the README are 37 kB with the number that is free.
    #[test]
    fn the_default_s_tables_are_small() {
        assert_eq!(multiple_texels(SkyModel::Full) * TEXEL, 36_864);
        assert_eq!(sky_table_bytes(SkyModel::Gradient), 0);
        let models = [SkyModel::Single, SkyModel::Fast, SkyModel::Full].map(sky_table_bytes);
        assert!(models.is_sorted() && models[2] < 1_000_000, "{models:?}");
    }
}
