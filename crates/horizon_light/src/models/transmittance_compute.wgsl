// How the transmittance table is made; the twin of transmittance.rs, where the coordinates are explained.

const TRANSMITTANCE_SIZE: vec2<u32> = vec2(256u, 64u);
const TRANSMITTANCE_SAMPLES: u32 = 40u;

// Altitude, cosine and distance to the top that the table's coordinates stand for.
fn transmittance_texel_ray(air: Medium, uv: vec2<f32>) -> vec3<f32> {
    let farthest = horizon_distance(air.radius, air.height);
    let horizon = farthest * uv.y;
    let square = horizon * horizon;
    let h = min(square / (air.radius + sqrt(air.radius * air.radius + square)), air.height);
    let least = air.height - h;
    let distance = least + (horizon + farthest - least) * uv.x;
    let rise = least * (air.radius + air.radius + air.height + h);
    let run = (air.radius + h) * distance;
    if run <= 0.0 {
        return vec3(h, 1.0, distance);
    }
    return vec3(h, clamp((rise - distance * distance) / (run + run), -1.0, 1.0), distance);
}

fn optical_depth(air: Medium, h: f32, mu: f32, distance: f32, samples: u32) -> vec3<f32> {
    let steps = steps_new(air.radius, h, mu, distance, samples);
    var depth = vec3(0.0);
    for (var i = 0u; i < samples; i += 1u) {
        let step = steps_step(steps, i);
        depth += air_extinction(air, air_densities(air, advance(air.radius, h, mu, step.x).x)) * step.y;
    }
    return depth;
}

// What the table holds at a texel.
fn transmittance_compute(air: Medium, texel: vec2<u32>) -> vec3<f32> {
    let ray = transmittance_texel_ray(air, coordinate(texel, TRANSMITTANCE_SIZE));
    return exp(-optical_depth(air, ray.x, ray.y, ray.z, TRANSMITTANCE_SAMPLES));
}
