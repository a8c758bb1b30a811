//! The WGSL is valid as a host includes it, and has its twin's constants.

use crate::water::{WGSL, body, caustics, rough, surface};

#[test]
fn the_shader_is_valid() {
    let entry = "
@group(0) @binding(0) var<uniform> water: Water;
@group(0) @binding(1) var<storage, read_write> out: array<vec4<f32>>;
@compute @workgroup_size(1)
fn entry() {
    let up = vec3<f32>(0.0, 1.0, 0.0);
    let light = water_lit(water, up, vec3<f32>(1.0), vec3<f32>(1.0));
    let ray = water_refract(-up, up, water.index);
    var colour = water_in_scatter(water, light, 0.0, ray.direction, 1e7) * water_crossing(1.0, 1.0 / water.index);
    colour += water_transmittance(water, 1.0) + water_blurred(water, 1.0) * water_upwelling(water, light, 1.0);
    colour += water_irradiance(water, light, 1.0) * water_focus(vec3<f32>(0.1), 1.0, water.index, WATER_BRIGHTEST);
    colour += water_reflectance(1.0, 0.01, water.index) + water_critical_cosine(water.index);
    colour += water_glitter(up, up, up, vec2<f32>(water_sun_variance(0.005)), 0.005, water.index);
    out[0] = vec4<f32>(water_foam(colour, vec3<f32>(1.0), water.foam, 0.5), select(0.0, 1.0, ray.total));
}
";
    let source = [WGSL, entry].concat();
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
    let flags = naga::valid::ValidationFlags::all();
    let valid = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module);
    valid.unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)));
}

#[test]
fn twins_share_their_constants() {
    let has = |name: &str, values: &[f64]| {
        let line = WGSL.lines().find(|line| line.starts_with(&format!("const {name}:"))).expect(name);
        let text = line.split_once('=').expect(name).1.trim().trim_end_matches(';');
        let list = text.split_once('(').map_or(text, |(_, list)| list.trim_end_matches(')'));
        let theirs: Vec<f32> = list.split(',').map(|number| number.trim().parse().expect(name)).collect();
        assert_eq!(theirs, values.iter().map(|x| *x as f32).collect::<Vec<_>>(), "{name}");
    };
    has("WATER_PI", &[core::f64::consts::PI]);
    has("WATER_SKY_COSINE", &[body::SKY_COSINE]);
    has("WATER_SKY_PEAK", &[body::SKY_PEAK]);
    has("WATER_KIRK", &body::KIRK);
    has("WATER_GATHERED", &[body::GATHERED]);
    has("WATER_MILKY", &[body::MILKY]);
    has("WATER_FARTHEST", &[body::FARTHEST]);
    has("WATER_LOWEST_SUN", &[body::LOWEST_SUN]);
    has("WATER_MOLECULES", &[body::MOLECULES]);
    has("WATER_ROUGHEST", &[rough::ROUGHEST]);
    has("WATER_NARROWEST", &[rough::NARROWEST]);
    has("WATER_FIT", &rough::FIT);
    has("WATER_DIFFUSE", &surface::DIFFUSE);
    has("WATER_BRIGHTEST", &[caustics::BRIGHTEST]);
}

/// Names that a host's own cannot meet, and no directives.
#[test]
fn the_shader_keeps_to_itself() {
    for line in WGSL.lines() {
        let mut words = line.split(' ');
        if let (Some("fn" | "const" | "struct"), Some(name)) = (words.next(), words.next()) {
            let ours = ["water_", "Water", "WATER_"].iter().any(|prefix| name.starts_with(prefix));
            assert!(ours, "{name}");
        }
        let directive =
            ["#", "enable ", "requires ", "diagnostic("].iter().any(|word| line.trim_start().starts_with(word));
        assert!(!directive, "{line}");
    }
}
