//! The render pipelines of the passes: specialised by what the view's target is, never by what the world is.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::core_pipeline::tonemapping::{Tonemapping, get_lut_bind_group_layout_entries};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{
    sampler, storage_buffer_read_only_sized, texture_3d, texture_depth_2d, texture_depth_2d_multisampled,
    uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BlendComponent, BlendFactor, BlendOperation, BlendState, CachedRenderPipelineId,
    ColorTargetState, ColorWrites, CompareFunction, DepthStencilState, DynamicBindGroupLayoutEntries, FragmentState,
    MultisampleState, PipelineCache, RenderPipelineDescriptor, SamplerBindingType, ShaderStages, TextureFormat,
    TextureSampleType, VertexState,
};
use bevy::render::view::ViewUniform;
use bevy::shader::ShaderDefVal;

use super::super::shaders::Source;
use super::super::uniforms::{AirUniform, ClipmapUniform, GradientUniform, HorizonViewUniform};
use crate::world::SkyModel;

/// A pass of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// A debug view of the ground.
    Heat,
    /// What the air takes from what was drawn.
    Veil,
    /// What the air adds to what was drawn.
    Haze,
    /// The sky, where nothing was.
    Sky,
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Heat, Self::Veil, Self::Haze, Self::Sky];

    /// Its name, in pipelines, passes and spans.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Heat => "horizon_heat",
            Self::Veil => "horizon_veil",
            Self::Haze => "horizon_haze",
            Self::Sky => "horizon_sky",
        }
    }

    /// Its fragment shader's entry point.
    const fn entry(self) -> &'static str {
        match self {
            Self::Heat => "shown",
            Self::Veil => "air_veil",
            Self::Haze => "air_haze",
            Self::Sky => "air_sky",
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
    /// The model of the air, if there is air.
    pub air: SkyModel,
}

/// The pipelines that views asked for, and the layouts of what they bind.
#[derive(Resource)]
pub struct PassPipelines {
    made: HashMap<(Pass, PassKey), CachedRenderPipelineId>,
    layouts: HashMap<(Pass, Variant), BindGroupLayoutDescriptor>,
}

impl Default for PassPipelines {
    fn default() -> Self {
        let mut layouts = HashMap::default();
        for pass in Pass::ALL {
            for bits in 0..8 {
                let bit = |i: u32| bits >> i & 1 != 0;
                let variant = Variant { ldr: bit(0), multisampled: bit(1), air: bit(2) };
                layouts.insert((pass, variant), new_layout(pass, variant));
            }
        }
        Self { made: HashMap::default(), layouts }
    }
}

/// What of a key decides what is bound, and which text the shader has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Variant {
    pub ldr: bool,
    pub multisampled: bool,
    /// Whether the air has tables.
    pub air: bool,
}

impl PassKey {
    pub fn variant(&self) -> Variant {
        Variant { ldr: self.tonemapping.is_some(), multisampled: self.samples > 1, air: self.air != SkyModel::Gradient }
    }
}

fn new_layout(pass: Pass, Variant { ldr, multisampled, air }: Variant) -> BindGroupLayoutDescriptor {
    let view = uniform_buffer::<HorizonViewUniform>(true);
    let read = || storage_buffer_read_only_sized(false, None);
    let mut entries = match pass {
        Pass::Heat => DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, uniform_buffer::<ClipmapUniform>(false)),
                (1, read()),
                (2, read()),
                (3, read()),
                (5, view),
                (6, read()),
                (9, read()),
            ),
        ),
        Pass::Veil | Pass::Haze | Pass::Sky => DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::FRAGMENT,
            (
                (0, view),
                (1, if air { uniform_buffer::<AirUniform>(true) } else { uniform_buffer::<GradientUniform>(true) }),
                (2, if multisampled { texture_depth_2d_multisampled() } else { texture_depth_2d() }),
            ),
        ),
    };
    if air && pass != Pass::Heat {
        let volume = || texture_3d(TextureSampleType::Float { filterable: true });
        let linear = sampler(SamplerBindingType::Filtering);
        entries = entries.extend_with_indices((
            (3, read()),
            (4, read()),
            (5, read()),
            (6, volume()),
            (7, volume()),
            (8, linear),
        ));
    }
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
    pub fn layout(&self, pass: Pass, variant: Variant) -> &BindGroupLayoutDescriptor {
        &self.layouts[&(pass, variant)]
    }

    /// The pipeline of a pass, asked for once.
    pub fn get(&mut self, cache: &PipelineCache, pass: Pass, key: PassKey) -> CachedRenderPipelineId {
        if let Some(id) = self.made.get(&(pass, key)) {
            return *id;
        }
        let variant = key.variant();
        let Variant { ldr, multisampled, air } = variant;
        let source = match pass {
            Pass::Heat => Source::Heat { ldr },
            Pass::Veil | Pass::Haze | Pass::Sky if air => Source::Air { model: key.air, ldr, multisampled },
            Pass::Veil | Pass::Haze | Pass::Sky => Source::Gradient { ldr, multisampled },
        };
        let shader = source.handle();
        let defs = key.tonemapping.map(tonemapping_defs).unwrap_or_default();
        let id = cache.queue_render_pipeline(RenderPipelineDescriptor {
            label: Some(pass.label().into()),
            layout: vec![self.layout(pass, variant).clone()],
            vertex: VertexState {
                shader: shader.clone(),
                shader_defs: defs.clone(),
                entry_point: Some("fullscreen".into()),
                ..default()
            },
            depth_stencil: Some(DepthStencilState {
                format: CORE_3D_DEPTH_FORMAT,
                depth_write_enabled: Some(pass == Pass::Heat),
                // The air's fragments lie at infinity, where depth is 0.
                depth_compare: Some(match pass {
                    Pass::Heat => CompareFunction::GreaterEqual,
                    Pass::Veil | Pass::Haze => CompareFunction::Less,
                    Pass::Sky => CompareFunction::Equal,
                }),
                stencil: default(),
                bias: default(),
            }),
            multisample: MultisampleState { count: key.samples, ..default() },
            fragment: Some(FragmentState {
                shader,
                shader_defs: defs,
                entry_point: Some(pass.entry().into()),
                targets: vec![Some(ColorTargetState {
                    format: key.format,
                    blend: match pass {
                        Pass::Heat | Pass::Sky => None,
                        Pass::Veil => Some(THROUGH),
                        Pass::Haze => Some(OVER),
                    },
                    write_mask: ColorWrites::ALL,
                })],
            }),
            ..default()
        });
        self.made.insert((pass, key), id);
        id
    }
}

/// What was drawn, as far as the air lets each channel of it through.
const THROUGH: BlendState = BlendState {
    color: BlendComponent {
        src_factor: BlendFactor::Zero,
        dst_factor: BlendFactor::Src,
        operation: BlendOperation::Add,
    },
    alpha: BlendComponent {
        src_factor: BlendFactor::Zero,
        dst_factor: BlendFactor::One,
        operation: BlendOperation::Add,
    },
};

/// The air over what is behind it: its own light, premultiplied, and the rest shines through.
const OVER: BlendState = {
    let over = BlendComponent {
        src_factor: BlendFactor::One,
        dst_factor: BlendFactor::OneMinusSrcAlpha,
        operation: BlendOperation::Add,
    };
    BlendState { color: over, alpha: over }
};
