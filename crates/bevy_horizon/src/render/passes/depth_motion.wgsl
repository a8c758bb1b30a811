// The geometry's depth and motion vectors, for views that need no more before the main pass. Needs seen_in() of whole.wgsl or
// upsample.wgsl, and motion.wgsl.

struct Ground {
    @location(1) motion: vec2<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn ground(@builtin(position) position: vec4<f32>) -> Ground {
    let pixel = pixel_ray(position);
    let seen = seen_in(pixel, position);
    if (seen.t < 0.0) {
        discard;
    }
    return Ground(motion_of(pixel.ray.origin + pixel.ray.direction * seen.t - view.eye), seen.depth);
}
