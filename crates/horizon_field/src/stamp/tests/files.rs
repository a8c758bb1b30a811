//! Stamps as text, as reflection sees them, and as the device does; what is refused, and by which name.

use super::*;
use crate::FieldError;
use crate::stamp::{Path, Rectangle, StampError, WGSL};

#[test]
fn stamps_survive_being_written() {
    let mut random = Random::new(31);
    let stamps = some(&mut random, 50, &Place::from_metres([1e9, 0.0, 4.0]), 100.0, 20.0);
    let text = ron::to_string(&stamps).unwrap();
    assert_eq!(ron::from_str::<Vec<Placed>>(&text).unwrap(), stamps);
    let short: Placed = ron::from_str("(edit: (mode: Raise(2.0)))").unwrap();
    assert_eq!(short, Placed { edit: Edit { mode: Mode::Raise(2.0), ..Edit::default() }, ..Placed::default() });
    assert!(ron::from_str::<Placed>("(edit: (mood: Flatten))").is_err());
}

#[test]
fn what_is_refused_is_named() {
    let named = |change: &dyn Fn(&mut Placed), name: &str| {
        let mut stamp = level(Place::ORIGIN, 5.0, 4.0);
        change(&mut stamp);
        let error = Stamps::compile(&[Placed::default(), stamp]).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("stamps[1].{name} ")) || error.starts_with(&format!("stamps[1].{name}[")),
            "{error}"
        );
    };
    named(&|s| s.edit.falloff = 0.0, "edit.falloff");
    named(&|s| s.edit.falloff = f64::NAN, "edit.falloff");
    named(&|s| s.edit.mode = Mode::Lower(f64::INFINITY), "edit.mode.Lower");
    named(&|s| s.edit.shape = Shape::Disc(Disc { radius: -1.0 }), "edit.shape.Disc.radius");
    named(
        &|s| s.edit.shape = Shape::Rectangle(Rectangle { size: [1.0, 1e9], corner: 0.0 }),
        "edit.shape.Rectangle.size",
    );
    named(&|s| s.heading = 1e9, "heading");
    named(&|s| s.place.offset[2] = f64::NAN, "place.offset[2]");
    named(&|s| s.place.offset[1] = 1e7, "place");
    let path = |points: Vec<[f64; 3]>| {
        move |s: &mut Placed| s.edit.shape = Shape::Path(Path { points: points.clone(), width: 1.0 })
    };
    named(&path(vec![[0.0; 3]]), "edit.shape.Path.points");
    named(&path(vec![[0.0; 3]; 300]), "edit.shape.Path.points");
    named(&path(vec![[0.0; 3], [0.0, 9.0, 0.0]]), "edit.shape.Path.points[1]");
    named(&path(vec![[0.0; 3], [0.0, 9.0, f64::NAN]]), "edit.shape.Path.points");
    let error = Stamps::compile(&[Placed { heading: f64::NAN, ..Placed::default() }]).unwrap_err();
    assert!(matches!(error, StampError::Param(FieldError::NotFinite { .. })));
}

#[test]
fn the_ends_of_every_range_are_finite() {
    let numbers = [0.1, 1e5];
    for falloff in numbers {
        for size in [0.0, 1e5] {
            for shape in [
                Shape::Disc(Disc { radius: size }),
                Shape::Rectangle(Rectangle { size: [size, 1e5 - size], corner: size }),
                Shape::Path(Path { points: vec![[-1e6, 1e6, 0.0], [0.0, 0.0, 1e-3], [1e6, -1e6, 0.0]], width: size }),
            ] {
                for mode in [Mode::Raise(1e5), Mode::Lower(1e5), Mode::Flatten] {
                    let edit = Edit { shape: shape.clone(), mode, falloff, order: 0 };
                    let stamps = compiled(&[Placed { edit, ..Placed::default() }]);
                    for q in [[0.0_f64; 2], [0.05, 0.0], [1e5, 1e5], [-1e6, 1.0], [1e300, -1e300]] {
                        let single = stamps.at(&Place::ORIGIN).jet(q.map(|x| x as f32), 0.0, Jet::constant(0.0));
                        let double = stamps.at(&Place::ORIGIN).jet(q, 0.0, Jet::constant(0.0));
                        assert!(double.v.is_finite() && double.g.iter().all(|g| g.is_finite()), "{double:?} at {q:?}");
                        assert!(single.v.is_finite() || q[0].abs() > 1e30, "{single:?} at {q:?} of {shape:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_twin_is_sound_wgsl() {
    let source = format!(
        "{WGSL}
@group(0) @binding(0) var<storage, read> parts: array<StampPart>;
fn stamp_part(i: u32) -> StampPart {{ return parts[i]; }}
@group(0) @binding(1) var<storage, read_write> out: array<vec4<f32>>;
@compute @workgroup_size(1)
fn main() {{
    let ground = stamped(0u, 3u, vec2<f32>(1.0), vec3<f32>(0.0));
    out[0] = vec4<f32>(ground, select(0.0, 1.0, stamp_hole(3u, 2u, vec2<f32>(1.0))));
}}"
    );
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let (flags, capabilities) = (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::default());
    naga::valid::Validator::new(flags, capabilities).validate(&module).unwrap();
    let part = module.types.iter().find(|(_, one)| one.name.as_deref() == Some("StampPart")).unwrap().1;
    let naga::TypeInner::Struct { span, .. } = part.inner else { panic!() };
    assert_eq!(span as usize, crate::stamp::PART_BYTES);
}

#[cfg(feature = "reflect")]
#[test]
fn every_number_is_declared() {
    use crate::field::Param;
    use bevy_reflect::{FromReflect, PartialReflect, TypeInfo, TypeRegistry};
    let mut registry = TypeRegistry::new();
    registry.register::<Edit>();
    let mut declared = 0;
    for registration in registry.iter() {
        let TypeInfo::Struct(info) = registration.type_info() else { continue };
        for parameter in info.iter().filter(|parameter| parameter.type_path().contains("f64")) {
            assert!(parameter.get_attribute::<Param>().is_some(), "{}.{}", info.type_path(), parameter.name());
            declared += 1;
        }
    }
    assert_eq!(declared, 6);
    let mut random = Random::new(32);
    for placed in some(&mut random, 50, &Place::ORIGIN, 1.0, 1.0) {
        assert_eq!(Edit::from_reflect(&*placed.edit.to_dynamic()), Some(placed.edit));
    }
}
