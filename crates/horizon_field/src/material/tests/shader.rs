//! The shader: valid in every language, of the structure alone, with the constants of its twin.

use crate::field::{Compiled, Field, Fractal, Kernel, NoImages, Noise};
use crate::material::compile::{CUTOFF, WIDENING};
use crate::material::{
    CurvatureRule, MAX_FIELDS, MAX_LAYERS, MaskRule, MaterialLayer, NoiseLayer, NoiseRule, ROWS, TerrainMaterial,
};

const WGSL: &str = include_str!("../material.wgsl");

fn height() -> Compiled<2> {
    Field::default().compile(&NoImages).unwrap()
}

fn kernel(material: &TerrainMaterial) -> Kernel {
    material.compile(&NoImages).unwrap().kernel(0, &height())
}

fn curved() -> MaterialLayer {
    MaterialLayer { curvature: Some(CurvatureRule::default()), ..MaterialLayer::default() }
}

fn masked(field: Field) -> MaterialLayer {
    MaterialLayer { mask: Some(MaskRule { field, ..MaskRule::default() }), ..MaterialLayer::default() }
}

fn with(layers: impl IntoIterator<Item = MaterialLayer>) -> TerrainMaterial {
    let mut material = TerrainMaterial::default();
    material.layers.extend(layers);
    material
}

#[test]
fn the_shader_is_valid() {
    let main = "
@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let q = vec2<f32>(id.xy);
    words[id.x] = material_packed(material_at(0u, q, 1.0, 0.75, height(0u, q, 0.75)), id.xy);
}
";
    let bare = TerrainMaterial { base: Default::default(), layers: Vec::new(), ..TerrainMaterial::default() };
    let all = with([curved(), masked(Field::Constant(2.0)), masked(Field::from(Noise::default()))]);
    for material in [bare, TerrainMaterial::default(), all] {
        let source = [&kernel(&material).source, main].join("\n");
        let module =
            naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
        let flags = naga::valid::ValidationFlags::all();
        let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module);
        let info = info.unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
        let words = naga::back::spv::write_vec(&module, &info, &naga::back::spv::Options::default(), None).unwrap();
        assert!(words.len() > 1000);
        let options = naga::back::msl::Options { lang_version: (2, 0), ..Default::default() };
        naga::back::msl::write_string(&module, &info, &options, &Default::default()).unwrap();
        let (options, pipeline, mut text) = (Default::default(), Default::default(), String::new());
        naga::back::hlsl::Writer::new(&mut text, &options, &pipeline).write(&module, &info, None).unwrap();
        let material = module.global_variables.iter().find(|(_, global)| global.name.as_deref() == Some("material"));
        let size = module.types[material.unwrap().1.ty].inner.size(module.to_ctx());
        assert_eq!(size as usize, 16 * ROWS);
    }
}

#[test]
fn numbers_are_no_part_of_the_structure() {
    let plain = kernel(&TerrainMaterial::default());
    let mut other = TerrainMaterial::default();
    other.edge.amplitude = 3.0;
    other.tint.octaves = 2.0;
    other.layers[1].height.as_mut().unwrap().high = 12.0;
    other.base.colour = [0.9; 3];
    assert_eq!(plain, kernel(&other));

    // Two noises that were the same, and are no longer: one more is computed, and nothing is compiled.
    let noisy = |seed| MaterialLayer {
        noise: Some(NoiseRule { noise: NoiseLayer { seed, ..NoiseLayer::default() }, ..NoiseRule::default() }),
        ..MaterialLayer::default()
    };
    let (same, apart) = (with([noisy(1), noisy(1)]), with([noisy(1), noisy(2)]));
    let count = |material: &TerrainMaterial| material.compile(&NoImages).unwrap().fields().count();
    assert_eq!((count(&same), count(&apart)), (3, 4));
    assert_eq!(kernel(&same), kernel(&apart));
    assert_eq!(plain, kernel(&same));

    let masks = with([masked(Field::Constant(2.0))]);
    assert_ne!(plain.structure, kernel(&masks).structure);
    assert_eq!(kernel(&masks), kernel(&with([masked(Field::Constant(3.0)), masked(Field::Constant(4.0))])));
    assert_ne!(plain.structure, kernel(&with([curved()])).structure);
    let ridged = Field::from(Fractal { rule: crate::fractal::Rule::Ridged, ..Fractal::default() });
    assert_ne!(kernel(&masks).structure, kernel(&with([masked(ridged)])).structure);
}

#[test]
fn one_material_asks_each_noise_once() {
    let compiled = TerrainMaterial::default().compile(&NoImages).unwrap();
    assert_eq!(compiled.fields().count(), 2);
    let source = kernel(&TerrainMaterial::default()).source;
    assert_eq!(source.matches("fn material_field_tree").count(), 1, "all noises share one function");
    assert_eq!(source.matches("= material_field(").count(), 1, "and one call");
    assert!(!source.contains("for (var i = 0u; i < 4u; i++) {\n        let side"), "no curvature without a rule");
}

#[test]
fn twins_share_their_constants() {
    for constant in [
        format!("const MATERIAL_FIELDS: u32 = {MAX_FIELDS}u;"),
        format!("const MATERIAL_LAYERS: u32 = {}u;", MAX_LAYERS + 1),
        format!("const MATERIAL_WIDENING: f32 = {WIDENING:.1};"),
        format!("fields: array<vec4<f32>, {}>", ROWS - 1 - 10 * (MAX_LAYERS + 1)),
        format!("must be {CUTOFF} texels"),
    ] {
        assert!(WGSL.contains(&constant), "{constant}");
    }
}

#[test]
fn the_shader_needs_no_preprocessor() {
    for directive in ["#import", "#if", "#define", "enable ", "requires ", "diagnostic("] {
        assert!(!WGSL.lines().any(|line| line.trim_start().starts_with(directive)), "{directive}");
    }
}
