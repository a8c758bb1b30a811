//! What light does on and in water. WGSL twin: `water.wgsl`.
//!
//! Water is here what [`WaterOptics`] say, alike at every depth, under a surface that is level at large; `y` is up, and depth
//! counts downward from the mean surface. A ratio `eta` is the refractive index where light goes to over that where it comes
//! from: [`index`](WaterOptics::index) into the water, its inverse out of it.
//!
//! | piece | answers |
//! |---|---|
//! | [`surface`] | what a flat surface reflects, and where the rest goes |
//! | [`rough`] | the same of a surface whose slopes are finer than a pixel, and the sun's glitter |
//! | [`body`] | what a path through the water takes away, and what it adds |
//! | [`caustics`] | where waves gather light on the bed |
//! | [`foam`] | what whitecaps add |
//!
//! A view from above, of a bed under a path of d metres, is F · L_mirrored + (1 − F)/n² · L_below, with
//! L_below = T(d) L_bed + blurred(d) (L̄_bed − L_upwelling) + L_in-scattered: the image, what has lost its outline, and the water's own
//! light ([`body::Water`]). Without the factor 1/n² ([`surface::crossing`]) a pool looks nearly twice too bright.

pub mod body;
pub mod caustics;
pub mod foam;
pub mod presets;
pub mod rough;
pub mod surface;
#[cfg(test)]
mod tests;

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
#[cfg(feature = "reflect")]
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

/// The same in WGSL. Needs nothing, has no directives, and its names start with `water_` or `Water`.
pub const WGSL: &str = include_str!("water.wgsl");

/// Declares the water: `name: type = the clear sea's value, "help", in min .. max unit;`. From one entry come the field, its
/// documentation, its default, the range that [`WaterOptics::check`] holds it against, and the attribute that an inspector reads.
macro_rules! optics {
    ($($field:ident: $type:ty = $sea:expr, $help:literal, in $min:literal .. $max:literal $unit:literal;)*) => {
        /// What water does to light, at the wavelengths of [`Medium::EARTH`](crate::medium::Medium::EARTH): red, green, blue.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
        #[serde(default, deny_unknown_fields)]
        pub struct WaterOptics {
            $(
                #[doc = concat!($help, " From ", stringify!($min), " to ", stringify!($max), " ", $unit, ". Default: `", stringify!($sea), "`.")]
                #[cfg_attr(feature = "reflect", reflect(@Param { min: $min, max: $max, unit: $unit, help: $help }))]
                pub $field: $type,
            )*
        }

        impl WaterOptics {
            /// The open sea far from land, with 0.05 mg of chlorophyll in a cubic metre: [`presets`] has the laws.
            pub const CLEAR_SEA: Self = Self { $($field: $sea,)* };

            /// Calls `each` on the name, the range and the value of every number.
            fn numbers(&self, each: &mut dyn FnMut(&'static str, [f32; 2], f32)) {
                $(self.$field.visit(&mut |value| each(stringify!($field), [$min, $max], value));)*
            }
        }
    };
}

optics! {
    absorption: [f32; 3] = [0.2689, 0.0544, 0.0189], "Absorption, by water and what it holds.", in 0.0 .. 1e3 "1/m";
    scattering: [f32; 3] = [0.0420, 0.0473, 0.0577], "Scattering by particles, mostly forward.", in 0.0 .. 1e3 "1/m";
    molecules: [f32; 3] = [0.00120, 0.00201, 0.00475], "Scattering by the water itself, to all sides.", in 0.0 .. 1e3 "1/m";
    anisotropy: f32 = 0.924, "Mean cosine g of scattering by particles (Henyey–Greenstein).", in -0.99 .. 0.99 "";
    index: f32 = 1.333, "Refractive index.", in 1.0 .. 1.6 "";
    foam: f32 = 0.55, "Albedo of dense foam.", in 0.0 .. 1.0 "";
}

impl Default for WaterOptics {
    fn default() -> Self {
        Self::CLEAR_SEA
    }
}

/// A parameter's type, seen as the numbers in it.
trait Numbers {
    fn visit(&self, each: &mut dyn FnMut(f32));
}

impl Numbers for f32 {
    fn visit(&self, each: &mut dyn FnMut(f32)) {
        each(*self);
    }
}

impl Numbers for [f32; 3] {
    fn visit(&self, each: &mut dyn FnMut(f32)) {
        self.iter().for_each(|x| each(*x));
    }
}

/// Water that no light can be computed for.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WaterError {
    /// A number that is NaN or infinite.
    #[error("`{field}` of the water is {value}, not a finite number")]
    NotFinite {
        /// The field's name.
        field: &'static str,
        /// What it holds.
        value: f32,
    },
    /// A number beyond what the formulas are made for.
    #[error("`{field}` of the water is {value}, outside {low} to {high}")]
    OutOfRange {
        /// The field's name.
        field: &'static str,
        /// What it holds.
        value: f32,
        /// The least value allowed.
        low: f32,
        /// The largest value allowed.
        high: f32,
    },
}

impl WaterOptics {
    /// Says which number, if any, cannot be used.
    ///
    /// # Errors
    /// The first number that is not finite, or out of its range.
    pub fn check(&self) -> Result<(), WaterError> {
        let mut found = Ok(());
        self.numbers(&mut |field, [low, high], value| {
            if found.is_err() {
            } else if !value.is_finite() {
                found = Err(WaterError::NotFinite { field, value });
            } else if value < low || value > high {
                found = Err(WaterError::OutOfRange { field, value, low, high });
            }
        });
        found
    }
}
