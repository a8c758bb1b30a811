//! The device's side of the seas: their buffers and textures, and the passes that fill these.

use std::sync::Arc;

use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{
    AddressMode, BindGroup, BindGroupEntries, Buffer, BufferDescriptor, BufferInitDescriptor, BufferUsages,
    ComputePassDescriptor, Extent3d, FilterMode, MipmapFilterMode, PipelineCache, SamplerDescriptor, Texture,
    TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
    TextureViewDimension,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue};
use bytemuck::{Pod, Zeroable};
use horizon_field::waves::{CASCADES, Cascade, GRID, REACH, Sea, roots};

use super::SeaTiles;
use super::pipelines::{SeaPipelines, Step};

/// Rows of wave vectors.
const ROWS: u32 = 2 * REACH as u32 + 1;
/// Levels of the textures, down to one texel.
const LEVELS: u32 = GRID.ilog2() + 1;

/// `Layer` of `bindings.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Layer {
    texel: f32,
    bound: f32,
    choppiness: f32,
}

/// What is filled, for these seas.
pub(super) struct SeaFill {
    seas: Vec<Arc<Sea>>,
    layers: u32,
    clock: Buffer,
    group: BindGroup,
    texels: BindGroup,
    means: Vec<BindGroup>,
    /// The time that the textures are of.
    filled: Option<u32>,
    /// They are filled in this frame.
    due: bool,
}

/// A level of a texture.
fn level(texture: &Texture, base_mip_level: u32) -> TextureView {
    texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        base_mip_level,
        mip_level_count: Some(1),
        ..default()
    })
}

impl SeaFill {
    /// Buffers and textures for these seas. Textures are flat until they are filled.
    pub fn new(
        seas: &[Arc<Sea>],
        pipelines: &SeaPipelines,
        cache: &PipelineCache,
        device: &RenderDevice,
    ) -> (Self, SeaTiles) {
        let layers = (CASCADES * seas.len()) as u32;
        let cascades: Vec<&Cascade> = seas.iter().flat_map(|sea| &sea.cascades).collect();
        let of: Vec<Layer> = cascades
            .iter()
            .map(|cascade| Layer {
                texel: cascade.texel() as f32,
                bound: cascade.bound,
                choppiness: cascade.choppiness as f32,
            })
            .collect();
        let modes: Vec<[f32; 4]> = cascades.iter().flat_map(|cascade| cascade.modes()).collect();
        let filled = |label, contents: &[u8]| {
            device.create_buffer_with_data(&BufferInitDescriptor {
                label: Some(label),
                contents,
                usage: BufferUsages::STORAGE,
            })
        };
        let empty = |label, bytes: usize| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size: u64::from(layers) * bytes as u64,
                usage: BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let clock = device.create_buffer(&BufferDescriptor {
            label: Some("horizon_sea_clock"),
            size: 16,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(
            "horizon_sea",
            &cache.get_bind_group_layout(&pipelines.sea_layout),
            &BindGroupEntries::sequential((
                clock.as_entire_binding(),
                filled("horizon_sea_layers", bytemuck::cast_slice(&of)).as_entire_binding(),
                filled("horizon_sea_roots", bytemuck::cast_slice(&roots().map(|root| root.map(|x| x as f32))))
                    .as_entire_binding(),
                filled("horizon_sea_modes", bytemuck::cast_slice(&modes)).as_entire_binding(),
                empty("horizon_sea_rows", ROWS as usize * GRID * 16).as_entire_binding(),
                empty("horizon_sea_grid", GRID * GRID * 16).as_entire_binding(),
                empty("horizon_sea_over", GRID * GRID * 8).as_entire_binding(),
            )),
        );
        let textures = ["horizon_sea_surface", "horizon_sea_moments"].map(|label| {
            device.create_texture(&TextureDescriptor {
                label: Some(label),
                size: Extent3d { width: GRID as u32, height: GRID as u32, depth_or_array_layers: layers },
                mip_level_count: LEVELS,
                sample_count: 1,
                dimension: TextureDimension::D2,
                format: TextureFormat::Rgba16Float,
                usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        });
        let texels = device.create_bind_group(
            "horizon_sea_texels",
            &cache.get_bind_group_layout(&pipelines.texels_layout),
            &BindGroupEntries::sequential((&level(&textures[0], 0), &level(&textures[1], 0))),
        );
        let means = (1..LEVELS).map(|to| {
            device.create_bind_group(
                "horizon_sea_means",
                &cache.get_bind_group_layout(&pipelines.means_layout),
                &BindGroupEntries::sequential((
                    &level(&textures[0], to - 1),
                    &level(&textures[1], to - 1),
                    &level(&textures[0], to),
                    &level(&textures[1], to),
                )),
            )
        });
        let fill = Self {
            seas: seas.to_vec(),
            layers,
            clock,
            group,
            texels,
            means: means.collect(),
            filled: None,
            due: false,
        };
        (fill, SeaTiles::new(textures, device))
    }

    /// Whether it is of these seas.
    pub fn is_of(&self, seas: &[Arc<Sea>]) -> bool {
        self.seas.len() == seas.len() && self.seas.iter().zip(seas).all(|(a, b)| Arc::ptr_eq(a, b))
    }

    /// Whether the textures hold waves.
    pub fn is_filled(&self) -> bool {
        self.filled.is_some()
    }

    /// Makes out whether the textures are to be filled for a time.
    pub fn look(&mut self, tick: u32, ready: bool, queue: &RenderQueue) {
        self.due = ready && self.filled != Some(tick);
        if self.due {
            self.filled = Some(tick);
            queue.write_buffer(&self.clock, 0, bytemuck::cast_slice(&[tick, 0, 0, 0]));
        }
    }

    pub fn dispatch(&self, pipelines: &SeaPipelines, cache: &PipelineCache, ctx: &mut RenderContext) {
        if !self.due {
            return;
        }
        let [Some(rows), Some(columns), Some(over), Some(texels), Some(means)] =
            [Step::Rows, Step::Columns, Step::Over, Step::Texels, Step::Means].map(|step| pipelines.get(step, cache))
        else {
            return;
        };
        let diagnostics = ctx.diagnostic_recorder();
        let diagnostics = diagnostics.as_deref();
        let mut pass = ctx
            .command_encoder()
            .begin_compute_pass(&ComputePassDescriptor { label: Some("horizon_sea"), timestamp_writes: None });
        let span = diagnostics.pass_span(&mut pass, "horizon_sea");
        let side = GRID as u32;
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_pipeline(rows);
        pass.dispatch_workgroups(ROWS, self.layers, 1);
        pass.set_pipeline(columns);
        pass.dispatch_workgroups(side, self.layers, 1);
        pass.set_pipeline(over);
        pass.dispatch_workgroups(side / 8, side / 8, self.layers);
        pass.set_pipeline(texels);
        pass.set_bind_group(1, &self.texels, &[]);
        pass.dispatch_workgroups(side / 8, side / 8, self.layers);
        pass.set_pipeline(means);
        for (level, group) in (1..).zip(&self.means) {
            let groups = (side >> level).div_ceil(8);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(groups, groups, self.layers);
        }
        span.end(&mut pass);
    }
}

impl SeaTiles {
    fn new(textures: [Texture; 2], device: &RenderDevice) -> Self {
        let [surface, moments] = textures.each_ref().map(|texture| {
            texture.create_view(&TextureViewDescriptor { dimension: Some(TextureViewDimension::D2Array), ..default() })
        });
        let sampler = device.create_sampler(&SamplerDescriptor {
            label: Some("horizon_sea"),
            address_mode_u: AddressMode::Repeat,
            address_mode_v: AddressMode::Repeat,
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            mipmap_filter: MipmapFilterMode::Linear,
            anisotropy_clamp: 8,
            ..default()
        });
        Self { surface, moments, sampler, textures }
    }
}
