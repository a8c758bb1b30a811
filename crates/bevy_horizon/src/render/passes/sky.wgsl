// The stand-in sky: a gradient where nothing was drawn, and exponential haze over everything that was, ground and
// meshes alike, by the depth that they left. Needs view.wgsl, and a declaration of depth_at().

struct Sky {
    zenith: vec4<f32>,
    horizon: vec4<f32>,
    // Light around the sun, in cd/m².
    glow: vec4<f32>,
    // Extinction at the datum, per metre; and per channel its colour.
    haze: f32,
    // Metres over which the haze thins by e.
    haze_height: f32,
    // Cosine of the sun's angular radius; luminance of its disc, in cd/m².
    sun_cosine: f32,
    sun_luminance: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> sky: Sky;

// 1 where there is a sun in the sky, 0 where there is none.
fn has_sun() -> f32 {
    return select(0.0, 1.0, any(view.sun > vec3<f32>(0.0)));
}

// The haze's own light: the horizon's, warmer around the sun.
fn haze_light(direction: vec3<f32>) -> vec3<f32> {
    let c = max(dot(direction, view.sun_direction), 0.0);
    return sky.horizon.rgb + has_sun() * sky.glow.rgb * (0.6 * pow(c, 8.0) + 0.15 * c * c);
}

fn sky_light(direction: vec3<f32>) -> vec3<f32> {
    let up = max(direction.y, 0.0);
    let c = dot(direction, view.sun_direction);
    var light = mix(haze_light(direction), sky.zenith.rgb + has_sun() * sky.glow.rgb * 0.25 * pow(max(c, 0.0), 32.0), 1.0 - pow(1.0 - up, 5.0));
    // The disc's edge is as soft as a pixel.
    let softness = max(view.pixel * 0.01, 2e-6);
    light += has_sun() * normalize(view.sun + 1e-6) * sky.sun_luminance * smoothstep(sky.sun_cosine - softness, sky.sun_cosine + softness, c);
    return light;
}

// Optical depth from the eye over t metres: ∫ β e^(−y/H), with its limit for level rays.
fn haze_depth(direction: vec3<f32>, y: f32, t: f32) -> f32 {
    let fall = direction.y * t / sky.haze_height;
    let at_eye = exp(clamp(-y / sky.haze_height, -60.0, 8.0));
    let mean = select((1.0 - exp(-clamp(fall, -40.0, 40.0))) / fall, 1.0 - 0.5 * fall, abs(fall) < 1e-3);
    return sky.haze * at_eye * mean * t;
}

@fragment
fn air(@builtin(position) position: vec4<f32>, @builtin(sample_index) sample_index: u32) -> @location(0) vec4<f32> {
    let ndc = ndc_of(position);
    let depth = depth_at(vec2<i32>(position.xy), i32(sample_index));
    let local = view_point(ndc, select(depth, 1.0, depth <= 0.0));
    var start = vec3<f32>(0.0);
    var ahead = normalize(local);
    if (view.orthographic != 0u) {
        ahead = vec3<f32>(0.0, 0.0, -1.0);
        start = view_point(ndc, 1.0);
    }
    let direction = world_direction(ahead);
    if (depth <= 0.0) {
        return present(vec4<f32>(sky_light(direction) * view.exposure, 1.0));
    }
    let eye = view.eye + world_direction(start);
    let opacity = 1.0 - exp(-haze_depth(direction, eye.y, distance(local, start)));
    let colour = present(vec4<f32>(haze_light(direction) * view.exposure, 1.0));
    return vec4<f32>(colour.rgb * opacity, opacity);
}
