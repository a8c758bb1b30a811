// Needs view.wgsl.

// By how much of the viewport a point, from the eye, has moved since the last frame; y down.
fn motion_of(offset: vec3<f32>) -> vec2<f32> {
    let now = view.clip_from_offset * vec4<f32>(offset, 1.0);
    let before = view.previous_clip_from_offset * vec4<f32>(offset, 1.0);
    return (now.xy / now.w - before.xy / before.w) * vec2<f32>(0.5, -0.5);
}
