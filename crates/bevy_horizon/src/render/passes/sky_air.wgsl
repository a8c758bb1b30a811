// The air: the sky where nothing was drawn; over what was, two draws: what the air takes is multiplied, what it adds is added, so that
// each channel fades by itself. Needs sky_common.wgsl, the air's tables and a model of horizon_light.

@group(0) @binding(5) var<storage, read> sky_view: array<vec4<u32>>;
@group(0) @binding(6) var aerial_light: texture_3d<f32>;
@group(0) @binding(7) var aerial_through: texture_3d<f32>;
@group(0) @binding(8) var aerial_sampler: sampler;

fn sky_view_texel(x: u32, y: u32, layer: u32) -> vec3<f32> {
    return sky_view_unpacked(sky_view[y * SKY_VIEW_AZIMUTHS + x], layer);
}

fn air_view_of(ray: AirRay) -> SkyRay {
    return SkyRay(
        air.h,
        clamp(ray.direction.y, -1.0, 1.0),
        clamp(air.sun.y, -1.0, 1.0),
        clamp(dot(ray.direction, air.sun), -1.0, 1.0));
}

// What comes out of a direction in which nothing was drawn, in cd/m².
fn sky_luminance(ray: AirRay) -> vec3<f32> {
    let seen = air_view_of(ray);
    let medium = air.medium;
    var radiance: vec3<f32>;
    // The table is of a camera inside the air.
    if (air.h <= medium.height) {
        radiance = sky_view_radiance(medium, seen);
    } else {
        radiance = scattered_radiance(sky(medium, seen, VIEW_STEPS), medium, seen.nu);
    }
    if (hits_ground(medium.radius, air.h, seen.mu)) {
        return air_rgb(air, radiance);
    }
    let sun = sun_luminance(air.disc, ray.direction, air.sun, view.pixel);
    if (any(sun > vec3<f32>(0.0))) {
        radiance += sun * sun_through(medium, seen);
    }
    return air_rgb(air, radiance) + air.night;
}

// What of the sun's light comes through the air along a ray that leaves it.
fn sun_through(medium: Medium, seen: SkyRay) -> vec3<f32> {
    if (air.h <= medium.height) {
        return transmittance_to_top(medium, air.h, seen.mu);
    }
    let interval = air_interval(medium.radius, medium.height, air.h, seen.mu);
    if (interval.y <= interval.x) {
        return vec3<f32>(1.0);
    }
    let inside = ray_entered(medium, seen, interval.x);
    return transmittance_to_top(medium, medium.height, inside.mu);
}

@fragment
fn air_sky(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    // A half float ends at 65 504.
    return present(vec4<f32>(min(sky_luminance(sky_ray(position)) * view.exposure, vec3<f32>(6e4)), 1.0));
}

@fragment
fn air_haze(@builtin(position) position: vec4<f32>, @builtin(sample_index) sample_index: u32) -> @location(0) vec4<f32> {
    let ray = haze_ray(position, sample_index);
    let seen = air_view_of(ray);
    var light: vec3<f32>;
    if (air.h <= air.medium.height) {
        let at = aerial_coordinates(air.medium, seen, ray.distance, air.far);
        light = textureSampleLevel(aerial_light, aerial_sampler, at, 0.0).rgb;
    } else {
        light = air_rgb(air, scattered_radiance(in_scatter(air.medium, seen, ray.distance, VIEW_STEPS), air.medium, seen.nu));
    }
    return vec4<f32>(present(vec4<f32>(light * view.exposure, 1.0)).rgb, 0.0);
}

@fragment
fn air_veil(@builtin(position) position: vec4<f32>, @builtin(sample_index) sample_index: u32) -> @location(0) vec4<f32> {
    let ray = haze_ray(position, sample_index);
    let seen = air_view_of(ray);
    if (air.h <= air.medium.height) {
        let at = aerial_coordinates(air.medium, seen, ray.distance, air.far);
        return vec4<f32>(textureSampleLevel(aerial_through, aerial_sampler, at, 0.0).rgb, 1.0);
    }
    return vec4<f32>(in_scatter(air.medium, seen, ray.distance, VIEW_STEPS).transmittance, 1.0);
}
