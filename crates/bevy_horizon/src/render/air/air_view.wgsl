// The air around a camera. Needs horizon_light's air.wgsl and sun.wgsl.

struct AirView {
    medium: Medium,
    // The sun above the air, in W m⁻² sr⁻¹ nm⁻¹.
    disc: SunDisc,
    // From radiance at the medium's wavelengths to linear sRGB in cd/m².
    to_rgb: mat3x3<f32>,
    // Diffuse light at the camera by its moments, in W m⁻² sr⁻¹ nm⁻¹, where the sun is the air's own; see `own_sun`.
    diffuse: array<vec3<f32>, 6>,
    // Towards the sun.
    sun: vec3<f32>,
    // The camera's altitude, and how far aerial perspective is kept, in metres.
    h: f32,
    // The camera's place above the eye's level in the passes' coordinates: what to subtract from y to get an altitude.
    datum: f32,
    far: f32,
    // Luminance of a moonless night, in cd/m².
    night: f32,
    // 1 where the sun's light is the air's to dim; 0 where the scene has a light of its own.
    own_sun: u32,
}

// Linear sRGB in cd/m². What lies outside of it is brought to its edge.
fn air_rgb(air: AirView, radiance: vec3<f32>) -> vec3<f32> {
    return max(air.to_rgb * radiance, vec3<f32>(0.0));
}
