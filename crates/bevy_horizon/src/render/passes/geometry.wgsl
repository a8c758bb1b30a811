// The ground's pass: one ray per pixel through the cache; colour and depth. Needs view.wgsl, surface.wgsl, march.wgsl,
// clear_start.wgsl and heat.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;
@group(0) @binding(3) var<storage, read> looks: array<u32>;
@group(0) @binding(4) var<storage, read> lights: array<u32>;
@group(0) @binding(5) var<uniform> view: HorizonView;
@group(0) @binding(6) var<storage, read> clearance: array<f32>;

struct Look {
    normal: vec3<f32>,
    albedo: vec3<f32>,
    gloss: f32,
    light: f32,
}

fn stored_normal(texel: u32) -> vec3<f32> {
    let word = looks[3u * (texel >> 1u) + 2u] >> (16u * (texel & 1u));
    let xz = (vec2<f32>(f32((word >> 8u) & 255u), f32(word & 255u)) - 127.5) / 127.0;
    return vec3<f32>(xz.x, sqrt(max(1.0 - dot(xz, xz), 1e-4)), xz.y);
}

// The albedo's square root, and gloss: the top five bits are the roughness.
fn stored_colour(texel: u32) -> vec4<f32> {
    let word = looks[3u * (texel >> 1u) + (texel & 1u)];
    return vec4<f32>(unpack4x8unorm(word).rgb, 1.0 - f32(word >> 27u) / 31.0);
}

fn light_at(l: Level, cell: vec2<i32>) -> f32 {
    let at = wrapped(l, cell);
    let texel = (at & vec2<u32>(TILE - 1u)) >> vec2<u32>(1u);
    let i = (texel.y << 5u) + texel.x;
    return f32((lights[tile_of(l, at) * TILE_LIGHTS + (i >> 2u)] >> (8u * (i & 3u))) & 255u) / 255.0;
}

// What one level holds at a point of the ground, interpolated.
fn level_look(l: Level, p: vec2<f32>) -> Look {
    let at = p * l.per_metre + l.fraction;
    let cell = vec2<i32>(floor(at));
    let f = at - floor(at);
    let w = vec4<f32>((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    let i = corner_indices(l, cell);
    let normal = w.x * stored_normal(i.x) + w.y * stored_normal(i.y) + w.z * stored_normal(i.z) + w.w * stored_normal(i.w);
    let colour = w.x * stored_colour(i.x) + w.y * stored_colour(i.y) + w.z * stored_colour(i.z) + w.w * stored_colour(i.w);
    // The light's lattice holds every other texel.
    let odd = (l.base + cell) & vec2<i32>(1);
    let even = cell - odd;
    let g = 0.5 * (vec2<f32>(odd) + f);
    let light = between_corners(vec4<f32>(
        light_at(l, even), light_at(l, even + vec2<i32>(2, 0)),
        light_at(l, even + vec2<i32>(0, 2)), light_at(l, even + vec2<i32>(2, 2))), g.x, g.y);
    return Look(normal, colour.rgb * colour.rgb, colour.a, light);
}

fn look_at(level: u32, p: vec2<f32>) -> Look {
    let l = clipmap.levels[level];
    var look = level_look(l, p);
    let w = blend_at(l, p * l.per_metre + l.fraction);
    if (w > 0.0) {
        let c = level_look(clipmap.levels[level + 1u], p);
        look = Look(mix(look.normal, c.normal, w), mix(look.albedo, c.albedo, w), mix(look.gloss, c.gloss, w), mix(look.light, c.light, w));
    }
    look.normal = normalize(look.normal);
    return look;
}

// Lambert for the body; for the surface Blinn–Phong, normalised, under Schlick's Fresnel term.
fn shade(look: Look, direction: vec3<f32>, p: vec3<f32>) -> vec3<f32> {
    let n_l = max(dot(look.normal, view.sun_direction), 0.0);
    // A ray that looks along the sun's has no half way.
    let half_way = normalize(view.sun_direction - direction + vec3<f32>(0.0, 1e-6, 0.0));
    let power = exp2(2.0 + 6.0 * look.gloss);
    let schlick = pow(1.0 - max(dot(half_way, view.sun_direction), 0.0), 5.0);
    let fresnel = 0.04 + 0.96 * schlick;
    let surface = look.gloss * fresnel * (power + 8.0) / 25.132741 * pow(max(dot(look.normal, half_way), 0.0), power);
    var colour = skylight_on(look.normal) * look.albedo;
    if (n_l * look.light > 0.0) {
        colour += sunlight_at(p) * n_l * look.light * (look.albedo / 3.14159265 + surface);
    }
    return colour;
}

struct Ground {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// A pixel's ray; where orthographic, its origin is on the near plane.
struct PixelRay {
    ray: Ray,
    // The direction and the origin in the view's own axes.
    local: vec3<f32>,
    start: vec3<f32>,
    t_near: f32,
}

fn pixel_ray(position: vec4<f32>) -> PixelRay {
    let near = view_point(ndc_of(position), 1.0);
    var local = normalize(near);
    var start = vec3<f32>(0.0);
    var t_near = length(near);
    if (view.orthographic != 0u) {
        local = vec3<f32>(0.0, 0.0, -1.0);
        start = near;
        t_near = 0.0;
    }
    return PixelRay(Ray(view.eye + world_direction(start), world_direction(local)), local, start, t_near);
}

fn depth_of(pixel: PixelRay, t: f32) -> f32 {
    let clip = view.clip_from_view * vec4<f32>(0.0, 0.0, (pixel.start + pixel.local * t).z, 1.0);
    return clip.z / clip.w;
}

// The ground in a pixel.
fn ground_in(pixel: PixelRay, position: vec4<f32>) -> Ground {
    let direction = pixel.ray.direction;
    let found = march(pixel.ray, max(pixel.t_near, clear_until(direction)), view.far);
    if (HEAT && shows_work()) {
        return Ground(present(vec4<f32>(work_colour(found, position), 1.0)), depth_of(pixel, select(view.far, found.t, found.t >= 0.0)));
    }
    if (found.t < 0.0) {
        discard;
    }
    let p = pixel.ray.origin + direction * found.t;
    let look = look_at(found.level, p.xz);
    var colour = shade(look, direction, p) * view.exposure;
    if (HEAT) {
        colour = heat_colour(colour, found, look);
    }
    return Ground(present(vec4<f32>(colour, 1.0)), depth_of(pixel, found.t));
}

@fragment
fn ground(@builtin(position) position: vec4<f32>) -> Ground {
    return ground_in(pixel_ray(position), position);
}
