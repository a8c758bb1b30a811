//! What is refused, by name; and that files are short.

use crate::field::{Field, Fractal, ImageField, NoImages};
use crate::material::{
    HeightRule, MAX_FIELDS, MAX_LAYERS, MaskRule, MaterialError, MaterialLayer, NoiseLayer, NoiseRule, TerrainMaterial,
};

/// As world files are read and written.
fn options() -> ron::Options {
    use ron::extensions::Extensions;
    let extensions = Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES | Extensions::UNWRAP_NEWTYPES;
    ron::Options::default().with_default_extension(extensions)
}

fn read(text: &str) -> Result<TerrainMaterial, String> {
    options().from_str(text).map_err(|error| error.to_string())
}

#[test]
fn bad_parameters_are_named() {
    let cases = [
        ("(base: (colour: (0.1, 1.5, 0.2)))", "material.base.colour", "1.5"),
        ("(base: (second: (0.1, 0.5, -0.2)))", "material.base.second", "-0.2"),
        ("(base: (roughness: 0.0))", "material.base.roughness", "0.089"),
        ("(base: (tint: (octaves: 25.0)))", "material.base.tint.octaves", "25"),
        ("(edge: (wavelength: 0.0))", "material.edge.wavelength", "0"),
        ("(tint: (amplitude: NaN))", "material.tint.amplitude", "NaN"),
        ("(curvature_scale: inf)", "material.curvature_scale", "inf"),
        ("(layers: [(), (height: (low: 5.0, high: 1.0))])", "material.layers[1].height", "5 to 1"),
        ("(layers: [(height: (soft: 0.0))])", "material.layers[0].height.soft", "0"),
        ("(layers: [(height: (noise: (octaves: -1.0)))])", "material.layers[0].height.noise.octaves", "-1"),
        ("(layers: [(slope: (low: 0.8, high: 0.8))])", "material.layers[0].slope", "0.8"),
        ("(layers: [(curvature: (soft: -1.0))])", "material.layers[0].curvature.soft", "-1"),
        ("(layers: [(noise: (noise: (wavelength: inf)))])", "material.layers[0].noise.noise.wavelength", "inf"),
        ("(layers: [(noise: (low: 2.0, high: 1.0))])", "material.layers[0].noise", "2 to 1"),
        ("(layers: [(mask: (field: Constant(NaN)))])", "material.layers[0].mask", "field.Constant"),
        ("(layers: [(strata: (thickness: 0.0))])", "material.layers[0].strata.thickness", "0"),
    ];
    for (text, path, value) in cases {
        let error = read(text).unwrap().check().expect_err(text).to_string();
        println!("{error}");
        assert!(error.contains(path) && error.contains(value), "{text}: {error}");
    }
    assert!(read("(layers: [(hight: ())])").unwrap_err().contains("hight"));
}

#[test]
fn there_are_limits() {
    let layers = |count: usize, layer: &dyn Fn(usize) -> MaterialLayer| TerrainMaterial {
        layers: (0..count).map(layer).collect(),
        ..TerrainMaterial::default()
    };
    let plain = |_| MaterialLayer::default();
    assert!(layers(MAX_LAYERS, &plain).check().is_ok());
    let error = layers(MAX_LAYERS + 1, &plain).check().unwrap_err();
    assert_eq!(error, MaterialError::TooManyLayers { count: 17 });

    // The base's tint is one more.
    let noisy = |i| MaterialLayer {
        noise: Some(NoiseRule {
            noise: NoiseLayer { seed: i as u32, ..NoiseLayer::default() },
            ..NoiseRule::default()
        }),
        height: Some(HeightRule {
            noise: Some(NoiseLayer { seed: i as u32 / 2, amplitude: 3.0, ..NoiseLayer::default() }),
            ..HeightRule::default()
        }),
        ..MaterialLayer::default()
    };
    assert!(layers(10, &noisy).check().is_ok());
    assert_eq!(layers(11, &noisy).check().unwrap_err(), MaterialError::TooManyFields { count: 18 });
    assert_eq!(layers(10, &noisy).compile(&NoImages).unwrap().fields().count(), MAX_FIELDS);
}

#[test]
fn masks_may_be_images() {
    let image = Field::from(ImageField { path: "paint.png".into(), ..ImageField::default() });
    let layer =
        MaterialLayer { mask: Some(MaskRule { field: image, ..MaskRule::default() }), ..MaterialLayer::default() };
    let material = TerrainMaterial { layers: vec![layer.clone(), layer], ..TerrainMaterial::default() };
    assert_eq!(material.image_paths(), ["paint.png"]);
    let error = material.compile(&NoImages).unwrap_err().to_string();
    assert!(error.contains("material.layers[0].mask") && error.contains("paint.png"), "{error}");
}

#[test]
fn materials_survive_being_written() {
    let layer = MaterialLayer {
        mask: Some(MaskRule { field: Field::from(Fractal::default()), ..MaskRule::default() }),
        ..TerrainMaterial::default().layers[1].clone()
    };
    let mut material = TerrainMaterial::default();
    material.layers.push(layer);
    let text = options().to_string(&material).unwrap();
    assert_eq!(read(&text).unwrap(), material);
    assert_eq!(read("()").unwrap(), TerrainMaterial::default());
}
