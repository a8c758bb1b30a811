// Water among ground. Needs view.wgsl, surface.wgsl, look.wgsl, sunlit.wgsl, march.wgsl, and a sky.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(4) var<storage, read> bounds: array<u32>;

fn sun_over_ground_at(o: vec3<f32>) -> f32 {
    if (view.self_shadow == 2u) {
        return 0.0;
    }
    let p = view.eye + o;
    let level = level_at(p.xz);
    if (view.self_shadow != 1u || level >= clipmap.count) {
        return 1.0;
    }
    return sun_seen_from(level, p.xz, max(p.y - ground_height(level, p.xz), 0.0));
}

// How much water there is over the ground.
fn shoal_at(body: u32, o: vec3<f32>, footprint: f32) -> f32 {
    let p = view.eye + o;
    let level = level_at(p.xz);
    if (level >= clipmap.count) {
        return 1e6;
    }
    return max(p.y - ground_height(level, p.xz), 0.0);
}

struct Mirrored {
    // How far; negative where nothing is.
    t: f32,
    light: vec3<f32>,
}

fn mirrored_ground(o: vec3<f32>, direction: vec3<f32>) -> Mirrored {
    let start = view.eye + o + vec3<f32>(0.0, 1e-3 + 1e-5 * length(o), 0.0);
    let found = march(Ray(start, direction), 0.0, view.far);
    if (found.t < 0.0) {
        return Mirrored(-1.0, vec3<f32>(0.0));
    }
    let p = start + direction * found.t;
    let look = look_at(found.level, p.xz);
    var sun = 1.0;
    if (view.self_shadow == 1u) {
        sun = sun_seen_from(found.level, p.xz, 0.0);
    }
    let direct = view.sun * sun * max(dot(look.normal, view.sun_direction), 0.0) / 3.14159265;
    let light = look.albedo * (direct + skylight_on_level() * (0.5 + 0.5 * look.normal.y));
    return Mirrored(found.t, light);
}
