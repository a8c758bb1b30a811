//! The declaration of parameters: once each. From one entry come the struct's field, its documentation, its default, the
//! range that [`Field::check`](super::Field::check) enforces, and the attribute that an inspector reads.

/// What there is to know of a numeric parameter. An attribute of the field in Reflect.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
pub struct Param {
    /// The smallest allowed value.
    pub min: f64,
    /// The largest allowed value.
    pub max: f64,
    /// The unit: `m`, `rad`, or empty for a pure number.
    pub unit: &'static str,
    /// The meaning.
    pub help: &'static str,
}

/// A parameter's type, seen as the numbers in it.
pub(crate) trait Numbers {
    /// Calls `each` on every number.
    fn numbers(&self, each: &mut dyn FnMut(f64));
}

impl Numbers for f64 {
    fn numbers(&self, each: &mut dyn FnMut(f64)) {
        each(*self);
    }
}

impl Numbers for u32 {
    fn numbers(&self, each: &mut dyn FnMut(f64)) {
        each(f64::from(*self));
    }
}

impl<const N: usize> Numbers for [f64; N] {
    fn numbers(&self, each: &mut dyn FnMut(f64)) {
        self.iter().for_each(|x| each(*x));
    }
}

impl Numbers for Vec<[f64; 3]> {
    fn numbers(&self, each: &mut dyn FnMut(f64)) {
        self.iter().flatten().for_each(|x| each(*x));
    }
}

impl<T: Numbers> Numbers for Option<T> {
    fn numbers(&self, each: &mut dyn FnMut(f64)) {
        if let Some(inner) = self {
            inner.numbers(each);
        }
    }
}

/// A node whose numeric parameters can be visited together with their declarations.
pub(crate) trait Params {
    /// Calls `each` on the name, the declaration and the value of every number.
    fn params(&self, each: &mut dyn FnMut(&'static str, &Param, f64));
}

/// Declares a node: `name: type = default, "help", in min .. max unit;`, where only numbers have a range.
macro_rules! node {
    (
        $(#[$meta:meta])*
        $name:ident {
            $( $field:ident: $type:ty = $default:expr, $help:literal $(, in $min:literal .. $max:literal $unit:literal)?; )*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect), reflect(no_field_bounds, Clone, Debug, Default, PartialEq))]
        #[serde(default, deny_unknown_fields)]
        pub struct $name {
            $(
                #[doc = concat!(
                    $help,
                    $(" From ", stringify!($min), " to ", stringify!($max), " ", $unit, ".",)?
                    " Default: `", stringify!($default), "`."
                )]
                $(#[cfg_attr(
                    feature = "reflect",
                    reflect(@Param { min: $min, max: $max, unit: $unit, help: $help })
                )])?
                pub $field: $type,
            )*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl Params for $name {
            fn params(&self, each: &mut dyn FnMut(&'static str, &Param, f64)) {
                // Some nodes have no numbers.
                let _ = &each;
                $($(
                    const { assert!($min <= $max) };
                    let param = Param { min: $min, max: $max, unit: $unit, help: $help };
                    self.$field.numbers(&mut |value| each(stringify!($field), &param, value));
                )?)*
            }
        }
    };
}
pub(crate) use node;
