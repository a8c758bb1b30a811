//! The air as a medium: what scatters, what absorbs, and how both thin with height.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
#[cfg(feature = "reflect")]
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

use crate::profile::{exponential_density, extinction, tent_density};

#[cfg(test)]
mod tests;

/// Wavelengths of published media, in nanometres: those of Bruneton 2017 for red, green and blue.
pub const WAVELENGTHS: [f64; 3] = [680.0, 550.0, 440.0];

/// The least that a medium's wavelengths may lie apart, in nanometres: a curve is drawn through what they see.
const APART: f64 = 10.0;

/// Declares the medium: `name: type = Earth's value, "help", in min .. max unit;`. From one entry come the field, its
/// documentation, its default, the range that [`Medium::check`] holds it against, and the attribute that an inspector
/// reads.
macro_rules! medium {
    ($($field:ident: $type:ty = $earth:expr, $help:literal, in $min:literal .. $max:literal $unit:literal;)*) => {
        /// A planet's air, at three wavelengths: molecules (Rayleigh) and aerosols (Mie), each with a density that falls
        /// by e over its scale height, and an absorbing layer (ozone) with a tent-shaped density. SI units. The ranges
        /// keep squares of lengths finite in single precision, and optical depths where exponentials still mean
        /// something. A colour's three numbers are those at `wavelengths`: who changes these changes those.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
        #[serde(default, deny_unknown_fields)]
        pub struct Medium {
            $(
                #[doc = concat!($help, " From ", stringify!($min), " to ", stringify!($max), " ", $unit, ". Default: `", stringify!($earth), "`.")]
                #[cfg_attr(feature = "reflect", reflect(@Param { min: $min, max: $max, unit: $unit, help: $help }))]
                pub $field: $type,
            )*
        }

        impl Medium {
            /// Earth's air by the laws of Bruneton 2017 (Rayleigh 1.24062e-6 λ⁻⁴ with λ in µm, ozone of 300 Dobson units,
            /// sun by ASTM G-173), at wavelengths chosen for their colours: [`spectrum::earth`](crate::spectrum::earth).
            pub const EARTH: Self = Self { $($field: $earth,)* };

            /// Calls `each` on the name, the range and the value of every number.
            fn numbers(&self, each: &mut dyn FnMut(&'static str, [f64; 2], f64)) {
                $(self.$field.visit(&mut |value| each(stringify!($field), [$min, $max], value));)*
            }
        }
    };
}

medium! {
    wavelengths: [f64; 3] = [613.0, 544.0, 446.0], "Wavelengths of red, green and blue, falling.", in 380.0 .. 780.0 "nm";
    radius: f64 = 6_360_000.0, "The ground's radius.", in 1.0 .. 1e10 "m";
    height: f64 = 60_000.0, "Thickness of the shell of air.", in 1e-3 .. 1e10 "m";
    rayleigh: [f64; 3] = [8.7861e-6, 14.166e-6, 31.354e-6], "Rayleigh scattering at the ground.", in 0.0 .. 1e3 "1/m";
    rayleigh_height: f64 = 8_000.0, "Height over which molecules thin by e.", in 1e-3 .. 1e15 "m";
    mie_scattering: [f64; 3] = [3.996e-6; 3], "Mie scattering at the ground.", in 0.0 .. 1e3 "1/m";
    mie_absorption: [f64; 3] = [0.444e-6; 3], "Mie absorption at the ground.", in 0.0 .. 1e3 "1/m";
    mie_height: f64 = 1_200.0, "Height over which aerosols thin by e.", in 1e-3 .. 1e15 "m";
    mie_asymmetry: f64 = 0.8, "Asymmetry g of the Cornette–Shanks phase function.", in -0.99 .. 0.99 "";
    absorption: [f64; 3] = [2.2224e-6, 1.749e-6, 1.0868e-7], "Absorption at the layer's peak.", in 0.0 .. 1e3 "1/m";
    absorption_peak: f64 = 25_000.0, "Altitude of the absorbing layer's peak.", in 0.0 .. 1e10 "m";
    absorption_width: f64 = 15_000.0, "From the absorbing layer's peak, where density is 1, to where it is 0.", in 1e-3 .. 1e10 "m";
    albedo: [f64; 3] = [0.1; 3], "The ground's albedo.", in 0.0 .. 1.0 "";
    irradiance: [f64; 3] = [1.692_132, 1.851_054, 1.985_636], "Solar irradiance at the top of the air.", in 0.0 .. 1e9 "W m⁻² nm⁻¹";
    sun_radius: f64 = 0.004_675, "The sun's angular radius.", in 0.0 .. 0.5 "rad";
}

impl Default for Medium {
    fn default() -> Self {
        Self::EARTH
    }
}

/// A parameter's type, seen as the numbers in it.
trait Numbers {
    fn visit(&self, each: &mut dyn FnMut(f64));
}

impl Numbers for f64 {
    fn visit(&self, each: &mut dyn FnMut(f64)) {
        each(*self);
    }
}

impl Numbers for [f64; 3] {
    fn visit(&self, each: &mut dyn FnMut(f64)) {
        self.iter().for_each(|x| each(*x));
    }
}

/// A medium that no light can be computed for.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MediumError {
    /// A number that is NaN or infinite.
    #[error("`{field}` of the air is {value}, not a finite number")]
    NotFinite {
        /// The field's name.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// A number beyond what the models are made for.
    #[error("`{field}` of the air is {value}, outside {low:e} to {high:e}")]
    OutOfRange {
        /// The field's name.
        field: &'static str,
        /// What it holds.
        value: f64,
        /// The least value allowed.
        low: f64,
        /// The largest value allowed.
        high: f64,
    },
}

impl Medium {
    /// Earth's air as published (Bruneton 2017), at 680, 550 and 440 nm: what reference values and truths are of. These
    /// wavelengths leave out the most of ozone's band, so that its twilight is purple.
    pub const BRUNETON: Self = Self {
        wavelengths: WAVELENGTHS,
        rayleigh: [5.8023e-6, 13.558e-6, 33.100e-6],
        absorption: [6.497e-7, 1.8809e-6, 8.502e-8],
        irradiance: [1.474, 1.8504, 1.911_98],
        ..Self::EARTH
    };

    /// Hazy air without ozone (seed 001, tables 8.2 and 8.3). The report gives no Mie absorption: a single-scattering
    /// albedo of 0.9 is taken from Bruneton and Neyret 2008, whose parameters it builds on.
    pub const LEEDS: Self = Self {
        rayleigh: [5.8e-6, 13.5e-6, 33.1e-6],
        mie_scattering: [2.21e-5; 3],
        mie_absorption: [2.21e-5 / 9.0; 3],
        mie_asymmetry: 0.73,
        absorption: [0.0; 3],
        albedo: [0.0, 0.0, 0.04],
        irradiance: [1.5; 3],
        sun_radius: 0.004_625_122_5,
        ..Self::BRUNETON
    };

    /// Mars under a clear season's dust, from rounded figures. Rayleigh: carbon dioxide at 610 Pa and 210 K has 2.1e23
    /// molecules per m³ (the gas law), each scattering 2.4 times as air's do (Sneep and Ubachs 2005); scale height 11.1
    /// km. Dust: vertical optical depth 0.5, as well mixed as the gas; single-scattering albedo 0.97, 0.88, 0.76 and g
    /// 0.7 after Tomasko et al. 1999. Sun: Earth's at 1.524 astronomical units. What dust does beyond its albedo (the
    /// narrower forward peak of blue light, which makes Mars' sunset blue) needs a g for each wavelength, which the
    /// medium does not have.
    pub const MARS: Self = Self {
        radius: 3_389_500.0,
        height: 100_000.0,
        rayleigh: [1.15e-7, 2.7e-7, 6.6e-7],
        rayleigh_height: 11_100.0,
        mie_scattering: [0.97 * DUST, 0.88 * DUST, 0.76 * DUST],
        mie_absorption: [0.03 * DUST, 0.12 * DUST, 0.24 * DUST],
        mie_height: 11_100.0,
        mie_asymmetry: 0.7,
        absorption: [0.0; 3],
        albedo: [0.28, 0.16, 0.08],
        irradiance: [1.474 / 2.3226, 1.8504 / 2.3226, 1.911_98 / 2.3226],
        sun_radius: 0.004_675 / 1.524,
        ..Self::BRUNETON
    };

    /// An invented thick air, for worlds and for tests: three times Earth's molecules with a larger scale height, much
    /// haze, a layer that absorbs blue, a nearer and dimmer sun.
    pub const ALIEN: Self = Self {
        wavelengths: WAVELENGTHS,
        radius: 5_000_000.0,
        height: 120_000.0,
        rayleigh: [17.4e-6, 40.7e-6, 99.3e-6],
        rayleigh_height: 12_000.0,
        mie_scattering: [3.0e-5, 2.4e-5, 1.8e-5],
        mie_absorption: [1.0e-6, 3.0e-6, 9.0e-6],
        mie_height: 4_000.0,
        mie_asymmetry: 0.65,
        absorption: [1.0e-7, 5.0e-7, 4.0e-6],
        absorption_peak: 40_000.0,
        absorption_width: 20_000.0,
        albedo: [0.3, 0.2, 0.1],
        irradiance: [1.6, 1.2, 0.7],
        sun_radius: 0.01,
    };

    /// A small planet with a deep shell, on which distances and layers are easy to work out: the set-up of Bruneton's
    /// unit tests (reference-values.md B).
    pub const SMALL_PLANET: Self = Self {
        radius: 1_000_000.0,
        height: 500_000.0,
        rayleigh: [1e-6; 3],
        rayleigh_height: 60_000.0,
        mie_scattering: [1.5e-6; 3],
        mie_absorption: [0.5e-6; 3],
        mie_height: 30_000.0,
        absorption: [0.0; 3],
        irradiance: [123.0; 3],
        ..Self::BRUNETON
    };

    /// The same without aerosols.
    pub const fn without_mie(mut self) -> Self {
        self.mie_scattering = [0.0; 3];
        self.mie_absorption = [0.0; 3];
        self
    }

    /// The same where nothing is lost: no absorption and a white ground, so that all light leaves again (a white
    /// furnace).
    pub const fn lossless(mut self) -> Self {
        self.mie_absorption = [0.0; 3];
        self.absorption = [0.0; 3];
        self.albedo = [1.0; 3];
        self
    }

    /// Densities at altitude `h` in metres, of molecules and aerosols relative to the ground, and of the absorbing
    /// layer relative to its peak.
    pub fn densities(&self, h: f64) -> [f64; 3] {
        [
            exponential_density(h, self.rayleigh_height),
            exponential_density(h, self.mie_height),
            tent_density(h, self.absorption_peak, self.absorption_width),
        ]
    }

    /// Mie extinction at the ground, per metre: what aerosols scatter and absorb.
    pub fn mie_extinction(&self) -> [f64; 3] {
        core::array::from_fn(|k| self.mie_scattering[k] + self.mie_absorption[k])
    }

    /// Extinction for columns or densities of the three layers, at each wavelength: per metre for densities, and a pure
    /// number (optical depth) for columns in metres.
    pub fn extinction(&self, layers: [f64; 3]) -> [f64; 3] {
        extinction(layers, self.rayleigh, self.mie_extinction(), self.absorption)
    }

    /// Says which number, if any, cannot be used.
    ///
    /// # Errors
    /// The first number that is not finite, or out of its range; wavelengths that do not fall by 10 nm from red to green
    /// and on to blue.
    pub fn check(&self) -> Result<(), MediumError> {
        let mut found = Ok(());
        self.numbers(&mut |field, [low, high], value| {
            if found.is_err() {
            } else if !value.is_finite() {
                found = Err(MediumError::NotFinite { field, value });
            } else if value < low || value > high {
                found = Err(MediumError::OutOfRange { field, value, low, high });
            }
        });
        let ([low, high], value) = (self.green_range(), self.wavelengths[1]);
        if found.is_ok() && !(low..=high).contains(&value) {
            found = Err(MediumError::OutOfRange { field: "wavelengths[1]", value, low, high });
        }
        found
    }

    /// From where to where green's wavelength may lie between blue's and red's, in nanometres; nowhere, if they do not fall. The
    /// ranges of the fields do not say this.
    pub fn green_range(&self) -> [f64; 2] {
        [self.wavelengths[2] + APART, self.wavelengths[0] - APART]
    }
}

/// Extinction of Mars' dust at the ground, per metre: optical depth 0.5 over a scale height of 11.1 km.
const DUST: f64 = 0.5 / 11_100.0;
