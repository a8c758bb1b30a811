// The air as the models compute with it; the twin of air.rs. SI units, a colour being the values at the three wavelengths.

struct Medium {
    rayleigh: vec3<f32>,
    rayleigh_height: f32,
    mie_scattering: vec3<f32>,
    mie_height: f32,
    mie_extinction: vec3<f32>,
    mie_asymmetry: f32,
    absorption: vec3<f32>,
    absorption_peak: f32,
    albedo: vec3<f32>,
    absorption_width: f32,
    irradiance: vec3<f32>,
    radius: f32,
    height: f32,
    // Cosine of the sun's zenith angle beyond which tables end.
    night: f32,
    // First and second Legendre moments of the Mie phase function.
    mie_moments: vec2<f32>,
}

fn air_densities(air: Medium, h: f32) -> vec3<f32> {
    return vec3(
        exponential_density(h, air.rayleigh_height),
        exponential_density(h, air.mie_height),
        tent_density(h, air.absorption_peak, air.absorption_width),
    );
}

fn air_extinction(air: Medium, densities: vec3<f32>) -> vec3<f32> {
    return extinction(densities, air.rayleigh, air.mie_extinction, air.absorption);
}
