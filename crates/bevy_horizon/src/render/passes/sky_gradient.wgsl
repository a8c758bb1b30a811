// The simplest air: a gradient where nothing was drawn, and exponential haze over everything that was, ground and meshes alike, by
// the depth that they left. Needs sky_common.wgsl, gradient_air.wgsl and horizon_light's
// gradient.wgsl.

@group(0) @binding(1) var<uniform> gradient: GradientAir;

fn gradient_light(direction: vec3<f32>) -> vec3<f32> {
    return gradient_luminance(gradient.sky, direction.y, view.sun_towards.y, dot(direction, view.sun_towards));
}

// Optical depth from the eye over t metres: ∫ β e^(−y/H), with its limit for level rays.
fn haze_depth(direction: vec3<f32>, y: f32, t: f32) -> f32 {
    let fall = direction.y * t / gradient.haze_height;
    let at_eye = exp(clamp(-y / gradient.haze_height, -60.0, 8.0));
    let mean = select((1.0 - exp(-clamp(fall, -40.0, 40.0))) / fall, 1.0 - 0.5 * fall, abs(fall) < 1e-3);
    return gradient.haze * at_eye * mean * t;
}

@fragment
fn air_sky(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let ray = sky_ray(position);
    var light = gradient_light(ray.direction);
    // The disc's edge is as soft as a pixel.
    let softness = max(view.pixel * 0.01, 2e-6);
    let disc = smoothstep(gradient.sun_cosine - softness, gradient.sun_cosine + softness, dot(ray.direction, view.sun_direction));
    light += select(0.0, 1.0, any(view.sun > vec3<f32>(0.0))) * normalize(view.sun + 1e-6) * gradient.sun_luminance * disc;
    return present(vec4<f32>(light * view.exposure, 1.0));
}

@fragment
fn air_haze(@builtin(position) position: vec4<f32>, @builtin(sample_index) sample_index: u32) -> @location(0) vec4<f32> {
    let ray = haze_ray(position, sample_index);
    let opacity = 1.0 - exp(-haze_depth(ray.direction, ray.start.y, ray.distance));
    let light = gradient_light(ray.direction);
    return vec4<f32>(present(vec4<f32>(light * view.exposure, 1.0)).rgb * opacity, opacity);
}
