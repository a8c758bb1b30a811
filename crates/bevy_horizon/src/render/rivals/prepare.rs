//! A rival's pipeline, one for each structure of a field, and what it binds: the field, anchored at the eye.

use bevy::core_pipeline::core_3d::CORE_3D_DEPTH_FORMAT;
use bevy::math::Vec4;
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{storage_buffer_read_only_sized, uniform_buffer};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, BufferInitDescriptor, BufferUsages,
    CachedRenderPipelineId, ColorTargetState, ColorWrites, CompareFunction, DepthStencilState, FragmentState,
    PipelineCache, RenderPipelineDescriptor, ShaderStages, ShaderType, TextureFormat, VertexState, encase,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::view::ExtractedView;
use bevy::shader::Shader;
use horizon_field::field::Contents;
use horizon_field::field::kernel::module;
use horizon_field::methods::{Method, WGSL};

use super::super::extract::{ExtractedHorizonCamera, ExtractedTerrain, ExtractedWorld};
use super::super::uniforms::HorizonViewUniform;
use super::super::view::{HorizonViews, ViewGround};
use super::RivalMarch;

/// What a view draws its rival's ground with.
#[derive(Component)]
pub struct ViewRival {
    pub pipeline: CachedRenderPipelineId,
    pub groups: [BindGroup; 2],
}

/// `Rival` of `rival.wgsl`.
#[derive(Clone, Debug, ShaderType)]
struct RivalUniform {
    kind: u32,
    bisections: u32,
    high: f32,
    slope: f32,
    numbers: Vec4,
}

impl RivalUniform {
    fn new(method: Method, terrain: &ExtractedTerrain, pixel: f32) -> Option<Self> {
        let (kind, bisections, numbers) = match method {
            Method::FixedStep { a, b, c, k } => (0, k, Vec4::new(a as f32, b as f32, c as f32, 0.0)),
            Method::Linear { delta } => (1, 0, Vec4::new(delta as f32, 0.0, 0.0, 0.0)),
            Method::SphereTracing { omega, pixel: share } => {
                (2, 0, Vec4::new(omega as f32, share as f32 * pixel, 0.0, 0.0))
            }
            _ => return None,
        };
        let field = &terrain.fields.height;
        Some(Self { kind, bisections, high: field.range().1 as f32, slope: field.slope() as f32, numbers })
    }
}

/// Pipelines by structure and format, and the layouts of what they bind.
#[derive(Resource)]
pub struct RivalPipelines {
    layouts: [BindGroupLayoutDescriptor; 2],
    shaders: HashMap<u64, Handle<Shader>>,
    made: HashMap<(u64, TextureFormat), CachedRenderPipelineId>,
}

impl Default for RivalPipelines {
    fn default() -> Self {
        let stage = ShaderStages::FRAGMENT;
        let read = || storage_buffer_read_only_sized(false, None);
        let view = (uniform_buffer::<HorizonViewUniform>(true), uniform_buffer::<RivalUniform>(false));
        let layouts = [
            BindGroupLayoutDescriptor::new("horizon_rival", &BindGroupLayoutEntries::sequential(stage, view)),
            BindGroupLayoutDescriptor::new(
                "horizon_rival_field",
                &BindGroupLayoutEntries::sequential(stage, (read(), read(), read(), read())),
            ),
        ];
        Self { layouts, shaders: HashMap::default(), made: HashMap::default() }
    }
}

impl RivalPipelines {
    fn get(
        &mut self,
        cache: &PipelineCache,
        shaders: &mut Vec<(Handle<Shader>, Shader)>,
        terrain: &ExtractedTerrain,
        format: TextureFormat,
    ) -> CachedRenderPipelineId {
        let kernel = module(1, &[("height", &terrain.fields.height)]);
        let shader = self
            .shaders
            .entry(kernel.structure)
            .or_insert_with(|| {
                let source =
                    [&kernel.source, include_str!("../passes/view.wgsl"), WGSL, include_str!("rival.wgsl")].join("\n");
                let path = format!("bevy_horizon/generated/rival_{:016x}.wgsl", kernel.structure);
                let handle =
                    Handle::Uuid(bevy::asset::uuid::Uuid::from_u64_pair(0x6e3f_0f52, kernel.structure), default());
                shaders.push((handle.clone(), Shader::from_wgsl(source, path)));
                handle
            })
            .clone();
        *self.made.entry((kernel.structure, format)).or_insert_with(|| {
            cache.queue_render_pipeline(RenderPipelineDescriptor {
                label: Some("horizon_rival".into()),
                layout: self.layouts.to_vec(),
                vertex: VertexState { shader: shader.clone(), entry_point: Some("fullscreen".into()), ..default() },
                depth_stencil: Some(DepthStencilState {
                    format: CORE_3D_DEPTH_FORMAT,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(CompareFunction::GreaterEqual),
                    stencil: default(),
                    bias: default(),
                }),
                fragment: Some(FragmentState {
                    shader,
                    entry_point: Some("draw".into()),
                    targets: vec![Some(ColorTargetState { format, blend: None, write_mask: ColorWrites::ALL })],
                    ..default()
                }),
                ..default()
            })
        })
    }
}

type Views<'w, 's> = Query<
    'w,
    's,
    (Entity, &'static RivalMarch, &'static ViewGround, &'static ExtractedHorizonCamera, &'static ExtractedView),
>;

pub fn prepare_rivals(
    mut commands: Commands,
    mut pipelines: ResMut<RivalPipelines>,
    mut cache: ResMut<PipelineCache>,
    world: Res<ExtractedWorld>,
    uniforms: Res<HorizonViews>,
    device: Res<RenderDevice>,
    views: Views,
) {
    for (entity, rival, ground, camera, view) in &views {
        commands.entity(entity).remove::<ViewRival>();
        let Some(terrain) = world.terrains.iter().find(|terrain| camera.layers.intersects(&terrain.layers)) else {
            continue;
        };
        let Some(numbers) = RivalUniform::new(rival.0, terrain, ground.pixel) else { continue };
        let mut new = Vec::new();
        let pipeline = pipelines.get(&cache, &mut new, terrain, view.target_format);
        for (handle, shader) in new {
            cache.set_shader(handle.id(), shader);
        }
        let Some(binding) = uniforms.views.binding() else { continue };
        let mut bytes = encase::UniformBuffer::new(Vec::new());
        bytes.write(&numbers).expect("a vector takes any size");
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_with_data(&BufferInitDescriptor { label: Some("horizon_rival"), contents, usage })
        };
        let numbers = buffer(bytes.as_ref(), BufferUsages::UNIFORM);
        let field = &terrain.fields.height;
        let contents = Contents::new(&[field]);
        let mut anchors = Vec::new();
        let eye = horizon_field::Place { cell: [ground.eye.cell[0], 0, ground.eye.cell[2]], ..ground.eye };
        field.append_anchor_bytes(&field.anchor(&eye), &mut anchors);
        anchors.resize(anchors.len().max(64), 0);
        let [layers, anchors, numbers_of, images] = [&contents.layers, &anchors, &contents.numbers, &contents.images]
            .map(|bytes| buffer(bytes, BufferUsages::STORAGE));
        let layout = |i: usize| cache.get_bind_group_layout(&pipelines.layouts[i]);
        let groups = [
            device.create_bind_group(
                "horizon_rival",
                &layout(0),
                &BindGroupEntries::sequential((binding, numbers.as_entire_binding())),
            ),
            device.create_bind_group(
                "horizon_rival_field",
                &layout(1),
                &BindGroupEntries::sequential((
                    layers.as_entire_binding(),
                    anchors.as_entire_binding(),
                    numbers_of.as_entire_binding(),
                    images.as_entire_binding(),
                )),
            ),
        ];
        commands.entity(entity).insert(ViewRival { pipeline, groups });
    }
}
