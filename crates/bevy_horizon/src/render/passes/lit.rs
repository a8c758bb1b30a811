//! Passes of our own under Bevy's light, in the main pass: Bevy's own deferred lighting pipeline, with our text, so that its definitions
//! and layouts follow a view's features without our knowing them.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::pbr::MeshPipelineKey;
use bevy::pbr::deferred::DeferredLightingLayout;
use bevy::prelude::*;
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, CompareFunction, DepthStencilState, RenderPipelineDescriptor, SpecializedRenderPipeline,
};
use bevy::shader::{Shader, ShaderDefVal};

/// A pass over the whole viewport, outside of the deferred route's lighting ids: behind so many of Bevy's groups comes ours. Without depth.
pub fn pipeline(
    bevy: &DeferredLightingLayout,
    key: MeshPipelineKey,
    label: &'static str,
    groups: usize,
    layout: BindGroupLayoutDescriptor,
    shader: Handle<Shader>,
    entry: &'static str,
) -> RenderPipelineDescriptor {
    let mut descriptor = bevy.specialize(key);
    descriptor.label = Some(label.into());
    descriptor.layout.truncate(groups);
    descriptor.layout.push(layout);
    descriptor.multisample.count = key.msaa_samples();
    descriptor.depth_stencil = None;
    descriptor.vertex.shader = shader.clone();
    descriptor.vertex.entry_point = Some("fullscreen".into());
    let of_deferred = |def: &ShaderDefVal| matches!(def, ShaderDefVal::Bool(name, _) if name.starts_with("DEFERRED_"));
    descriptor.vertex.shader_defs.retain(|def| !of_deferred(def));
    let fragment = descriptor.fragment.as_mut().expect("lighting has a fragment shader");
    fragment.shader = shader;
    fragment.entry_point = Some(entry.into());
    fragment.shader_defs.retain(|def| !of_deferred(def));
    if key.msaa_samples() > 1 {
        fragment.shader_defs.push("MULTISAMPLED".into());
    }
    descriptor
}

/// Depth for what is drawn among the view's meshes, and hides what comes later.
pub fn depth() -> Option<DepthStencilState> {
    Some(DepthStencilState {
        format: CORE_3D_DEPTH_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(CompareFunction::GreaterEqual),
        stencil: default(),
        bias: default(),
    })
}
