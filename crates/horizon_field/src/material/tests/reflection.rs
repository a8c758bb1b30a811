//! What an inspector sees: every number with its range.

use bevy_reflect::{FromReflect, PartialReflect, TypeInfo, TypeRegistry};

use crate::field::Param;
use crate::material::TerrainMaterial;

#[test]
fn every_number_is_declared() {
    let mut registry = TypeRegistry::new();
    registry.register::<TerrainMaterial>();
    let mut structs = 0;
    for registration in registry.iter() {
        let TypeInfo::Struct(info) = registration.type_info() else { continue };
        if !info.type_path().contains("::material::") {
            continue;
        }
        structs += 1;
        for parameter in info.iter() {
            let param = parameter.get_attribute::<Param>();
            let number = ["f64", "u32", "[f64; 3]", "core::option::Option<[f64; 3]>"].contains(&parameter.type_path());
            assert_eq!(param.is_some(), number, "{}.{}", info.type_path(), parameter.name());
            assert!(param.is_none_or(|param| param.min < param.max && !param.help.is_empty()));
        }
    }
    assert_eq!(structs, 10);
}

#[test]
fn materials_survive_reflection() {
    let material = TerrainMaterial::default();
    let dynamic = material.to_dynamic();
    assert_eq!(TerrainMaterial::from_reflect(&*dynamic).as_ref(), Some(&material));
}
