//! The shaders, put together from their files: plain WGSL, joined in order, so that nothing depends on an import being
//! found. Only the tonemapping of LDR views imports, from Bevy.

use bevy::asset::{Assets, Handle, uuid_handle};
use bevy::shader::Shader;

pub const PYRAMID: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a01");
pub const LIGHT: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a02");
/// By whether the view is LDR, and whether it is a debug view.
const GEOMETRY: [[Handle<Shader>; 2]; 2] = [
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a03"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0a")],
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a04"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0b")],
];
const UPSAMPLE: [[Handle<Shader>; 2]; 2] = [
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0c"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0d")],
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0e"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a0f")],
];
/// By whether the view is LDR, and whether it is multisampled.
const SKY: [[Handle<Shader>; 2]; 2] = [
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a05"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a06")],
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a07"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a08")],
];

pub const CLEARANCE: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a09");

const SURFACE: &str = include_str!("cache/surface.wgsl");
const PRESENT_HDR: &str = "fn present(colour: vec4<f32>) -> vec4<f32> {\n    return colour;\n}\n";
const DEPTH_SINGLE: &str = "@group(0) @binding(2) var depth_texture: texture_depth_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, 0);\n}\n";
const DEPTH_MULTISAMPLED: &str = "@group(0) @binding(2) var depth_texture: texture_depth_multisampled_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, sample_index);\n}\n";

const HEAT: &str = "const HEAT: bool = true;\n@group(0) @binding(9) var<storage, read> truths: array<f32>;\n\
    fn truth_at(i: u32) -> f32 {\n    if (i >= arrayLength(&truths)) {\n        return 0.0;\n    }\n    return truths[i];\n}\n";
const NO_HEAT: &str = "const HEAT: bool = false;\nfn truth_at(i: u32) -> f32 {\n    return 0.0;\n}\n";

/// Adds the shaders that are the same for every world. They are text until a pipeline asks for them.
pub fn add_shaders(shaders: &mut Assets<Shader>) {
    let mut add = |handle: Handle<Shader>, name: &str, source: String| {
        let path = format!("bevy_horizon/{name}.wgsl");
        shaders.insert(&handle, Shader::from_wgsl(source, path)).expect("a handle by UUID is always valid");
    };
    add(PYRAMID, "pyramid", pyramid_source());
    add(LIGHT, "light", light_source());
    add(CLEARANCE, "clearance", clearance_source());
    for ldr in [false, true] {
        for heat in [false, true] {
            add(geometry(ldr, heat), "geometry", geometry_source(ldr, heat));
            add(upsample(ldr, heat), "upsample", upsample_source(ldr, heat));
        }
        for multisampled in [false, true] {
            add(sky(ldr, multisampled), "sky", sky_source(ldr, multisampled));
        }
    }
}

/// The shader of the geometry pass.
pub fn geometry(ldr: bool, heat: bool) -> Handle<Shader> {
    GEOMETRY[usize::from(ldr)][usize::from(heat)].clone()
}

/// The shader of the pass that brings the ground to the view's resolution.
pub fn upsample(ldr: bool, heat: bool) -> Handle<Shader> {
    UPSAMPLE[usize::from(ldr)][usize::from(heat)].clone()
}

/// The shader of the sky pass.
pub fn sky(ldr: bool, multisampled: bool) -> Handle<Shader> {
    SKY[usize::from(ldr)][usize::from(multisampled)].clone()
}

/// The fill pass behind a field's kernel.
pub fn fill_source(kernel: &str) -> String {
    [kernel, include_str!("cache/material.wgsl"), include_str!("cache/fill.wgsl")].join("\n")
}

fn pyramid_source() -> String {
    [SURFACE, include_str!("cache/pyramid.wgsl")].join("\n")
}

fn light_source() -> String {
    [SURFACE, include_str!("cache/light.wgsl")].join("\n")
}

fn clearance_source() -> String {
    [include_str!("passes/view.wgsl"), SURFACE, include_str!("passes/clearance.wgsl")].join("\n")
}

fn present(ldr: bool) -> &'static str {
    if ldr { include_str!("passes/present_ldr.wgsl") } else { PRESENT_HDR }
}

fn geometry_source(ldr: bool, heat: bool) -> String {
    let heat = if heat { HEAT } else { NO_HEAT };
    [
        present(ldr),
        heat,
        include_str!("passes/view.wgsl"),
        SURFACE,
        include_str!("cache/march.wgsl"),
        include_str!("passes/clear_start.wgsl"),
        include_str!("passes/heat.wgsl"),
        include_str!("passes/geometry.wgsl"),
    ]
    .join("\n")
}

fn upsample_source(ldr: bool, heat: bool) -> String {
    [&geometry_source(ldr, heat), include_str!("passes/upsample.wgsl")].join("\n")
}

fn sky_source(ldr: bool, multisampled: bool) -> String {
    let depth = if multisampled { DEPTH_MULTISAMPLED } else { DEPTH_SINGLE };
    [present(ldr), include_str!("passes/view.wgsl"), depth, include_str!("passes/sky.wgsl")].join("\n")
}

/// Every shader of this crate that stands without Bevy's imports, by name: for tests that translate them to other
/// shading languages. `kernel` is a field's, from [`horizon_field::field::kernel`].
pub fn shader_sources(kernel: &str) -> Vec<(&'static str, String)> {
    vec![
        ("fill", fill_source(kernel)),
        ("pyramid", pyramid_source()),
        ("light", light_source()),
        ("clearance", clearance_source()),
        ("geometry", geometry_source(false, false)),
        ("heat", geometry_source(false, true)),
        ("upsample", upsample_source(false, false)),
        ("upsample_heat", upsample_source(false, true)),
        ("sky", sky_source(false, false)),
        ("sky_multisampled", sky_source(false, true)),
    ]
}
