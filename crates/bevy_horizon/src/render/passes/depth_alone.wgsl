// The geometry's depth, for views that need no more of it before the main pass. Needs seen_in() of whole.wgsl or upsample.wgsl.

@fragment
fn ground(@builtin(position) position: vec4<f32>) -> @builtin(frag_depth) f32 {
    let seen = seen_in(pixel_ray(position), position);
    if (seen.t < 0.0) {
        discard;
    }
    return seen.depth;
}
