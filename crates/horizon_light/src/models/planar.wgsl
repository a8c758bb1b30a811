// Single scattering over flat ground; the twin of planar.rs, where the reasons stand.

const PLANAR_FARTHEST: f32 = 200.0;

fn planar_exponential(air: Medium, h: f32, scale: f32) -> f32 {
    return scale * max(exp(-h / scale) - exp(-air.height / scale), 0.0);
}

// The tent's integral from altitude h on, in half widths.
fn planar_tent(air: Medium, h: f32) -> f32 {
    let x = clamp((h - air.absorption_peak) / air.absorption_width, -1.0, 1.0);
    return select(0.5 * (1.0 - x) * (1.0 - x), 1.0 - 0.5 * (1.0 + x) * (1.0 + x), x < 0.0);
}

// The sun's transmittance at altitude h, 0 under the horizon.
fn planar_sun(air: Medium, h: f32, mu_s: f32) -> vec3<f32> {
    if mu_s <= 0.0 {
        return vec3(0.0);
    }
    let columns = vec3(
        planar_exponential(air, h, air.rayleigh_height),
        planar_exponential(air, h, air.mie_height),
        air.absorption_width * max(planar_tent(air, h) - planar_tent(air, air.height), 0.0),
    );
    return exp(-air_extinction(air, columns) / mu_s);
}

fn planar(air: Medium, view: SkyRay, distance: f32, count: u32) -> Scattered {
    var near = 0.0;
    if view.h > air.height {
        if view.mu >= 0.0 {
            return scattered_nothing();
        }
        near = (air.height - view.h) / view.mu;
    }
    let h = min(view.h, air.height);
    let room = select(air.height - h, h, view.mu < 0.0);
    var reach = air.rayleigh_height * PLANAR_FARTHEST;
    if abs(view.mu) * reach > room {
        reach = room / abs(view.mu);
    }
    reach = min(distance - near, reach);
    if reach <= 0.0 {
        return scattered_nothing();
    }
    let phase = rayleigh_phase(view.nu);
    var sum = scattered_nothing();
    for (var i = 0u; i < count; i += 1u) {
        var ends = vec2(f32(i), f32(i + 1u)) / f32(count);
        ends *= ends;
        if view.mu < 0.0 {
            ends = vec2(f32(count - i), f32(count - i - 1u)) / f32(count);
            ends = 1.0 - ends * ends;
        }
        let length = (ends.y - ends.x) * reach;
        let here = clamp(h + view.mu * reach * 0.5 * (ends.x + ends.y), 0.0, air.height);
        let densities = air_densities(air, here);
        let depth = air_extinction(air, densities) * length;
        let direct = sum.transmittance * length * faded(depth) * air.irradiance * planar_sun(air, here, view.mu_s);
        sum.soft += direct * air.rayleigh * densities.x * phase;
        sum.mie += direct * air.mie_scattering * densities.y;
        sum.transmittance *= exp(-depth);
    }
    return sum;
}
