//! What an inspector sees: every number with its range.

use bevy_reflect::{FromReflect, PartialReflect, TypeInfo, TypeRegistry};

use super::super::Waves;
use super::every_model;
use crate::field::Param;

#[test]
fn every_number_is_declared() {
    let mut registry = TypeRegistry::new();
    registry.register::<Waves>();
    let mut structs = 0;
    for registration in registry.iter() {
        let TypeInfo::Struct(info) = registration.type_info() else { continue };
        structs += 1;
        for parameter in info.iter() {
            let param = parameter.get_attribute::<Param>().expect("waves have numbers alone");
            assert!(param.min < param.max && !param.help.is_empty(), "{}", parameter.name());
        }
    }
    assert_eq!(structs, 4);
}

#[test]
fn waves_survive_reflection() {
    for (name, waves) in every_model().into_iter().chain([("still", Waves::Still)]) {
        assert_eq!(Waves::from_reflect(&*waves.to_dynamic()).as_ref(), Some(&waves), "{name}");
    }
}
