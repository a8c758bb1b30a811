// The transmittance table, a texel to an invocation.

@group(0) @binding(0) var<uniform> medium: Medium;
@group(0) @binding(1) var<storage, read_write> transmittances: array<vec4<f32>>;

fn transmittance_texel(x: u32, y: u32) -> vec3<f32> {
    return transmittances[y * TRANSMITTANCE_SIZE.x + x].rgb;
}

@compute @workgroup_size(8, 8, 1)
fn transmittance_table(@builtin(global_invocation_id) id: vec3<u32>) {
    transmittances[id.y * TRANSMITTANCE_SIZE.x + id.x] = vec4<f32>(transmittance_compute(medium, id.xy), 1.0);
}
