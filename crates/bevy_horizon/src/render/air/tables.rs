//! The tables of each medium that a camera sees.

use bevy::math::Mat3;
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, Buffer, BufferDescriptor, BufferInitDescriptor, BufferUsages, ComputePassDescriptor,
    PipelineCache, encase,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use horizon_light::medium::Medium;
use horizon_light::models::air::Air;
use horizon_light::spectrum::Star;
use horizon_light::sun::SunDisc;

use super::super::uniforms::{DiscUniform, MediumUniform};
use super::pipelines::{AirPipelines, Step};
use super::sizes::{self, TEXEL};
use crate::world::{Atmosphere, SkyModel};

/// The tables of all media.
#[derive(Resource, Default)]
pub struct AirTables {
    tables: Vec<AirTable>,
    /// How many times any were made.
    versions: u32,
}

/// A medium's tables. A medium that changes keeps them: each of its versions is made over the last.
struct AirTable {
    model: SkyModel,
    medium: Medium,
    seen: SeenMedium,
    uniform: Buffer,
    transmittances: Buffer,
    multiple: Buffer,
    group: BindGroup,
    /// Their number among all that were made; 0 before they are.
    version: u32,
    stale: bool,
    /// They are made in this frame.
    due: bool,
    used: bool,
}

/// What the shaders see of a medium: it does not change from frame to frame.
#[derive(Clone, Copy)]
pub struct SeenMedium {
    pub medium: MediumUniform,
    pub disc: DiscUniform,
    /// From radiance at the medium's wavelengths to linear sRGB in cd/m²: integrals over the spectrum.
    pub to_rgb: Mat3,
}

impl SeenMedium {
    fn new(medium: &Medium) -> Self {
        let rows = Star::of(medium).matrix().map(|row| row.map(|x| x as f32));
        Self {
            medium: MediumUniform::new(&Air::new(medium)),
            disc: DiscUniform::new(&SunDisc::of(medium).cast()),
            to_rgb: Mat3::from_cols_array_2d(&rows).transpose(),
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let mut bytes = encase::UniformBuffer::new(Vec::new());
        bytes.write(&self.medium).expect("a vector takes any size");
        bytes.into_inner()
    }
}

impl AirTable {
    fn new(atmosphere: &Atmosphere, pipelines: &AirPipelines, cache: &PipelineCache, device: &RenderDevice) -> Self {
        let buffer = |label, texels: u64| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size: texels * TEXEL,
                usage: BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let model = atmosphere.model;
        let orders = buffer("horizon_air_orders", sizes::order_texels(model));
        let transmittances = buffer("horizon_air_transmittance", sizes::texels(sizes::TRANSMITTANCE));
        let multiple = buffer("horizon_air_multiple", sizes::multiple_texels(model));
        let seen = SeenMedium::new(&atmosphere.medium);
        let uniform = device.create_buffer_with_data(&BufferInitDescriptor {
            label: Some("horizon_medium"),
            contents: &seen.bytes(),
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        });
        let group = device.create_bind_group(
            "horizon_medium",
            &cache.get_bind_group_layout(&pipelines.medium_layout),
            &BindGroupEntries::sequential((
                uniform.as_entire_binding(),
                transmittances.as_entire_binding(),
                orders.as_entire_binding(),
                multiple.as_entire_binding(),
            )),
        );
        Self {
            model,
            medium: atmosphere.medium,
            seen,
            uniform,
            transmittances,
            multiple,
            group,
            version: 0,
            stale: true,
            due: false,
            used: false,
        }
    }
}

impl AirTables {
    /// A frame begins.
    pub fn begin(&mut self) {
        for table in &mut self.tables {
            (table.used, table.due) = (false, false);
        }
    }

    /// The tables of an atmosphere, by their index in this frame; made anew if the medium is not the one that they are of.
    pub fn find(
        &mut self,
        atmosphere: &Atmosphere,
        pipelines: &mut AirPipelines,
        cache: &PipelineCache,
        device: &RenderDevice,
        queue: &RenderQueue,
    ) -> usize {
        let model = atmosphere.model;
        pipelines.queue(model, cache);
        let same = |table: &AirTable| table.model == model && table.medium == atmosphere.medium;
        let index = self
            .tables
            .iter()
            .position(same)
            .or_else(|| self.tables.iter().position(|table| table.model == model && !table.used));
        let index = index.unwrap_or_else(|| {
            self.tables.push(AirTable::new(atmosphere, pipelines, cache, device));
            self.tables.len() - 1
        });
        let table = &mut self.tables[index];
        if table.medium != atmosphere.medium {
            table.medium = atmosphere.medium;
            table.seen = SeenMedium::new(&atmosphere.medium);
            table.stale = true;
            queue.write_buffer(&table.uniform, 0, &table.seen.bytes());
        }
        if table.stale && pipelines.ready(model, cache) {
            (table.stale, table.due) = (false, true);
            self.versions += 1;
            table.version = self.versions;
        }
        table.used = true;
        index
    }

    /// The views are through: what none uses goes once it lies behind all that are.
    pub fn end(&mut self) {
        while self.tables.last().is_some_and(|table| !table.used) {
            self.tables.pop();
        }
    }

    /// Whether there is something to draw from.
    pub fn made(&self, table: usize) -> bool {
        self.tables[table].version > 0
    }

    /// Their number among all that were made.
    pub fn version(&self, table: usize) -> u32 {
        self.tables[table].version
    }

    /// What the shaders see of the medium.
    pub fn seen(&self, table: usize) -> &SeenMedium {
        &self.tables[table].seen
    }

    /// Transmittance, and diffuse light.
    pub fn buffers(&self, table: usize) -> Option<[&Buffer; 2]> {
        self.tables.get(table).map(|table| [&table.transmittances, &table.multiple])
    }

    /// Tables that are up to date, and all.
    pub fn progress(&self) -> (usize, usize) {
        (self.tables.iter().filter(|table| !table.stale).count(), self.tables.len())
    }

    pub fn dispatch(&self, pipelines: &AirPipelines, cache: &PipelineCache, ctx: &mut RenderContext) {
        for table in self.tables.iter().filter(|table| table.due) {
            let diagnostics = ctx.diagnostic_recorder();
            let diagnostics = diagnostics.as_deref();
            let mut pass = ctx
                .command_encoder()
                .begin_compute_pass(&ComputePassDescriptor { label: Some("horizon_air"), timestamp_writes: None });
            let span = diagnostics.pass_span(&mut pass, "horizon_air");
            for &step in Step::of(table.model) {
                let Some(pipeline) = pipelines.get(step, cache) else { continue };
                let [x, y] = step.groups();
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &table.group, &[]);
                pass.dispatch_workgroups(x, y, 1);
            }
            span.end(&mut pass);
        }
    }
}
