//! The WGSL is valid by itself, and has the constants of its twin.

use crate::methods::path::BISECTIONS;
use crate::methods::{MARCH_STEPS, WGSL};

#[test]
fn the_shader_is_valid() {
    let source = format!("fn ground(p: vec2<f32>) -> f32 {{ return 0.1 * p.x; }}\n{WGSL}");
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let names: Vec<_> = module.functions.iter().filter_map(|(_, function)| function.name.as_deref()).collect();
    for name in ["march_fixed", "march_linear", "march_sphere"] {
        assert!(names.contains(&name), "{name} is not among {names:?}");
    }
    let flags = naga::valid::ValidationFlags::all();
    let nothing_special = naga::valid::Capabilities::empty();
    naga::valid::Validator::new(flags, nothing_special).validate(&module).unwrap();
}

#[test]
fn the_shader_needs_no_preprocessor() {
    for directive in ["#import", "#if", "#define", "enable ", "requires ", "diagnostic("] {
        assert!(!WGSL.lines().any(|line| line.trim_start().starts_with(directive)), "{directive}");
    }
}

#[test]
fn twins_share_their_constants() {
    assert!(WGSL.contains(&format!("const MARCH_STEPS: u32 = {MARCH_STEPS}u;")));
    assert!(WGSL.contains(&format!("const MARCH_BISECTIONS: u32 = {BISECTIONS}u;")));
}
