// What light water gets from the simplest air. Needs view.wgsl, horizon_light's gradient.wgsl, and gradient_air.wgsl.

@group(0) @binding(13) var<uniform> gradient: GradientAir;

fn sky_from(direction: vec3<f32>) -> vec3<f32> {
    return gradient_luminance(gradient.sky, direction.y, view.sun_towards.y, dot(direction, view.sun_towards));
}

fn skylight_on_level() -> vec3<f32> {
    return view.ambient;
}

struct Veil {
    through: vec3<f32>,
    light: vec3<f32>,
}

fn veil_along(direction: vec3<f32>, distance: f32) -> Veil {
    let through = exp(-gradient.haze * distance);
    return Veil(vec3<f32>(through), (1.0 - through) * sky_from(direction));
}
