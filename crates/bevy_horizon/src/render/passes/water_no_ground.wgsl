// Water where there is no ground.

fn sun_over_ground_at(o: vec3<f32>) -> f32 {
    return 1.0;
}

// How much water there is over the ground.
fn shoal_at(body: u32, o: vec3<f32>, footprint: f32) -> f32 {
    return 1e6;
}

struct Mirrored {
    // How far; negative where nothing is.
    t: f32,
    light: vec3<f32>,
}

fn mirrored_ground(o: vec3<f32>, direction: vec3<f32>) -> Mirrored {
    return Mirrored(-1.0, vec3<f32>(0.0));
}
