// Water, over what lies behind it: mirrored sky and ground, refracted bed, light that is scattered within, foam; from above and from
// within. It is found for itself, wherever ground is. Needs view.wgsl, water_bodies.wgsl, waves or none, a sky, horizon_light's
// water.wgsl, water_sun.wgsl, water_mirror.wgsl, and declarations of depth_at() and water_present().

@group(0) @binding(5) var<uniform> view: HorizonView;
// What was drawn before, lit, without the air.
@group(0) @binding(24) var drawn: texture_2d<f32>;

// A pixel's ray, relative to the eye and in the view's own axes.
struct WaterPixel {
    ray: WaterRay,
    local_start: vec3<f32>,
    local: vec3<f32>,
    t_near: f32,
}

// Pixels over which slopes are smoothed.
const SMOOTHER: f32 = 2.0;
// Further than anything is.
const UNSEEN: f32 = 1e9;

fn water_pixel(position: vec4<f32>) -> WaterPixel {
    let near = view_point(ndc_of(position), 1.0);
    if (view.orthographic != 0u) {
        let ahead = vec3<f32>(0.0, 0.0, -1.0);
        return WaterPixel(WaterRay(world_direction(near), -view.back), near, ahead, 0.0);
    }
    let local = normalize(near);
    return WaterPixel(WaterRay(vec3<f32>(0.0), world_direction(local)), vec3<f32>(0.0), local, length(near));
}

fn water_depth_of(pixel: WaterPixel, t: f32) -> f32 {
    let clip = view.clip_from_view * vec4<f32>(0.0, 0.0, (pixel.local_start + pixel.local * t).z, 1.0);
    return clip.z / clip.w;
}

// A point, relative to the eye, that was drawn at a pixel with this depth.
fn drawn_at(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    return world_direction(view_point(ndc_of(vec4<f32>(pixel, 0.0, 0.0)), depth));
}

// The pixel that shows a point relative to the eye; negative where none does.
fn pixel_of(p: vec3<f32>) -> vec2<f32> {
    let clip = view.clip_from_view * vec4<f32>(dot(view.right, p), dot(view.up, p), dot(view.back, p), 1.0);
    let ndc = clip.xy / clip.w;
    if (clip.w <= 0.0 || any(abs(ndc) >= vec2<f32>(1.0))) {
        return vec2<f32>(-1.0);
    }
    return view.viewport.xy + vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * view.viewport.zw;
}

fn drawn_colour(pixel: vec2<f32>) -> vec3<f32> {
    return textureLoad(drawn, vec2<i32>(pixel), 0).rgb;
}

// In cd/m².
fn drawn_light(pixel: vec2<f32>) -> vec3<f32> {
    return drawn_colour(pixel) / max(view.exposure, 1e-30);
}

// What is behind water.
struct Behind {
    // As it was drawn, exposed; and how much of it comes to the eye.
    colour: vec3<f32>,
    share: vec3<f32>,
    // Light of the water's own, in cd/m².
    light: vec3<f32>,
}

// How wide what is seen of level ground in a pixel is along the view.
fn seen_width(o: vec3<f32>) -> f32 {
    let far = length(o);
    return footprint_at(far) * clamp(far / max(abs(o.y), 1e-3), 1.0, 20.0);
}

// The light in the water under a surface that gets so much of the sun.
fn light_in(body: u32, sun_seen: f32) -> WaterLight {
    return water_lit(waters.bodies[body].optics, view.sun_direction, view.sun * sun_seen, WATER_PI * skylight_on_level());
}

// How bright the bed is under so much water, as a part of how bright it would be in air. What shades the bed is in its colour.
fn bed_light(body: u32, o: vec3<f32>, under: f32, light: WaterLight) -> vec3<f32> {
    let optics = waters.bodies[body].optics;
    // A night's lamps need a ratio too.
    let sky = WATER_PI * skylight_on_level() + vec3<f32>(1e-6);
    var lit = water_lit(optics, view.sun_direction, view.sun, sky);
    if (under < 40.0) {
        // Sunlight crossed the surface there. The deeper the bed, the wider the waves that gather light on it.
        let crossed = o.xz + lit.sun.xz / lit.sun.y * under;
        let bend = wave_bend(body, crossed, 0.08 + 0.03 * under + seen_width(o));
        let focus = water_focus(bend.xzy, under / lit.sun.y, optics.index, 3.0);
        // None where the surface is in shadow.
        let sunny = clamp(light.sun_irradiance.y / max(lit.sun_irradiance.y, 1e-6), 0.0, 1.0);
        lit.sun_irradiance *= mix(1.0, focus, sunny);
    }
    let open = view.sun * max(view.sun_direction.y, 0.0) + sky;
    return clamp(water_irradiance(optics, lit, under) / open, vec3<f32>(0.0), vec3<f32>(4.0));
}

// Along a path in the water, from `start` on to what was drawn at `to`, or without end: radiance where it starts.
fn through_water(body: u32, start: vec3<f32>, to: vec3<f32>, endless: bool, direction: vec3<f32>, colour: vec3<f32>, light: WaterLight) -> Behind {
    let optics = waters.bodies[body].optics;
    let above = waters.bodies[body].above;
    let depth = max(-(above + start.y), 0.0);
    var behind = Behind(vec3<f32>(0.0), vec3<f32>(0.0), vec3<f32>(0.0));
    if (endless) {
        behind.light = water_in_scatter(optics, light, depth, direction, UNSEEN);
        return behind;
    }
    let reach = distance(start, to);
    let way = select(direction, (to - start) / reach, reach > 1e-4);
    let under = max(-(above + to.y), 0.0);
    let blurred = water_blurred(optics, reach);
    behind.colour = colour;
    behind.share = (water_transmittance(optics, reach) + blurred) * bed_light(body, to, under, light);
    behind.light = water_in_scatter(optics, light, depth, way, reach);
    behind.light = max(behind.light - blurred * water_upwelling(optics, light, under), vec3<f32>(0.0));
    return behind;
}

// The sun's disc as a rough surface blurs it, seen from within: luminance per illuminance.
fn sun_through_surface(out: vec3<f32>, variance: f32) -> f32 {
    let wide = 0.15 * variance + 0.5 * waters.sun_radius * waters.sun_radius;
    let off = out - view.sun_direction;
    return exp(-0.5 * dot(off, off) / wide) / (2.0 * WATER_PI * wide);
}

struct Painted {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// Light of its own, in cd/m², over what was drawn, exposed. A half float ends at 65 504.
fn painted(own: vec3<f32>, colour: vec3<f32>, share: vec3<f32>, depth: f32) -> Painted {
    let shown = water_present(vec4<f32>(min(own * view.exposure, vec3<f32>(6e4)), 1.0)).rgb;
    return Painted(vec4<f32>(min(shown + colour * share, vec3<f32>(6e4)), 1.0), depth);
}

// The farthest and the nearest depth of a pixel's samples. Where the farthest is not 0, nothing that was cleared is in its colour.
fn drawn_depths(at: vec2<i32>) -> vec2<f32> {
    var depths = vec2<f32>(depth_at(at, 0));
    for (var i = 1; i < depth_samples(); i++) {
        let depth = depth_at(at, i);
        depths = vec2<f32>(min(depths.x, depth), max(depths.y, depth));
    }
    return depths;
}

// Foam where waves break and where they run up the shore, in clumps.
fn foam_at(body: u32, o: vec3<f32>, breaking: f32, shoal: f32, footprint: f32) -> f32 {
    let wanted = waters.bodies[body].foam;
    if (wanted <= 0.0) {
        return 0.0;
    }
    // 1 at the water's edge.
    let run = 0.4 + 0.8 * waters.bodies[body].bound;
    let shore = 1.0 - smoothstep(0.0, run, shoal);
    let amount = wanted * max(breaking, shore * shore);
    let clumps = foam_clumps(body, o.xz, footprint);
    return clamp(1.6 * amount - 0.6 * clumps, 0.0, 1.0) * min(amount, 1.0);
}

fn seen_from_air(pixel: WaterPixel, position: vec4<f32>, met: Met, depth: f32, t_scene: f32) -> Painted {
    let body = met.body;
    let optics = waters.bodies[body].optics;
    let t = met.t;
    let o = water_point(pixel.ray, t);
    let d = pixel.ray.direction;
    let footprint = footprint_at(t);
    // The footprint on the level: as wide as a pixel, and longer the flatter one looks.
    let ahead = normalize(d.xz + vec2<f32>(1e-9, 0.0));
    let long = footprint / max(abs(d.y), 2e-4);
    // Light that is mirrored is no linear function of the slopes: it needs them smoother than a picture of them would.
    let shape = wave_shape(body, o.xz, ahead * min(SMOOTHER * long, 1e5), vec2<f32>(-ahead.y, ahead.x) * (SMOOTHER * footprint));
    let variance = shape.variance + vec2<f32>(0.5 * waters.bodies[body].ripples);
    var normal = normalize(vec3<f32>(-shape.slope.x, 1.0, -shape.slope.y));
    let v = -d;
    let facing = dot(normal, v);
    // A pixel on a crest sees slopes that face it; one that is all but parallel to the view would mirror the horizon alone.
    let least = clamp(0.9 * v.y, 0.005, 0.08);
    if (facing < least) {
        normal = normalize(normal + (least - facing) * v);
    }
    let cosine = max(dot(normal, v), 0.005);
    let mean = 0.5 * (variance.x + variance.y);
    let fresnel = water_reflectance(cosine, dot(variance, ahead * ahead), optics.index);
    // Of a rough surface one sees the slopes that face the eye, and these mirror what is higher.
    var mirrored = reflect(d, normal);
    mirrored.y = abs(mirrored.y) + 0.4 * sqrt(mean) * (1.0 - cosine) * (1.0 - cosine);
    mirrored = normalize(mirrored);

    let sun_seen = sun_over_water(o, position);
    let light = light_in(body, sun_seen);
    let ground = shoal_at(body, o, footprint);
    let edge = smoothstep(0.0, 0.06 + footprint, min(ground, t_scene - t));
    let reflected = mirrored_light(body, o, mirrored, position);
    let glitter = water_glitter(v, view.sun_direction, normal, variance, waters.sun_radius, optics.index) * view.sun * sun_seen;

    // What is refracted, looked for on the screen: where that is not under water, straight behind.
    let into = water_refract(d, normal, optics.index).direction;
    var behind_at = position.xy;
    var behind_depth = depth;
    if (depth > 0.0 || view.orthographic != 0u) {
        let bent = pixel_of(o + into * min(t_scene - t, 12.0));
        if (bent.x >= 0.0) {
            let bent_depth = drawn_depths(vec2<i32>(bent)).x;
            if (bent_depth > 0.0 && waters.bodies[body].above + drawn_at(bent, bent_depth).y < 0.0) {
                behind_at = bent;
                behind_depth = bent_depth;
            }
        }
    }
    let behind_point = drawn_at(behind_at, max(behind_depth, 1e-12));
    let behind = through_water(body, o, behind_point, behind_depth <= 0.0, into, drawn_colour(behind_at), light);

    // A ray's cone widens where it leaves the water.
    let leaves = (1.0 - fresnel) / (optics.index * optics.index);
    var own = leaves * behind.light + fresnel * reflected + glitter;
    var share = leaves * behind.share;
    let foam = foam_at(body, o, shape.foam, ground, footprint) * edge;
    let lit = view.sun * max(dot(normal, view.sun_direction), 0.0) * sun_seen + WATER_PI * skylight_on_level();
    own = water_foam(own, lit, optics.foam, foam);
    share *= 1.0 - foam;
    // The last film of water has no edge.
    return painted(own * edge, drawn_colour(behind_at), mix(vec3<f32>(1.0), share, edge), water_depth_of(pixel, t));
}

// `nearest`: of the pixel's samples. All of them are under water, and take the one colour.
fn seen_from_within(pixel: WaterPixel, position: vec4<f32>, body: u32, met: Met, depth: f32, nearest: f32) -> Painted {
    let optics = waters.bodies[body].optics;
    let start = water_point(pixel.ray, pixel.t_near);
    let d = pixel.ray.direction;
    let light = light_in(body, sun_over_water(start, position));
    if (met.t < 0.0) {
        // Down to the bed, or into the deep.
        let endless = depth <= 0.0;
        let to = drawn_at(position.xy, max(depth, 1e-12));
        let behind = through_water(body, start, to, endless, d, drawn_colour(position.xy), light);
        return painted(behind.light, behind.colour, behind.share, max(nearest, water_depth_of(pixel, 200.0)));
    }
    let o = water_point(pixel.ray, met.t);
    let footprint = footprint_at(met.t);
    let ahead = normalize(d.xz + vec2<f32>(1e-9, 0.0));
    let shape = wave_shape(body, o.xz, ahead * footprint / max(abs(d.y), 1e-2), vec2<f32>(-ahead.y, ahead.x) * footprint);
    // Towards the eye, down.
    var normal = normalize(vec3<f32>(shape.slope.x, -1.0, shape.slope.y));
    let fresnel = water_fresnel(dot(normal, d), 1.0 / optics.index);
    let leaves = water_refract(d, normal, 1.0 / optics.index);
    let reach = met.t - pixel.t_near;
    let depth_here = max(-(waters.bodies[body].above + start.y), 0.0);
    // What the sky's light is scattered forward is in the light along the way.
    let through = water_transmittance(optics, reach);
    // What is mirrored from below: the water's own light.
    let back = reflect(d, normal);
    let deep = water_in_scatter(optics, light, 0.0, vec3<f32>(back.x, -abs(back.y), back.z), UNSEEN);
    var own = water_in_scatter(optics, light, depth_here, d, reach) + through * fresnel * deep;
    var share = vec3<f32>(0.0);
    var colour = vec3<f32>(0.0);
    if (!leaves.total) {
        let enters = through * water_crossing(leaves.direction.y, optics.index);
        let out = normalize(vec3<f32>(leaves.direction.x, max(leaves.direction.y, 1e-3), leaves.direction.z));
        let mean = 0.5 * (shape.variance.x + shape.variance.y + waters.bodies[body].ripples);
        let sun = sun_over_water(o, position) * view.sun * sun_through_surface(out, mean);
        // What stands over the water, where it is on the screen.
        let bent = pixel_of(o + out * 50.0);
        var on_screen = false;
        if (bent.x >= 0.0) {
            let bent_depth = drawn_depths(vec2<i32>(bent)).x;
            on_screen = bent_depth > 0.0 && waters.bodies[body].above + drawn_at(bent, bent_depth).y > 0.0;
        }
        if (on_screen) {
            colour = drawn_colour(bent);
            share = enters;
        } else {
            own += enters * (sky_from(out) + sun);
        }
    }
    // No farther than light goes in water: the air lays its haze over what is far.
    return painted(own, colour, share, max(nearest, water_depth_of(pixel, min(met.t, 200.0))));
}

@fragment
fn water(@builtin(position) position: vec4<f32>) -> Painted {
    let pixel = water_pixel(position);
    // The farthest: what stands before the water in some samples only keeps these by its own depth.
    let depths = drawn_depths(vec2<i32>(position.xy));
    let depth = depths.x;
    var t_scene = UNSEEN;
    if (depth > 0.0) {
        t_scene = distance(view_point(ndc_of(position), depth), pixel.local_start);
    }
    let body = water_around(water_point(pixel.ray, pixel.t_near), footprint_at(pixel.t_near));
    let met = meets_water(pixel.ray, pixel.t_near, t_scene, body);
    if (body < BODIES) {
        return seen_from_within(pixel, position, body, met, depth, depths.y);
    }
    if (met.t < 0.0) {
        discard;
    }
    return seen_from_air(pixel, position, met, depth, t_scene);
}
