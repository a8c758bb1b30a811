//! The compute pipelines of the air's tables. None is made before an atmosphere asks for it.

use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, storage_buffer_sized, texture_storage_3d, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BindGroupLayoutEntries, CachedComputePipelineId, ComputePipeline,
    ComputePipelineDescriptor, DynamicBindGroupLayoutEntries, PipelineCache, ShaderStages, StorageTextureAccess,
    TextureFormat,
};

use super::super::shaders::Source;
use super::super::uniforms::{AirUniform, MediumUniform};
use super::sizes;
use crate::world::SkyModel;

/// A step of making tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    Transmittance,
    FirstOrder,
    SecondOrder,
    ThirdOrder,
    Isotropic,
    SkyView(SkyModel),
    Aerial(SkyModel),
}

impl Step {
    /// The steps that a medium's tables take, in order.
    pub fn of(model: SkyModel) -> &'static [Self] {
        match model {
            SkyModel::Gradient => &[],
            SkyModel::Single => &[Self::Transmittance],
            SkyModel::Fast => &[Self::Transmittance, Self::Isotropic],
            SkyModel::Full => &[Self::Transmittance, Self::FirstOrder, Self::SecondOrder, Self::ThirdOrder],
        }
    }

    fn shader(self) -> Source {
        match self {
            Self::Transmittance => Source::Transmittance,
            Self::FirstOrder => Source::Moments { first: true },
            Self::SecondOrder | Self::ThirdOrder => Source::Moments { first: false },
            Self::Isotropic => Source::Isotropic,
            Self::SkyView(model) | Self::Aerial(model) => Source::ViewTables { model },
        }
    }

    fn entry(self) -> &'static str {
        match self {
            Self::Transmittance => "transmittance_table",
            Self::FirstOrder => "first_order",
            Self::SecondOrder => "second_order",
            Self::ThirdOrder => "third_order",
            Self::Isotropic => "isotropic_table",
            Self::SkyView(_) => "sky_table",
            Self::Aerial(_) => "aerial_table",
        }
    }

    /// Work groups of its shader.
    pub fn groups(self) -> [u32; 2] {
        let eighths = |[width, height]: [u32; 2]| [width / 8, height / 8];
        match self {
            Self::Transmittance => eighths(sizes::TRANSMITTANCE),
            Self::FirstOrder | Self::SecondOrder | Self::ThirdOrder => sizes::MOMENTS,
            Self::Isotropic => eighths(sizes::ISOTROPIC),
            Self::SkyView(_) => eighths(sizes::SKY),
            Self::Aerial(_) => [sizes::AERIAL[0] / 8, sizes::AERIAL[1] / 4],
        }
    }

    fn is_of_view(self) -> bool {
        matches!(self, Self::SkyView(_) | Self::Aerial(_))
    }
}

/// The pipelines, and the layouts of what they bind.
#[derive(Resource)]
pub struct AirPipelines {
    pub medium_layout: BindGroupLayoutDescriptor,
    pub view_layout: BindGroupLayoutDescriptor,
    made: HashMap<Step, CachedComputePipelineId>,
}

impl Default for AirPipelines {
    fn default() -> Self {
        let write = || storage_buffer_sized(false, None);
        let read = || storage_buffer_read_only_sized(false, None);
        let volume = || texture_storage_3d(TextureFormat::Rgba16Float, StorageTextureAccess::WriteOnly);
        let medium = BindGroupLayoutEntries::sequential(
            ShaderStages::COMPUTE,
            (uniform_buffer::<MediumUniform>(false), write(), write(), write()),
        );
        let view = DynamicBindGroupLayoutEntries::new_with_indices(
            ShaderStages::COMPUTE,
            (
                (1, uniform_buffer::<AirUniform>(true)),
                (3, read()),
                (4, read()),
                (5, write()),
                (6, volume()),
                (7, volume()),
            ),
        );
        Self {
            medium_layout: BindGroupLayoutDescriptor::new("horizon_medium", &medium),
            view_layout: BindGroupLayoutDescriptor::new("horizon_air_view", &view),
            made: HashMap::default(),
        }
    }
}

impl AirPipelines {
    /// Asks for what a model needs.
    pub fn queue(&mut self, model: SkyModel, cache: &PipelineCache) {
        for &step in Step::of(model).iter().chain(&[Step::SkyView(model), Step::Aerial(model)]) {
            let layout = if step.is_of_view() { &self.view_layout } else { &self.medium_layout };
            self.made.entry(step).or_insert_with(|| {
                cache.queue_compute_pipeline(ComputePipelineDescriptor {
                    label: Some(step.entry().into()),
                    layout: vec![layout.clone()],
                    shader: step.shader().handle(),
                    entry_point: Some(step.entry().into()),
                    ..default()
                })
            });
        }
    }

    /// The pipeline of a step, once it is there.
    pub fn get<'a>(&self, step: Step, cache: &'a PipelineCache) -> Option<&'a ComputePipeline> {
        cache.get_compute_pipeline(*self.made.get(&step)?)
    }

    /// Whether a model's tables can be made.
    pub fn ready(&self, model: SkyModel, cache: &PipelineCache) -> bool {
        let steps = [Step::SkyView(model), Step::Aerial(model)];
        Step::of(model).iter().chain(&steps).all(|step| self.get(*step, cache).is_some())
    }
}
