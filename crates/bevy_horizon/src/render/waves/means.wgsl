// One level of the means of both textures: of 2 × 2 texels of the level before.

@group(0) @binding(0) var last_surface: texture_2d_array<f32>;
@group(0) @binding(1) var last_moments: texture_2d_array<f32>;
@group(0) @binding(2) var next_surface: texture_storage_2d_array<rgba16float, write>;
@group(0) @binding(3) var next_moments: texture_storage_2d_array<rgba16float, write>;

@compute @workgroup_size(8, 8, 1)
fn sea_means(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= textureDimensions(next_surface))) {
        return;
    }
    var surface = vec4<f32>(0.0);
    var moments = vec4<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        let at = 2u * id.xy + vec2<u32>(i & 1u, i >> 1u);
        surface += 0.25 * textureLoad(last_surface, at, id.z, 0);
        moments += 0.25 * textureLoad(last_moments, at, id.z, 0);
    }
    textureStore(next_surface, id.xy, id.z, surface);
    textureStore(next_moments, id.xy, id.z, moments);
}
