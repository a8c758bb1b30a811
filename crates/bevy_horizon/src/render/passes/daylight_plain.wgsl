// What lights a scene where there is no air that does: its own lights, as Bevy has them.

fn daylight_is_own() -> bool {
    return false;
}

fn sunlight_at(p: vec3<f32>) -> vec3<f32> {
    return view.sun;
}

fn skylight_on(normal: vec3<f32>) -> vec3<f32> {
    return view.ambient;
}
