// The sky's light on a surface at the camera, by its moments: irradiance over π. Needs air_view.wgsl, horizon_light's harmonics.wgsl, and
// the uniform `air`.

fn skylight_on(normal: vec3<f32>) -> vec3<f32> {
    // Irradiance of a cosine lobe over π, as horizon_light's moments.rs has it.
    let above = max(normal.y, 0.0) * max(normal.y, 0.0);
    let level = max(length(air.sun.xz), 1e-6);
    let y = harmonics(normal.y, dot(normal.xz, air.sun.xz) / level);
    let m = air.diffuse;
    let sum = m[0] * y[0] + 0.66666667 * (m[1] * y[1] + m[2] * y[2]) + (0.25 + 0.05 * above) * (m[3] * y[3] + m[4] * y[4] + m[5] * y[5]);
    return air_rgb(air, max(sum, vec3<f32>(0.0))) + air.night;
}
