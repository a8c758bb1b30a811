//! What an inspector sees: every node, and every number with its range.

use bevy_reflect::{FromReflect, PartialReflect, TypeInfo, TypeRegistry};

use crate::field::arbitrary::{Random, every_kind, field};
use crate::field::{Field, Param};

#[test]
fn every_number_is_declared() {
    let mut registry = TypeRegistry::new();
    registry.register::<Field>();
    let mut structs = 0;
    for registration in registry.iter() {
        let TypeInfo::Struct(info) = registration.type_info() else { continue };
        structs += 1;
        for parameter in info.iter() {
            let param = parameter.get_attribute::<Param>();
            let number = ["f64", "u32", "[f64; 2]"].contains(&parameter.type_path());
            assert_eq!(param.is_some(), number, "{}.{}", info.type_path(), parameter.name());
            assert!(param.is_none_or(|param| param.min < param.max && !param.help.is_empty()));
        }
    }
    assert_eq!(structs, 11);
    let Some(TypeInfo::Enum(info)) = registry.get_type_info(core::any::TypeId::of::<Field>()) else { panic!() };
    let Some(bevy_reflect::enums::VariantInfo::Tuple(constant)) = info.variant("Constant") else { panic!() };
    assert!(constant.field_at(0).is_some_and(|height| height.get_attribute::<Param>().is_some()));
}

#[test]
fn fields_survive_reflection() {
    let mut random = Random::new(6);
    let random = (0..50).map(|_| field(&mut random, 4));
    for field in every_kind(5).into_iter().map(|(_, field)| field).chain(random) {
        let dynamic = field.to_dynamic();
        assert_eq!(Field::from_reflect(&*dynamic).as_ref(), Some(&field));
        let mut other = Field::Constant(1.0);
        other.apply(&*dynamic);
        assert_eq!(other, field);
        assert_eq!(field.reflect_partial_eq(&*field.reflect_clone().unwrap()), Some(true));
    }
}
