//! What a layer of clouds is. Each number is declared once.

#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;
#[cfg(feature = "reflect")]
use horizon_field::field::Param;
use serde::{Deserialize, Serialize};

/// How a cloud's density comes about, from cheap to rich.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
pub enum CloudModel {
    /// fBm in the plane, alike through the layer's thickness: for thin high clouds.
    Sheet,
    /// Dense about the layer's middle, plus fBm in space (seed 000, section 3.6.1): for closed decks.
    Slab,
    /// Billows of gradient and Worley noise under a profile over height (Schneider 2015): for heaped clouds.
    #[default]
    Billow,
}

/// Where droplets scatter light to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
pub enum CloudPhase {
    /// Two lobes of Henyey and Greenstein, forward and backward.
    #[default]
    Lobes,
    /// Mie's theory for water droplets of one size, as Jendersie and d'Eon (2023) fit it.
    Droplets,
}

/// Declares the layer: `name: type = the cumulus' value, "help", in min .. max unit;`. From one entry come the field, its
/// documentation, its default, the range that [`CloudLayer::check`] holds it against, and the attribute that an inspector reads.
macro_rules! layer {
    ($($field:ident: $type:ty = $cumulus:expr, $help:literal, in $min:literal .. $max:literal $unit:literal;)*) => {
        /// A layer of clouds. SI units.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(Clone, Debug, Default, PartialEq))]
        #[serde(default, deny_unknown_fields)]
        pub struct CloudLayer {
            /// How density comes about. Default: [`CloudModel::Billow`].
            pub model: CloudModel,
            /// Where droplets scatter light to. Default: [`CloudPhase::Lobes`].
            pub phase: CloudPhase,
            $(
                #[doc = concat!($help, " From ", stringify!($min), " to ", stringify!($max), " ", $unit, ". Default: `", stringify!($cumulus), "`.")]
                #[cfg_attr(feature = "reflect", reflect(@Param { min: $min, max: $max, unit: $unit, help: $help }))]
                pub $field: $type,
            )*
        }

        impl CloudLayer {
            /// Heaped clouds of fair weather.
            pub const CUMULUS: Self =
                Self { model: CloudModel::Billow, phase: CloudPhase::Lobes, $($field: $cumulus,)* };

            /// Calls `each` on the name, the range and the value of every number.
            fn numbers(&self, each: &mut dyn FnMut(&'static str, [f32; 2], f32)) {
                $(self.$field.visit(&mut |value| each(stringify!($field), [$min, $max], value));)*
            }
        }
    };
}

layer! {
    base: f32 = 1_000.0, "Altitude of the layer's lower face.", in 0.0 .. 1e6 "m";
    top: f32 = 2_200.0, "Altitude of the layer's upper face, at least 1 m above the lower one.", in 1.0 .. 1e6 "m";
    coverage: f32 = 0.4, "Which part of the noise is cloud: 0 is a clear sky, 1 a closed one.", in 0.0 .. 1.0 "";
    kind: f32 = 1.0, "From a flat deck low in the layer, 0, to heaps that reach its top, 1 (billows only).", in 0.0 .. 1.0 "";
    extinction: f32 = 0.04, "What a dense cloud takes from a beam.", in 0.0 .. 10.0 "1/m";
    softness: f32 = 0.2, "Over how much of the noise's range density grows from 0 to 1: an edge's width.", in 0.01 .. 1.0 "";
    erosion: f32 = 0.4, "How deep fine noise eats into the edges.", in 0.0 .. 0.95 "";
    size: f32 = 5_000.0, "After how far shapes come again; a heap is about a fifth as wide.", in 10.0 .. 1e6 "m";
    detail: f32 = 900.0, "After how far the fine noise comes again.", in 1.0 .. 1e6 "m";
    asymmetry: f32 = 0.88, "Mean cosine g of the forward lobe.", in 0.0 .. 0.99 "";
    back_asymmetry: f32 = -0.4, "Mean cosine of the backward lobe.", in -0.99 .. 0.0 "";
    back_share: f32 = 0.03, "The backward lobe's share.", in 0.0 .. 1.0 "";
    droplet: f32 = 20.0, "Diameter of the droplets, where the phase function is theirs.", in 5.0 .. 50.0 "µm";
    wind: [f32; 2] = [8.0, 3.0], "Wind along x and z.", in -200.0 .. 200.0 "m/s";
    evolution: f32 = 1.5, "How fast the fine noise rises through the shapes.", in 0.0 .. 50.0 "m/s";
}

impl Default for CloudLayer {
    fn default() -> Self {
        Self::CUMULUS
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

impl Numbers for [f32; 2] {
    fn visit(&self, each: &mut dyn FnMut(f32)) {
        self.iter().for_each(|x| each(*x));
    }
}

/// A layer that nothing can be drawn of.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CloudError {
    /// A number that is NaN or infinite.
    #[error("`{field}` of the clouds is {value}, not a finite number")]
    NotFinite {
        /// The field's name.
        field: &'static str,
        /// What it holds.
        value: f32,
    },
    /// A number beyond what the models are made for.
    #[error("`{field}` of the clouds is {value}, outside {low} to {high}")]
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
    /// A layer of no thickness.
    #[error("`top` of the clouds is {top}, not 1 m or more above `base`, {base}")]
    Flat {
        /// The lower face's altitude.
        base: f32,
        /// The upper face's altitude.
        top: f32,
    },
}

impl CloudLayer {
    /// Says which number, if any, cannot be used.
    ///
    /// # Errors
    /// The first number that is not finite, or out of its range; faces less than 1 m apart.
    pub fn check(&self) -> Result<(), CloudError> {
        let mut found = Ok(());
        self.numbers(&mut |field, [low, high], value| {
            if found.is_err() {
            } else if !value.is_finite() {
                found = Err(CloudError::NotFinite { field, value });
            } else if value < low || value > high {
                found = Err(CloudError::OutOfRange { field, value, low, high });
            }
        });
        let Self { base, top, .. } = *self;
        if found.is_ok() && top - base < 1.0 {
            found = Err(CloudError::Flat { base, top });
        }
        found
    }

    /// How far the wind has carried the layer after `seconds`, in metres along x, y and z.
    pub fn drift(&self, seconds: f64) -> [f64; 3] {
        [f64::from(self.wind[0]) * seconds, 0.0, f64::from(self.wind[1]) * seconds]
    }
}
