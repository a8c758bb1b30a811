// A fragment of the air's passes: its ray, and how far what was drawn there is. The depth test sorts fragments: those of the sky, where
// nothing was drawn, and those of the haze. Needs view.wgsl, and a declaration of depth_at().

@group(0) @binding(0) var<uniform> view: HorizonView;

struct AirRay {
    // Where the ray starts, in the passes' coordinates, and where it goes.
    start: vec3<f32>,
    direction: vec3<f32>,
    // How far what was drawn there is, in metres.
    distance: f32,
}

fn sky_ray(position: vec4<f32>) -> AirRay {
    let local = view_point(ndc_of(position), 1.0);
    if (view.orthographic != 0u) {
        return AirRay(view.eye + world_direction(local), -view.back, 0.0);
    }
    return AirRay(view.eye, world_direction(normalize(local)), 0.0);
}

fn haze_ray(position: vec4<f32>, sample_index: u32) -> AirRay {
    let ndc = ndc_of(position);
    let local = view_point(ndc, max(depth_at(vec2<i32>(position.xy), i32(sample_index)), 1e-30));
    var start = vec3<f32>(0.0);
    var ahead = normalize(local);
    if (view.orthographic != 0u) {
        ahead = vec3<f32>(0.0, 0.0, -1.0);
        start = view_point(ndc, 1.0);
    }
    return AirRay(view.eye + world_direction(start), world_direction(ahead), distance(local, start));
}
