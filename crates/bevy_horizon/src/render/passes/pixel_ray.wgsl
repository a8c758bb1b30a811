// A pixel's ray, and the depth of its points. Needs view.wgsl and ray.wgsl.

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
