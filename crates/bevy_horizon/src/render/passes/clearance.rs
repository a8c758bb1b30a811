//! The clearance table of a view: how far its rays are clear of the ground, by azimuth and slope. See `clearance.wgsl`.

use bevy::math::{UVec3, Vec2, Vec3};
use bevy::prelude::*;
use bevy::render::diagnostic::RecordDiagnostics;
use bevy::render::render_resource::binding_types::{
    storage_buffer_read_only_sized, storage_buffer_sized, uniform_buffer,
};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntries, BindGroupLayoutDescriptor, BindGroupLayoutEntries, Buffer, BufferDescriptor,
    BufferUsages, CachedComputePipelineId, ComputePassDescriptor, ComputePipelineDescriptor, PipelineCache,
    ShaderStages,
};
use bevy::render::renderer::{RenderContext, RenderDevice};

use super::super::cache::CacheBuffers;
use super::super::shaders::Source;
use super::super::uniforms::{ClipmapUniform, HorizonViewUniform};
use super::super::view::HorizonViews;

/// Slopes in a column; as in `view.wgsl`.
const BINS: u32 = 256;
/// Rings of a column; as in `clearance.wgsl`.
const RINGS: u32 = 1024;
/// The most columns that a table has.
const COLUMNS: u32 = 512;
/// Pixels that a column is wide, about, in the middle of the view.
const PIXELS: f32 = 4.0;

/// Which part of all azimuths and slopes a view's table holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Table {
    /// The least slope, as v = m / (1 + |m|), and bins per unit of v.
    pub slopes: Vec2,
    /// The first column, how many there are, and columns in each quadrant.
    pub columns: UVec3,
    /// The radius that the first ring would have, in metres, and the binary logarithm of the ratio of two.
    pub rings: Vec2,
}

impl Table {
    /// The table of a view whose pixels are `pixel` radians large. `ray` gives a direction for a point of the target,
    /// in −1 … 1. The table is as long as `far`, and begins at `near`.
    pub fn new(ray: impl Fn(Vec2) -> Vec3, pixel: f32, [near, far]: [f32; 2]) -> Self {
        let near = near.max(1e-3);
        let rings = Vec2::new(near, (far.max(2.0 * near) / near).log2() / (RINGS - 1) as f32);
        // Azimuths and elevations are extreme along the picture's border, but for a pole within it.
        let border: Vec<Vec3> = (0..=16)
            .flat_map(|i| {
                let u = i as f32 / 8.0 - 1.0;
                [Vec2::new(u, -1.0), Vec2::new(u, 1.0), Vec2::new(-1.0, u), Vec2::new(1.0, u)]
            })
            .map(&ray)
            .collect();
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|c| ray(Vec2::from_array(c)));
        let holds = |pole: Vec3| {
            let side = |i: usize| corners[i].cross(corners[(i + 1) % 4]).dot(pole);
            (0..4).all(|i| side(i) >= 0.0) || (0..4).all(|i| side(i) <= 0.0)
        };
        let ahead = ray(Vec2::ZERO);
        let up = holds(Vec3::Y) && ahead.y > 0.0;
        let down = holds(Vec3::NEG_Y) && ahead.y < 0.0;
        let v = |d: &Vec3| d.y / (d.x.abs().max(d.z.abs()) + d.y.abs()).max(1e-20);
        let [mut low, mut high] = border.iter().map(v).fold([1.0f32, -1.0], |[low, high], v| [low.min(v), high.max(v)]);
        // A border's highest point may lie between two samples.
        let room = 0.02 * (high - low) + 1e-6;
        low = if down { -1.0 } else { (low - room).max(-1.0) };
        high = if up { 1.0 } else { (high + room).min(1.0) };
        let slopes = Vec2::new(low, BINS as f32 / (high - low));

        let all = up || down;
        let [from, to] = if all { [0.0, 4.0] } else { azimuths(&border) };
        let wanted = (2.0 / (PIXELS * pixel.max(1e-9))).min((COLUMNS - 2) as f32 / (to - from).max(1e-6));
        let per_quadrant = (wanted as u32).clamp(1, if all { COLUMNS / 4 } else { 1 << 20 });
        let first = (from * per_quadrant as f32).floor();
        let count = (to * per_quadrant as f32).floor() - first + 1.0;
        let columns = if all {
            UVec3::new(0, 4 * per_quadrant, per_quadrant)
        } else {
            UVec3::new(
                (first as i32).rem_euclid(4 * per_quadrant as i32) as u32,
                (count as u32).min(COLUMNS).min(4 * per_quadrant),
                per_quadrant,
            )
        };
        Self { slopes, columns, rings }
    }
}

/// Azimuth as `clearance.wgsl` measures it: 0 to 4, a quadrant around each of +x, +z, −x, −z from −½.
fn azimuth(d: &Vec3) -> f32 {
    if d.x.abs() >= d.z.abs() {
        let s = d.z / if d.x == 0.0 { 1e-20 } else { d.x };
        if d.x > 0.0 { 0.5 * (s + 1.0) } else { 2.0 + 0.5 * (s + 1.0) }
    } else {
        let s = -d.x / d.z;
        if d.z > 0.0 { 1.0 + 0.5 * (s + 1.0) } else { 3.0 + 0.5 * (s + 1.0) }
    }
}

/// The shortest range of azimuths that holds these directions, of which none is a pole; it may pass 4.
fn azimuths(directions: &[Vec3]) -> [f32; 2] {
    let mut sorted: Vec<f32> = directions.iter().map(azimuth).collect();
    sorted.sort_by(f32::total_cmp);
    let gap = |i: usize| {
        if i + 1 < sorted.len() { sorted[i + 1] - sorted[i] } else { sorted[0] + 4.0 - sorted[i] }
    };
    let widest = (0..sorted.len()).max_by(|a, b| gap(*a).total_cmp(&gap(*b))).unwrap_or(0);
    let from = sorted[(widest + 1) % sorted.len()];
    let length = 4.0 - gap(widest);
    [from - 1e-3 * length, from + 1.001 * length]
}

/// A view's table on the device.
#[derive(Component, Clone)]
pub struct ViewClearance(Buffer);

impl ViewClearance {
    pub fn new(device: &RenderDevice) -> Self {
        Self(device.create_buffer(&BufferDescriptor {
            label: Some("horizon_clearance"),
            size: u64::from(COLUMNS * BINS) * 4,
            usage: BufferUsages::STORAGE,
            mapped_at_creation: false,
        }))
    }

    pub fn buffer(&self) -> &Buffer {
        &self.0
    }
}

/// The pipeline that makes tables; asked for with the first terrain.
#[derive(Resource)]
pub struct ClearancePipeline {
    layout: BindGroupLayoutDescriptor,
    id: Option<CachedComputePipelineId>,
}

impl Default for ClearancePipeline {
    fn default() -> Self {
        let read = || storage_buffer_read_only_sized(false, None);
        let entries = (
            uniform_buffer::<ClipmapUniform>(false),
            read(),
            read(),
            uniform_buffer::<HorizonViewUniform>(true),
            storage_buffer_sized(false, None),
        );
        let entries = BindGroupLayoutEntries::sequential(ShaderStages::COMPUTE, entries);
        Self { layout: BindGroupLayoutDescriptor::new("horizon_clearance", &entries), id: None }
    }
}

impl ClearancePipeline {
    pub fn queue(&mut self, cache: &PipelineCache) {
        self.id.get_or_insert_with(|| {
            cache.queue_compute_pipeline(ComputePipelineDescriptor {
                label: Some("horizon_clearance".into()),
                layout: vec![self.layout.clone()],
                shader: Source::Clearance.handle(),
                entry_point: Some("clear".into()),
                ..default()
            })
        });
    }

    pub fn ready(&self, cache: &PipelineCache) -> bool {
        self.id.is_some_and(|id| cache.get_compute_pipeline(id).is_some())
    }

    pub fn bind(
        &self,
        clearance: &ViewClearance,
        buffers: &CacheBuffers,
        views: &HorizonViews,
        cache: &PipelineCache,
        device: &RenderDevice,
    ) -> Option<BindGroup> {
        Some(device.create_bind_group(
            "horizon_clearance",
            &cache.get_bind_group_layout(&self.layout),
            &BindGroupEntries::sequential((
                buffers.clipmap.binding()?,
                buffers.heights.as_entire_binding(),
                buffers.bounds.as_entire_binding(),
                views.views.binding()?,
                clearance.0.as_entire_binding(),
            )),
        ))
    }

    /// Makes a view's table, before its ground is drawn.
    pub fn dispatch(
        &self,
        group: &BindGroup,
        offset: u32,
        table: &Table,
        cache: &PipelineCache,
        ctx: &mut RenderContext,
    ) {
        let Some(pipeline) = self.id.and_then(|id| cache.get_compute_pipeline(id)) else { return };
        let diagnostics = ctx.diagnostic_recorder();
        let diagnostics = diagnostics.as_deref();
        let mut pass = ctx
            .command_encoder()
            .begin_compute_pass(&ComputePassDescriptor { label: Some("horizon_clearance"), timestamp_writes: None });
        let span = diagnostics.pass_span(&mut pass, "horizon_clearance");
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[offset]);
        pass.dispatch_workgroups(table.columns.y, 1, 1);
        span.end(&mut pass);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a ray falls in the table, as `clear_start.wgsl` has it: column and bin, if both are there.
    fn place(table: &Table, d: Vec3) -> Option<[u32; 2]> {
        let per_quadrant = table.columns.z;
        let all = 4 * per_quadrant;
        let column = ((azimuth(&d) * per_quadrant as f32) as u32 % all + all - table.columns.x) % all;
        let v = d.y / (d.x.abs().max(d.z.abs()) + d.y.abs());
        let bin = (v - table.slopes.x) * table.slopes.y;
        (column < table.columns.y && bin >= 0.0).then(|| [column, (bin as u32).min(BINS - 1)])
    }

    /// A camera's rays by point of its target.
    fn rays(pose: Transform, half_height: f32, aspect: f32) -> impl Fn(Vec2) -> Vec3 {
        move |ndc| pose.rotation * Vec3::new(ndc.x * half_height * aspect, ndc.y * half_height, -1.0)
    }

    #[test]
    fn every_pixel_finds_its_column_wherever_a_camera_looks() {
        for half_height in [0.577, 0.0577, 1.5] {
            for turn in 0..48 {
                for tilt in -8..=8 {
                    for roll in [0.0, 0.7] {
                        let turn = turn as f32 * 0.1309;
                        let rotation = Quat::from_euler(EulerRot::YXZ, turn, tilt as f32 * 0.19, roll);
                        let ray = rays(Transform::from_rotation(rotation), half_height, 16.0 / 9.0);
                        let table = Table::new(&ray, 2.0 * half_height / 720.0, [0.1, 1e5]);
                        assert!(table.columns.y <= COLUMNS, "{table:?}");
                        for i in 0..17 * 17 {
                            let ndc = Vec2::new((i % 17) as f32, (i / 17) as f32) / 8.5 - 0.94;
                            let d = ray(ndc);
                            assert!(
                                place(&table, d).is_some(),
                                "turn {turn} tilt {tilt} roll {roll}: {d} in {table:?}"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn columns_are_some_pixels_wide() {
        let ray = rays(Transform::IDENTITY, 0.577, 16.0 / 9.0);
        let pixel = 2.0 * 0.577 / 720.0;
        let table = Table::new(&ray, pixel, [0.1, 1e5]);
        let columns: std::collections::HashSet<u32> =
            (0..1280).filter_map(|x| Some(place(&table, ray(Vec2::new(x as f32 / 640.0 - 1.0, 0.1)))?[0])).collect();
        assert!((200..=400).contains(&columns.len()), "{} columns over 1280 pixels", columns.len());
        // The last ring begins where the ground ends.
        let last = table.rings.x * (table.rings.y * (RINGS - 1) as f32).exp2();
        assert!((last / 1e5 - 1.0).abs() < 1e-3, "{last}");
    }
}
