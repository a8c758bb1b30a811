// The first order of scattering: sunlight. Goes with once.wgsl.

@compute @workgroup_size(48, 1, 1)
fn first_order(@builtin(workgroup_id) texel: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    gather_order(0u, texel.xy, lane);
}
