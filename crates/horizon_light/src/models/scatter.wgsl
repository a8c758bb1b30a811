// The march that every model shares; the twin of scatter.rs, where the reasons stand. A model adds one of once.wgsl, moments.wgsl,
// isotropic.wgsl, which declare
//     fn multiple_source(air: Medium, densities: vec3<f32>, at: SkyRay) -> vec3<f32>
//     fn ground_irradiance(air: Medium, mu_s: f32) -> vec3<f32>

const VIEW_STEPS: u32 = 16u;

// A ray under a sun: altitude, and the cosines vertical-ray, vertical-sun and ray-sun.
struct Scattered {
    // Radiance but for mie.
    soft: vec3<f32>,
    // Radiance of sunlight that aerosols scattered once, divided by their phase function.
    mie: vec3<f32>,
    transmittance: vec3<f32>,
}

fn ray_advanced(view: SkyRay, radius: f32, distance: f32) -> SkyRay {
    let moved = advance(radius, view.h, view.mu, distance);
    return SkyRay(moved.x, moved.y, advance_sun(radius, view.h, view.mu_s, view.nu, distance, moved.x), view.nu);
}

fn scattered_nothing() -> Scattered {
    return Scattered(vec3(0.0), vec3(0.0), vec3(1.0));
}

fn scattered_radiance(scattered: Scattered, air: Medium, nu: f32) -> vec3<f32> {
    return scattered.soft + scattered.mie * mie_phase(air.mie_asymmetry, nu);
}

// (1 - e^-x)/x, by its series where that cancels.
fn faded(x: vec3<f32>) -> vec3<f32> {
    let series = 1.0 - x * (0.5 - x / 6.0);
    return select((1.0 - exp(-x)) / max(x, vec3(1e-2)), series, x < vec3(1e-2));
}

// Light scattered into the first `distance` metres of a ray inside the air. Without `sunlit`, multiple scattering alone is the light.
fn gather(air: Medium, view: SkyRay, distance: f32, count: u32, sunlit: bool) -> Scattered {
    let steps = steps_new(air.radius, view.h, view.mu, distance, count);
    let phase = rayleigh_phase(view.nu);
    var sum = scattered_nothing();
    for (var i = 0u; i < count; i += 1u) {
        let step = steps_step(steps, i);
        var here = ray_advanced(view, air.radius, step.x);
        here.h = min(here.h, air.height);
        let densities = air_densities(air, here.h);
        let depth = air_extinction(air, densities) * step.y;
        let weight = sum.transmittance * step.y * faded(depth);
        sum.soft += weight * multiple_source(air, densities, here);
        if sunlit {
            let direct = weight * air.irradiance * transmittance_of_sun(air, here.h, here.mu_s);
            sum.soft += direct * air.rayleigh * densities.x * phase;
            sum.mie += direct * air.mie_scattering * densities.y;
        }
        sum.transmittance *= exp(-depth);
    }
    return sum;
}

fn ground_radiance(air: Medium, mu_s: f32, sunlit: bool) -> vec3<f32> {
    var light = ground_irradiance(air, mu_s);
    if sunlit {
        light += air.irradiance * transmittance_of_sun(air, 0.0, mu_s) * max(mu_s, 0.0);
    }
    return air.albedo * 0.318309886 * light;
}

// The march to the end of a ray inside the air, with the ground's light if it ends there.
fn gather_all(air: Medium, view: SkyRay, distance: f32, ground: bool, count: u32, sunlit: bool) -> Scattered {
    var sum = gather(air, view, distance, count, sunlit);
    if ground {
        sum.soft += sum.transmittance * ground_radiance(air, ray_advanced(view, air.radius, distance).mu_s, sunlit);
    }
    return sum;
}

// Aerial perspective of the first `distance` metres of any ray, from inside or outside the air. It ends at the ground.
fn in_scatter(air: Medium, view: SkyRay, distance: f32, count: u32) -> Scattered {
    let interval = air_interval(air.radius, air.height, view.h, view.mu);
    if min(distance, interval.y) <= interval.x {
        return scattered_nothing();
    }
    let inside = ray_entered(air, view, interval.x);
    let end = distance_to_end(air.radius, air.height, inside.h, inside.mu);
    return gather(air, inside, min(distance - interval.x, end), count, true);
}

// The sky, or the bare ground where it is met, out of any direction.
fn sky(air: Medium, view: SkyRay, count: u32) -> Scattered {
    let interval = air_interval(air.radius, air.height, view.h, view.mu);
    if view.h > air.height && interval.y <= interval.x {
        return scattered_nothing();
    }
    let inside = ray_entered(air, view, interval.x);
    let end = distance_to_end(air.radius, air.height, inside.h, inside.mu);
    return gather_all(air, inside, end, hits_ground(air.radius, inside.h, inside.mu), count, true);
}

// The ray from where it is in the air first, `near` metres on.
fn ray_entered(air: Medium, view: SkyRay, near: f32) -> SkyRay {
    if view.h <= air.height {
        return view;
    }
    var entered = ray_advanced(view, air.radius, near);
    entered.h = air.height;
    return entered;
}
