//! The render pipelines of the passes: specialised by what the view's target is, never by what the world is.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::core_pipeline::tonemapping::{Tonemapping, get_lut_bind_group_layout_entries};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, texture_depth_2d, texture_depth_2d_multisampled, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BlendComponent, BlendFactor, BlendOperation, BlendState, CachedRenderPipelineId,
    ColorTargetState, ColorWrites, CompareFunction, DepthStencilState, DynamicBindGroupLayoutEntries, FragmentState,
    MultisampleState, PipelineCache, RenderPipelineDescriptor, ShaderStages, TextureFormat, VertexState,
};
use bevy::render::view::ViewUniform;
use bevy::shader::ShaderDefVal;

use super::super::shaders;
use super::super::uniforms::{ClipmapUniform, HorizonViewUniform, SkyUniform};

/// A pass of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    Ground,
    Sky,
}

impl Pass {
    /// Its name, in pipelines, passes and spans.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Ground => "horizon_ground",
            Self::Sky => "horizon_sky",
        }
    }
}

/// What a pipeline depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PassKey {
    pub format: TextureFormat,
    pub samples: u32,
    /// How an LDR view is tonemapped; `None` in HDR.
    pub tonemapping: Option<Tonemapping>,
}

/// The pipelines that views asked for, and the layouts of what they bind.
#[derive(Resource)]
pub struct PassPipelines {
    made: HashMap<(Pass, PassKey), CachedRenderPipelineId>,
    layouts: HashMap<(Pass, bool, bool), BindGroupLayoutDescriptor>,
}

impl Default for PassPipelines {
    fn default() -> Self {
        let mut layouts = HashMap::default();
        for pass in [Pass::Ground, Pass::Sky] {
            for (ldr, multisampled) in [(false, false), (false, true), (true, false), (true, true)] {
                layouts.insert((pass, ldr, multisampled), new_layout(pass, ldr, multisampled));
            }
        }
        Self { made: HashMap::default(), layouts }
    }
}

fn new_layout(pass: Pass, ldr: bool, multisampled: bool) -> BindGroupLayoutDescriptor {
    let view = uniform_buffer::<HorizonViewUniform>(true);
    let read = || storage_buffer_read_only_sized(false, None);
    let mut entries = match pass {
        Pass::Ground => DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (2, read()),
                (3, read()),
                (4, read()),
                (5, view),
            ),
        ),
        Pass::Sky => DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, view),
                (1, uniform_buffer::<SkyUniform>(true)),
                (2, if multisampled { texture_depth_2d_multisampled() } else { texture_depth_2d() }),
            ),
        ),
    };
    if ldr {
        let [texture, sampler] = get_lut_bind_group_layout_entries();
        entries =
            entries.extend_with_indices(((10, uniform_buffer::<ViewUniform>(true)), (11, texture), (12, sampler)));
    }
    BindGroupLayoutDescriptor::new("horizon_pass", &entries)
}

/// The definitions that Bevy's tonemapping expects.
fn tonemapping_defs(tonemapping: Tonemapping) -> Vec<ShaderDefVal> {
    let method = match tonemapping {
        Tonemapping::None => "TONEMAP_METHOD_NONE",
        Tonemapping::Reinhard => "TONEMAP_METHOD_REINHARD",
        Tonemapping::ReinhardLuminance => "TONEMAP_METHOD_REINHARD_LUMINANCE",
        Tonemapping::AcesFitted => "TONEMAP_METHOD_ACES_FITTED",
        Tonemapping::AgX => "TONEMAP_METHOD_AGX",
        Tonemapping::SomewhatBoringDisplayTransform => "TONEMAP_METHOD_SOMEWHAT_BORING_DISPLAY_TRANSFORM",
        Tonemapping::TonyMcMapface => "TONEMAP_METHOD_TONY_MC_MAPFACE",
        Tonemapping::BlenderFilmic => "TONEMAP_METHOD_BLENDER_FILMIC",
        Tonemapping::KhronosPbrNeutral => "TONEMAP_METHOD_PBR_NEUTRAL",
    };
    vec![
        method.into(),
        ShaderDefVal::UInt("TONEMAPPING_LUT_TEXTURE_BINDING_INDEX".into(), 11),
        ShaderDefVal::UInt("TONEMAPPING_LUT_SAMPLER_BINDING_INDEX".into(), 12),
    ]
}

impl PassPipelines {
    /// The layout of what a pass binds.
    pub fn layout(&self, pass: Pass, ldr: bool, multisampled: bool) -> &BindGroupLayoutDescriptor {
        &self.layouts[&(pass, ldr, multisampled)]
    }

    /// The pipeline of a pass, asked for once.
    pub fn get(&mut self, cache: &PipelineCache, pass: Pass, key: PassKey) -> CachedRenderPipelineId {
        if let Some(id) = self.made.get(&(pass, key)) {
            return *id;
        }
        let ldr = key.tonemapping.is_some();
        let multisampled = key.samples > 1;
        let shader = match pass {
            Pass::Ground => shaders::geometry(ldr),
            Pass::Sky => shaders::sky(ldr, multisampled),
        };
        let defs = key.tonemapping.map(tonemapping_defs).unwrap_or_default();
        let id = cache.queue_render_pipeline(RenderPipelineDescriptor {
            label: Some(pass.label().into()),
            layout: vec![self.layout(pass, ldr, multisampled).clone()],
            vertex: VertexState {
                shader: shader.clone(),
                shader_defs: defs.clone(),
                entry_point: Some("fullscreen".into()),
                ..default()
            },
            depth_stencil: (pass == Pass::Ground).then(|| DepthStencilState {
                format: CORE_3D_DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(CompareFunction::GreaterEqual),
                stencil: default(),
                bias: default(),
            }),
            multisample: MultisampleState { count: key.samples, ..default() },
            fragment: Some(FragmentState {
                shader,
                shader_defs: defs,
                entry_point: Some(if pass == Pass::Ground { "ground" } else { "air" }.into()),
                targets: vec![Some(ColorTargetState {
                    format: key.format,
                    blend: (pass == Pass::Sky).then_some(OVER),
                    write_mask: ColorWrites::ALL,
                })],
            }),
            ..default()
        });
        self.made.insert((pass, key), id);
        id
    }
}

/// The air over what is behind it: its own light, premultiplied, and the rest shines through.
const OVER: BlendState = {
    let over = BlendComponent {
        src_factor: BlendFactor::One,
        dst_factor: BlendFactor::OneMinusSrcAlpha,
        operation: BlendOperation::Add,
    };
    BlendState { color: over, alpha: over }
};
