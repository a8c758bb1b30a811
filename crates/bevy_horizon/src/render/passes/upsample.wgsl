// The ground, drawn at a lower resolution, brought to the view's. Reverse-z depth is linear over a plane, so where the four
// drawn pixels around a pixel lie in one plane, both depth and colour are interpolated; where they don't (silhouettes,
// ridges, pillars), the pixel casts its own ray, and edges stay as sharp as ever. Needs all that geometry.wgsl needs.

@group(0) @binding(7) var drawn_colour: texture_2d<f32>;
@group(0) @binding(8) var drawn_depth: texture_depth_2d;

@fragment
fn upsampled(@builtin(position) position: vec4<f32>) -> Ground {
    let size = vec2<i32>(textureDimensions(drawn_depth));
    let at = (position.xy - view.viewport.xy) / view.viewport.zw * vec2<f32>(size) - 0.5;
    let low = vec2<i32>(floor(at));
    let f = at - floor(at);
    let w = vec4<f32>((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    var d: vec4<f32>;
    var colour = vec4<f32>(0.0);
    for (var k = 0; k < 4; k++) {
        let tap = clamp(low + vec2<i32>(k & 1, k >> 1u), vec2<i32>(0), size - vec2<i32>(1));
        d[k] = textureLoad(drawn_depth, tap, 0);
        colour += w[k] * textureLoad(drawn_colour, tap, 0);
    }
    let least = min(min(d.x, d.y), min(d.z, d.w));
    let most = max(max(d.x, d.y), max(d.z, d.w));
    if (most <= 0.0 && view.orthographic == 0u) {
        discard;
    }
    // A pixel's depth off the plane is what the eye forgives; and over a fifth of the depth, no plane is trusted.
    let bent = abs(d.x + d.w - d.y - d.z);
    if (bent < 4.0 * view.pixel * most && least > 0.8 * most) {
        return Ground(colour, dot(w, d));
    }
    return ground_in(pixel_ray(position), position);
}
