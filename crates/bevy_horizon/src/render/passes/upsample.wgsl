// The ground, found at a lower resolution, brought to the view's. Reverse-z depth is linear over a plane, so where the four
// found pixels around a pixel lie in one plane, depth is interpolated, if that comes to lie on the ground; where it does not
// (silhouettes, ridges, pillars), the pixel casts its own ray, and edges stay as sharp as ever. Needs geometry.wgsl.

@group(0) @binding(8) var drawn_depth: texture_depth_2d;

fn seen_in(pixel: PixelRay, position: vec4<f32>) -> Seen {
    let size = vec2<i32>(textureDimensions(drawn_depth));
    let at = (position.xy - view.viewport.xy) / view.viewport.zw * vec2<f32>(size) - 0.5;
    let low = vec2<i32>(floor(at));
    let f = at - floor(at);
    let w = vec4<f32>((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    var d: vec4<f32>;
    for (var k = 0; k < 4; k++) {
        d[k] = textureLoad(drawn_depth, clamp(low + vec2<i32>(k & 1, k >> 1u), vec2<i32>(0), size - vec2<i32>(1)), 0);
    }
    let least = min(min(d.x, d.y), min(d.z, d.w));
    let most = max(max(d.x, d.y), max(d.z, d.w));
    if (most <= 0.0 && view.orthographic == 0u) {
        return Seen(-1.0, 0.0);
    }
    // A pixel's depth off the plane is what the eye forgives; and over a fifth of the depth, no plane is trusted.
    let bent = abs(d.x + d.w - d.y - d.z);
    if (bent < 4.0 * view.pixel * most && least > 0.8 * most) {
        let depth = dot(w, d);
        let t = distance(view_point(ndc_of(position), depth), pixel.start);
        let p = pixel.ray.origin + pixel.ray.direction * t;
        let level = level_at(p.xz);
        if (level < clipmap.count && abs(p.y - ground_height(level, p.xz)) < 5e-3 + 5e-4 * t) {
            return Seen(t, depth);
        }
    }
    return seen_by_ray(pixel);
}
