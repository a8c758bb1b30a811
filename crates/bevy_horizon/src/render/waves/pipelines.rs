//! The compute pipelines of the waves. None is made before a sea is there.

use bevy::math::UVec4;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, storage_buffer_sized, texture_2d_array, texture_storage_2d_array, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BindGroupLayoutEntries, CachedComputePipelineId, ComputePipeline,
    ComputePipelineDescriptor, PipelineCache, ShaderStages, StorageTextureAccess, TextureFormat, TextureSampleType,
};

use super::super::shaders::Source;

/// A step of filling tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Rows,
    Columns,
    Over,
    Texels,
    Means,
}

impl Step {
    const ALL: [Self; 5] = [Self::Rows, Self::Columns, Self::Over, Self::Texels, Self::Means];

    fn shader(self) -> Source {
        match self {
            Self::Rows | Self::Columns => Source::SeaTransform,
            Self::Over | Self::Texels => Source::SeaSurface,
            Self::Means => Source::SeaMeans,
        }
    }

    fn entry(self) -> &'static str {
        match self {
            Self::Rows => "sea_rows",
            Self::Columns => "sea_columns",
            Self::Over => "sea_over",
            Self::Texels => "sea_texels",
            Self::Means => "sea_means",
        }
    }
}

/// The pipelines, and the layouts of what they bind.
#[derive(Resource)]
pub(crate) struct SeaPipelines {
    /// All buffers.
    pub sea_layout: BindGroupLayoutDescriptor,
    /// The textures' first level.
    pub texels_layout: BindGroupLayoutDescriptor,
    /// A level and the next.
    pub means_layout: BindGroupLayoutDescriptor,
    made: Option<[CachedComputePipelineId; 5]>,
}

impl Default for SeaPipelines {
    fn default() -> Self {
        let read = || storage_buffer_read_only_sized(false, None);
        let write = || storage_buffer_sized(false, None);
        let texture = || texture_2d_array(TextureSampleType::Float { filterable: true });
        let stored = || texture_storage_2d_array(TextureFormat::Rgba16Float, StorageTextureAccess::WriteOnly);
        let stage = ShaderStages::COMPUTE;
        Self {
            sea_layout: BindGroupLayoutDescriptor::new(
                "horizon_sea",
                &BindGroupLayoutEntries::sequential(
                    stage,
                    (uniform_buffer::<UVec4>(false), read(), read(), read(), write(), write(), write()),
                ),
            ),
            texels_layout: BindGroupLayoutDescriptor::new(
                "horizon_sea_texels",
                &BindGroupLayoutEntries::sequential(stage, (stored(), stored())),
            ),
            means_layout: BindGroupLayoutDescriptor::new(
                "horizon_sea_means",
                &BindGroupLayoutEntries::sequential(stage, (texture(), texture(), stored(), stored())),
            ),
            made: None,
        }
    }
}

impl SeaPipelines {
    /// Asks for all of them.
    pub fn queue(&mut self, cache: &PipelineCache) {
        let layout = |step| match step {
            Step::Rows | Step::Columns | Step::Over => vec![self.sea_layout.clone()],
            Step::Texels => vec![self.sea_layout.clone(), self.texels_layout.clone()],
            Step::Means => vec![self.means_layout.clone()],
        };
        let made = &mut self.made;
        made.get_or_insert_with(|| {
            Step::ALL.map(|step| {
                cache.queue_compute_pipeline(ComputePipelineDescriptor {
                    label: Some(step.entry().into()),
                    layout: layout(step),
                    shader: step.shader().handle(),
                    entry_point: Some(step.entry().into()),
                    ..default()
                })
            })
        });
    }

    /// The pipeline of a step, once it is there.
    pub fn get<'a>(&self, step: Step, cache: &'a PipelineCache) -> Option<&'a ComputePipeline> {
        cache.get_compute_pipeline(self.made?[step as usize])
    }

    /// Whether tiles can be filled.
    pub fn ready(&self, cache: &PipelineCache) -> bool {
        Step::ALL.into_iter().all(|step| self.get(step, cache).is_some())
    }
}
