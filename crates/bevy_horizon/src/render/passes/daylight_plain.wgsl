// What lights the ground where there is no air that does: the scene's own lights.

fn sunlight_at(p: vec3<f32>) -> vec3<f32> {
    return view.sun;
}

// Luminance of the light from all round that a surface gathers: the sky above, and ground of the same colour below.
fn skylight_on(normal: vec3<f32>) -> vec3<f32> {
    return view.ambient * mix(0.35, 1.0, 0.5 + 0.5 * normal.y);
}
