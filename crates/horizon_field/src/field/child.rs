//! A field inside a field.

use core::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};

use super::Field;

/// A field inside a field: a box, which is what makes the tree of finite size. In files it is the inner field itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Child(Box<Field>);

impl From<Field> for Child {
    fn from(field: Field) -> Self {
        Self(Box::new(field))
    }
}

impl Deref for Child {
    type Target = Field;

    fn deref(&self) -> &Field {
        &self.0
    }
}

impl DerefMut for Child {
    fn deref_mut(&mut self) -> &mut Field {
        &mut self.0
    }
}

/// Reflect has no boxes, hence by hand: a tuple struct of one field, which is the inner one.
#[cfg(feature = "reflect")]
mod reflected {
    use core::any::Any;

    use bevy_reflect::tuple_struct::{DynamicTupleStruct, TupleStruct, TupleStructFieldIter, TupleStructInfo};
    use bevy_reflect::utility::NonGenericTypeInfoCell;
    use bevy_reflect::{
        ApplyError, FromReflect, GetTypeRegistration, PartialReflect, Reflect, ReflectCloneError, ReflectKind,
        ReflectMut, ReflectOwned, ReflectRef, TypeInfo, TypePath, TypeRegistration, TypeRegistry, Typed, UnnamedField,
    };

    use super::{Child, Field};

    impl TypePath for Child {
        fn type_path() -> &'static str {
            "horizon_field::field::child::Child"
        }

        fn short_type_path() -> &'static str {
            "Child"
        }
    }

    impl Typed for Child {
        fn type_info() -> &'static TypeInfo {
            static CELL: NonGenericTypeInfoCell = NonGenericTypeInfoCell::new();
            CELL.get_or_set(|| TypeInfo::TupleStruct(TupleStructInfo::new::<Self>(&[UnnamedField::new::<Field>(0)])))
        }
    }

    impl GetTypeRegistration for Child {
        fn get_type_registration() -> TypeRegistration {
            TypeRegistration::of::<Self>()
        }

        fn register_type_dependencies(registry: &mut TypeRegistry) {
            registry.register::<Field>();
        }
    }

    impl TupleStruct for Child {
        fn field(&self, index: usize) -> Option<&dyn PartialReflect> {
            (index == 0).then_some(&*self.0)
        }

        fn field_mut(&mut self, index: usize) -> Option<&mut dyn PartialReflect> {
            (index == 0).then_some(&mut *self.0)
        }

        fn field_len(&self) -> usize {
            1
        }

        fn iter_fields(&self) -> TupleStructFieldIter<'_> {
            TupleStructFieldIter::new(self)
        }

        fn to_dynamic_tuple_struct(&self) -> DynamicTupleStruct {
            let mut dynamic = DynamicTupleStruct::default();
            dynamic.set_represented_type(Some(Self::type_info()));
            dynamic.insert_boxed(self.0.to_dynamic());
            dynamic
        }
    }

    impl PartialReflect for Child {
        fn get_represented_type_info(&self) -> Option<&'static TypeInfo> {
            Some(Self::type_info())
        }

        fn into_partial_reflect(self: Box<Self>) -> Box<dyn PartialReflect> {
            self
        }

        fn as_partial_reflect(&self) -> &dyn PartialReflect {
            self
        }

        fn as_partial_reflect_mut(&mut self) -> &mut dyn PartialReflect {
            self
        }

        fn try_into_reflect(self: Box<Self>) -> Result<Box<dyn Reflect>, Box<dyn PartialReflect>> {
            Ok(self)
        }

        fn try_as_reflect(&self) -> Option<&dyn Reflect> {
            Some(self)
        }

        fn try_as_reflect_mut(&mut self) -> Option<&mut dyn Reflect> {
            Some(self)
        }

        fn try_apply(&mut self, value: &dyn PartialReflect) -> Result<(), ApplyError> {
            let tuple = value.reflect_ref().as_tuple_struct()?;
            tuple.field(0).map_or(Ok(()), |field| self.0.try_apply(field))
        }

        fn reflect_kind(&self) -> ReflectKind {
            ReflectKind::TupleStruct
        }

        fn reflect_ref(&self) -> ReflectRef<'_> {
            ReflectRef::TupleStruct(self)
        }

        fn reflect_mut(&mut self) -> ReflectMut<'_> {
            ReflectMut::TupleStruct(self)
        }

        fn reflect_owned(self: Box<Self>) -> ReflectOwned {
            ReflectOwned::TupleStruct(self)
        }

        fn reflect_clone(&self) -> Result<Box<dyn Reflect>, ReflectCloneError> {
            Ok(Box::new(self.clone()))
        }

        fn reflect_partial_eq(&self, value: &dyn PartialReflect) -> Option<bool> {
            Some(value.try_downcast_ref::<Self>().is_some_and(|other| self == other))
        }
    }

    impl Reflect for Child {
        fn into_any(self: Box<Self>) -> Box<dyn Any> {
            self
        }

        fn as_any(&self) -> &dyn Any {
            self
        }

        fn as_any_mut(&mut self) -> &mut dyn Any {
            self
        }

        fn into_reflect(self: Box<Self>) -> Box<dyn Reflect> {
            self
        }

        fn as_reflect(&self) -> &dyn Reflect {
            self
        }

        fn as_reflect_mut(&mut self) -> &mut dyn Reflect {
            self
        }

        fn set(&mut self, value: Box<dyn Reflect>) -> Result<(), Box<dyn Reflect>> {
            *self = value.take()?;
            Ok(())
        }
    }

    impl FromReflect for Child {
        fn from_reflect(reflect: &dyn PartialReflect) -> Option<Self> {
            let ReflectRef::TupleStruct(tuple) = reflect.reflect_ref() else { return None };
            Some(Self(Box::new(Field::from_reflect(tuple.field(0)?)?)))
        }
    }
}
