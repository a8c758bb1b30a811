// The default model's multiple scattering, by spherical moments; the twin of moments.rs, where the idea and the reasons stand. The host
// declares fn moment_texel(x: u32, y: u32, harmonic: u32) -> vec3<f32>, the sum of all orders for drawing, the last order for a pass.
// Needs moments_compute.wgsl.

struct Moments {
    moments: array<vec3<f32>, 6>,
}

fn moments_at(air: Medium, h: f32, mu_s: f32) -> Moments {
    let c = cell(vec2(sun_coordinate(air, mu_s), sqrt(max(h / air.height, 0.0))), MOMENTS_SIZE);
    var light: Moments;
    for (var i = 0u; i < 6u; i += 1u) {
        light.moments[i] = bilinear(
            moment_texel(c.first.x, c.first.y, i),
            moment_texel(c.first.x + 1u, c.first.y, i),
            moment_texel(c.first.x, c.first.y + 1u, i),
            moment_texel(c.first.x + 1u, c.first.y + 1u, i),
            c.part,
        );
    }
    return light;
}

// The light of these moments, each degree weighted, for one direction's harmonics.
fn blurred(light: Moments, direction: array<f32, 6>, isotropic: vec3<f32>, linear: vec3<f32>, square: vec3<f32>) -> vec3<f32> {
    let m = light.moments;
    let sum = isotropic * m[0] * direction[0]
        + linear * (m[1] * direction[1] + m[2] * direction[2])
        + square * (m[3] * direction[3] + m[4] * direction[4] + m[5] * direction[5]);
    return max(sum, vec3(0.0));
}

fn multiple_source(air: Medium, densities: vec3<f32>, at: SkyRay) -> vec3<f32> {
    let rayleigh = air.rayleigh * densities.x;
    let mie = air.mie_scattering * densities.y;
    return blurred(
        moments_at(air, at.h, at.mu_s),
        harmonics(at.mu, sunward(at.mu, at.mu_s, at.nu)),
        rayleigh + mie,
        mie * air.mie_moments.x,
        rayleigh * 0.1 + mie * air.mie_moments.y,
    );
}

// Diffuse irradiance at altitude h of a surface whose normal has the cosine `up` to the vertical and `to_sun` to the sun.
fn irradiance(air: Medium, h: f32, mu_s: f32, up: f32, to_sun: f32) -> vec3<f32> {
    let level = max(up, 0.0) * max(up, 0.0);
    return blurred(
        moments_at(air, min(h, air.height), mu_s),
        harmonics(up, sunward(up, mu_s, to_sun)),
        vec3(3.14159265),
        vec3(2.0943951),
        vec3(0.785398163 + 0.157079633 * level),
    );
}

fn ground_irradiance(air: Medium, mu_s: f32) -> vec3<f32> {
    return irradiance(air, 0.0, mu_s, 1.0, mu_s);
}
