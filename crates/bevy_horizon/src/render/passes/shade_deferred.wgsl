// Lights what the G-buffer holds, ground and meshes alike, in place of Bevy's own pass. Needs shade.wgsl, and a declaration of
// depth_at().
#import bevy_pbr::pbr_deferred_functions as bevy_deferred

// Where the depth texture of lighting ids holds Bevy's own.
@vertex
fn fullscreen_of_id(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let uv = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0;
    return vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 1.0 / 255.0, 1.0);
}

@fragment
fn shade(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let depth = depth_at(at, 0);
    let surfaces = textureLoad(bevy_bindings::deferred_prepass_texture, at, 0);
    var pbr = bevy_deferred::pbr_input_from_deferred_gbuffer(vec4<f32>(position.xy, depth, 0.0), surfaces);
    if ((pbr.material.flags & bevy_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT) != 0u) {
        return bevy_functions::main_pass_post_lighting_processing(pbr, pbr.material.base_color);
    }
    // From the eye, not through the world's coordinates: as exact far away.
    let p = drawn_point(position, depth);
    pbr.world_position = bevy_point(p);
    pbr.V = towards_eye(p);
    return lit(pbr, p, position);
}
