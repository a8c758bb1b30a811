//! The compute pipelines of the caches: one to fill for each structure of a field, one for pyramids, one for light. None is
//! made before a terrain is there.

use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, storage_buffer_sized, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BindGroupLayoutEntries, CachedComputePipelineId, ComputePipeline,
    ComputePipelineDescriptor, PipelineCache, ShaderStages,
};
use bevy::shader::Shader;

use super::super::extract::ExtractedTerrain;
use super::super::shaders::Source;
use super::super::uniforms::{ClipmapUniform, MaterialUniform, SunUniform};

/// The pipelines, and the layouts of what they bind.
#[derive(Resource)]
pub struct CachePipelines {
    pub field_layout: BindGroupLayoutDescriptor,
    pub fill_layout: BindGroupLayoutDescriptor,
    pub pyramid_layout: BindGroupLayoutDescriptor,
    pub light_layout: BindGroupLayoutDescriptor,
    fill: HashMap<u64, CachedComputePipelineId>,
    pyramid: Option<CachedComputePipelineId>,
    light: Option<CachedComputePipelineId>,
}

impl Default for CachePipelines {
    fn default() -> Self {
        let read = || storage_buffer_read_only_sized(false, None);
        let write = || storage_buffer_sized(false, None);
        let stage = ShaderStages::COMPUTE;
        Self {
            field_layout: BindGroupLayoutDescriptor::new(
                "horizon_field",
                &BindGroupLayoutEntries::sequential(stage, (read(), read(), read(), read())),
            ),
            fill_layout: BindGroupLayoutDescriptor::new(
                "horizon_fill",
                &BindGroupLayoutEntries::sequential(
                    stage,
                    (read(), uniform_buffer::<MaterialUniform>(false), write(), write(), read()),
                ),
            ),
            pyramid_layout: BindGroupLayoutDescriptor::new(
                "horizon_pyramid",
                &BindGroupLayoutEntries::sequential(
                    stage,
                    (uniform_buffer::<ClipmapUniform>(false), read(), write(), read()),
                ),
            ),
            light_layout: BindGroupLayoutDescriptor::new(
                "horizon_light",
                &BindGroupLayoutEntries::sequential(
                    stage,
                    (
                        uniform_buffer::<ClipmapUniform>(false),
                        read(),
                        read(),
                        read(),
                        uniform_buffer::<SunUniform>(false),
                        write(),
                    ),
                ),
            ),
            fill: HashMap::default(),
            pyramid: None,
            light: None,
        }
    }
}

impl CachePipelines {
    /// Asks for what a terrain needs.
    pub fn queue(&mut self, cache: &PipelineCache, terrain: &ExtractedTerrain) {
        let compute = |label: &'static str,
                       layout: Vec<BindGroupLayoutDescriptor>,
                       shader: Handle<Shader>,
                       entry: &'static str| {
            cache.queue_compute_pipeline(ComputePipelineDescriptor {
                label: Some(label.into()),
                layout,
                shader,
                entry_point: Some(entry.into()),
                ..default()
            })
        };
        self.fill.entry(terrain.kernel.structure).or_insert_with(|| {
            let layout = vec![self.field_layout.clone(), self.fill_layout.clone()];
            compute("horizon_fill", layout, terrain.kernel.shader.clone(), "fill")
        });
        self.pyramid.get_or_insert_with(|| {
            compute("horizon_pyramid", vec![self.pyramid_layout.clone()], Source::Pyramid.handle(), "pyramid")
        });
        self.light.get_or_insert_with(|| {
            compute("horizon_light", vec![self.light_layout.clone()], Source::Light.handle(), "light")
        });
    }

    /// Whether a terrain of this structure can be filled.
    pub fn ready(&self, cache: &PipelineCache, structure: u64) -> bool {
        self.get(cache, structure).is_some()
    }

    /// The pipelines to fill, for pyramids and for light.
    pub fn get<'a>(&self, cache: &'a PipelineCache, structure: u64) -> Option<[&'a ComputePipeline; 3]> {
        Some([
            cache.get_compute_pipeline(*self.fill.get(&structure)?)?,
            cache.get_compute_pipeline(self.pyramid?)?,
            cache.get_compute_pipeline(self.light?)?,
        ])
    }
}
