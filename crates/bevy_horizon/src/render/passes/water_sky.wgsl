// What light water gets from the air: from a direction, and on its level. Needs view.wgsl, horizon_light's base and sky view, and
// air_view.wgsl, skylight_air.wgsl.

@group(0) @binding(13) var<uniform> air: AirView;
@group(0) @binding(15) var<storage, read> sky_view: array<vec4<u32>>;
@group(0) @binding(16) var aerial_light: texture_3d<f32>;
@group(0) @binding(17) var aerial_through: texture_3d<f32>;
@group(0) @binding(18) var aerial_sampler: sampler;

fn sky_view_texel(x: u32, y: u32, layer: u32) -> vec3<f32> {
    return sky_view_unpacked(sky_view[y * SKY_VIEW_AZIMUTHS + x], layer);
}

fn air_seen_along(direction: vec3<f32>) -> SkyRay {
    return SkyRay(
        min(air.h, air.medium.height),
        clamp(direction.y, -1.0, 1.0),
        clamp(air.sun.y, -1.0, 1.0),
        clamp(dot(direction, air.sun), -1.0, 1.0));
}

// Luminance of the sky without the sun's disc, in cd/m².
fn sky_from(direction: vec3<f32>) -> vec3<f32> {
    return air_rgb(air, sky_view_radiance(air.medium, air_seen_along(direction))) + air.night;
}

// The sky's light on level water, as an irradiance over π.
fn skylight_on_level() -> vec3<f32> {
    if (air.own_sun == 0u) {
        return view.ambient;
    }
    return skylight_on(vec3<f32>(0.0, 1.0, 0.0));
}

// What the air over so many metres leaves of light, and adds to it.
struct Veil {
    through: vec3<f32>,
    light: vec3<f32>,
}

fn veil_along(direction: vec3<f32>, distance: f32) -> Veil {
    let at = aerial_coordinates(air.medium, air_seen_along(direction), distance, air.far);
    return Veil(
        textureSampleLevel(aerial_through, aerial_sampler, at, 0.0).rgb,
        textureSampleLevel(aerial_light, aerial_sampler, at, 0.0).rgb);
}
