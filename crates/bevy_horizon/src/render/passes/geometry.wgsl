// The ground's geometry: one ray a pixel through the cache. Needs view.wgsl, surface.wgsl, look.wgsl, march.wgsl and
// clear_start.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;
@group(0) @binding(5) var<uniform> view: HorizonView;
@group(0) @binding(6) var<storage, read> clearance: array<f32>;

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

fn cast_ray(pixel: PixelRay) -> Found {
    return march(pixel.ray, max(pixel.t_near, clear_until(pixel.ray.direction)), view.far);
}

// The ground in a pixel.
struct Seen {
    // Distance along the ray; negative where there is none.
    t: f32,
    depth: f32,
}

fn seen_by_ray(pixel: PixelRay) -> Seen {
    let t = cast_ray(pixel).t;
    return Seen(t, depth_of(pixel, max(t, pixel.t_near)));
}
