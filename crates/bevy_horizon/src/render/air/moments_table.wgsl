// The moments of diffuse light, one order of scattering after the other: a texel to a group, a direction to a lane. Needs
// moments_first.wgsl or moments_next.wgsl.

@group(0) @binding(0) var<uniform> medium: Medium;
@group(0) @binding(1) var<storage, read_write> transmittances: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> orders: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> multiple: array<vec4<f32>>;

const ORDER_TEXELS: u32 = 2304u; // 32 · 12 · 6

var<private> order_before: u32;
var<workgroup> parts: array<vec3<f32>, 288>; // 48 · 6
var<workgroup> whole_light: array<vec3<f32>, 6>;

fn transmittance_texel(x: u32, y: u32) -> vec3<f32> {
    return transmittances[y * TRANSMITTANCE_SIZE.x + x].rgb;
}

fn moment_at(order: u32, x: u32, y: u32, harmonic: u32) -> u32 {
    return order * ORDER_TEXELS + (y * MOMENTS_SIZE.x + x) * 6u + harmonic;
}

fn gather_order(order: u32, texel: vec2<u32>, lane: u32) {
    let part = moments_direction(medium, texel, lane, order == 0u);
    for (var i = 0u; i < 6u; i++) {
        parts[lane * 6u + i] = part[i];
    }
    workgroupBarrier();
    if (lane < 6u) {
        var sum = vec3<f32>(0.0);
        for (var i = 0u; i < 48u; i++) {
            sum += parts[i * 6u + lane];
        }
        orders[moment_at(order, texel.x, texel.y, lane)] = vec4<f32>(sum, 0.0);
        whole_light[lane] = sum;
    }
    workgroupBarrier();
}
