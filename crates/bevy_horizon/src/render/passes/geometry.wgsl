// The ground's geometry: one ray a pixel through the cache. Needs pixel_ray.wgsl, surface.wgsl, look.wgsl, march.wgsl and
// clear_start.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(0) @binding(2) var<storage, read> bounds: array<u32>;
@group(0) @binding(5) var<uniform> view: HorizonView;
@group(0) @binding(6) var<storage, read> clearance: array<f32>;

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
