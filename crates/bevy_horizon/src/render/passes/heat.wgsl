// What a debug view shows in place of the picture, in the order of `DebugView`. It casts every pixel's ray once more, and counts.
// Needs geometry.wgsl, sunlit.wgsl and motion.wgsl.

@group(0) @binding(9) var<storage, read> truths: array<f32>;

fn truth_at(i: u32) -> f32 {
    if (i >= arrayLength(&truths)) {
        return 0.0;
    }
    return truths[i];
}

fn heat(x: f32) -> vec3<f32> {
    let c = clamp(x, 0.0, 1.0);
    return clamp(vec3<f32>(1.5) - abs(4.0 * c - vec3<f32>(3.0, 2.0, 1.0)), vec3<f32>(0.0), vec3<f32>(1.0));
}

fn heat_colour(found: Found, p: vec3<f32>) -> vec3<f32> {
    let look = look_at(found.level, p.xz);
    switch view.debug {
        case 1u: { return look.normal * 0.5 + 0.5; }
        case 3u: { return heat(f32(found.level) / 12.0) * (0.4 + 0.6 * max(look.normal.y, 0.0)); }
        case 4u: { return vec3<f32>(sun_seen_from(found.level, p.xz, 0.0)); }
        case 5u: { return look.albedo; }
        case 6u: { return heat(log2(1.0 + found.t) / 16.0); }
        case 10u: { return vec3<f32>(look.roughness); }
        // Grey stands still; red moves to the right, green down, and so many pixels are full.
        default: { return vec3<f32>(0.5 + motion_of(p - view.eye) * view.viewport.zw / 64.0, 0.5); }
    }
}

// Whether the view is of what a ray costs, or how far it is off: these concern rays that meet nothing, too.
fn shows_work() -> bool {
    return view.debug == 2u || (view.debug >= 7u && view.debug <= 9u);
}

fn work_colour(found: Found, position: vec4<f32>) -> vec3<f32> {
    switch view.debug {
        case 2u: { return heat(f32(found.steps) / 64.0); }
        case 7u: { return heat(f32(found.loads) / 96.0); }
        case 8u: { return error_colour(found, position); }
        // Numbers, for programs to read: turns and loads.
        default: { return vec3<f32>(f32(found.steps), f32(found.loads), 1.0); }
    }
}

// How far the drawn depth is from the truth, in pixels: blue is exact, red is 1 and more. Grey where the truth is not yet
// known, magenta where one of the two meets the ground and the other does not.
fn error_colour(found: Found, position: vec4<f32>) -> vec3<f32> {
    let size = vec2<u32>(view.viewport.zw);
    let at = vec2<u32>(position.xy - view.viewport.xy);
    // 0 where it is not known, infinite where the truth meets nothing.
    let truth = truth_at(at.y * size.x + at.x);
    if (truth == 0.0) {
        return vec3<f32>(0.2);
    }
    let hit = truth < 1e30;
    if (hit != (found.t >= 0.0)) {
        return vec3<f32>(1.0, 0.0, 1.0);
    }
    return select(vec3<f32>(0.0), heat(abs(found.t - truth) / (view.pixel * truth)), hit);
}

struct Heat {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn shown(@builtin(position) position: vec4<f32>) -> Heat {
    let pixel = pixel_ray(position);
    let found = cast_ray(pixel);
    if (shows_work()) {
        return Heat(present(vec4<f32>(work_colour(found, position), 1.0)), depth_of(pixel, select(view.far, found.t, found.t >= 0.0)));
    }
    if (found.t < 0.0) {
        discard;
    }
    let p = pixel.ray.origin + pixel.ray.direction * found.t;
    return Heat(present(vec4<f32>(heat_colour(found, p), 1.0)), depth_of(pixel, found.t));
}
