//! The WGSL is valid in every way that a host joins it, and has the constants of its twin.

use crate::models::shaders::*;
use crate::models::{directions, isotropic, moments, scatter, sky_view, transmittance};

const TRANSMITTANCE_TEXEL: &str = "fn transmittance_texel(x: u32, y: u32) -> vec3<f32> { return vec3(f32(x + y)); }\n";
const MOMENT_TEXEL: &str = "fn moment_texel(x: u32, y: u32, i: u32) -> vec3<f32> { return vec3(f32(x + y + i)); }\n";
const ISOTROPIC_TEXEL: &str = "fn isotropic_texel(x: u32, y: u32) -> vec3<f32> { return vec3(f32(x + y)); }\n";
const SKY_VIEW_TEXEL: &str =
    "fn sky_view_texel(x: u32, y: u32, i: u32) -> vec3<f32> { return vec3(f32(x + y + i)); }\n";

fn assert_valid(pieces: &[&str], entry: &str) {
    let header = "@group(0) @binding(0) var<uniform> air: Medium;\n\
        @group(0) @binding(1) var<storage, read_write> out: array<vec4<f32>>;\n";
    let source = [&pieces.concat(), header, "@compute @workgroup_size(1) fn entry() { ", entry, " }"].concat();
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let flags = naga::valid::ValidationFlags::all();
    let nothing_special = naga::valid::Capabilities::empty();
    let valid = naga::valid::Validator::new(flags, nothing_special).validate(&module);
    valid.unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
}

const VIEW: &str = "let view = SkyRay(2.0, 0.5, 0.6, 0.7); ";

#[test]
fn transmittance_pass() {
    assert_valid(&[BASE], "out[0] = vec4(transmittance_compute(air, vec2(3u, 4u)), 0.0);");
}

#[test]
fn moments_passes() {
    let entry = |sunlit| {
        format!(
            "let m = moments_compute(air, vec2(3u, 4u), {sunlit}); \
             out[0] = vec4(m[0] * geometric_series(m[1], m[2]), 0.0);"
        )
    };
    assert_valid(&[BASE, TRANSMITTANCE_TEXEL, SCATTER, ONCE, MOMENTS_COMPUTE], &entry(true));
    let again = [BASE, TRANSMITTANCE_TEXEL, SCATTER, MOMENTS_COMPUTE, MOMENT_TEXEL, MOMENTS];
    assert_valid(&again, &entry(false));
}

#[test]
fn isotropic_pass() {
    let pieces = [BASE, TRANSMITTANCE_TEXEL, SCATTER, ONCE, ISOTROPIC_COMPUTE];
    assert_valid(&pieces, "out[0] = vec4(isotropic_compute(air, vec2(3u, 4u)), 0.0);");
}

#[test]
fn drawing_with_each_model() {
    let entry = [
        VIEW,
        "let made = sky_view_compute(air, 2.0, 0.6, vec2(3u, 4u), VIEW_STEPS);",
        "let whole_sky = scattered_radiance(sky(air, view, VIEW_STEPS), air, view.nu);",
        "let haze = in_scatter(air, view, 1e4, 8u);",
        "let flat_sky = planar(air, view, 1e4, 8u);",
        "out[0] = vec4(made.mie + whole_sky + haze.transmittance + flat_sky.soft + sky_view_radiance(air, view), 0.0);",
    ]
    .concat();
    let models = [[ONCE, "", ""], [MOMENTS_COMPUTE, MOMENT_TEXEL, MOMENTS], ["", ISOTROPIC_TEXEL, ISOTROPIC]];
    for [a, b, c] in models {
        let pieces = [BASE, TRANSMITTANCE_TEXEL, SCATTER, a, b, c, SKY_VIEW_COMPUTE, SKY_VIEW_TEXEL, SKY_VIEW, PLANAR];
        assert_valid(&pieces, &entry);
    }
}

#[test]
fn ambient_light() {
    let pieces = [BASE, TRANSMITTANCE_TEXEL, SCATTER, MOMENTS_COMPUTE, MOMENT_TEXEL, MOMENTS];
    assert_valid(&pieces, "out[0] = vec4(irradiance(air, 2.0, 0.5, 1.0, 0.5), 0.0);");
}

#[test]
fn twins_share_their_constants() {
    let has = |source: &str, line: String| assert!(source.contains(&line), "{line}");
    let (directions, altitudes) = (transmittance::DIRECTIONS, transmittance::ALTITUDES);
    has(BASE, format!("const TRANSMITTANCE_SIZE: vec2<u32> = vec2({directions}u, {altitudes}u);"));
    has(BASE, format!("const TRANSMITTANCE_SAMPLES: u32 = {}u;", transmittance::SAMPLES));
    has(SCATTER, format!("const VIEW_STEPS: u32 = {}u;", scatter::VIEW_STEPS));
    has(SCATTER, format!("const DIRECTIONS: u32 = {}u;", directions::DIRECTIONS));
    let moments::Resolution { suns, altitudes, steps, passes } = moments::Resolution::DEFAULT;
    has(MOMENTS_COMPUTE, format!("const MOMENTS_SIZE: vec2<u32> = vec2({suns}u, {altitudes}u);"));
    has(MOMENTS_COMPUTE, format!("const MOMENTS_STEPS: u32 = {steps}u;"));
    has(MOMENTS_COMPUTE, format!("const MOMENTS_PASSES: u32 = {passes}u;"));
    has(ISOTROPIC_COMPUTE, format!("const ISOTROPIC_SIZE: vec2<u32> = vec2({}u);", isotropic::SIZE));
    has(ISOTROPIC, format!("vec2(0.5 * mu_s + 0.5, h / air.height), vec2({}u)", isotropic::SIZE));
    has(ISOTROPIC_COMPUTE, format!("const ISOTROPIC_STEPS: u32 = {}u;", isotropic::STEPS));
    has(SKY_VIEW, format!("const SKY_VIEW_AZIMUTHS: u32 = {}u;", sky_view::AZIMUTHS));
    has(SKY_VIEW, format!("const SKY_VIEW_ABOVE: u32 = {}u;", sky_view::ABOVE));
    has(SKY_VIEW, format!("const SKY_VIEW_BELOW: u32 = {}u;", sky_view::BELOW));
    let float = |x: f64| format!("{:?}", x as f32);
    for [node, weight] in directions::POLAR {
        has(SCATTER, format!("vec2({}, {})", float(node), float(weight)));
    }
    has(SCATTER, format!("array({})", directions::AZIMUTHS.map(float).join(", ")));
}

#[test]
fn the_shaders_need_no_preprocessor() {
    let all = [
        BASE,
        SCATTER,
        ONCE,
        MOMENTS_COMPUTE,
        MOMENTS,
        ISOTROPIC,
        ISOTROPIC_COMPUTE,
        SKY_VIEW_COMPUTE,
        SKY_VIEW,
        PLANAR,
    ];
    for directive in ["#", "enable ", "requires ", "diagnostic("] {
        assert!(!all.iter().any(|source| source.lines().any(|line| line.trim_start().starts_with(directive))));
    }
}
