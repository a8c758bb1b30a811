// Every pixel casts its own ray. Needs geometry.wgsl.

fn seen_in(pixel: PixelRay, position: vec4<f32>) -> Seen {
    return seen_by_ray(pixel);
}
