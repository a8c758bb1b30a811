// What lights the ground under air: the sun, as far as the air over each point lets it through, so that peaks still glow when the
// valleys are dark; and the sky at the camera, by its moments. Needs air_view.wgsl and horizon_light's transmittance.wgsl.

@group(0) @binding(13) var<uniform> air: AirView;
@group(0) @binding(14) var<storage, read> transmittances: array<vec4<f32>>;

fn transmittance_texel(x: u32, y: u32) -> vec3<f32> {
    return transmittances[y * TRANSMITTANCE_SIZE.x + x].rgb;
}

// Whether the sun is the air's to dim, or the scene has a light of its own.
fn daylight_is_own() -> bool {
    return air.own_sun != 0u;
}

fn sunlight_at(p: vec3<f32>) -> vec3<f32> {
    // The vertical turns as one goes over the planet.
    let medium = air.medium;
    let h = clamp(p.y - air.datum, 0.0, medium.height);
    let up = normalize(vec3<f32>(p.x - view.eye.x, medium.radius + h, p.z - view.eye.z));
    let mu_s = clamp(dot(up, air.sun), -1.0, 1.0);
    let visible = sun_visible(air.disc, sun_above_horizon(mu_s, h, medium.radius));
    if (all(visible <= vec3<f32>(0.0))) {
        return vec3<f32>(0.0);
    }
    let through = transmittance_to_top(medium, h, max(mu_s, horizon_cosine(medium.radius, h)));
    return air_rgb(air, medium.irradiance * through * visible);
}
