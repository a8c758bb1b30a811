//! Waters of the world, from what they hold.
//!
//! Absorption: pure water by Pope and Fry (1997); chlorophyll by Prieur and Sathyendranath (1981) as 0.06 A(λ) C^0.65, C in mg/m³
//! (Morel 1991); yellow substance, the brown of peat, as e^{−0.014(λ − 440)} (Bricaud, Morel and Prieur 1981). Scattering:
//! 0.30 C^0.62 · 550/λ by what goes with chlorophyll (Gordon and Morel 1983), as much at every wavelength by mineral particles, and
//! by molecules after Morel (1974), 0.0029 (λ/500)^−4.32 in sea water, 1.3 times less in fresh. With g = 0.924 the lobe has the mean
//! cosine of what Petzold measured in San Diego's harbour, and 0.017 of it lies behind where he found 0.018 (Mobley 1994).
//!
//! The amounts in each water are round figures for its kind.

use super::WaterOptics;

/// Wavelengths of red, green and blue in nanometres: those of [`Medium::EARTH`](crate::medium::Medium::EARTH).
const WAVELENGTHS: [f64; 3] = [613.0, 544.0, 446.0];
/// Pure water's absorption there, per metre, between the table's neighbours.
const PURE: [f64; 3] = [0.2664, 0.0504, 0.00785];
/// Chlorophyll's there, relative to 440 nm.
const CHLOROPHYLL: [f64; 3] = [0.259, 0.392, 0.966];

/// What a water holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contents {
    /// Chlorophyll, in mg/m³: 0.03 in the emptiest sea to 100 in a green pond.
    pub chlorophyll: f64,
    /// Absorption by yellow substance at 440 nm, per metre: 0 to 20.
    pub yellow: f64,
    /// Scattering by mineral particles, per metre: 0 to 100, about 0.5 for each g/m³.
    pub mineral: f64,
    /// Whether the water is salt.
    pub salt: bool,
}

impl Contents {
    /// The optics that the laws give. Chlorophyll below 0 counts as 0.
    pub fn optics(&self) -> WaterOptics {
        let chlorophyll = self.chlorophyll.max(0.0);
        let (absorbs, scatters) = (0.06 * libm::pow(chlorophyll, 0.65), 0.30 * libm::pow(chlorophyll, 0.62));
        let each = |law: &dyn Fn(f64, usize) -> f64| core::array::from_fn(|k| law(WAVELENGTHS[k], k) as f32);
        let fresh = if self.salt { 1.0 } else { 1.3 };
        WaterOptics {
            absorption: each(&|nm, k| {
                PURE[k] + CHLOROPHYLL[k] * absorbs + self.yellow * libm::exp(-0.014 * (nm - 440.0))
            }),
            scattering: each(&|nm, _| scatters * 550.0 / nm + self.mineral),
            molecules: each(&|nm, _| 0.0029 * libm::pow(nm / 500.0, -4.32) / fresh),
            ..WaterOptics::CLEAR_SEA
        }
    }

    /// [`WaterOptics::CLEAR_SEA`]'s.
    pub const CLEAR_SEA: Self = Self { chlorophyll: 0.05, yellow: 0.003, mineral: 0.0, salt: true };
    /// [`WaterOptics::COAST`]'s.
    pub const COAST: Self = Self { chlorophyll: 2.0, yellow: 0.15, mineral: 0.2, salt: true };
    /// [`WaterOptics::LAKE`]'s.
    pub const LAKE: Self = Self { chlorophyll: 5.0, yellow: 0.8, mineral: 0.5, salt: false };
    /// [`WaterOptics::GLACIER_MILK`]'s.
    pub const GLACIER_MILK: Self = Self { chlorophyll: 0.2, yellow: 0.05, mineral: 20.0, salt: false };
    /// [`WaterOptics::SWAMP`]'s.
    pub const SWAMP: Self = Self { chlorophyll: 10.0, yellow: 15.0, mineral: 2.0, salt: false };
}

impl WaterOptics {
    /// Pure fresh water: absorption by Pope and Fry, and nothing that floats in it.
    pub const PURE: Self = Self {
        absorption: [0.2664, 0.0504, 0.00785],
        scattering: [0.0; 3],
        molecules: [0.000925, 0.00155, 0.00365],
        ..Self::CLEAR_SEA
    };

    /// A coast's green water: some plankton, some silt.
    pub const COAST: Self =
        Self { absorption: [0.304, 0.122, 0.237], scattering: [0.614, 0.666, 0.769], ..Self::CLEAR_SEA };

    /// A lowland lake's: greenish brown.
    pub const LAKE: Self = Self { absorption: [0.382, 0.304, 0.908], scattering: [1.23, 1.32, 1.50], ..Self::PURE };

    /// The turquoise of lakes that glaciers feed with rock flour, 40 g/m³ of it.
    pub const GLACIER_MILK: Self =
        Self { absorption: [0.276, 0.0703, 0.0742], scattering: [20.1, 20.1, 20.1], ..Self::PURE };

    /// Peat's black water: red in a glass, dark by the metre.
    pub const SWAMP: Self = Self { absorption: [1.67, 3.65, 14.1], scattering: [3.12, 3.26, 3.54], ..Self::PURE };
}
