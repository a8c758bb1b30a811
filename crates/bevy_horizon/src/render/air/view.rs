//! What a camera sees of the air: its uniform, and the tables of its altitude and sun.

use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::{
    BindGroup, Buffer, BufferDescriptor, BufferUsages, ComputePassDescriptor, DynamicBindGroupEntries, Extent3d,
    FilterMode, PipelineCache, Sampler, SamplerDescriptor, TextureDescriptor, TextureDimension, TextureFormat,
    TextureUsages, TextureView, TextureViewDescriptor,
};
use bevy::render::renderer::{RenderContext, RenderDevice};
use bevy::render::view::ExtractedView;
use horizon_light::models::moments::HARMONICS;

use super::super::extract::{ExtractedAtmosphere, ExtractedHorizonCamera, ExtractedWorld};
use super::super::uniforms::AirUniform;
use super::super::view::{HorizonViews, ViewGround, ViewSky};
use super::pipelines::{AirPipelines, Step};
use super::sizes::{AERIAL, SKY, TEXEL, VOLUMES, texels};
use super::tables::{AirTables, SeenMedium};
use crate::world::altitude;

/// Metres, and parts of its altitude, by which a camera may rise before its tables are made anew: the densest layer that is usual
/// thins by e over a kilometre.
const RISE: [f32; 2] = [1.0, 2e-3];
/// By how much the sun may move, as the length of a difference of unit vectors: a tenth of its radius.
const TURN: f32 = 4e-4;

/// Where a camera stands in the air.
pub struct Seen {
    pub uniform: AirUniform,
}

impl Seen {
    pub fn new(
        world: &ExtractedWorld,
        found: &ExtractedAtmosphere,
        view: &ExtractedView,
        camera: &ExtractedHorizonCamera,
        ground: &ViewGround,
        seen: &SeenMedium,
    ) -> Self {
        let atmosphere = &found.compiled.atmosphere;
        let eye = view.world_from_view.translation();
        let h = altitude(&crate::world::WorldOrigin(world.origin), eye, found.translation) as f32;
        let above_datum = (ground.eye.cell[1] as f64 * horizon_field::CELL + ground.eye.offset[1]) as f32;
        // Without a sun it is night.
        let sun = world.sun.map_or(Vec3::NEG_Y, |sun| sun.direction);
        let mut diffuse = [Vec3::ZERO; HARMONICS];
        if let Some(light) = &found.compiled.light {
            diffuse = light.moments.at(&light.air, h.min(atmosphere.medium.height as f32), sun.y).map(Vec3::from_array);
        }
        Self {
            uniform: AirUniform {
                medium: seen.medium,
                disc: seen.disc,
                to_rgb: seen.to_rgb,
                diffuse,
                sun,
                h,
                datum: above_datum - h,
                far: camera.camera.far.max(1.0),
                night: atmosphere.night,
                own_sun: u32::from(world.sun.is_some_and(|sun| sun.own)),
            },
        }
    }
}

/// What a view's tables are of.
#[derive(Clone, Copy)]
struct Made {
    table: usize,
    version: u32,
    h: f32,
    sun: Vec3,
    far: f32,
}

/// A view's tables.
#[derive(Component)]
pub struct ViewAir {
    sky: Buffer,
    /// Light and transmittance of aerial perspective.
    aerial: [TextureView; VOLUMES],
    sampler: Sampler,
    /// What the sky and aerial perspective were made of.
    made: [Option<Made>; 2],
    table: usize,
    /// Which of the two are made in this frame.
    due: [bool; 2],
    group: Option<BindGroup>,
}

impl ViewAir {
    pub fn new(device: &RenderDevice) -> Self {
        let volume = |label| {
            let [width, height, depth_or_array_layers] = AERIAL;
            let texture = device.create_texture(&TextureDescriptor {
                label: Some(label),
                size: Extent3d { width, height, depth_or_array_layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: TextureDimension::D3,
                format: TextureFormat::Rgba16Float,
                usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&TextureViewDescriptor::default())
        };
        Self {
            sky: device.create_buffer(&BufferDescriptor {
                label: Some("horizon_sky_view"),
                size: texels(SKY) * TEXEL,
                usage: BufferUsages::STORAGE,
                mapped_at_creation: false,
            }),
            aerial: [volume("horizon_aerial_light"), volume("horizon_aerial_through")],
            sampler: device.create_sampler(&SamplerDescriptor {
                label: Some("horizon_aerial"),
                mag_filter: FilterMode::Linear,
                min_filter: FilterMode::Linear,
                ..default()
            }),
            made: [None; 2],
            table: 0,
            due: [false; 2],
            group: None,
        }
    }

    /// Makes out whether its tables are to be made anew. Where both are out of date in frame after frame, as under a sun that is turned
    /// fast, they take turns.
    pub fn look(&mut self, seen: &Seen, table: usize, version: u32, made: bool) {
        let AirUniform { h, sun, far, .. } = seen.uniform;
        let now = Made { table, version, h, sun, far };
        let [metres, part] = RISE;
        let stale = self.made.map(|last| {
            last.is_none_or(|last| {
                (last.table, last.version, last.far) != (table, version, far)
                    || (last.h - h).abs() > metres.max(part * h)
                    || last.sun.distance(sun) > TURN
            })
        });
        let sky_was_last = self.due[0];
        self.due = match stale {
            _ if !made => [false; 2],
            [true, true] if self.made.iter().all(Option::is_some) => [!sky_was_last, sky_was_last],
            either => either,
        };
        self.table = table;
        for (last, due) in self.made.iter_mut().zip(self.due) {
            if due {
                *last = Some(now);
            }
        }
    }

    pub fn bind(
        &mut self,
        tables: &AirTables,
        pipelines: &AirPipelines,
        uniforms: &HorizonViews,
        cache: &PipelineCache,
        device: &RenderDevice,
    ) {
        self.group = None;
        if let (true, Some([transmittances, multiple]), Some(air)) =
            (self.due.contains(&true), tables.buffers(self.table), uniforms.airs.binding())
        {
            self.group = Some(device.create_bind_group(
                "horizon_air_view",
                &cache.get_bind_group_layout(&pipelines.view_layout),
                &DynamicBindGroupEntries::new_with_indices((
                    (1, air),
                    (3, transmittances.as_entire_binding()),
                    (4, multiple.as_entire_binding()),
                    (5, self.sky.as_entire_binding()),
                    (6, &self.aerial[0]),
                    (7, &self.aerial[1]),
                )),
            ));
        }
    }

    /// What the pass of the sky binds beside the air's own tables: from 5 on.
    pub fn drawn(&self) -> (&Buffer, &TextureView, &TextureView, &Sampler) {
        (&self.sky, &self.aerial[0], &self.aerial[1], &self.sampler)
    }

    pub fn dispatch(
        &self,
        ground: &ViewGround,
        pipelines: &AirPipelines,
        cache: &PipelineCache,
        ctx: &mut RenderContext,
    ) {
        let (Some(group), Some(ViewSky::Air { model, .. })) = (&self.group, &ground.sky) else { return };
        let diagnostics = ctx.diagnostic_recorder();
        let diagnostics = diagnostics.as_deref();
        let mut pass = ctx
            .command_encoder()
            .begin_compute_pass(&ComputePassDescriptor { label: Some("horizon_air_view"), timestamp_writes: None });
        let span = diagnostics.pass_span(&mut pass, "horizon_air_view");
        let steps = [Step::SkyView(*model), Step::Aerial(*model)];
        for (step, _) in steps.into_iter().zip(self.due).filter(|(_, due)| *due) {
            let Some(pipeline) = pipelines.get(step, cache) else { continue };
            let [x, y] = step.groups();
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[ground.offsets[1]]);
            pass.dispatch_workgroups(x, y, 1);
        }
        span.end(&mut pass);
    }
}
