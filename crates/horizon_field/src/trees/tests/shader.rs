//! The WGSL is valid by itself, and its layouts are those of the bytes.

use naga::{Module, TypeInner};

use crate::trees::{
    Forest, MIPS, PLANT_HURRY, PLANT_PATIENCE, PLANT_STEP, PLANT_STEPS, RECORD_WORDS, TEXELS, UNIFORM_BYTES, WGSL, Wind,
};

const INCLUDER: &str = "@group(2) @binding(0) var<uniform> plant_forest: PlantForest;
@group(2) @binding(1) var plant_foliage: texture_3d<f32>;
@group(2) @binding(2) var plant_foliage_sampler: sampler;
@group(2) @binding(3) var<storage, read> plants: array<Plant>;
fn plant_at(cell: vec2<i32>) -> Plant { return plants[u32(cell.x & 1023) + 1024u * u32(cell.y & 1023)]; }
";

fn module() -> Module {
    let source = format!("{INCLUDER}{WGSL}");
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)))
}

/// The size of a struct, and the offset of each of its members.
fn layout(name: &str) -> (usize, Vec<(String, usize)>) {
    let module = module();
    let found = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).expect("the struct is there");
    let TypeInner::Struct { members, span } = &found.1.inner else { panic!("{name} is no struct") };
    let offset = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset as usize);
    (*span as usize, members.iter().map(offset).collect())
}

#[test]
fn the_shader_is_valid() {
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module()).unwrap();
    for directive in ["#import", "#if", "#define", "enable ", "requires ", "diagnostic("] {
        assert!(!WGSL.lines().any(|line| line.trim_start().starts_with(directive)), "{directive}");
    }
}

#[test]
fn bytes_are_laid_out_as_the_shader_reads_them() {
    assert_eq!(layout("Plant").0, 4 * RECORD_WORDS);
    let bytes = Forest::default().uniform_bytes(&Wind { sway: [0.1, 0.0], gust: 1.0 });
    let (size, members) = layout("PlantForest");
    assert_eq!((bytes.len(), size), (UNIFORM_BYTES, UNIFORM_BYTES));
    let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let at = |members: &[(String, usize)], name: &str| {
        members.iter().find(|(member, _)| member == name).unwrap_or_else(|| panic!("{name}")).1
    };
    assert_eq!(number(at(&members, "spacing")), 7.0);
    assert_eq!(number(at(&members, "gust")), 1.0);
    assert_eq!(number(at(&members, "sway")), 0.1);
    let (stride, species) = layout("PlantSpecies");
    let default = crate::trees::Species::default();
    assert_eq!(number(at(&species, "lean")), default.lean as f32);
    assert_eq!(number(at(&species, "density")), default.density as f32);
    assert_eq!(number(at(&species, "translucency")), default.translucency as f32);
    assert_eq!(number(at(&species, "period")), default.period() as f32);
    assert_eq!(number(at(&species, "trunk") + 4), default.trunk as f32);
    assert_eq!(number(stride + at(&species, "foliage")), Forest::default().species[1].foliage as f32);
}

#[test]
fn twins_share_their_constants() {
    for constant in [
        format!("const PLANT_STEPS: u32 = {PLANT_STEPS}u;"),
        format!("const PLANT_STEP: f32 = {PLANT_STEP};"),
        format!("const PLANT_PATIENCE: u32 = {PLANT_PATIENCE}u;"),
        format!("const PLANT_HURRY: f32 = {PLANT_HURRY};"),
        format!("const PLANT_TEXELS: f32 = {TEXELS}.0;"),
        format!("const PLANT_COARSEST: f32 = {}.0;", MIPS - 1),
    ] {
        assert!(WGSL.contains(&constant), "{constant}");
    }
}
