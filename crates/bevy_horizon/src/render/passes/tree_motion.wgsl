// Motion vectors of plants: where they were drawn, they lie over those of what is behind. Wind has no part in them. Needs view.wgsl and
// motion.wgsl.

@group(0) @binding(2) var depth_before: texture_depth_2d;
@group(0) @binding(3) var depth_now: texture_depth_2d;
@group(0) @binding(5) var<uniform> view: HorizonView;

@fragment
fn plants_motion(@builtin(position) position: vec4<f32>) -> @location(0) vec2<f32> {
    let at = vec2<i32>(position.xy);
    let depth = textureLoad(depth_now, at, 0);
    if (depth <= textureLoad(depth_before, at, 0)) {
        discard;
    }
    return motion_of(world_direction(view_point(ndc_of(position), depth)));
}
