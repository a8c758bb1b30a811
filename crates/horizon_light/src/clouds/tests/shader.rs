//! The WGSL is valid as a host joins it, and has its twins' constants.

use crate::clouds::{Cloud, CloudLayer, CloudModel, WGSL, density, light, march, span, volume};
use horizon_field::Place;

const HOST: &str = "
@group(0) @binding(0) var<uniform> cloud: Cloud;
@group(0) @binding(1) var<storage, read_write> out: array<vec4<f32>>;
@group(0) @binding(2) var volume: texture_3d<f32>;
@group(0) @binding(3) var repeating: sampler;
fn cloud_volume(u: vec3<f32>) -> vec3<f32> { return textureSampleLevel(volume, repeating, u, 0.0).xyz; }
fn cloud_volume_most(block: vec3<i32>, mip: u32) -> vec3<f32> {
    let edge = i32(CLOUD_BLOCKS) >> mip;
    return textureLoad(volume, ((block % edge) + edge) % edge, i32(mip)).xyz;
}
fn cloud_weather(cloud: Cloud, at: vec3<f32>) -> vec2<f32> { return cloud.weather; }
fn cloud_weather_most(cloud: Cloud, at: vec3<f32>, reach: f32) -> vec2<f32> { return cloud.weather; }
@compute @workgroup_size(1)
fn entry() {
    let start = CloudPoint(vec3<f32>(0.0), 2.0, vec3<f32>(0.0, 1.0, 0.0));
    let ray = CloudRay(start, vec3<f32>(0.6, 0.8, 0.0), 6.36e6);
    let quality = CloudQuality(32u, 6u, 2e3, 0.5, 1e-3, CLOUD_OCTAVES);
    let none = CloudMarched(vec3<f32>(0.0), 1.0, 0.0, 0u);
    let seen = cloud_march(none, cloud, ray, vec2<f32>(0.0, 1e5), vec3<f32>(0.0, 1.0, 0.0), quality);
    out[0] = vec4<f32>(seen.light.xy, seen.transmittance, seen.depth);
}
";

const MAKER: &str = "
@group(0) @binding(0) var<storage, read_write> out: array<vec4<f32>>;
fn cloud_finer(texel: vec3<u32>) -> vec4<f32> { return vec4<f32>(vec3<f32>(texel), 1.0); }
@compute @workgroup_size(4, 4, 4)
fn entry(@builtin(global_invocation_id) id: vec3<u32>) {
    out[0] = cloud_texel(id) + cloud_border_most(id) + cloud_most(id);
}
";

fn assert_valid(source: &str) {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let flags = naga::valid::ValidationFlags::all();
    let valid = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module);
    valid.unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
}

#[test]
fn the_shaders_are_valid() {
    assert_valid(&[include_str!("../../geometry.wgsl"), WGSL, HOST].concat());
    assert_valid(&[volume::compute_wgsl().as_str(), MAKER].concat());
}

#[test]
fn twins_share_their_constants() {
    let all = [WGSL, include_str!("../volume_compute.wgsl")].concat();
    let has = |name: &str, values: &[f64]| {
        let line = all.lines().find(|line| line.starts_with(&format!("const {name}:"))).expect(name);
        let text = line.split_once('=').expect(name).1.trim().trim_end_matches(';');
        let list = text.split_once('(').map_or(text, |(_, list)| list.trim_end_matches(')'));
        let numbers = list.split(',').map(|number| number.trim().trim_end_matches('u').parse().expect(name));
        let theirs: Vec<f32> = numbers.collect();
        assert_eq!(theirs, values.iter().map(|x| *x as f32).collect::<Vec<_>>(), "{name}");
    };
    has("CLOUD_TEXELS", &[volume::TEXELS as f64]);
    has("CLOUD_BLOCKS", &[volume::TEXELS as f64]);
    has("CLOUD_MIPS", &[volume::MIPS as f64]);
    has("CLOUD_CELLS", &[f64::from(volume::CELLS)]);
    has("CLOUD_GRADIENT", &volume::GRADIENT);
    has("CLOUD_WORLEY", &volume::WORLEY);
    has("CLOUD_SPREAD_LOW", &volume::SPREAD.map(|ends| ends[0]));
    has("CLOUD_SPREAD_HIGH", &volume::SPREAD.map(|ends| ends[1]));
    has("CLOUD_SEEDS", &volume::SEEDS.map(f64::from));
    has("CLOUD_RISE", &[density::RISE]);
    has("CLOUD_FALL", density::FALL.as_flattened());
    has("CLOUD_TURN", &[density::TURN]);
    has("CLOUD_FARTHEST", &[span::FARTHEST]);
    has("CLOUD_MOST_STEPS", &[f64::from(march::MOST_STEPS)]);
    has("CLOUD_SKIP_MIP", &[march::SKIP_MIP as f64]);
    has("CLOUD_OCTAVES", &[f64::from(light::OCTAVES)]);
    for (i, octave) in light::DIFFUSE.iter().enumerate() {
        has(&format!("CLOUD_DIFFUSE_{}", i + 1), octave);
    }
}

/// The host's words are the shader's fields, in order and without a gap.
#[test]
fn words_are_laid_out_as_the_shader_s() {
    let source = [include_str!("../../geometry.wgsl"), WGSL, HOST].concat();
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Cloud")).expect("the shader's struct");
    let naga::TypeInner::Struct { members, span } = &found.1.inner else { panic!("no struct") };
    let layer = CloudLayer { model: CloudModel::Slab, ..CloudLayer::CUMULUS };
    let cloud = Cloud::<f32>::new(&layer, &Place::from_metres([1.0, 2.0, 3.0]), 4.0);
    let words = cloud.words();
    assert_eq!(*span as usize, 4 * words.len());
    let at = |name: &str| {
        let member = members.iter().find(|member| member.name.as_deref() == Some(name)).expect(name);
        words[member.offset as usize / 4]
    };
    for (name, value) in [
        ("offset", cloud.offset[0]),
        ("per_shape", cloud.per_shape),
        ("detail_offset", cloud.detail_offset[0]),
        ("per_detail", cloud.per_detail),
        ("base", cloud.base),
        ("thickness", cloud.thickness),
        ("extinction", cloud.extinction),
        ("softness", cloud.softness),
        ("erosion", cloud.erosion),
        ("weather", cloud.weather.coverage),
        ("phase", cloud.phase.forward),
    ] {
        assert_eq!(at(name), value.to_bits(), "{name}");
    }
    assert_eq!(at("model"), 1);
    for (name, model) in [("SHEET", CloudModel::Sheet), ("SLAB", CloudModel::Slab), ("BILLOW", CloudModel::Billow)] {
        assert!(WGSL.contains(&format!("const CLOUD_{name}: u32 = {}u;", model as u32)));
    }
}

/// Names that a host's own cannot meet, and no directives.
#[test]
fn the_shaders_keep_to_themselves() {
    for line in WGSL.lines() {
        let mut words = line.split(' ');
        match words.next() {
            Some("fn") => assert!(words.next().is_some_and(|name| name.starts_with("cloud_")), "{line}"),
            Some("struct") => assert!(words.next().is_some_and(|name| name.starts_with("Cloud")), "{line}"),
            Some("const") => assert!(words.next().is_some_and(|name| name.starts_with("CLOUD_")), "{line}"),
            Some(word) => assert!(!word.starts_with('#') && word != "enable" && word != "requires", "{line}"),
            None => {}
        }
    }
}
