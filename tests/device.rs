//! The graphics device, as the tests use it: it runs a compute shader, and gives back what that wrote.

use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};

use bevy::render::RenderApp;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingType, Buffer, BufferBindingType,
    BufferDescriptor, BufferInitDescriptor, BufferUsages, CommandEncoderDescriptor, ComputePassDescriptor, MapMode,
    PipelineCompilationOptions, PipelineLayoutDescriptor, PollType, RawComputePipelineDescriptor,
    ShaderModuleDescriptor, ShaderSource, ShaderStages,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy_horizon_workspace::offscreen::{self, Offscreen};

type Device = (RenderDevice, RenderQueue);

/// Two devices of the kind that Bevy chooses, for all tests: a software driver compiles a device's shaders one after the
/// other. Unlike Bevy, they do not go on after an error.
static DEVICES: LazyLock<[Mutex<Device>; 2]> = LazyLock::new(|| {
    [(); 2].map(|()| {
        let off = Offscreen::new(offscreen::plugins(), 8, 8);
        let world = off.app.sub_app(RenderApp).world();
        let device = world.resource::<RenderDevice>().clone();
        device.wgpu_device().on_uncaptured_error(Arc::new(|error| panic!("{error}")));
        Mutex::new((device, world.resource::<RenderQueue>().clone()))
    })
});

/// A device that is free. One on which a test has failed still works.
fn device() -> MutexGuard<'static, Device> {
    let free = DEVICES.iter().find_map(|device| device.try_lock().ok());
    free.unwrap_or_else(|| DEVICES[0].lock().unwrap_or_else(PoisonError::into_inner))
}

/// Runs the entry point `main` of a compute shader. `groups` are the contents of its read-only storage buffers, by group
/// and binding; what comes back are the bytes of one more, writable buffer, of `output` bytes, which follows in the last
/// group.
pub fn run(source: &str, groups: &[&[&[u8]]], output: usize, workgroups: u32) -> Vec<u8> {
    let guard = device();
    let (device, queue) = &*guard;
    let written = device.create_buffer(&BufferDescriptor {
        label: None,
        size: output as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let read = device.create_buffer(&BufferDescriptor {
        label: None,
        size: output as u64,
        usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let groups: Vec<(BindGroupLayout, BindGroup)> = groups
        .iter()
        .enumerate()
        .map(|(i, contents)| {
            let writable = (i + 1 == groups.len()).then_some(&written);
            group(device, contents, writable)
        })
        .collect();
    let layouts: Vec<_> = groups.iter().map(|(layout, _)| Some(&**layout)).collect();
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    let module = device.create_and_validate_shader_module(ShaderModuleDescriptor {
        label: None,
        source: ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&RawComputePipelineDescriptor {
        label: None,
        layout: Some(&layout),
        module: &module,
        entry_point: Some("main"),
        compilation_options: PipelineCompilationOptions::default(),
        cache: None,
    });
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        for (i, (_, group)) in groups.iter().enumerate() {
            pass.set_bind_group(i as u32, &**group, &[]);
        }
        pass.dispatch_workgroups(workgroups, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&written, 0, &read, 0, output as u64);
    queue.submit([encoder.finish()]);
    let slice = read.slice(..);
    slice.map_async(MapMode::Read, |result| result.expect("the buffer can be mapped"));
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    slice.get_mapped_range().to_vec()
}

fn group(device: &RenderDevice, contents: &[&[u8]], written: Option<&Buffer>) -> (BindGroupLayout, BindGroup) {
    let mut buffers: Vec<Buffer> = contents
        .iter()
        .map(|contents| {
            device.create_buffer_with_data(&BufferInitDescriptor {
                label: None,
                contents,
                usage: BufferUsages::STORAGE,
            })
        })
        .collect();
    buffers.extend(written.cloned());
    let layout: Vec<BindGroupLayoutEntry> = (0..buffers.len())
        .map(|binding| BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: ShaderStages::COMPUTE,
            ty: BindingType::Buffer {
                ty: BufferBindingType::Storage { read_only: binding < contents.len() },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    let layout = device.create_bind_group_layout(None, &layout);
    let entries: Vec<BindGroupEntry> = buffers
        .iter()
        .enumerate()
        .map(|(binding, buffer)| BindGroupEntry { binding: binding as u32, resource: buffer.as_entire_binding() })
        .collect();
    let group = device.create_bind_group(None, &layout, &entries);
    (layout, group)
}
