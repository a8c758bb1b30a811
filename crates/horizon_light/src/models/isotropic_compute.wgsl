// What isotropic.wgsl's table holds at a texel; the twin of isotropic.rs, where the reasons stand.

const ISOTROPIC_SIZE: vec2<u32> = vec2(32u);
const ISOTROPIC_STEPS: u32 = 20u;

struct Both {
    // Sunlight scattered once, as if evenly.
    first: vec3<f32>,
    // Light out of a unit of isotropic light.
    again: vec3<f32>,
}

fn isotropic_both(air: Medium, d: Direction) -> Both {
    let steps = steps_new(air.radius, d.view.h, d.view.mu, d.distance, ISOTROPIC_STEPS);
    var sum = Both(vec3(0.0), vec3(0.0));
    var through = vec3(1.0);
    for (var i = 0u; i < ISOTROPIC_STEPS; i += 1u) {
        let step = steps_step(steps, i);
        let here = ray_advanced(d.view, air.radius, step.x);
        let densities = air_densities(air, here.h);
        let depth = air_extinction(air, densities) * step.y;
        let scattering = air.rayleigh * densities.x + air.mie_scattering * densities.y;
        let light = through * step.y * faded(depth) * scattering;
        sum.again += light;
        let sun = transmittance_of_sun(air, min(here.h, air.height), here.mu_s);
        sum.first += light * 0.0795774715 * air.irradiance * sun; // 1/(4 pi)
        through *= exp(-depth);
    }
    if d.ground {
        let mu_s = ray_advanced(d.view, air.radius, d.distance).mu_s;
        let sun = air.irradiance * transmittance_of_sun(air, 0.0, mu_s) * max(mu_s, 0.0);
        sum.first += through * air.albedo * 0.318309886 * sun;
    }
    return sum;
}

fn isotropic_compute(air: Medium, texel: vec2<u32>) -> vec3<f32> {
    let uv = coordinate(texel, ISOTROPIC_SIZE);
    var once = vec3(0.0);
    var back = vec3(0.0);
    for (var i = 0u; i < DIRECTIONS; i += 1u) {
        let d = direction(air, uv.y * air.height, 2.0 * uv.x - 1.0, i);
        let both = isotropic_both(air, d);
        once += both.first * (d.weight * 0.0795774715);
        back += both.again * (d.weight * 0.0795774715);
    }
    return once / (1.0 - min(back, vec3(0.99)));
}
