// No light but the sun's own: single scattering, and the first pass of moments.wgsl's table. The twin of `Once` in scatter.rs.

fn multiple_source(air: Medium, densities: vec3<f32>, at: SkyRay) -> vec3<f32> {
    return vec3(0.0);
}

fn ground_irradiance(air: Medium, mu_s: f32) -> vec3<f32> {
    return vec3(0.0);
}
