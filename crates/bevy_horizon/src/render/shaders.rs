//! The shaders, put together from their files: plain WGSL, joined in order, so that nothing depends on an import being
//! found. Only the tonemapping of LDR views imports, from Bevy.

use bevy::asset::{Assets, Handle, uuid_handle};
use bevy::shader::Shader;

pub const PYRAMID: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a01");
pub const LIGHT: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a02");
const GEOMETRY_HDR: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a03");
const GEOMETRY_LDR: Handle<Shader> = uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a04");
const SKY: [[Handle<Shader>; 2]; 2] = [
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a05"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a06")],
    [uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a07"), uuid_handle!("6e3f0f52-7b57-4b0f-9f0a-0d6a4d1c8a08")],
];

const SURFACE: &str = include_str!("cache/surface.wgsl");
const PRESENT_HDR: &str = "fn present(colour: vec4<f32>) -> vec4<f32> {\n    return colour;\n}\n";
const DEPTH_SINGLE: &str = "@group(0) @binding(2) var depth_texture: texture_depth_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, 0);\n}\n";
const DEPTH_MULTISAMPLED: &str = "@group(0) @binding(2) var depth_texture: texture_depth_multisampled_2d;\n\
    fn depth_at(at: vec2<i32>, sample_index: i32) -> f32 {\n    return textureLoad(depth_texture, at, sample_index);\n}\n";

/// Adds the shaders that are the same for every world. They are text until a pipeline asks for them.
pub fn add_shaders(shaders: &mut Assets<Shader>) {
    let mut add = |handle: Handle<Shader>, name: &str, source: String| {
        let path = format!("bevy_horizon/{name}.wgsl");
        shaders.insert(&handle, Shader::from_wgsl(source, path)).expect("a handle by UUID is always valid");
    };
    add(PYRAMID, "pyramid", pyramid_source());
    add(LIGHT, "light", light_source());
    for ldr in [false, true] {
        add(geometry(ldr), "geometry", geometry_source(ldr));
        for multisampled in [false, true] {
            add(sky(ldr, multisampled), "sky", sky_source(ldr, multisampled));
        }
    }
}

/// The shader of the geometry pass.
pub fn geometry(ldr: bool) -> Handle<Shader> {
    if ldr { GEOMETRY_LDR } else { GEOMETRY_HDR }
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

fn present(ldr: bool) -> &'static str {
    if ldr { include_str!("passes/present_ldr.wgsl") } else { PRESENT_HDR }
}

fn geometry_source(ldr: bool) -> String {
    [
        present(ldr),
        include_str!("passes/view.wgsl"),
        SURFACE,
        include_str!("cache/march.wgsl"),
        include_str!("passes/geometry.wgsl"),
    ]
    .join("\n")
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
        ("geometry", geometry_source(false)),
        ("sky", sky_source(false, false)),
        ("sky_multisampled", sky_source(false, true)),
    ]
}
