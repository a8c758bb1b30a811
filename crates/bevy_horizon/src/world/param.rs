//! The check of parameters against the ranges that they were declared with.

use bevy::reflect::{PartialReflect, ReflectRef, TypeInfo};
use horizon_field::field::Param;
use thiserror::Error;

/// A parameter that is not a number, or out of the range that it was declared with.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{field} is {value}, but must lie in {min} ..= {max} {unit}")]
pub struct ParamError {
    /// The parameter, by its path.
    pub field: String,
    /// Its value.
    pub value: f64,
    /// The smallest allowed value.
    pub min: f64,
    /// The largest allowed value.
    pub max: f64,
    /// The unit.
    pub unit: &'static str,
}

/// Holds every number of a struct against the [`Param`] attribute of its field, and so on down.
///
/// # Errors
/// The first parameter that is not finite or out of its range.
pub fn check_params(path: &str, value: &dyn PartialReflect) -> Result<(), ParamError> {
    let (ReflectRef::Struct(fields), Some(TypeInfo::Struct(info))) =
        (value.reflect_ref(), value.get_represented_type_info())
    else {
        return Ok(());
    };
    for (i, field) in info.iter().enumerate() {
        let Some(value) = fields.field_at(i) else { continue };
        let path = format!("{path}.{}", field.name());
        match field.get_attribute::<Param>() {
            Some(param) => check_numbers(&path, param, value)?,
            None => check_params(&path, value)?,
        }
    }
    Ok(())
}

fn check_numbers(path: &str, param: &Param, value: &dyn PartialReflect) -> Result<(), ParamError> {
    if let ReflectRef::Array(items) = value.reflect_ref() {
        return items.iter().enumerate().try_for_each(|(i, item)| check_numbers(&format!("{path}[{i}]"), param, item));
    }
    let number = value
        .try_downcast_ref::<f32>()
        .map(|x| f64::from(*x))
        .or_else(|| value.try_downcast_ref::<f64>().copied())
        .or_else(|| value.try_downcast_ref::<u32>().map(|x| f64::from(*x)))
        .or_else(|| value.try_downcast_ref::<i32>().map(|x| f64::from(*x)));
    match number {
        Some(value) if !(param.min..=param.max).contains(&value) => {
            Err(ParamError { field: path.into(), value, min: param.min, max: param.max, unit: param.unit })
        }
        _ => Ok(()),
    }
}
