// Bodies of water around a view, and where a ray meets their surfaces: planes, with the waves' tiles on them. Independent of the ground.
// Points are relative to the eye. Needs view.wgsl, horizon_light's
// water.wgsl, and wave_height() and wave_shape() of water_waves.wgsl or water_still.wgsl.

struct WaveCascade {
    // Where in its tile the eye stands, and tiles per metre.
    @align(16) phase: vec2<f32>,
    per_metre: f32,
    // The highest that it gets, in metres; its layer of the tiles.
    bound: f32,
    layer: u32,
}

struct WaterBody {
    optics: Water,
    // Its middle, relative to the eye, and from there to its sides; a disc has its radius in x.
    centre: vec2<f32>,
    half: vec2<f32>,
    // 0 endless, 1 a disc, 2 a rectangle, 3 a rectangle with a mask, and the mask's layer.
    outline: u32,
    mask: u32,
    // The eye above its level, and the waves above that at most.
    above: f32,
    bound: f32,
    // A slope that hardly any wave exceeds.
    slope: f32,
    foam: f32,
    // Variance of the slopes of the finest ripples.
    ripples: f32,
    count: u32,
    cascades: array<WaveCascade, 3>,
}

const BODIES: u32 = 8u;

struct Waters {
    count: u32,
    // Angular, in radians.
    sun_radius: f32,
    bodies: array<WaterBody, BODIES>,
}

@group(0) @binding(20) var<uniform> waters: Waters;
@group(0) @binding(25) var water_masks: texture_2d_array<f32>;

const WATER_STEPS: u32 = 72u;
// Steps grow with the distance: what is missed that way is less than a pixel high.
const WATER_GROWTH: f32 = 0.02;

// A ray relative to the eye.
struct WaterRay {
    start: vec3<f32>,
    direction: vec3<f32>,
}

fn water_point(ray: WaterRay, t: f32) -> vec3<f32> {
    return ray.start + ray.direction * t;
}

// From where to where a ray is within the outline.
fn outline_interval(body: u32, ray: WaterRay) -> vec2<f32> {
    let outline = waters.bodies[body].outline;
    if (outline == 0u) {
        return vec2<f32>(-1e30, 1e30);
    }
    let away = ray.start.xz - waters.bodies[body].centre;
    let d = ray.direction.xz;
    let half = waters.bodies[body].half;
    if (outline == 1u) {
        let a = dot(d, d);
        let b = dot(away, d);
        let c = dot(away, away) - half.x * half.x;
        if (a < 1e-12) {
            return select(vec2<f32>(1.0, -1.0), vec2<f32>(-1e30, 1e30), c <= 0.0);
        }
        let root = b * b - a * c;
        if (root <= 0.0) {
            return vec2<f32>(1.0, -1.0);
        }
        let s = sqrt(root);
        return vec2<f32>(-b - s, -b + s) / a;
    }
    let steep = abs(d) < vec2<f32>(1e-9);
    let inverse = 1.0 / select(d, vec2<f32>(1e-9), steep);
    let p = (-half - away) * inverse;
    let q = (half - away) * inverse;
    let near = max(min(p.x, q.x), min(p.y, q.y));
    return vec2<f32>(near, min(max(p.x, q.x), max(p.y, q.y)));
}

// Whether a body's mask has water at a point within its rectangle: bilinear, as the CPU has it.
fn in_mask(body: u32, p: vec3<f32>) -> bool {
    let last = vec2<f32>(textureDimensions(water_masks)) - 1.0;
    let at = ((p.xz - waters.bodies[body].centre) / waters.bodies[body].half + 1.0) * 0.5 * last;
    let cell = clamp(floor(at), vec2<f32>(0.0), last - 1.0);
    let f = at - cell;
    let i = vec2<i32>(cell);
    let layer = waters.bodies[body].mask;
    let low = mix(textureLoad(water_masks, i, layer, 0).x, textureLoad(water_masks, i + vec2<i32>(1, 0), layer, 0).x, f.x);
    let high = mix(
        textureLoad(water_masks, i + vec2<i32>(0, 1), layer, 0).x, textureLoad(water_masks, i + vec2<i32>(1, 1), layer, 0).x, f.x);
    return mix(low, high, f.y) > 0.0;
}

fn in_outline(body: u32, p: vec3<f32>) -> bool {
    let away = abs(p.xz - waters.bodies[body].centre);
    let half = waters.bodies[body].half;
    switch waters.bodies[body].outline {
        case 0u: { return true; }
        case 1u: { return dot(away, away) <= half.x * half.x; }
        case 3u: { return all(away <= half) && in_mask(body, p); }
        default: { return all(away <= half); }
    }
}

// How high a point is over a body's surface, seen with footprints this wide.
fn over_water(body: u32, p: vec3<f32>, footprint: f32) -> f32 {
    return waters.bodies[body].above + p.y - wave_height(body, p.xz, footprint);
}

// How wide a pixel is at a distance, in metres.
fn footprint_at(t: f32) -> f32 {
    return view.pixel * select(max(t, 0.0), 1.0, view.orthographic != 0u);
}

// The body that a point is in; BODIES where there is none.
fn water_around(p: vec3<f32>, footprint: f32) -> u32 {
    for (var i = 0u; i < waters.count; i++) {
        if (waters.bodies[i].above + p.y < waters.bodies[i].bound && in_outline(i, p) && over_water(i, p, footprint) < 0.0) {
            return i;
        }
    }
    return BODIES;
}

// Where the ray goes through a body's surface between t_near and t_end; negative where it does not.
fn meets_body(body: u32, ray: WaterRay, t_near: f32, t_end: f32) -> f32 {
    let above = waters.bodies[body].above + ray.start.y;
    let fall = ray.direction.y;
    let highest = waters.bodies[body].bound;
    // Half floats and single precision round crests up: none may stand out of the slab.
    let bound = 1.002 * highest + select(0.0, 1e-6 * abs(above), highest > 0.0);
    let inside = outline_interval(body, ray);
    let last_t = min(t_end, inside.y);
    var t0 = max(t_near, inside.x);
    var t1 = last_t;
    if (t0 > t1) {
        return -1.0;
    }
    if (abs(fall) < 1e-9) {
        if (abs(above) > bound) {
            return -1.0;
        }
    } else {
        let a = (bound - above) / fall;
        let b = (-bound - above) / fall;
        t0 = max(t0, min(a, b));
        t1 = min(t1, max(a, b));
        if (t0 > t1) {
            return -1.0;
        }
        // Waves that move the surface by less than half a pixel have no shape of their own.
        let plane = -above / fall;
        if (highest < 0.5 * footprint_at(plane)) {
            return select(-1.0, plane, plane >= max(t_near, inside.x) && plane <= last_t);
        }
    }
    let level = length(ray.direction.xz) * waters.bodies[body].slope + abs(fall);
    var last = over_water(body, water_point(ray, t0), footprint_at(t0));
    let side = select(-1.0, 1.0, last > 0.0);
    var t = t0;
    for (var i = 0u; i < WATER_STEPS; i++) {
        let step = max(abs(last) / level, max(WATER_GROWTH * (t - t_near), 2e-3) + 4e-7 * t);
        let next = min(t + step, t1);
        let f = over_water(body, water_point(ray, next), footprint_at(next));
        if (f * side <= 0.0) {
            // Between the two; a few steps of the false position, kept within.
            var a = vec2<f32>(t, last);
            var b = vec2<f32>(next, f);
            for (var k = 0u; k < 4u; k++) {
                let share = clamp(a.y / (a.y - b.y), 0.05, 0.95);
                let m = mix(a.x, b.x, share);
                let g = over_water(body, water_point(ray, m), footprint_at(m));
                if (g * side > 0.0) {
                    a = vec2<f32>(m, g);
                } else {
                    b = vec2<f32>(m, g);
                }
            }
            return mix(a.x, b.x, clamp(abs(a.y) / max(abs(a.y - b.y), 1e-20), 0.0, 1.0));
        }
        if (next >= t1) {
            // What ended the ray there stands over a trough, or is the outline; below the slab it is under water, within rounding.
            if (t1 >= last_t) {
                return -1.0;
            }
            break;
        }
        t = next;
        last = f;
    }
    // Through the slab within rounding, or out of steps: the level itself, or where the ray is below that by now.
    let plane = max(-above / select(fall, 1e-9, abs(fall) < 1e-9), t);
    return select(-1.0, plane, side * fall < 0.0 && plane >= t_near && plane <= last_t);
}

struct Met {
    t: f32,
    body: u32,
}

// The nearest surface; that of one body alone, where `alone` is one.
fn meets_water(ray: WaterRay, t_near: f32, t_end: f32, alone: u32) -> Met {
    var met = Met(-1.0, BODIES);
    var end = t_end;
    for (var i = 0u; i < waters.count; i++) {
        if (alone < BODIES && i != alone) {
            continue;
        }
        let t = meets_body(i, ray, t_near, end);
        if (t >= 0.0 && (waters.bodies[i].outline != 3u || in_mask(i, water_point(ray, t)))) {
            met = Met(t, i);
            end = t;
        }
    }
    return met;
}
