// The fast model's multiple scattering, after Hillaire (2020); the twin of isotropic.rs. The host declares
// fn isotropic_texel(x: u32, y: u32) -> vec3<f32>. The table is made with isotropic_compute.wgsl.

fn isotropic_at(air: Medium, h: f32, mu_s: f32) -> vec3<f32> {
    let c = cell(vec2(0.5 * mu_s + 0.5, h / air.height), vec2(32u));
    return bilinear(
        isotropic_texel(c.first.x, c.first.y),
        isotropic_texel(c.first.x + 1u, c.first.y),
        isotropic_texel(c.first.x, c.first.y + 1u),
        isotropic_texel(c.first.x + 1u, c.first.y + 1u),
        c.part,
    );
}

fn multiple_source(air: Medium, densities: vec3<f32>, at: SkyRay) -> vec3<f32> {
    return (air.rayleigh * densities.x + air.mie_scattering * densities.y) * isotropic_at(air, at.h, at.mu_s);
}

fn ground_irradiance(air: Medium, mu_s: f32) -> vec3<f32> {
    return 3.14159265 * isotropic_at(air, 0.0, mu_s);
}
