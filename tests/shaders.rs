//! Every shader, on every platform: translated by naga, within WebGPU's default limits, and run with no more than those.

use bevy::camera::Hdr;
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::{CachedPipelineState, PipelineCache, WgpuFeatures};
use bevy::render::renderer::RenderDevice;
use bevy::render::settings::{RenderCreation, WgpuSettings, WgpuSettingsPriority};
use bevy_horizon::prelude::*;
use bevy_horizon::render::ready::Progress;
use bevy_horizon::render::shader_sources;
use bevy_horizon::world::{CurvatureRule, MaskRule, MaterialLayer};
use bevy_horizon_workspace::offscreen::{self, Offscreen};
use horizon_field::field::arbitrary::{Pictures, every_kind};
use naga::back::{hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Module, TypeInner};

/// What a shader uses at most, in any of its stages.
#[derive(Clone, Copy, Debug, Default)]
struct Uses {
    storage_buffers: usize,
    uniform_bytes: u32,
    textures: usize,
    groups: u32,
    workgroup_bytes: u32,
    invocations: u32,
}

impl Uses {
    fn of(module: &Module, info: &ModuleInfo) -> Self {
        let mut uses = Self::default();
        for (index, entry) in module.entry_points.iter().enumerate() {
            let stage = info.get_entry_point(index);
            let (mut storage_buffers, mut textures, mut workgroup_bytes) = (0, 0, 0);
            for (handle, global) in module.global_variables.iter().filter(|(handle, _)| !stage[*handle].is_empty()) {
                let inner = &module.types[global.ty].inner;
                match global.space {
                    AddressSpace::Storage { .. } => storage_buffers += 1,
                    AddressSpace::Uniform => uses.uniform_bytes = uses.uniform_bytes.max(inner.size(module.to_ctx())),
                    AddressSpace::WorkGroup => workgroup_bytes += inner.size(module.to_ctx()),
                    AddressSpace::Handle => textures += usize::from(matches!(inner, TypeInner::Image { .. })),
                    _ => {}
                }
                let group = module.global_variables[handle].binding.map_or(0, |binding| binding.group + 1);
                uses.groups = uses.groups.max(group);
            }
            uses.storage_buffers = uses.storage_buffers.max(storage_buffers);
            uses.textures = uses.textures.max(textures);
            uses.workgroup_bytes = uses.workgroup_bytes.max(workgroup_bytes);
            uses.invocations = uses.invocations.max(entry.workgroup_size.iter().product());
        }
        uses
    }

    /// WebGPU's default limits; each stage of a pipeline has them for itself.
    fn check(&self, name: &str) {
        assert!(self.storage_buffers <= 8, "{name}: {self:?}");
        assert!(self.uniform_bytes <= 64 << 10, "{name}: {self:?}");
        assert!(self.textures <= 16, "{name}: {self:?}");
        assert!(self.groups <= 4, "{name}: {self:?}");
        assert!(self.workgroup_bytes <= 16 << 10, "{name}: {self:?}");
        assert!(self.invocations <= 256, "{name}: {self:?}");
    }
}

/// Validates a shader with no capability beyond WebGPU's own (half floats in words are part of it), and translates it into the three languages.
fn translate(name: &str, source: &str) -> Uses {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    let info =
        Validator::new(ValidationFlags::all(), Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32)
            .validate(&module)
            .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    assert!(!module.entry_points.is_empty(), "{name} has no entry point");

    let words = spv::write_vec(&module, &info, &spv::Options::default(), None).expect(name);
    assert_eq!(words[0], 0x0723_0203, "{name}: SPIR-V's magic number");
    let options = msl::Options { lang_version: (2, 0), ..Default::default() };
    let (metal, translation) = msl::write_string(&module, &info, &options, &Default::default()).expect(name);
    assert!(metal.contains("#include <metal_stdlib>"), "{name}");
    for entry in translation.entry_point_names {
        entry.unwrap_or_else(|error| panic!("{name} in Metal: {error}"));
    }
    let (options, pipeline) = (hlsl::Options::default(), hlsl::PipelineOptions::default());
    let mut text = String::new();
    let reflection = hlsl::Writer::new(&mut text, &options, &pipeline).write(&module, &info, None).expect(name);
    for entry in reflection.entry_point_names {
        entry.unwrap_or_else(|error| panic!("{name} in HLSL: {error}"));
    }
    assert!(!text.is_empty(), "{name}");

    let uses = Uses::of(&module, &info);
    uses.check(name);
    uses
}

/// Loops run a number of times that is known before: a `for` or a `while` that compares with a limit.
fn assert_bounded(name: &str, source: &str) {
    for line in source.lines().map(str::trim).filter(|line| !line.starts_with("//")) {
        assert!(!line.starts_with("loop"), "{name}: {line}");
        if line.starts_with("while") || line.starts_with("for ") {
            assert!(line.contains(" < ") || line.contains(" <= "), "{name}: {line}");
        }
    }
}

#[test]
fn every_shader_translates_within_the_limits() {
    let mut worst = Uses::default();
    let mut shaders = 0;
    for (kind, field) in every_kind(9) {
        let plane = field.compile::<2>(&Pictures).unwrap();
        let mask = Some(MaskRule { field, ..default() });
        let masked = MaterialLayer { mask, curvature: Some(CurvatureRule::default()), ..default() };
        let material = TerrainMaterial { layers: vec![masked], ..default() };
        let kernel = material.compile(&Pictures).unwrap().kernel(0, &plane).source;
        // Only the fill pass has the kernel in it.
        let parts = if shaders == 0 { usize::MAX } else { 1 };
        for (name, source) in shader_sources(&kernel).into_iter().take(parts) {
            let name = format!("{name} of {kind}");
            assert_bounded(&name, &source);
            let uses = translate(&name, &source);
            shaders += 1;
            worst = Uses {
                storage_buffers: worst.storage_buffers.max(uses.storage_buffers),
                uniform_bytes: worst.uniform_bytes.max(uses.uniform_bytes),
                textures: worst.textures.max(uses.textures),
                groups: worst.groups.max(uses.groups),
                workgroup_bytes: worst.workgroup_bytes.max(uses.workgroup_bytes),
                invocations: worst.invocations.max(uses.invocations),
            };
        }
    }
    println!("{shaders} shaders in SPIR-V, Metal and HLSL; at most {worst:?}");
}

#[test]
fn every_kernel_in_space_translates() {
    let main = "
@group(1) @binding(0) var<storage, read_write> jets: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    jets[id.x] = field(0u, vec3<f32>(id), 1.0);
}
";
    for (kind, field) in every_kind(10) {
        let kernel = field.compile::<3>(&Pictures).unwrap().kernel(0).source;
        assert_bounded(&kind, &kernel);
        translate(&kind, &[&kernel, main].join("\n"));
    }
}

#[test]
fn the_world_is_drawn_within_webgpus_default_limits() {
    // Neither a limit nor a feature beyond what every WebGPU device has.
    let settings =
        WgpuSettings { priority: WgpuSettingsPriority::WebGPU, features: WgpuFeatures::empty(), ..default() };
    let render = RenderPlugin {
        render_creation: RenderCreation::Automatic(Box::new(settings)),
        synchronous_pipeline_compilation: true,
        ..default()
    };
    let mut off = Offscreen::new((offscreen::plugins().set(render), HorizonPlugins), 160, 90);
    let device = off.app.sub_app(RenderApp).world().resource::<RenderDevice>();
    assert_eq!(device.limits().max_storage_buffers_per_shader_stage, 8);
    assert_eq!(device.features(), WgpuFeatures::empty());

    let target = off.target();
    let world = off.app.world_mut();
    world.spawn((Terrain::default(), Trees::default(), Atmosphere::default()));
    let light = DirectionalLight { illuminance: 100_000.0, shadow_maps_enabled: true, ..default() };
    world.spawn((light, Sun::default().transform()));
    world.spawn((
        Camera3d::default(),
        target,
        Hdr,
        Msaa::Off,
        bevy::camera::Exposure { ev100: 14.5 },
        HorizonCamera::default(),
        Transform::from_xyz(0.0, 500.0, 0.0).looking_to(Vec3::new(0.0, -0.3, -1.0), Vec3::Y),
    ));
    for _ in 0..200 {
        off.update();
        let progress = off.app.world().resource::<Progress>().get();
        if progress.total > 0 && progress.done == progress.total {
            break;
        }
    }
    let picture = off.screenshot();
    // Bevy ends the app after a device error.
    assert!(off.app.should_exit().is_none(), "the device refused something");
    for pipeline in off.app.sub_app(RenderApp).world().resource::<PipelineCache>().pipelines() {
        assert!(matches!(pipeline.state, CachedPipelineState::Ok(_)), "{:?}", pipeline.descriptor);
    }
    let colours: std::collections::BTreeSet<[u8; 4]> = picture.pixels().map(|pixel| pixel.0).collect();
    println!("{} colours in the picture", colours.len());
    assert!(colours.len() > 100, "{} colours", colours.len());
}
