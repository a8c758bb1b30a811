// Water without air over it mirrors the ambient light. Needs view.wgsl.

fn sky_from(direction: vec3<f32>) -> vec3<f32> {
    return view.ambient;
}

fn skylight_on_level() -> vec3<f32> {
    return view.ambient;
}

struct Veil {
    through: vec3<f32>,
    light: vec3<f32>,
}

fn veil_along(direction: vec3<f32>, distance: f32) -> Veil {
    return Veil(vec3<f32>(1.0), vec3<f32>(0.0));
}
