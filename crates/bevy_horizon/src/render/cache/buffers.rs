//! The device's side of a cache: its buffers, and a frame's jobs.

use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, Buffer, BufferDescriptor, BufferInitDescriptor, BufferUsages, ComputePassDescriptor,
    PipelineCache, ShaderType, UniformBuffer, encase,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use bytemuck::{Pod, Zeroable};
use horizon_field::Stamps;
use horizon_field::field::Contents;
use horizon_field::material::compile::CUTOFF;
use horizon_field::stamp::PART_BYTES;

use super::super::kernel::fields_of;
use super::super::uniforms::{ClipmapUniform, MaterialUniform, SunUniform};
use super::CachePipelines;
use super::clipmap::{Clipmap, DrawnLevel, TILE, TILE_BOUNDS, TILE_LOOKS, TILE_TEXELS, Tile, Work, place_of};
use crate::world::TerrainFields;

/// Bytes of a tile: height, looks and bounds.
pub const TILE_BYTES: u64 = TILE_TEXELS * 4 + LOOK_BYTES + TILE_BOUNDS * 4;
/// Bytes of a tile's looks, the largest of the buffers.
pub const LOOK_BYTES: u64 = TILE_LOOKS * 4;

/// What the passes read.
pub struct CacheBuffers {
    pub heights: Buffer,
    pub bounds: Buffer,
    pub looks: Buffer,
    pub clipmap: UniformBuffer<ClipmapUniform>,
    layers: Buffer,
    numbers: Buffer,
    images: Buffer,
}

fn filled(label: &str, contents: &[u8], usage: BufferUsages, device: &RenderDevice) -> Buffer {
    device.create_buffer_with_data(&BufferInitDescriptor { label: Some(label), contents, usage })
}

fn uniform<T: ShaderType + encase::internal::WriteInto>(label: &str, value: &T, device: &RenderDevice) -> Buffer {
    let mut bytes = encase::UniformBuffer::new(Vec::new());
    bytes.write(value).expect("a vector takes any size");
    filled(label, bytes.as_ref(), BufferUsages::UNIFORM, device)
}

impl CacheBuffers {
    pub fn new(side: u32, capacity: usize, fields: &TerrainFields, device: &RenderDevice) -> Self {
        let tiles = u64::from(side).pow(2) * capacity as u64;
        let stored = |label, bytes: u64| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size: tiles * bytes,
                usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let [layers, numbers, images] = field_buffers(fields, device);
        Self {
            heights: stored("horizon_heights", TILE_TEXELS * 4),
            bounds: stored("horizon_bounds", TILE_BOUNDS * 4),
            looks: stored("horizon_looks", LOOK_BYTES),
            clipmap: UniformBuffer::default(),
            layers,
            numbers,
            images,
        }
    }

    pub fn set_fields(&mut self, fields: &TerrainFields, device: &RenderDevice) {
        [self.layers, self.numbers, self.images] = field_buffers(fields, device);
    }

    pub fn set_clipmap(&mut self, drawn: &[DrawnLevel], side: u32, device: &RenderDevice, queue: &RenderQueue) {
        self.clipmap.set(ClipmapUniform::new(drawn, side));
        self.clipmap.write_buffer(device, queue);
    }
}

fn field_buffers(fields: &TerrainFields, device: &RenderDevice) -> [Buffer; 3] {
    let contents = Contents::new(&fields_of(fields));
    [
        filled("horizon_field_layers", &contents.layers, BufferUsages::STORAGE, device),
        filled("horizon_field_numbers", &contents.numbers, BufferUsages::STORAGE, device),
        filled("horizon_field_images", &contents.images, BufferUsages::STORAGE, device),
    ]
}

/// `Job` of `fill.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct FillJob {
    tile: u32,
    anchor: u32,
    texel: f32,
    stamp: u32,
    stamps: u32,
    holes: u32,
}

/// `TileJob` of `pyramid.wgsl` and `light.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TileJob {
    level: u32,
    padding: u32,
    cell: [i32; 2],
}

/// The compute work of one frame.
#[derive(Default)]
pub struct FrameJobs {
    fill: Option<(u32, [Buffer; 4], [Option<BindGroup>; 2])>,
    pyramid: Option<(u32, Buffer, Option<BindGroup>)>,
    light: Option<(u32, [Buffer; 2], Option<BindGroup>)>,
}

impl FrameJobs {
    pub fn new(
        work: &Work,
        clipmap: &Clipmap,
        fields: &TerrainFields,
        stamps: &Stamps,
        sun: Option<SunUniform>,
        device: &RenderDevice,
    ) -> Self {
        let storage = |label, contents: &[u8]| filled(label, contents, BufferUsages::STORAGE, device);
        let tile_jobs = |tiles: &[Tile]| -> Vec<TileJob> {
            let relative = tiles.iter().filter_map(|tile| clipmap.relative(*tile));
            relative.map(|(level, cell)| TileJob { level, padding: 0, cell }).collect()
        };
        let mut jobs = Self::default();
        if !work.fill.is_empty() {
            let (mut anchors, mut parts) = (Vec::new(), Vec::new());
            let mut fills = Vec::with_capacity(work.fill.len());
            let all = fields_of(fields);
            let stride = all.iter().map(|field| field.layer_count()).sum::<usize>() as u32;
            for (i, tile) in work.fill.iter().enumerate() {
                let place = place_of(*tile);
                for field in &all {
                    field.append_anchor_bytes(&field.anchor(&place), &mut anchors);
                }
                let texel = f64::from(tile.exponent).exp2();
                let half = [0.5 * (TILE - 1) as f64 * texel; 2];
                let stamp = (parts.len() / PART_BYTES) as u32;
                let [moving, holes] = stamps.at(&place).append_bytes(half, half, CUTOFF * texel, &mut parts);
                fills.push(FillJob {
                    tile: clipmap.stored(*tile),
                    anchor: i as u32 * stride,
                    texel: texel as f32,
                    stamp,
                    stamps: moving,
                    holes,
                });
            }
            anchors.resize(anchors.len().max(64), 0);
            parts.resize(parts.len().max(PART_BYTES), 0);
            let buffers = [
                storage("horizon_fill_anchors", &anchors),
                storage("horizon_fill_jobs", bytemuck::cast_slice(&fills)),
                uniform("horizon_material", &MaterialUniform::new(&fields.material), device),
                storage("horizon_fill_stamps", &parts),
            ];
            jobs.fill = Some((fills.len() as u32, buffers, [None, None]));
        }
        let pyramid = tile_jobs(&work.pyramid);
        if !pyramid.is_empty() {
            jobs.pyramid =
                Some((pyramid.len() as u32, storage("horizon_pyramid_jobs", bytemuck::cast_slice(&pyramid)), None));
        }
        let light = tile_jobs(&work.light);
        if let Some(sun) = sun.filter(|_| !light.is_empty()) {
            let buffers =
                [storage("horizon_light_jobs", bytemuck::cast_slice(&light)), uniform("horizon_sun", &sun, device)];
            jobs.light = Some((light.len() as u32, buffers, None));
        }
        jobs
    }

    pub fn bind(
        &mut self,
        buffers: &CacheBuffers,
        pipelines: &CachePipelines,
        cache: &PipelineCache,
        device: &RenderDevice,
    ) {
        let Some(clipmap) = buffers.clipmap.binding() else { return };
        if let Some((_, [anchors, jobs, material, stamps], groups)) = &mut self.fill {
            groups[0] = Some(device.create_bind_group(
                "horizon_field",
                &cache.get_bind_group_layout(&pipelines.field_layout),
                &BindGroupEntries::sequential((
                    buffers.layers.as_entire_binding(),
                    anchors.as_entire_binding(),
                    buffers.numbers.as_entire_binding(),
                    buffers.images.as_entire_binding(),
                )),
            ));
            groups[1] = Some(device.create_bind_group(
                "horizon_fill",
                &cache.get_bind_group_layout(&pipelines.fill_layout),
                &BindGroupEntries::sequential((
                    jobs.as_entire_binding(),
                    material.as_entire_binding(),
                    buffers.heights.as_entire_binding(),
                    buffers.looks.as_entire_binding(),
                    stamps.as_entire_binding(),
                )),
            ));
        }
        if let Some((_, jobs, group)) = &mut self.pyramid {
            *group = Some(device.create_bind_group(
                "horizon_pyramid",
                &cache.get_bind_group_layout(&pipelines.pyramid_layout),
                &BindGroupEntries::sequential((
                    clipmap.clone(),
                    buffers.heights.as_entire_binding(),
                    buffers.bounds.as_entire_binding(),
                    jobs.as_entire_binding(),
                )),
            ));
        }
        if let Some((_, [jobs, sun], group)) = &mut self.light {
            *group = Some(device.create_bind_group(
                "horizon_light",
                &cache.get_bind_group_layout(&pipelines.light_layout),
                &BindGroupEntries::sequential((
                    clipmap,
                    buffers.heights.as_entire_binding(),
                    buffers.bounds.as_entire_binding(),
                    jobs.as_entire_binding(),
                    sun.as_entire_binding(),
                    buffers.looks.as_entire_binding(),
                )),
            ));
        }
    }

    pub fn dispatch(&self, pipelines: &CachePipelines, structure: u64, cache: &PipelineCache, ctx: &mut RenderContext) {
        if self.fill.is_none() && self.pyramid.is_none() && self.light.is_none() {
            return;
        }
        let Some([fill, pyramid, light]) = pipelines.get(cache, structure) else { return };
        let diagnostics = ctx.diagnostic_recorder();
        let diagnostics = diagnostics.as_deref();
        let mut pass = ctx
            .command_encoder()
            .begin_compute_pass(&ComputePassDescriptor { label: Some("horizon_cache"), timestamp_writes: None });
        if let Some((count, _, [Some(field), Some(jobs)])) = &self.fill {
            let span = diagnostics.pass_span(&mut pass, "horizon_fill");
            pass.set_pipeline(fill);
            pass.set_bind_group(0, field, &[]);
            pass.set_bind_group(1, jobs, &[]);
            pass.dispatch_workgroups(8, 8, *count);
            span.end(&mut pass);
        }
        if let Some((count, _, Some(group))) = &self.pyramid {
            let span = diagnostics.pass_span(&mut pass, "horizon_pyramid");
            pass.set_pipeline(pyramid);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(*count, 1, 1);
            span.end(&mut pass);
        }
        if let Some((count, _, Some(group))) = &self.light {
            let span = diagnostics.pass_span(&mut pass, "horizon_light");
            pass.set_pipeline(light);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(4, 4, *count);
            span.end(&mut pass);
        }
    }
}
