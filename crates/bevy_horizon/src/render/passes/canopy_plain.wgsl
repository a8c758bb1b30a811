// A scene without plants: nothing stands in the light.

fn canopy_transmittance(p: vec3<f32>, towards_sun: vec3<f32>) -> f32 {
    return 1.0;
}

fn canopy_open(p: vec3<f32>) -> f32 {
    return 1.0;
}
