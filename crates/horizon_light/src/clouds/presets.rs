//! Skies to start from. Altitudes and thicknesses are round figures for each genus (WMO, *International Cloud Atlas*); extinction by
//! σ = 1.5 Q w/(ρ r) with Q = 2 holds for some 0.3 g/m³ of water in droplets of 10 µm radius: 0.1 1/m at a cumulus' core, less
//! over its whole.

use super::layer::{CloudLayer, CloudModel, CloudPhase};

impl CloudLayer {
    /// A grey deck, low and closed.
    pub const STRATUS: Self = Self {
        model: CloudModel::Slab,
        base: 400.0,
        top: 900.0,
        coverage: 0.75,
        kind: 0.0,
        extinction: 0.03,
        softness: 0.5,
        erosion: 0.2,
        size: 6_000.0,
        detail: 1_200.0,
        wind: [6.0, 2.0],
        evolution: 0.3,
        ..Self::CUMULUS
    };

    /// Towers over most of the sky, dark below.
    pub const STORM: Self = Self {
        base: 700.0,
        top: 9_000.0,
        coverage: 0.75,
        kind: 1.0,
        extinction: 0.06,
        softness: 0.25,
        erosion: 0.35,
        size: 18_000.0,
        detail: 2_400.0,
        wind: [14.0, 5.0],
        evolution: 4.0,
        ..Self::CUMULUS
    };

    /// A veil of ice, through which the sun shows: optical depth about 0.5 where it is closed. Crystals scatter less far forward than
    /// droplets do.
    pub const CIRRUS: Self = Self {
        model: CloudModel::Sheet,
        phase: CloudPhase::Lobes,
        base: 8_500.0,
        top: 9_000.0,
        coverage: 0.6,
        extinction: 0.001,
        softness: 0.8,
        erosion: 0.3,
        size: 30_000.0,
        detail: 6_000.0,
        asymmetry: 0.8,
        back_asymmetry: -0.3,
        back_share: 0.05,
        wind: [25.0, 10.0],
        evolution: 0.0,
        ..Self::CUMULUS
    };
}
