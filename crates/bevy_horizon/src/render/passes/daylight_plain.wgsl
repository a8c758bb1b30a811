// A scene without air that makes light: Bevy's is left as it is.

fn daylight_is_own() -> bool {
    return false;
}

fn sunlight_at(p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn skylight_on(normal: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}
