// What a camera inside the air sees of it: the sky all round, and aerial perspective. Made anew where the camera's altitude or
// the sun has changed, not where the camera turns.

@group(0) @binding(5) var<storage, read_write> sky_view: array<vec4<u32>>;
@group(0) @binding(6) var aerial_light: texture_storage_3d<rgba16float, write>;
@group(0) @binding(7) var aerial_through: texture_storage_3d<rgba16float, write>;

// Not read here.
fn sky_view_texel(x: u32, y: u32, layer: u32) -> vec3<f32> {
    return sky_view_unpacked(sky_view[y * SKY_VIEW_AZIMUTHS + x], layer);
}

fn sun_cosine_here() -> f32 {
    return clamp(air.sun.y, -1.0, 1.0);
}

@compute @workgroup_size(8, 8, 1)
fn sky_table(@builtin(global_invocation_id) id: vec3<u32>) {
    let light = sky_view_compute(air.medium, air.h, sun_cosine_here(), id.xy, VIEW_STEPS);
    sky_view[id.y * SKY_VIEW_AZIMUTHS + id.x] = sky_view_packed(light.soft, light.mie);
}

@compute @workgroup_size(8, 4, 1)
fn aerial_table(@builtin(global_invocation_id) id: vec3<u32>) {
    let below = id.y >= AERIAL_ABOVE;
    let rows = select(AERIAL_ABOVE, AERIAL_BELOW, below);
    let uv = coordinate(vec2<u32>(id.x, id.y - select(0u, AERIAL_ABOVE, below)), vec2<u32>(AERIAL_AZIMUTHS, rows));
    let start = sky_view_ray(air.medium, air.h, sun_cosine_here(), below, uv);
    let phase = mie_phase(air.medium.mie_asymmetry, start.nu);
    let end = distance_to_end(air.medium.radius, air.medium.height, start.h, start.mu);
    var light = vec3<f32>(0.0);
    var through = vec3<f32>(1.0);
    var reached = 0.0;
    for (var slice = 0u; slice < AERIAL_SLICES; slice++) {
        // Terrain lies above and below the sphere that the table ends at: what is past it takes the last light.
        let distance = min(aerial_distance(slice, air.far), end);
        if (distance > reached) {
            let part = gather(air.medium, ray_advanced(start, air.medium.radius, reached), distance - reached, 1u, true);
            light += through * (part.soft + part.mie * phase);
            through *= part.transmittance;
            reached = distance;
        }
        // In luminance, which a half float holds from starlight to the sun's aureole.
        let at = vec3<u32>(id.xy, slice);
        textureStore(aerial_light, at, vec4<f32>(min(air_rgb(air, light), vec3<f32>(6e4)), 1.0));
        textureStore(aerial_through, at, vec4<f32>(through, 1.0));
    }
}
