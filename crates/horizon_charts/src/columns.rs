//! The names of a row type's columns, known before there is a row: serde tells a struct's field names to whoever
//! deserialises it.

use serde::Deserialize;
use serde::de::value::Error;
use serde::de::{Deserializer, Error as _, Visitor};
use serde::forward_to_deserialize_any;

/// The columns of `R`, in order.
///
/// # Panics
/// If `R` is no plain struct with named fields (`flatten` makes it something else).
pub fn columns<'de, R: Deserialize<'de>>() -> &'static [&'static str] {
    let mut names = None;
    // It always ends in an error: there is nothing to deserialise.
    let _ = R::deserialize(Names(&mut names));
    names.expect("a row is a struct with named fields")
}

/// A deserialiser that only takes down the names.
struct Names<'a>(&'a mut Option<&'static [&'static str]>);

impl<'de> Deserializer<'de> for Names<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom("not a struct"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        *self.0 = Some(fields);
        Err(Error::custom("names taken"))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_fields_as_files_name_them() {
        #[derive(Deserialize)]
        #[expect(dead_code, reason = "only its names are asked for")]
        struct Sample {
            run: u64,
            #[serde(rename = "false")]
            false_hits: u32,
            ms: Option<f64>,
        }
        assert_eq!(columns::<Sample>(), ["run", "false", "ms"]);
    }
}
