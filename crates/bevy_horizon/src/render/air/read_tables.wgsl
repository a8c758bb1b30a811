// The air's tables, to read.

@group(0) @binding(1) var<uniform> air: AirView;
@group(0) @binding(3) var<storage, read> transmittances: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> multiple: array<vec4<f32>>;

fn transmittance_texel(x: u32, y: u32) -> vec3<f32> {
    return transmittances[y * TRANSMITTANCE_SIZE.x + x].rgb;
}

fn moment_texel(x: u32, y: u32, harmonic: u32) -> vec3<f32> {
    return multiple[(y * 32u + x) * 6u + harmonic].rgb;
}

fn isotropic_texel(x: u32, y: u32) -> vec3<f32> {
    return multiple[y * 32u + x].rgb;
}
