//! Kernels: what enters the source, and the sizes of buffers. That they run, and agree, is tested on a device.

use crate::field::arbitrary::{Pictures, every_kind};
use crate::field::{Contents, Field, Fractal, NoImages, Triplanar};
use crate::place::Place;

#[test]
fn numbers_are_no_part_of_the_source() {
    let kernel = |fractal: Fractal| {
        let field = Field::Add(vec![Field::from(fractal), Field::Constant(7.0)]);
        field.compile::<2>(&NoImages).unwrap().kernel(1)
    };
    let one = kernel(Fractal::default());
    let numbers = Fractal { octaves: 3.5, amplitude: 7.0, seed: 9, wavelength: 10.0, gain: 0.7, ..Fractal::default() };
    assert_eq!(one, kernel(numbers));
    let structure = Fractal { basis: crate::noise::Basis::Simplex, ..Fractal::default() };
    assert_ne!(one.structure, kernel(structure).structure);
}

#[test]
fn only_what_is_used_is_in_the_source() {
    let source = Field::Constant(1.0).compile::<2>(&NoImages).unwrap().kernel(0).source;
    for absent in ["fbm_step2", "gradient2", "image2", "curve_clamp", "triplanar_weights"] {
        assert!(!source.contains(absent), "{absent}");
    }
    let source = Field::default().compile::<2>(&NoImages).unwrap().kernel(3).source;
    assert!(
        source.contains("@group(3) @binding(2)") && source.contains("fn gradient2") && !source.contains("fn simplex2")
    );
}

#[test]
fn buffers_have_the_layouts_sizes() {
    for (name, field) in every_kind(3) {
        let plane = field.compile::<2>(&Pictures).unwrap();
        let space = field.compile::<3>(&Pictures).unwrap();
        let contents = [Contents::new(&[&plane, &plane]), Contents::new(&[&space, &space])];
        let anchors =
            [plane.anchor_bytes(&plane.anchor(&Place::ORIGIN)), space.anchor_bytes(&space.anchor(&Place::ORIGIN))];
        for (k, (layers, layer, anchor)) in
            [(plane.layer_count(), 32, 24), (space.layer_count(), 48, 48)].into_iter().enumerate()
        {
            assert_eq!(contents[k].layers.len(), (2 * layers).max(1) * layer, "{name}");
            assert_eq!(anchors[k].len(), layers.max(1) * anchor, "{name}");
            assert!(contents[k].numbers.len() >= 4 * 9 && contents[k].images.len() >= 4, "{name}");
        }
    }
}

#[test]
fn triplanar_layers_follow_their_position() {
    let triplanar = Triplanar { field: Field::default().into(), ..Triplanar::default() };
    let field = Field::Add(vec![Field::default(), Field::from(triplanar.clone()), Field::from(triplanar)]);
    let space = field.compile::<3>(&NoImages).unwrap();
    assert_eq!(space.layer_count(), 12 + 2 * (1 + 3 * 12));
    assert_eq!(field.compile::<2>(&NoImages).unwrap().layer_count(), 36);
}
