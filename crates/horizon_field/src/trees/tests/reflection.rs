//! What an inspector sees: every number with its range.

use bevy_reflect::{FromReflect, PartialReflect, TypeInfo, Typed};

use super::dense;
use crate::field::Param;
use crate::trees::{Forest, Species};

#[test]
fn every_number_is_declared() {
    for info in [Forest::type_info(), Species::type_info()] {
        let TypeInfo::Struct(info) = info else { panic!("{} is a struct", info.type_path()) };
        for parameter in info.iter() {
            let number = ["f64", "u32", "[f64; 2]", "[f64; 3]"].contains(&parameter.type_path());
            let param = parameter.get_attribute::<Param>();
            assert_eq!(param.is_some(), number, "{}", parameter.name());
            assert!(param.is_none_or(|param| param.min < param.max && !param.help.is_empty()));
        }
    }
}

#[test]
fn forests_survive_reflection() {
    let dynamic = dense().to_dynamic();
    assert_eq!(Forest::from_reflect(&*dynamic), Some(dense()));
}
