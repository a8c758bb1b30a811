// The transmittance table; the twin of transmittance.rs, where the coordinates are explained. The host declares
// fn transmittance_texel(x: u32, y: u32) -> vec3<f32>, which transmittance_compute.wgsl fills.

fn transmittance_at(uv: vec2<f32>) -> vec3<f32> {
    let c = cell(uv, TRANSMITTANCE_SIZE);
    return bilinear(
        transmittance_texel(c.first.x, c.first.y),
        transmittance_texel(c.first.x + 1u, c.first.y),
        transmittance_texel(c.first.x, c.first.y + 1u),
        transmittance_texel(c.first.x + 1u, c.first.y + 1u),
        c.part,
    );
}

// From altitude h <= air.height out of direction mu, which must not meet the ground.
fn transmittance_to_top(air: Medium, h: f32, mu: f32) -> vec3<f32> {
    let horizon = horizon_distance(air.radius, h);
    let farthest = horizon_distance(air.radius, air.height);
    let least = air.height - h;
    let most = horizon + farthest;
    let distance = distance_to_top(air.radius, air.height, h, mu);
    return transmittance_at(vec2((distance - least) / (most - least), horizon / farthest));
}

// Of the sun's centre, 0 behind the ground.
fn transmittance_of_sun(air: Medium, h: f32, mu_s: f32) -> vec3<f32> {
    if hits_ground(air.radius, h, mu_s) {
        return vec3(0.0);
    }
    return transmittance_to_top(air, h, mu_s);
}
