// How the air thins with height, and what its layers take from light together; the twin of profile.rs. Lengths in
// metres.

fn exponential_density(h: f32, scale_height: f32) -> f32 {
    return exp(-h / scale_height);
}

fn tent_density(h: f32, peak: f32, width: f32) -> f32 {
    return max(1.0 - abs(h - peak) / width, 0.0);
}

// `layers`: densities, or columns in metres, of molecules, aerosols and the absorbing layer.
fn extinction(layers: vec3<f32>, rayleigh: vec3<f32>, mie: vec3<f32>, absorption: vec3<f32>) -> vec3<f32> {
    return layers.x * rayleigh + layers.y * mie + layers.z * absorption;
}
