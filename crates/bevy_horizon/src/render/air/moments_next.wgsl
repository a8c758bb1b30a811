// The orders that follow: each reads the one before. Goes with moments.wgsl.

fn moment_texel(x: u32, y: u32, harmonic: u32) -> vec3<f32> {
    return orders[moment_at(order_before, x, y, harmonic)].rgb;
}

@compute @workgroup_size(48, 1, 1)
fn second_order(@builtin(workgroup_id) texel: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    order_before = 0u;
    gather_order(1u, texel.xy, lane);
}

// The third order stands for all that follow, and the sum of all is what drawing reads.
@compute @workgroup_size(48, 1, 1)
fn third_order(@builtin(workgroup_id) texel: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    order_before = 1u;
    gather_order(2u, texel.xy, lane);
    if (lane < 6u) {
        let series = geometric_series(orders[moment_at(1u, texel.x, texel.y, 0u)].rgb, whole_light[0]);
        let sum = orders[moment_at(0u, texel.x, texel.y, lane)].rgb + orders[moment_at(1u, texel.x, texel.y, lane)].rgb
            + whole_light[lane] * series;
        multiple[moment_at(0u, texel.x, texel.y, lane)] = vec4<f32>(sum, 0.0);
    }
}
